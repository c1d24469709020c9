"""Curves of a solver that runs alone: its series over time, and profiles along a line beside the exact solution."""
from __future__ import annotations

from pathlib import Path

import numpy
from matplotlib import pyplot

from launcher import style
from launcher.draw_curves import MILLI, finish, save
from launcher.series import Series

SCALED = ("Pa", "J", "N", "m", "s", "Hz")  # units that take a prefix; "km/s" or "mkg" would not read well


def draw_columns(scene: dict, series: Series, path: Path) -> Path | None:
    """The series of a solver that runs alone: one panel per unit, whatever the columns are."""
    abscissa = next(iter(series.columns))
    groups: dict[str, list[str]] = {}
    for name in list(series.columns)[1:]:
        values = series[name][numpy.isfinite(series[name])]
        if name not in ("step", "window", "span") and len(values) and numpy.ptp(values) > 0:
            groups.setdefault(series.units[name], []).append(name)
    if not groups or len(series) < 2:
        return None
    figure, axes = pyplot.subplots(len(groups), 1, figsize=(7.4, 0.9 + 1.75 * len(groups)), sharex=True, squeeze=False)
    for ax, (unit, names) in zip(axes[:, 0], groups.items()):
        largest = max(numpy.nanmax(abs(series[name])) for name in names)
        factor, prefix = style.scale(largest) if unit in SCALED else (1.0, "")
        for name in names:
            ax.plot(series[abscissa] * MILLI, series[name] * factor, label=name.replace("_", " "), lw=1.2)
        ax.set_ylabel(f"[{prefix}{unit}]" if unit else "")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    finish(figure, list(axes[:, 0]), scene, {}, series[abscissa][-1])
    figure.subplots_adjust(right=0.74)
    return save(figure, path)


def draw_profiles(scene: dict, series: Series, path: Path) -> Path | None:
    """A solution along a line (the first column) with the exact one, in columns `exact_NAME` or `NAME_exact`."""
    abscissa, *names = series.columns
    exact = {name: other for name in names for other in (f"exact_{name}", f"{name}_exact") if other in names}
    plain = [name for name in names if name not in exact.values()]
    if not plain:
        return None
    figure, axes = pyplot.subplots(len(plain), 1, figsize=(7.4, 0.9 + 1.9 * len(plain)), sharex=True, squeeze=False)
    for ax, name in zip(axes[:, 0], plain):
        unit = series.units[name].replace("^2", "²").replace("^3", "³")
        factor, prefix = style.scale(numpy.nanmax(abs(series[name]))) if unit in SCALED else (1.0, "")
        if name in exact:
            ax.plot(series[abscissa], series[exact[name]] * factor, color=style.INK, lw=1.0, label="exact")
        ax.plot(series[abscissa], series[name] * factor, ".", ms=3.2, color=style.VERMILION, label="computed")
        ax.set_ylabel(name.replace("_", " ") + (f"  [{prefix}{unit}]" if unit else ""))
        ax.margins(x=0)
    axes[0, 0].legend(loc="best")
    axes[-1, 0].set_xlabel(f"{abscissa}  [{series.units[abscissa]}]")
    height = figure.get_size_inches()[1]
    figure.subplots_adjust(left=0.115, right=0.975, top=1 - 0.55 / height, bottom=0.48 / height, hspace=0.18)
    figure.align_ylabels(list(axes[:, 0]))
    style.heading(figure, scene.get("title") or "", scene.get("level") or "")
    return save(figure, path)
