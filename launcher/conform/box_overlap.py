"""The overlap arrays of docs/protocol.md, section 5, for a box-shaped vehicle in the water, in closed form."""
from __future__ import annotations

from dataclasses import dataclass

import numpy

from launcher.conform.wire import Breach

CELLS = 3          # of the box along each axis, at most
START_GAP = 1e-5   # of a cell, between the top of the box and the grid's line above it at the start


@dataclass
class Box:
    """Lower and upper ends along x, y, z in m."""

    ends: list[tuple[float, float]]

    def raised(self, way: float) -> Box:
        return Box([*self.ends[:2], (self.ends[2][0] + way, self.ends[2][1] + way)])


def box_in_water(lines: list[numpy.ndarray], waterline: float) -> Box:
    """Some cells wide about the axis, or from the planes of symmetry on, halfway between bottom and waterline."""
    ends = []
    for line in lines[:2]:
        first = 0 if line[0] > -1e-9 * line[-1] else max(1, int(numpy.searchsorted(line, 0.0)) - CELLS // 2)
        last = min(first + CELLS, len(line) - 2)
        ends.append((line[0] if first == 0 else between(line, first - 1), between(line, last - 1)))
    z = lines[2]
    k = int(numpy.searchsorted(z, 0.5 * (z[0] + min(waterline, z[-1]))))
    if not 1 < k < len(z) - CELLS or any(len(line) < CELLS + 2 for line in lines):
        raise Breach("5", f"'ready': a grid of {' x '.join(str(len(line) - 1) for line in lines)} cells with the "
                          f"waterline at {waterline:g} m is too coarse to hold a body in the water")
    top = k + CELLS - 1
    ends.append((between(z, k - 1), float(z[top] - START_GAP * (z[top] - z[top - 1]))))
    return Box(ends)


def between(line: numpy.ndarray, i: int) -> float:
    return float(line[i] + 0.4 * (line[i + 1] - line[i]))


def overlap(lines: list[numpy.ndarray], box: Box, speed: float) -> dict[str, numpy.ndarray]:
    """Everything that `begin` and `span` carry, for a box that moves upward with this speed (m/s)."""
    sizes = [numpy.diff(line) for line in lines]
    inside = [(numpy.clip(line[1:], *ends) - numpy.clip(line[:-1], *ends)) / size
              for line, ends, size in zip(lines, box.ends, sizes)]
    cut = [numpy.array((line >= low) & (line <= high), float) for line, (low, high) in zip(lines, box.ends)]
    faces = [product(*(cut[a] if a == axis else inside[a] for a in range(3))) for axis in range(3)]
    areas = [product(*(numpy.ones(len(lines[a])) if a == axis else sizes[a] for a in range(3))) for axis in range(3)]
    volume = product(*(part * size for part, size in zip(inside, sizes)))
    # The area vectors of the walls and of the solid parts of the faces close each cell's solid.
    wall = numpy.stack([numpy.diff(faces[axis] * areas[axis], axis=2 - axis) for axis in range(3)], axis=-1)
    touched = (volume > 0) | numpy.any(wall != 0, axis=-1)
    for axis in range(3):
        low, high = (numpy.delete(faces[axis], end, axis=2 - axis) for end in (-1, 0))
        touched |= (low > 0) | (high > 0)
    walled = numpy.any(wall != 0, axis=-1)
    full = ~walled & (volume >= product(*sizes))
    cells = numpy.flatnonzero(touched & ~full)  # C order of [k][j][i]: ascending i + nx (j + ny k)
    walls = numpy.flatnonzero(walled)
    areas_of_walls, velocities = numpy.zeros((len(walls), 2, 3)), numpy.zeros((len(walls), 2, 3))
    areas_of_walls[:, 0] = wall.reshape(-1, 3)[walls]
    velocities[:, 0, 2] = speed
    arrays = {"cell": cells.astype("i8"), "solid_volume": volume.ravel()[cells],
              "debris_volume": numpy.zeros(len(cells)), "cell.full": runs(full), "wall": walls.astype("i8"),
              "wall_area": areas_of_walls, "wall_velocity": velocities,
              "wall_size": numpy.abs(wall).sum(axis=-1).ravel()[walls]}
    for axis, name in enumerate(("face_x", "face_y", "face_z")):
        solid = faces[axis].ravel()
        index = numpy.flatnonzero((solid > 0) & (solid < 1))
        arrays |= {name: index.astype("i8"), name + ".solid": solid[index], name + ".full": runs(solid == 1)}
    return arrays


def runs(mask: numpy.ndarray) -> numpy.ndarray:
    """[runs][2], first and how many, of the places where the mask holds."""
    edges = numpy.flatnonzero(numpy.diff(mask.ravel().astype("i1"), prepend=0, append=0))
    return numpy.stack([edges[::2], edges[1::2] - edges[::2]], axis=1).astype("i8")


def product(x: numpy.ndarray, y: numpy.ndarray, z: numpy.ndarray) -> numpy.ndarray:
    """[nz][ny][nx] from the values along each axis."""
    return z[:, None, None] * y[None, :, None] * x[None, None, :]


def depths(lines: list[numpy.ndarray], cells: numpy.ndarray, waterline: float) -> numpy.ndarray:
    """Depth of the centres of cells below the waterline, m."""
    nx, ny = len(lines[0]) - 1, len(lines[1]) - 1
    middle = 0.5 * (lines[2][1:] + lines[2][:-1])
    return waterline - middle[cells // (nx * ny)]
