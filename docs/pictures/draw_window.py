"""Draws the order of events in one span of a coupled run from the waits that its processes recorded.

    /usr/bin/python3 docs/pictures/draw_window.py RUN docs/pictures/window.svg

The span is the quickest of the run: the one that other work on the machine disturbed least."""
from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from launcher import critical_path, style  # noqa: E402
from launcher.critical_path import Wait  # noqa: E402
from matplotlib import pyplot  # noqa: E402

NAMES = ("fluid", "coupler", "ice", "structure")
MESSAGES = {("coupler", "fluid"): "span", ("fluid", "coupler"): "pressure", ("coupler", "ice"): "loads",
            ("coupler", "structure"): "loads", ("ice", "coupler"): "surface", ("structure", "coupler"): "surface"}
COLOURS = {"structure": style.VERMILION, "ice": style.SKY, "fluid": style.BLUE, "coupler": style.ORANGE}


def quickest_span(fluid: list[Wait]) -> tuple[float, float]:
    """From one word to the fluid, `span`, to the next."""
    begins = [wait.end for wait in fluid[2:]]
    return min(zip(begins, begins[1:]), key=lambda span: span[1] - span[0])


def busy(waits: list[Wait], start: float, end: float) -> list[tuple[float, float]]:
    """When a process was not blocked."""
    times = []
    for before, after in zip(waits, waits[1:]):
        begin, stop = max(before.end, start), min(after.begin, end)
        if stop > begin:
            times.append((begin, stop))
    return times


def draw(waits: dict[str, list[Wait]], axes: pyplot.Axes) -> None:
    start, end = quickest_span(waits["fluid"])
    margin = 0.06 * (end - start)
    start, end = start - margin, end + margin
    row = {name: len(NAMES) - 1 - i for i, name in enumerate(NAMES)}
    said: set[str] = set()
    for name in NAMES:
        bars = [(1e3 * (a - start), 1e3 * (b - a)) for a, b in busy(waits[name], start, end)]
        axes.broken_barh(bars, (row[name] - 0.3, 0.6), color=COLOURS[name], linewidth=0)
        for wait in waits[name]:
            if start < wait.end < end and (name == "coupler" or wait.whom == "coupler"):
                at = 1e3 * (wait.end - start)
                axes.annotate("", (at, row[name] + 0.3 * sign(row[wait.whom] - row[name])),
                              (at, row[wait.whom] - 0.3 * sign(row[wait.whom] - row[name])),
                              arrowprops={"arrowstyle": "-|>", "color": style.INK, "lw": 0.7, "shrinkA": 0,
                                          "shrinkB": 0, "mutation_scale": 7})
                word = MESSAGES[wait.whom, name]
                if word not in said:
                    other = wait.whom if name == "coupler" else name
                    beside = row["coupler"] + 0.5 * sign(row[other] - row["coupler"])
                    to_the_left = word != "surface"
                    axes.text(at, beside, f"{word} " if to_the_left else f" {word}", fontsize=8.5, va="center",
                              ha="right" if to_the_left else "left",
                              bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.4, "alpha": 0.8})
                said.add(word)
    axes.set_yticks([row[name] for name in NAMES], NAMES)
    axes.set_xlim(0, 1e3 * (end - start))
    axes.set_ylim(-0.6, len(NAMES) - 0.4)
    axes.set_xlabel("wall time, ms")
    axes.grid(axis="y", visible=False)
    axes.spines["left"].set_visible(False)
    axes.tick_params(axis="y", length=0)


def sign(number: int) -> int:
    return (number > 0) - (number < 0)


def main(run: Path, picture: Path) -> None:
    style.apply()
    pyplot.rcParams.update({"svg.fonttype": "path", "svg.hashsalt": "window"})
    figure, axes = pyplot.subplots(figsize=(9, 2.9))
    draw(critical_path.read_waits(run, list(NAMES)), axes)
    figure.subplots_adjust(left=0.085, right=0.985, top=0.97, bottom=0.16)
    figure.savefig(picture, metadata={"Date": None} if picture.suffix == ".svg" else None)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
