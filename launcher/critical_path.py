"""Who kept the others waiting: the critical path of a coupled run (docs/coupling.md), from the waits that every process
wrote (RUN/logs/NAME_waits.csv, on the clock that all processes of a machine share)."""
from __future__ import annotations

import csv
from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from launcher.effect_times import MESSAGES, computed

COUPLER = "coupler"
UNTOLD = {"exchange_share": None, "overlap_share": None, "critical_path": None}


@dataclass(frozen=True)
class Wait:
    """A process was blocked until a message came from `whom`. Seconds."""

    begin: float
    end: float
    whom: str


@dataclass(frozen=True)
class Stretch:
    """A part of the critical path: what `process` did; None: a message was on its way."""

    begin: float
    end: float
    process: str | None


def read_waits(folder: Path, names: list[str]) -> dict[str, list[Wait]]:
    """Per process its waits in the order of time; only processes that wrote them."""
    found = {}
    for name in names:
        try:
            with open(folder / "logs" / f"{name}_waits.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.reader(file))[1:]
            found[name] = sorted((Wait(float(a), float(b), whom) for a, b, whom in rows), key=lambda wait: wait.end)
        except (OSError, ValueError):
            continue
    return found


def first_window(waits: dict[str, list[Wait]]) -> float:
    """When the last solver had its first word from the coupler, `begin`."""
    return max(own[0].end for name, own in waits.items() if name != COUPLER)


def walk(waits: dict[str, list[Wait]]) -> Iterator[Stretch]:
    """From the end of the run back to its first window: what a process does began when it was woken by a message; what
    went on then is what its sender did before."""
    start = first_window(waits)
    last = waits[COUPLER][-1]
    process, time = last.whom, last.end
    ends = {name: [wait.end for wait in own] for name, own in waits.items()}
    while time > start:
        own = waits[process]
        i = bisect_left(ends[process], time)  # the first wait that ends now or later
        if i < len(own) and own[i].begin < time:
            yield Stretch(max(start, own[i].begin), time, None)  # it had sent its message and slept again
            time = own[i].begin
        elif i == 0:
            yield Stretch(start, time, process)
            return
        else:
            yield Stretch(max(start, own[i - 1].end), time, process)
            time, process = own[i - 1].end, own[i - 1].whom


def read_cuts(folder: Path) -> list[tuple[float, float]]:
    """When the coupler cut the fluid's grid, in the order of time; empty if it did not."""
    try:
        with open(folder / "logs" / f"{COUPLER}_cuts.csv", newline="", encoding="utf-8") as file:
            return [(float(begin), float(end)) for begin, end in list(csv.reader(file))[1:]]
    except (OSError, ValueError):
        return []


def time_within(stretch: Stretch, intervals: list[tuple[float, float]]) -> float:
    """Seconds of a stretch that lie in one of the intervals, which do not overlap."""
    first = max(0, bisect_left(intervals, (stretch.begin,)) - 1)
    sum_of_parts = 0.0
    for begin, end in intervals[first:]:
        if begin >= stretch.end:
            break
        sum_of_parts += max(0.0, min(end, stretch.end) - max(begin, stretch.begin))
    return sum_of_parts


def summary(folder: Path, processes: dict[str, dict]) -> dict | None:
    """Seconds on the critical path per process and of messages, the share of exchange, and the part of that share which
    is the cutting of the grid; None if not all told."""
    waits = read_waits(folder, list(processes))
    if COUPLER not in waits or set(waits) != set(processes) or not all(waits.values()):
        return None
    path = dict.fromkeys([*processes, MESSAGES], 0.0)
    cuts, cutting = read_cuts(folder), 0.0
    for stretch in walk(waits):
        path[stretch.process or MESSAGES] += stretch.end - stretch.begin
        if stretch.process == COUPLER:
            cutting += time_within(stretch, cuts)
    total = sum(path.values())
    if total <= 0:
        return None
    exchange = path[COUPLER] + path[MESSAGES]
    for name, report in processes.items():
        seconds = report.get("seconds") or {}
        if name != COUPLER and seconds:
            exchange += path[name] * seconds.get(MESSAGES, 0.0) / (seconds.get(MESSAGES, 0.0) + computed(seconds))
    return {"exchange_share": exchange / total, "overlap_share": cutting / total, "critical_path": path}
