"""What is compared with what: the files tests/validation/NAME.toml."""
from __future__ import annotations

import hashlib
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from launcher import ROOT, WrongInput

FOLDER = ROOT / "tests" / "validation"


@dataclass(frozen=True)
class Reference:
    """A value with its tolerance (absolute), or a range that measurements span."""
    low: float
    high: float
    value: float | None

    def holds(self, ours: float) -> bool:
        return self.low <= ours <= self.high


@dataclass(frozen=True)
class Quantity:
    """One number: where it comes from (see measure.py) and what it is compared with."""
    name: str
    where: dict
    reference: Reference
    source: str
    unit: str = ""
    scale: float = 1.0  # from SI to `unit`, for tables
    remark: str = ""


@dataclass(frozen=True)
class Curve:
    """Two columns of a series over points of a reference: a picture."""
    series: str
    along: str
    column: str
    references: dict[str, list[list[float]]]
    labels: tuple[str, str]


@dataclass(frozen=True)
class Comparison:
    """A run of a scene, or of a program of tests, and the quantities that are read from it."""
    name: str
    title: str
    about: str
    minutes: float
    quantities: tuple[Quantity, ...]
    fingerprint: str
    scene: str = ""
    level: str = ""
    settings: tuple[str, ...] = ()
    program: str = ""
    filter: str = ""
    curves: tuple[Curve, ...] = field(default=())
    repeats: tuple[tuple[str, ...], ...] = ((),)  # further settings of each run; quantities are means over the runs


def read_all(folder: Path = FOLDER) -> list[Comparison]:
    """All comparisons, the cheapest first."""
    return sorted((read(file) for file in folder.glob("*.toml")), key=lambda each: (each.minutes, each.name))


def choose(names: list[str], comparisons: list[Comparison]) -> list[Comparison]:
    """Those with these names, all if there are none. Throws WrongInput."""
    known = {each.name: each for each in comparisons}
    for name in names:
        if name not in known:
            raise WrongInput(f"there is no comparison '{name}'; there are {', '.join(sorted(known))}")
    return [each for each in comparisons if not names or each.name in names]


def read(file: Path) -> Comparison:
    """Throws WrongInput naming file and key."""
    text = file.read_bytes()
    try:
        table = tomllib.loads(text.decode())
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise WrongInput(f"{file}: {error}") from None
    entries = Entries(file, table)
    scene, program = entries.text("scene", ""), entries.text("program", "")
    if bool(scene) == bool(program):
        raise WrongInput(f"{file}: must have either a scene or a program")
    quantities = tuple(read_quantity(Entries(file, each, f"quantity {n + 1}: "))
                       for n, each in enumerate(table.pop("quantity", [])))
    if not quantities:
        raise WrongInput(f"{file}: must have a [[quantity]]")
    curves = tuple(read_curve(Entries(file, each, f"curve {n + 1}: ")) for n, each in enumerate(table.pop("curve", [])))
    comparison = Comparison(file.stem, entries.text("title"), entries.text("about"), entries.number("minutes"),
                            quantities, hashlib.sha256(text).hexdigest()[:16], scene, entries.text("level", ""),
                            tuple(entries.take("set", [])), program, entries.text("filter", ""), curves,
                            tuple(tuple(each) for each in entries.take("repeats", [[]])))
    entries.finish()
    return comparison


def read_quantity(entries: Entries) -> Quantity:
    quantity = Quantity(entries.text("name"), entries.take("from"), read_reference(entries), entries.text("source"),
                        entries.text("unit", ""), entries.number("scale", 1.0), entries.text("remark", ""))
    entries.finish()
    return quantity


def read_reference(entries: Entries) -> Reference:
    """`range = [low, high]`, or `reference` with `tolerance` or `relative_tolerance`."""
    span = entries.take("range", None)
    if span is not None:
        return Reference(float(span[0]), float(span[1]), None)
    value = entries.number("reference")
    relative = entries.take("relative_tolerance", None)
    tolerance = abs(value) * float(relative) if relative is not None else entries.number("tolerance")
    return Reference(value - tolerance, value + tolerance, value)


def read_curve(entries: Entries) -> Curve:
    curve = Curve(entries.text("series"), entries.text("along"), entries.text("column"), entries.take("references"),
                  tuple(entries.take("labels")))
    entries.finish()
    return curve


class Entries:
    """A table that is used up: what is left over was written wrongly."""

    def __init__(self, file: Path, table: dict, where: str = "") -> None:
        self.file, self.table, self.where = file, table, where

    def take(self, key: str, *otherwise):
        if key not in self.table and not otherwise:
            raise WrongInput(f"{self.file}: {self.where}{key} is missing")
        return self.table.pop(key, *otherwise)

    def text(self, key: str, *otherwise: str) -> str:
        value = self.take(key, *otherwise)
        if not isinstance(value, str):
            raise WrongInput(f"{self.file}: {self.where}{key} must be a text, it is {value!r}")
        return value

    def number(self, key: str, *otherwise: float) -> float:
        value = self.take(key, *otherwise)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise WrongInput(f"{self.file}: {self.where}{key} must be a number, it is {value!r}")
        return float(value)

    def finish(self) -> None:
        if self.table:
            raise WrongInput(f"{self.file}: {self.where}unknown key {sorted(self.table)[0]}")
