"""Pictures of the vertical cut through the axis: water, air, ice, particles, vehicle; and of the pressure."""
from __future__ import annotations

from pathlib import Path

import matplotlib.patheffects
import numpy
from matplotlib import pyplot
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import Normalize, SymLogNorm
from matplotlib.ticker import MaxNLocator
from scipy.spatial import ConvexHull

from launcher import style
from launcher.sections import Section, View

MM = 1e3


def draw_section(ax: pyplot.Axes, section: Section, view: View, what: str) -> None:
    """One moment; `what` is "materials" or "pressure"."""
    ax.set_facecolor(style.AIR)
    if what == "pressure":
        mesh(ax, section, view, "pressure", cmap=style.PRESSURE_MAP, norm=view.pressure)
        waterline(ax, section, view)
    else:
        mesh(ax, section, view, "water_fraction", cmap=style.WATER_MAP, vmin=0, vmax=1)
    plain = what == "pressure"
    if (view.scene.get("fluid") or {}).get("bodies"):
        bodies(ax, section, view)
    if section.ice is not None:
        cells(ax, section.ice, section.ice_damage, view, Normalize(0, 1), style.DAMAGE_MAP,
              "#f4f4f4" if plain else None)
    if section.particles is not None:
        dots(ax, section, view, "#dddddd" if plain else None)
    if section.vehicle is not None and len(section.vehicle):
        hull(ax, section, view)
        cells(ax, section.vehicle, section.vehicle_stress, view, view.stress, style.STRESS_MAP,
              "#8a8a8a" if plain else None)
    ax.set_xlim(view.x[0] * MM, view.x[1] * MM)
    ax.set_ylim(view.z[0] * MM, view.z[1] * MM)
    ax.set_aspect("equal")
    ax.grid(False)
    ax.spines[["top", "right"]].set_visible(True)
    text = ax.text(0.03, 0.975, f"{section.time * 1e3:.2f} ms", transform=ax.transAxes, va="top", fontweight="bold")
    text.set_path_effects([matplotlib.patheffects.withStroke(linewidth=2.5, foreground="white")])


def sides(view: View) -> tuple[int, ...]:
    return (1, -1) if view.mirrored else (1,)


def mesh(ax: pyplot.Axes, section: Section, view: View, name: str, **colours) -> None:
    if name not in section.fluid:
        return
    for side in sides(view):
        ax.pcolormesh(side * section.x * MM, section.z * MM, section.fluid[name], shading="flat", rasterized=True,
                      **colours)


def bodies(ax: pyplot.Axes, section: Section, view: View) -> None:
    """Bodies that have no mesh of their own: where more than half of the cells is solid."""
    solid = section.fluid.get("solid_fraction")
    if solid is None:
        return
    x, z = (0.5 * (line[1:] + line[:-1]) for line in (section.x, section.z))
    if view.mirrored:
        x, solid = numpy.concatenate([-x[::-1], x]), numpy.concatenate([solid[:, ::-1], solid], axis=1)
    ax.contourf(x * MM, z * MM, solid, levels=[0.5, 2.0], colors=["#8a8a8a"])


def waterline(ax: pyplot.Axes, section: Section, view: View) -> None:
    water = section.fluid.get("water_fraction")
    if water is None or min(water.shape) < 2:
        return
    x, z = ((line[1:] + line[:-1]) / 2 * MM for line in (section.x, section.z))
    if view.mirrored:
        x, water = numpy.concatenate([-x[::-1], x]), numpy.hstack([water[:, ::-1], water])
    ax.contour(x, z, water, levels=[0.5], colors=style.INK, linewidths=0.7, zorder=1)


def cells(ax: pyplot.Axes, places: numpy.ndarray, values: numpy.ndarray, view: View, norm: Normalize, colours: object,
          plain: str | None) -> None:
    """Cut cells by value, or all in one colour."""
    for side in sides(view):
        collection = PolyCollection(places * [side * MM, MM], linewidths=0.25, rasterized=True)
        if plain:
            collection.set(facecolor=plain, edgecolor="#555555")
        else:
            collection.set(array=values, cmap=colours, norm=norm, edgecolor=(0.2, 0.2, 0.2, 0.35))
        ax.add_collection(collection)


def hull(ax: pyplot.Axes, section: Section, view: View) -> None:
    """What lies inside the vehicle's outline (heads and cylinder are convex) is neither water nor air."""
    corners = numpy.concatenate([section.vehicle.reshape(-1, 2) * [side * MM, MM] for side in sides(view)])
    outline = corners[ConvexHull(corners).vertices]
    ax.add_collection(PolyCollection([outline], facecolor="#e4e4e8", edgecolor="#777777", linewidths=0.5))


def dots(ax: pyplot.Axes, section: Section, view: View, plain: str | None) -> None:
    size = numpy.full(len(section.particles), view.particle_size * MM)
    for side in sides(view):
        collection = EllipseCollection(size, size, numpy.zeros(len(size)), units="xy", linewidths=0.3,
                                       offsets=section.particles * [side * MM, MM], transOffset=ax.transData)
        if plain:
            collection.set(facecolor=plain, edgecolor="#555555")
        else:
            collection.set(array=section.particle_damage, cmap=style.DAMAGE_MAP, norm=Normalize(0, 1),
                           edgecolor=(1, 1, 1, 0.7))
        ax.add_collection(collection)


def draw_sheet(sections: list[Section], view: View, path: Path, what: str) -> Path:
    """All moments side by side with common axes and scales."""
    columns = min(len(sections), 3 if view.x[1] - view.x[0] < 2 * (view.z[1] - view.z[0]) else 1)
    rows = -(-len(sections) // columns)
    shape = (view.z[1] - view.z[0]) / (view.x[1] - view.x[0])
    panel_width = min(8.6 / columns - 0.18, 9.0 / shape)
    panel_height = panel_width * shape
    width, height = max(7.0, columns * (panel_width + 0.18) + 0.8), 0.45 + rows * (panel_height + 0.14) + 1.15
    figure, axes = pyplot.subplots(rows, columns, figsize=(width, height), sharex=True, sharey=True, squeeze=False)
    figure.subplots_adjust(left=0.62 / width, right=1 - 0.12 / width, top=1 - 0.45 / height, bottom=1.2 / height,
                           wspace=0.06, hspace=0.14 / panel_height)
    for ax in axes.flat[len(sections):]:
        ax.set_visible(False)
    for ax, section in zip(axes.flat, sections):
        draw_section(ax, section, view, what)
    for ax in axes[:, 0]:
        ax.set_ylabel("z  [mm]")
        ticks = min(9, max(2, int(2.2 * panel_height)))
        ax.yaxis.set_major_locator(MaxNLocator(ticks, prune="both", steps=[1, 2, 5, 10]))
    for ax in axes[-1]:
        ax.set_xlabel("x  [mm]")
    legends(figure, sections, view, what, height)
    style.heading(figure, view.scene.get("title") or "", "pressure in the cut y = 0" if what == "pressure" else
                  "cut y = 0" + (", mirrored at x = 0" if view.mirrored else ""))
    figure.savefig(path)
    pyplot.close(figure)
    return path


def legends(figure: pyplot.Figure, sections: list[Section], view: View, what: str, height: float) -> None:
    """Colour bars in a row under the panels."""
    bars: list[tuple[ScalarMappable, str]] = []
    if what == "pressure":
        bars.append((ScalarMappable(view.pressure, style.PRESSURE_MAP), "gauge pressure  [Pa]"))
    else:
        if any(section.vehicle is not None for section in sections):
            factor, prefix = style.scale(view.stress.vmax)
            bars.append((ScalarMappable(Normalize(0, view.stress.vmax * factor), style.STRESS_MAP),
                         f"von Mises stress of the vehicle  [{prefix}Pa]"))
        if any(section.ice is not None for section in sections):
            bars.append((ScalarMappable(Normalize(0, 1), style.DAMAGE_MAP), "damage of the ice"))
        if any("water_fraction" in section.fluid for section in sections):
            bars.append((ScalarMappable(Normalize(0, 1), style.WATER_MAP), "share of water"))
    for number, (mappable, label) in enumerate(bars):
        room = 0.92 / len(bars)
        ax = figure.add_axes([0.06 + number * room, 0.42 / height, room - 0.06, 0.10 / height])
        ticks = decades(view.pressure) if what == "pressure" else None
        bar = figure.colorbar(mappable, cax=ax, orientation="horizontal", label=label, ticks=ticks)
        bar.outline.set_visible(False)


def decades(scale: SymLogNorm) -> list[float]:
    """Ticks of a symmetric logarithmic scale: zero and the powers of ten outside the linear part."""
    powers = 10.0 ** numpy.arange(round(numpy.log10(scale.linthresh)), numpy.log10(scale.vmax) + 1e-9)
    return [*-powers[::-1], 0.0, *powers]
