"""Draws load over time of runs of cases/four_point_bending with different elements, and the damage of the last frame.

    ./polynya run cases/four_point_bending --set ice.width="60 mm" --out R1
    ./polynya run cases/four_point_bending --set ice.width="60 mm" --level standard --out R2
    /usr/bin/python3 docs/pictures/draw_bending.py docs/pictures/four_point_bending.png R1 R2 ..."""
from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy
from matplotlib import pyplot
from matplotlib.collections import PolyCollection

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from launcher import fields, sections, style  # noqa: E402
from launcher.series import read_series  # noqa: E402


def draw(target: Path, runs: list[Path]) -> None:
    style.apply()
    figure, (curves, cut) = pyplot.subplots(2, 1, figsize=(7.4, 5.4), height_ratios=(3, 1.3))
    colours = (style.INK, style.VERMILION, style.BLUE, style.GREEN)
    for run, colour in zip(runs, colours):
        scene = json.loads((run / "scene.json").read_text())
        series = read_series(run / "series" / "ice.csv")
        size = 1e3 * scene["resolution"]["ice_element"]
        curves.plot(1e3 * series["time"], 1e-3 * series["load"], color=colour, lw=1.0, label=f"{size:.3g} mm")
    ice = scene["ice"]
    arm = 0.5 * (ice["bending"]["support_span"] - ice["bending"]["load_span"])
    summary = json.loads((run / "ice_summary.json").read_text())
    limit = summary["tensile_strength"] * ice["width"] * ice["thickness"] ** 2 / (3 * arm)
    curves.axhline(1e-3 * limit, color="grey", lw=0.8, ls="--", label="beam theory at the card's strength")
    curves.set_xlabel("time [ms]")
    curves.set_ylabel("load [kN]")
    curves.set_ylim(0, None)
    curves.legend(loc="upper left")
    last = fields.moments(run, "ice")[-1]
    frame = fields.read_frame(last.path)
    polygons, damage = sections.polygons(frame, "damage")
    cut.add_collection(PolyCollection(polygons, array=numpy.asarray(damage), cmap="Reds", clim=(0, 1), lw=0.1,
                                      edgecolors="grey"))
    cut.set_xlim(0, 0.5 * ice["length"])
    cut.set_ylim(-0.02, ice["thickness"] + 0.02)
    cut.set_aspect("equal")
    cut.set_xlabel(f"x [m], damage at {1e3 * last.time:.0f} ms, {size:.3g} mm")
    figure.tight_layout()
    figure.savefig(target, dpi=130)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), [Path(name) for name in sys.argv[2:]])
