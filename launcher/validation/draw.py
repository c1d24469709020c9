"""Curves of a run over the points of references."""
from __future__ import annotations

from pathlib import Path

import numpy
from matplotlib import pyplot

from launcher import Failure, style
from launcher.series import read_series
from launcher.validation.comparison import Comparison, Curve


def draw(comparison: Comparison, run: Path, folder: Path) -> list[str]:
    """Writes one picture per curve; their names."""
    style.apply()
    names = []
    for number, curve in enumerate(comparison.curves):
        name = f"{comparison.name}_{number + 1}.png" if len(comparison.curves) > 1 else f"{comparison.name}.png"
        folder.mkdir(parents=True, exist_ok=True)
        draw_curve(comparison.title, curve, run, folder / name)
        names.append(name)
    return names


def draw_curve(title: str, curve: Curve, run: Path, path: Path) -> None:
    series = read_series(run / "series" / curve.series)
    if series is None or not series.has(curve.along, curve.column):
        raise Failure(f"{run}/series/{curve.series}: there is no {curve.along} or {curve.column}")
    figure, ax = pyplot.subplots(figsize=(6, 3.8), constrained_layout=True)
    ax.plot(series[curve.along], series[curve.column], label="Polynya")
    for marker, (name, points) in zip("os^dv", curve.references.items()):
        ax.plot(*numpy.array(points).T, marker, mfc="none", label=name)
    ax.set(title=title, xlabel=curve.labels[0], ylabel=curve.labels[1])
    ax.legend()
    figure.savefig(path)
    pyplot.close(figure)
