#!/usr/bin/env python3
"""Draws the deflection of the elastic wedge's middle in runs of cases/elastic_wedge, beside theory.

    docs/pictures/draw_elastic_wedge.py OUT.png RUN...
"""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "end_to_end"))
import wagner_beam
from test_elastic_wedge import course


def main():
    out, *runs = sys.argv[1:]
    figure, axes = plt.subplots(figsize=(8, 4.6))
    times = np.linspace(0.1e-3, 2.25e-3, 60)
    for label, water, reach, style in (("Wagner's theory with Euler's beam", 1, 1, "k:"),
                                       ("the same, exact free surface, compressible water",
                                        wagner_beam.SIMILARITY * wagner_beam.ACOUSTICS, wagner_beam.ACOUSTICS, "k-")):
        axes.plot(1e3 * times, 1e3 * wagner_beam.deflection(times, water, reach), style, label=label)
    time, deflection = np.array(wagner_beam.PUBLISHED).T
    axes.plot(1e3 * time, 1e3 * deflection, "ko", mfc="none", label="Scolan (2004), read from a figure")
    for run, colour in zip(map(Path, runs), ("#56b4e9", "#009e73", "#d55e00")):
        scene = json.loads((run / "scene.json").read_text())
        t, w = course(run).T
        axes.plot(1e3 * t, 1e3 * w, color=colour, label=f"run, cells of {1e3 * scene['resolution']['cell']:g} mm")
    axes.set_xlabel("time, ms")
    axes.set_ylabel("deflection of the middle, mm")
    axes.set_xlim(0, 2.3)
    axes.set_ylim(0, 11.5)
    axes.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(out, dpi=80)


if __name__ == "__main__":
    main()
