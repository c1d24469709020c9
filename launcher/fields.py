"""Field frames (VTKHDF unstructured grids) and their cut by a vertical plane y = const."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy

from launcher.run_folder import read_json

HEXAHEDRON, TRIANGLE, VERTEX = 12, 5, 1
EDGES = numpy.array([(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)])


@dataclass(frozen=True)
class Frame:
    """One frame: node positions [n][3], hexahedra [m][8], vertex cells [k], and cell fields split the same way."""

    points: numpy.ndarray
    hexahedra: numpy.ndarray
    vertices: numpy.ndarray
    hexahedron_fields: dict[str, numpy.ndarray]
    vertex_fields: dict[str, numpy.ndarray]
    grid: tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray] | None


@dataclass(frozen=True)
class Moment:
    """An entry of a frame index."""

    time: float
    path: Path


def moments(run: Path, name: str) -> list[Moment]:
    """The frames of RUN/fields/<name>.json whose files are there, in the order of time."""
    entries = read_json(run / "fields" / f"{name}.json").get("frames", [])
    found = [Moment(float(entry["time"]), run / "fields" / Path(entry["file"]).name) for entry in entries]
    return sorted((moment for moment in found if moment.path.is_file()), key=lambda moment: moment.time)


def nearest(choices: list[Moment], time: float, tolerance: float) -> Moment | None:
    """The frame of a time, if there is one so near."""
    best = min(choices, key=lambda moment: abs(moment.time - time), default=None)
    return best if best is not None and abs(best.time - time) <= tolerance else None


def read_frame(path: Path) -> Frame:
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        points = root["Points"][:].astype(float)
        kinds, connectivity, offsets = root["Types"][:], root["Connectivity"][:], root["Offsets"][:]
        is_hexahedron, is_vertex = kinds == HEXAHEDRON, kinds == VERTEX
        first = offsets[:-1]
        corners = numpy.arange(8)
        if not is_hexahedron.any():  # a bare surface: its triangles are hexahedra without volume
            is_hexahedron, corners = kinds == TRIANGLE, numpy.array([0, 1, 2, 2, 0, 1, 2, 2])
        hexahedra = connectivity[first[is_hexahedron][:, None] + corners]
        cell_data = {name: data[:] for name, data in root.get("CellData", {}).items()}
        if len(points) == len(kinds):  # fields of particles may be given per point: the same thing
            cell_data = {**{name: data[:] for name, data in root.get("PointData", {}).items()}, **cell_data}
        lines = file.get("Grid") or root.get("Grid")
        grid = tuple(lines[axis][:] for axis in "xyz") if lines is not None else None
    return Frame(points, hexahedra, connectivity[first[is_vertex]],
                 {name: data[is_hexahedron] for name, data in cell_data.items()},
                 {name: data[is_vertex] for name, data in cell_data.items()}, grid)


def cut_height(points: numpy.ndarray, hexahedra: numpy.ndarray, plane: float = 0.0) -> float:
    """A height just beyond the plane: the plane itself may hold faces, and on a symmetry plane it always does."""
    if not len(hexahedra):
        return plane
    y = points[hexahedra, 1]
    return plane + 1e-3 * float(numpy.median(numpy.ptp(y, axis=1)))


def cut(points: numpy.ndarray, hexahedra: numpy.ndarray, height: float) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Polygons [m][12][2] in x and z where y = height cuts hexahedra (corners repeat), and the number of each cell."""
    distance = points[hexahedra, 1] - height
    which = numpy.flatnonzero((distance.min(axis=1) < 0) & (distance.max(axis=1) > 0))
    distance, corners = distance[which], points[hexahedra[which]][:, :, [0, 2]]
    begin, end = distance[:, EDGES[:, 0]], distance[:, EDGES[:, 1]]
    crossed = (begin < 0) != (end < 0)
    share = numpy.where(crossed, begin / numpy.where(crossed, begin - end, 1.0), 0.0)[..., None]
    places = corners[:, EDGES[:, 0]] * (1 - share) + corners[:, EDGES[:, 1]] * share
    middle = (places * crossed[..., None]).sum(axis=1) / crossed.sum(axis=1)[:, None]
    from_middle = places - middle[:, None]
    angle = numpy.where(crossed, numpy.arctan2(from_middle[..., 1], from_middle[..., 0]), numpy.inf)
    order = numpy.argsort(angle, axis=1)
    last = crossed.sum(axis=1)[:, None] - 1
    order = numpy.take_along_axis(order, numpy.minimum(numpy.arange(len(EDGES)), last), axis=1)
    return numpy.take_along_axis(places, order[..., None], axis=1), which


def grid_lines(frame: Frame) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray] | None:
    """The lines of a structured grid, read or found from the nodes; None if the cells do not fill such a grid."""
    lines = frame.grid
    if lines is None:
        span = numpy.ptp(frame.points, axis=0).max()
        rounded = numpy.round(frame.points / (1e-9 * span)) * (1e-9 * span)
        lines = tuple(numpy.unique(rounded[:, axis]) for axis in range(3))
    cells = numpy.prod([len(line) - 1 for line in lines])
    return lines if cells == len(frame.hexahedra) else None


def grid_row(frame: Frame, lines: tuple[numpy.ndarray, ...], name: str) -> numpy.ndarray | None:
    """The values [nz][nx] of a cell field in the row of cells just beyond y = 0."""
    values = frame.hexahedron_fields.get(name)
    if values is None:
        return None
    nx, ny, nz = (len(line) - 1 for line in lines)
    row = min(max(int(numpy.searchsorted(lines[1], 1e-9 * numpy.ptp(lines[1]), side="right")) - 1, 0), ny - 1)
    return values.reshape(nz, ny, nx)[:, row, :]
