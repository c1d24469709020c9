"""Time series as the solvers write them: CSV with a header `name [unit],...`, readable while it grows."""
from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy

HEADER = re.compile(r"^\s*(?P<name>.*?)\s*(?:\[(?P<unit>[^\]]*)\])?\s*$")


@dataclass(frozen=True)
class Series:
    """Columns by name (arrays of one length) and their units."""

    columns: dict[str, numpy.ndarray]
    units: dict[str, str]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def has(self, *names: str) -> bool:
        return all(name in self.columns for name in names)

    def __getitem__(self, name: str) -> numpy.ndarray:
        return self.columns[name]

    def renamed(self, names: dict[str, str]) -> Series:
        """The same columns, those in `names` under their new name."""
        return Series({names.get(name, name): values for name, values in self.columns.items()},
                      {names.get(name, name): unit for name, unit in self.units.items()})

    def last(self, name: str) -> float | None:
        """The last finite value of a column; None where there is none."""
        values = self.columns.get(name, numpy.empty(0))
        finite = values[numpy.isfinite(values)]
        return float(finite[-1]) if len(finite) else None

    def ordered(self, *needed: str) -> Series:
        """Only rows with numbers in the needed columns and with times (first column) later than all before."""
        first = next(iter(self.columns))
        good = numpy.logical_and.reduce([numpy.isfinite(self.columns[name]) for name in (first, *needed)])
        latest = numpy.maximum.accumulate(numpy.where(good, self.columns[first], -numpy.inf))
        good[1:] &= self.columns[first][1:] > latest[:-1]
        return Series({name: values[good] for name, values in self.columns.items()}, self.units)


def parse_header(line: str) -> tuple[list[str], list[str]]:
    """Names and units of a header line; without one, or with [-], the unit is ''."""
    matches = [HEADER.match(part) for part in line.rstrip("\n").split(",")]
    units = [match["unit"] or "" for match in matches]
    return [match["name"] for match in matches], ["" if unit == "-" else unit for unit in units]


def parse_row(line: str, width: int) -> list[float] | None:
    """The numbers of a complete row (empty or unreadable: nan); None for a row cut off by a crash."""
    parts = line.rstrip("\n").split(",")
    if len(parts) != width:
        return None
    return [to_number(part) for part in parts]


def to_number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("nan")


def read_series(path: Path) -> Series | None:
    """A whole file; None if there is no file or no complete row in it."""
    if not path.is_file():
        return None
    with open(path, encoding="utf-8", errors="replace") as lines:
        names, units = parse_header(lines.readline())
        # A last line without its end was cut off while being written.
        rows = [row for row in (parse_row(line, len(names)) for line in lines if line.endswith("\n")) if row]
    if not rows:
        return None
    table = numpy.array(rows)
    return Series({name: table[:, i] for i, name in enumerate(names)}, dict(zip(names, units)))


class Tail:
    """The latest complete row of a growing file, without reading the whole of it."""

    CHUNK = 8192

    def __init__(self, path: Path) -> None:
        self.path = path
        self.names: list[str] = []
        self.first: dict[str, float] = {}  # the first row, once it has been seen

    def latest(self) -> dict[str, float]:
        """Values by column name; empty as long as there is no complete row."""
        try:
            with open(self.path, "rb") as file:
                if not self.names:
                    header = file.readline()
                    if not header.endswith(b"\n"):
                        return {}
                    self.names, _ = parse_header(header.decode("utf-8", "replace"))
                if not self.first:
                    file.seek(0)
                    file.readline()
                    line = file.readline()
                    self.first = self.row(line) if line.endswith(b"\n") else {}
                size = file.seek(0, 2)
                file.seek(max(0, size - self.CHUNK))
                lines = file.read().split(b"\n")[:-1]
        except OSError:
            return {}
        return next((row for row in map(self.row, reversed(lines)) if row), {})

    def row(self, line: bytes) -> dict[str, float]:
        """Values of a line; empty if it is cut off, or the header, which reads as nan."""
        values = parse_row(line.decode("utf-8", "replace"), len(self.names))
        return dict(zip(self.names, values)) if values and values[0] == values[0] else {}
