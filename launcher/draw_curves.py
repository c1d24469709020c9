"""Curves over time of the coupled run: motion and loads, energies, with the three stages of the passage marked."""
from __future__ import annotations

from pathlib import Path

import numpy
from matplotlib import pyplot

from launcher import definitions, style
from launcher.series import Series

MILLI = 1e3
STAGES = ("approach", "breaking", "passing")
SHADES = ("#ffffff", "#f2e8dc", "#f6f4f0")
RESERVOIRS = (("vehicle_kinetic", "vehicle, kinetic", style.BLUE, "-"),
              ("vehicle_internal", "vehicle, internal", style.SKY, "-"),
              ("ice_kinetic", "ice, kinetic", style.ORANGE, "-"),
              ("ice_internal", "ice, internal", style.VERMILION, "-"),
              ("fluid_energy_change", "water and air", style.GREEN, "-"),
              ("contact_energy", "contact", style.PURPLE, "-"), ("dissipated", "dissipated", style.INK, "-"),
              ("external_work", "work from outside", style.QUIET, "--"),
              ("numerical_work", "numerical work", style.QUIET, ":"))

ERRORS = (("energy_error", "energy", style.VERMILION), ("momentum_error", "momentum", style.BLUE))


def changes(series: Series, name: str) -> bool:
    """Is there a curve to draw? A column of a part that the scene does not have stays at zero."""
    return series.has(name) and bool(numpy.nan_to_num(series[name]).any())


def stage_limits(summary: dict, end: float) -> list[tuple[str, float, float]]:
    """Name, begin and end (s) of the stages: until first contact, until the shoulder is clear, and after."""
    contact, clear = summary.get("first_contact_time"), summary.get("shoulder_clear_time")
    if contact is None:
        return []
    cleared = contact + clear if clear is not None else end
    limits = [("approach", 0.0, contact), ("breaking", contact, cleared), ("passing", cleared, end)]
    return [limit for limit in limits if limit[2] > limit[1]]


def mark_stages(axes: list[pyplot.Axes], limits: list[tuple[str, float, float]], end: float) -> None:
    """Shades the stages in all panels and names them above the first."""
    for name, begin, until in limits:
        for panel in axes:
            panel.axvspan(begin * MILLI, until * MILLI, color=SHADES[STAGES.index(name)], lw=0, zorder=-5)
        if until - begin > 0.05 * end:
            axes[0].annotate(name, ((begin + until) / 2 * MILLI, 1.0), xycoords=("data", "axes fraction"),
                             xytext=(0, 3), textcoords="offset points", ha="center", color=style.QUIET, fontsize=8.5,
                             style="italic")


def draw_motion(scene: dict, summary: dict, series: Series, path: Path) -> Path | None:
    """Speed, deceleration, forces and head stress one above the other."""
    time = series["time"]
    panels = [panel for panel in (speed_panel, deceleration_panel, force_panel, stress_panel)
              if any(changes(series, name) for name in NEEDED[panel])]
    if not panels or len(time) < 2:
        return None
    height = 0.9 + 1.75 * len(panels)
    figure, axes = pyplot.subplots(len(panels), 1, figsize=(7.4, height), sharex=True, squeeze=False)
    axes = list(axes[:, 0])
    for panel, ax in zip(panels, axes):
        panel(ax, scene, summary, series)
    finish(figure, axes, scene, summary, time[-1])
    return save(figure, path)


def finish(figure: pyplot.Figure, axes: list[pyplot.Axes], scene: dict, summary: dict, end: float) -> None:
    axes[-1].set_xlabel("time  [ms]")
    axes[-1].set_xlim(0, end * MILLI)
    mark_stages(axes, stage_limits(summary, end), end)
    height = figure.get_size_inches()[1]
    figure.subplots_adjust(left=0.115, right=0.975, top=1 - 0.66 / height, bottom=0.48 / height, hspace=0.18)
    figure.align_ylabels(axes)
    style.heading(figure, scene.get("title") or "", scene.get("level") or "")


def save(figure: pyplot.Figure, path: Path) -> Path:
    figure.savefig(path)
    pyplot.close(figure)
    return path


def speed_panel(ax: pyplot.Axes, _scene: dict, summary: dict, series: Series) -> None:
    ax.plot(series["time"] * MILLI, series["vehicle_speed"], color=style.BLUE)
    ax.set_ylabel("speed  [m/s]")
    residual, through = summary.get("residual_speed"), summary.get("through_time")
    if residual is not None and through is not None:
        ax.plot(through * MILLI, residual, "o", ms=5, color=style.BLUE)
        ax.annotate(f"through: {residual:.2f} m/s at {through * MILLI:.2f} ms", (through * MILLI, residual),
                    xytext=(4, 9), textcoords="offset points", fontsize=8.5, color=style.INK)
    ax.margins(y=0.12)


def deceleration_panel(ax: pyplot.Axes, scene: dict, summary: dict, series: Series) -> None:
    time, speed = series["time"], series["vehicle_speed"]
    frequency = scene["run"]["filter_frequency"]
    raw = definitions.raw_deceleration(time, speed)
    filtered = definitions.filtered_deceleration(time, speed, frequency)
    factor, label = (1e-3, "deceleration  [10³ m/s²]") if abs(filtered).max() > 1e3 else (1, "deceleration  [m/s²]")
    ax.plot(time * MILLI, raw * factor, color="#b9b9b9", lw=0.6, label="raw")
    ax.plot(time * MILLI, filtered * factor, color=style.VERMILION, label=f"filtered, {frequency / 1e3:g} kHz")
    limit_to(ax, filtered * factor, raw * factor)
    ax.set_ylabel(label)
    ax.legend(loc="upper right", ncols=2)


def force_panel(ax: pyplot.Axes, scene: dict, _summary: dict, series: Series) -> None:
    """Contact is a rattle of short blows: the filtered force over the raw one, as for the deceleration."""
    shown = [(name, label, color) for name, label, color in (
        ("contact_force", "ice", style.ORANGE), ("fluid_force", "water and air", style.GREEN))
        if changes(series, name)]
    time, frequency = series["time"], scene["run"]["filter_frequency"]
    smooth = {name: definitions.filtered(time, numpy.nan_to_num(series[name]), frequency) for name, _, _ in shown}
    factor, prefix = style.scale(max(abs(values).max() for values in smooth.values()))
    for name, label, color in shown:
        ax.plot(time * MILLI, series[name] * factor, color=color, lw=0.4, alpha=0.35)
        ax.plot(time * MILLI, smooth[name] * factor, color=color, lw=1.4, label=label)
    raw = numpy.array([series[name] for name in smooth])
    limit_to(ax, numpy.array(list(smooth.values())) * factor, raw * factor)
    ax.set_ylabel(f"force on vehicle  [{prefix}N]")
    ax.legend(loc="best", ncols=2)


def limit_to(ax: pyplot.Axes, smooth: numpy.ndarray, raw: numpy.ndarray) -> None:
    """The raw curve may spike far beyond what matters: the filtered one sets the range."""
    low, high = smooth.min(), smooth.max()
    room = 0.35 * max(high - low, 1e-12)
    ax.set_ylim(max(low - room, min(low, numpy.nanmin(raw)) - 0.1 * room),
                min(high + room, max(high, numpy.nanmax(raw)) + 0.3 * room))


def stress_panel(ax: pyplot.Axes, _scene: dict, _summary: dict, series: Series) -> None:
    stress = series["head_stress"]
    factor, prefix = style.scale(numpy.nanmax(abs(stress)))
    ax.plot(series["time"] * MILLI, stress * factor, color=style.PURPLE, lw=1.2)
    ax.set_ylabel(f"head stress  [{prefix}Pa]")
    ax.set_ylim(bottom=0)


NEEDED = {speed_panel: ("vehicle_speed",), deceleration_panel: ("vehicle_speed",),
          force_panel: ("contact_force", "fluid_force"), stress_panel: ("head_stress",)}


def draw_energies(scene: dict, summary: dict, series: Series, path: Path) -> Path | None:
    """Every reservoir relative to the start, and the errors of the ledger below."""
    shown = [row for row in RESERVOIRS if changes(series, row[0])]
    if len(shown) < 2 or len(series) < 2:
        return None
    time = series["time"] * MILLI
    errors = [row for row in ERRORS if series.has(row[0])]
    shape = {"height_ratios": [2.6, 1]} if errors else {}
    figure, axes = pyplot.subplots(2 if errors else 1, 1, figsize=(7.4, 5.4), sharex=True, squeeze=False,
                                   gridspec_kw=shape)
    axes = list(axes[:, 0])
    gained = {name: series[name] - series[name][0] for name, *_ in shown}
    factor, prefix = style.scale(max(numpy.nanmax(abs(change)) for change in gained.values()))
    axes[0].axhline(0, color=style.QUIET, lw=0.7)
    for name, label, color, line in shown:
        axes[0].plot(time, gained[name] * factor, line, color=color, label=label)
    axes[0].set_ylabel(f"energy since the start  [{prefix}J]")
    axes[0].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    if errors:
        error_panel(axes[1], series, errors)
    finish(figure, axes, scene, summary, series["time"][-1])
    figure.subplots_adjust(right=0.78)
    return save(figure, path)


def error_panel(ax: pyplot.Axes, series: Series, errors: list[tuple[str, str, str]]) -> None:
    for name, label, color in errors:
        ax.plot(series["time"] * MILLI, numpy.maximum(abs(series[name]), 1e-16), color=color, lw=1.2, label=label)
    ax.set_yscale("log")
    ax.set_ylim(bottom=max(ax.get_ylim()[0], 1e-13))
    ax.set_ylabel("relative error")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
