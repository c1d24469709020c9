"""A mesh file as arrays: what meshio reads, and the numbers that the file itself gives its elements."""
from __future__ import annotations

import contextlib
import io
import re
from dataclasses import dataclass, field
from pathlib import Path

import meshio
import numpy as np

from launcher import WrongInput

METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254, "ft": 0.3048}
READERS = {".msh": meshio.gmsh.read, ".inp": meshio.abaqus.read}
HEXAHEDRON, GMSH_HEXAHEDRON, NODES = "hexahedron", 5, 8
# Cells that only name nodes: those of supports, as physical groups of surfaces, lines and points.
NAMING = ("vertex", "line", "triangle", "quad")
SPOKEN = {"tetra": "tetrahedra", "tetra4": "tetrahedra", "tetra10": "second-order tetrahedra", "pyramid": "pyramids",
          "wedge": "wedges", "wedge15": "second-order wedges", "triangle": "triangles (shells)",
          "quad": "quadrilaterals (shells)", "quad8": "second-order quadrilaterals (shells)",
          "triangle6": "second-order triangles (shells)", "hexahedron20": "second-order hexahedra (20 nodes)",
          "hexahedron27": "second-order hexahedra (27 nodes)", "line": "lines", "vertex": "points"}


@dataclass
class Mesh:
    """`nodes` [n][3] in m, `elements` [e][8] in the order of VTK, `numbers` [e] as in the file, `sets`: nodes by name,
    `notes`: what was found and done, whole sentences."""

    file: str
    nodes: np.ndarray
    elements: np.ndarray
    numbers: np.ndarray
    sets: dict[str, np.ndarray]
    notes: list[str] = field(default_factory=list)

    def element(self, e: int) -> str:
        """An element as the user finds it: its number in the file and its centre."""
        return f"{self.file}: element {self.numbers[e]} at {place(self.nodes[self.elements[e]].mean(axis=0))}"


def place(point: np.ndarray) -> str:
    return "(" + ", ".join(f"{1e3 * x:.6g}" for x in point) + ") mm"


def read(file: Path, unit: str) -> Mesh:
    """The hexahedra of a Gmsh or Abaqus file, coordinates in m. Raises WrongInput."""
    raw = read_raw(file)
    check_cells(file, raw)
    blocks = [block.data for block in raw.cells if block.type == HEXAHEDRON]
    elements = np.concatenate(blocks).astype(np.int64)
    points = np.asarray(raw.points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise WrongInput(f"{file}: its nodes have no three coordinates; a mesh of hexahedra has x, y and z")
    if elements.min() < 0 or elements.max() >= len(points):
        raise WrongInput(f"{file}: an element names a node that the file does not define")
    if not np.isfinite(points).all():
        raise WrongInput(f"{file}: a coordinate is not finite")
    numbers = file_numbers(file)
    if numbers is None or len(numbers) != len(elements):
        numbers = np.arange(1, len(elements) + 1)
    # A slash would be a folder in HDF5.
    sets = {name.replace("/", "_"): nodes for name, nodes in {**node_sets(raw), **cell_sets(raw)}.items()}
    return Mesh(str(file), points * METRES[unit], elements, numbers, sets)


def read_raw(file: Path) -> meshio.Mesh:
    if file.suffix not in READERS:
        raise WrongInput(f"{file}: unknown kind of mesh; must be Gmsh's .msh or Abaqus' .inp")
    if not file.is_file():
        raise WrongInput(f"{file}: no such file")
    blocks = re.findall(r"^\*NODE\s*(?:,|$)", file.read_text(errors="replace"), re.I | re.M)
    if file.suffix == ".inp" and len(blocks) > 1:
        raise WrongInput(f"{file}: several *NODE blocks; write all nodes as one block")
    try:
        with contextlib.redirect_stdout(io.StringIO()):  # meshio prints its warnings
            return READERS[file.suffix](file)  # meshio.read would end the process and keep the reason to itself
    except KeyError as error:
        raise WrongInput(f"{file}: names node or element {error}, which the file does not define") from None
    except Exception as error:  # meshio's own, and whatever a damaged file makes numpy say
        reason = " ".join(str(error).split()) or type(error).__name__
        raise WrongInput(f"{file}: cannot be read as a mesh: {reason}; must be Gmsh 2.2 or 4.1 (.msh), or Abaqus "
                         "(.inp) with C3D8 or C3D8R") from None


def check_cells(file: Path, raw: meshio.Mesh) -> None:
    """Hexahedra with eight nodes; cells below three dimensions only beside them and only on their nodes."""
    kinds = list(dict.fromkeys(block.type for block in raw.cells if len(block.data)))
    others = [SPOKEN.get(kind, kind) for kind in kinds if kind != HEXAHEDRON]
    if HEXAHEDRON not in kinds:
        raise WrongInput(f"{file}: holds no hexahedra" + (f", only {', '.join(others)}" if others else "")
                         + "; must be meshed with hexahedra of eight nodes (C3D8)")
    bad = [SPOKEN.get(kind, kind) for kind in kinds if kind not in (HEXAHEDRON, *NAMING)]
    if bad:
        raise WrongInput(f"{file}: holds {', '.join(bad)} beside hexahedra; all cells must be hexahedra of eight nodes")
    used = np.unique(np.concatenate([block.data.ravel() for block in raw.cells if block.type == HEXAHEDRON]))
    for block in raw.cells:
        if block.type not in ("triangle", "quad"):
            continue
        loose = np.flatnonzero(~np.isin(block.data, used).all(axis=1))
        if block.type == "triangle" or loose.size:
            nodes = np.asarray(raw.points)[block.data[loose[0] if loose.size else 0]]
            centre = ", ".join(f"{x:.6g}" for x in nodes.mean(axis=0))
            raise WrongInput(f"{file}: holds {SPOKEN[block.type]} that are no faces of its hexahedra, one at "
                             f"({centre}) in the file's unit; all cells must be hexahedra of eight nodes")


def node_sets(raw: meshio.Mesh) -> dict[str, np.ndarray]:
    return {name: np.unique(np.asarray(nodes, dtype=np.int64)) for name, nodes in (raw.point_sets or {}).items()}


def cell_sets(raw: meshio.Mesh) -> dict[str, np.ndarray]:
    """The nodes of named cells: element sets of Abaqus, physical groups of Gmsh (unnamed ones by their number)."""
    sets: dict[str, list[np.ndarray]] = {}
    for name, chosen in (raw.cell_sets or {}).items():
        if name.startswith("gmsh:"):
            continue
        for block, cells in zip(raw.cells, chosen):
            if cells is not None and len(cells):
                sets.setdefault(name, []).append(block.data[np.asarray(cells, dtype=np.int64)].ravel())
    names = {(int(tag), int(dimension)): name for name, (tag, dimension) in raw.field_data.items()}
    dimensions = {"vertex": 0, "line": 1, "quad": 2, HEXAHEDRON: 3}
    for block, tags in zip(raw.cells, raw.cell_data.get("gmsh:physical", [])):
        for tag in np.unique(tags):
            name = names.get((int(tag), dimensions[block.type]), str(tag))
            sets.setdefault(name, []).append(block.data[np.asarray(tags) == tag].ravel())
    return {name: np.unique(np.concatenate(parts)).astype(np.int64) for name, parts in sets.items()}


def file_numbers(file: Path) -> np.ndarray | None:
    """The numbers of the hexahedra in the order of the file, which meshio drops; None where they cannot be told: in a
    binary file, or one that includes others."""
    with file.open("rb") as stream:
        head = stream.read(64)
    if file.suffix == ".inp":
        return abaqus_numbers(file)
    words = head.split()
    if words[:1] != [b"$MeshFormat"] or words[2:3] != [b"0"]:
        return None
    text = file.read_text(errors="replace")
    body = text[text.index("$Elements") + len("$Elements"):text.index("$EndElements")].strip().splitlines()
    return gmsh2_numbers(body) if words[1].startswith(b"2") else gmsh4_numbers(body)


def abaqus_numbers(file: Path) -> np.ndarray:
    numbers: list[int] = []
    for block in re.split(r"(?m)^\*(?!\*)", file.read_text(errors="replace")):
        header, _, body = block.partition("\n")
        if re.match(r"ELEMENT\b.*TYPE\s*=\s*C3D8", header, re.I):
            body = re.sub(r"(?m)^\*\*.*$", "", body)
            numbers += [int(word) for word in re.split(r"[\s,]+", body) if word][::NODES + 1]
    return np.array(numbers, dtype=np.int64)


def gmsh2_numbers(lines: list[str]) -> np.ndarray:
    words = (line.split(None, 2) for line in lines[1:])
    return np.array([int(number) for number, kind, _ in words if int(kind) == GMSH_HEXAHEDRON], dtype=np.int64)


def gmsh4_numbers(lines: list[str]) -> np.ndarray:
    numbers, at = [], 1
    while at < len(lines):
        _, _, kind, count = (int(word) for word in lines[at].split())
        if kind == GMSH_HEXAHEDRON:
            numbers += [int(line.split(None, 1)[0]) for line in lines[at + 1:at + 1 + count]]
        at += 1 + count
    return np.array(numbers, dtype=np.int64)
