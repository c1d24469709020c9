"""Writes wedge.inp: half an elastic wedge, a beam in plane strain, 0.6 m long and 40 mm thick, 10 degrees up from its keel.

Arguments: elements along and through the beam. The end faces are vertical, so that the keel's lies in the plane of symmetry. Sets:
keel and knuckle, the end faces; slice, all nodes; middle, those half way."""
from pathlib import Path
from sys import argv

import numpy as np

LENGTH, THICKNESS, ANGLE, WIDTH = 0.6, 0.04, np.radians(10), 0.005  # m
ALONG, LAYERS = (int(n) for n in argv[1:3]) if len(argv) > 2 else (60, 4)


def number(i: int, j: int, k: int) -> int:
    return 1 + i + (ALONG + 1) * (j + 2 * k)


def place(i: int, j: int, k: int) -> str:
    x = LENGTH * np.cos(ANGLE) * i / ALONG
    z = x * np.tan(ANGLE) + THICKNESS / np.cos(ANGLE) * k / LAYERS
    return f"{number(i, j, k)}, {x:.9g}, {WIDTH * j:.9g}, {z:.9g}"


every = [(i, j, k) for k in range(LAYERS + 1) for j in (0, 1) for i in range(ALONG + 1)]
lines = ["*NODE", *(place(*n) for n in every), "*ELEMENT, TYPE=C3D8R"]
flat = ((0, 0), (1, 0), (1, 1), (0, 1))
for e, (k, i) in enumerate(((k, i) for k in range(LAYERS) for i in range(ALONG)), 1):
    lines.append(f"{e}, " + ", ".join(str(number(i + a, b, k + up)) for up in (0, 1) for a, b in flat))
sets = {"keel": [n for n in every if n[0] == 0], "knuckle": [n for n in every if n[0] == ALONG],
        "middle": [n for n in every if 2 * n[0] == ALONG], "slice": every}
for name, members in sets.items():
    numbers = [number(*n) for n in members]
    lines += [f"*NSET, NSET={name}", *(", ".join(map(str, numbers[n:n + 12])) for n in range(0, len(numbers), 12))]
(Path(__file__).parent / "wedge.inp").write_text("\n".join(lines) + "\n")
