"""How pictures look: one set of colours that colour-blind people tell apart, quiet axes, no frames."""
from __future__ import annotations

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.colors import LinearSegmentedColormap  # noqa: E402

# Okabe and Ito's colours.
BLUE, VERMILION, GREEN, ORANGE, SKY, PURPLE = "#0072B2", "#D55E00", "#009E73", "#E69F00", "#56B4E9", "#CC79A7"
INK, QUIET, FAINT = "#222222", "#6b6b6b", "#d9d9d9"
CYCLE = [BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, INK]

AIR, WATER = "#fbfaf7", "#a9cde6"
WATER_MAP = LinearSegmentedColormap.from_list("water", [AIR, WATER])
# From sound ice, nearly white, to crushed ice: lightness falls all the way, so it reads in grey as well.
DAMAGE_MAP = LinearSegmentedColormap.from_list("damage", ["#ffffff", "#fbd9a5", "#e8963c", "#a8480f", "#4a1704"])
STRESS_MAP = "viridis"
PRESSURE_MAP = LinearSegmentedColormap.from_list("pressure", [
    "#5e2a84", "#9b79c4", "#d8cde8", "#f7f7f7", "#f6d5ad", "#de8a3c", "#8f3a06"])

SETTINGS = {
    "figure.dpi": 100, "savefig.dpi": 160, "figure.facecolor": "white", "savefig.facecolor": "white",
    "font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 10, "axes.titlelocation": "left",
    "axes.titleweight": "bold", "axes.labelsize": 9, "axes.labelcolor": INK, "axes.edgecolor": QUIET,
    "axes.linewidth": 0.7, "axes.spines.top": False, "axes.spines.right": False, "axes.prop_cycle":
        matplotlib.cycler(color=CYCLE), "axes.formatter.limits": (-3, 5), "axes.formatter.use_mathtext": True,
    "xtick.color": QUIET, "ytick.color": QUIET, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "xtick.major.width": 0.7, "ytick.major.width": 0.7, "xtick.direction": "out", "ytick.direction": "out",
    "axes.grid": True, "grid.color": "#ececec", "grid.linewidth": 0.6, "axes.axisbelow": True,
    "lines.linewidth": 1.5, "lines.solid_capstyle": "round", "legend.frameon": False, "legend.fontsize": 8.5,
}


def apply() -> None:
    pyplot.rcParams.update(SETTINGS)


def scale(largest: float) -> tuple[float, str]:
    """Factor and prefix of the unit that make a largest value readable: 9.5e7 -> (1e-6, "M")."""
    for limit, factor, prefix in ((1e9, 1e-9, "G"), (1e6, 1e-6, "M"), (1e3, 1e-3, "k"), (1.0, 1.0, ""),
                                  (1e-3, 1e3, "m"), (1e-6, 1e6, "µ")):
        if abs(largest) >= limit:
            return factor, prefix
    return 1.0, ""


def heading(figure: pyplot.Figure, title: str, note: str = "") -> None:
    """Title at the upper left of a figure and a quiet note beside it."""
    height = figure.get_size_inches()[1]
    figure.text(0.012, 1 - 0.10 / height, title, fontsize=12, fontweight="bold", color=INK, va="top")
    if note:
        figure.text(0.988, 1 - 0.13 / height, note, fontsize=8.5, color=QUIET, va="top", ha="right")
