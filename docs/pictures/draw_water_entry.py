#!/usr/bin/env python3
"""Draws fields that tests/fluid_solver/test_water_entry*.cpp write: water in blue, gauge pressure of what is mostly water.

    docs/pictures/draw_water_entry.py OUT.png FIELD.csv...
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def draw(axes, path):
    table = np.genfromtxt(path, delimiter=",", names=True)
    x, z = np.unique(table["x"]), np.unique(table["z"])
    free, water, pressure = (table[name].reshape(len(z), len(x)) for name in ("free", "water", "pressure"))
    solid = free < 0.5
    wide = x[np.any(solid, axis=0)].max()
    low = z[np.any(solid, axis=1)].min()
    axes[0].pcolormesh(x, z, np.where(solid, np.nan, water), cmap="Blues", vmin=0, vmax=1.3, shading="nearest")
    shown = np.where(solid | (water < 0.5), np.nan, pressure)
    top = np.nanmax(shown)
    mesh = axes[1].pcolormesh(x, z, shown / 1e3, cmap="inferno_r", vmin=0, vmax=top / 1e3, shading="nearest")
    axes[1].figure.colorbar(mesh, ax=axes[1], label="kPa")
    for one in axes:
        one.set_xlim(0, 1.25 * wide)
        one.set_ylim(low - 0.5 * wide, low + 1.3 * wide)
        one.set_aspect("equal")
        one.set_facecolor("0.75")
        one.set_xlabel("x, m")
    axes[0].set_ylabel("z, m")


def main():
    out, *paths = sys.argv[1:]
    figure, axes = plt.subplots(len(paths), 2, figsize=(10, 4.6 * len(paths)), squeeze=False)
    for row, path in zip(axes, paths):
        draw(row, path)
    figure.tight_layout()
    figure.savefig(out, dpi=80)


if __name__ == "__main__":
    main()
