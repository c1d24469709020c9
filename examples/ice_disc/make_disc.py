"""Writes disc.inp: a quarter of a disc of ice, 120 mm across and 8 mm thick, as a mesh generator would leave it.

A square core of which two sides bulge and a ring of two blocks around it; nodes that blocks share are written once."""
from pathlib import Path

import numpy as np

RADIUS, CORE, THICKNESS = 60.0, 30.0, 8.0  # mm
SIDE, RING, LAYERS = 8, 8, 3  # elements

nodes: dict[tuple, int] = {}


def node(x: float, y: float, z: float) -> int:
    return nodes.setdefault((round(x, 9) + 0.0, round(y, 9) + 0.0, round(z, 9)), len(nodes) + 1)


def core(u: float, v: float) -> np.ndarray:
    """The square [0, 1]^2 whose outer corner is drawn in."""
    return CORE * np.array([u * (1 - 0.12 * v * v), v * (1 - 0.12 * u * u)])


def ring(u: float, v: float, mirrored: bool) -> np.ndarray:
    """u along the core's side, v from it to the rim."""
    inner, angle = core(1, u), 0.25 * np.pi * u
    point = (1 - v) * inner + v * RADIUS * np.array([np.cos(angle), np.sin(angle)])
    return point[::-1] if mirrored else point


def block(place, cells: tuple[int, int], turned: bool) -> list[list[int]]:
    """Elements of the layers over a patch; `turned`: its two directions are left-handed."""
    elements = []
    for i in range(cells[0]):
        for j in range(cells[1]):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            flat = [place(a / cells[0], b / cells[1]) for a, b in (corners[::-1] if turned else corners)]
            for k in range(LAYERS):
                elements.append([node(*p, THICKNESS * z / LAYERS) for z in (k, k + 1) for p in flat])
    return elements


elements = block(core, (SIDE, SIDE), False)
elements += block(lambda u, v: ring(u, v, False), (SIDE, RING), True)
elements += block(lambda u, v: ring(u, v, True), (SIDE, RING), False)
rim = [n for (x, y, _), n in nodes.items() if abs(np.hypot(x, y) - RADIUS) < 1e-6]
lines = ["*NODE", *(f"{n}, {x:.9g}, {y:.9g}, {z:.9g}" for (x, y, z), n in nodes.items()), "*ELEMENT, TYPE=C3D8R",
         *(f"{e}, " + ", ".join(map(str, corners)) for e, corners in enumerate(elements, 1)), "*NSET, NSET=rim",
         *(", ".join(map(str, rim[i:i + 12])) for i in range(0, len(rim), 12))]
(Path(__file__).parent / "disc.inp").write_text("\n".join(lines) + "\n")
