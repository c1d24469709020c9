"""From a mesh file to what a run needs: the facts that resolve the scene and RUN/ice_mesh.h5, which the ice reads."""
from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np

from launcher import WrongInput
from launcher.mesh import checking, reading, renumbering
from launcher.mesh.reading import Mesh

SUSPICIOUSLY_SMALL = 0.2  # of the middle element's thickness: such an element rules the step of all


def load(wanted: dict) -> Mesh:
    """The mesh that a scene asks for (`resolve_scene` says so): read, checked and renumbered. Raises WrongInput."""
    mesh = reading.read(Path(wanted["file"]), wanted["unit"])
    checking.check(mesh, wanted["pieces"])
    checking.check_symmetry(mesh, wanted["planes"])
    for name in wanted["sets"]:
        if name not in mesh.sets:
            known = ", ".join(sorted(mesh.sets)) or "none"
            raise WrongInput(f"{mesh.file}: the scene names the set '{name}'; the file's sets: {known}")
        if len(mesh.sets[name]) == 0:
            raise WrongInput(f"{mesh.file}: the scene names the set '{name}', which has no node of a hexahedron")
    renumbering.renumber(mesh)
    return mesh


def facts(mesh: Mesh) -> dict:
    """What the scene takes from a mesh: corners of its box (m), sizes and counts."""
    volume, thickness = checking.volumes(mesh), checking.smallest_thickness(mesh)
    inner = len(checking.shared_faces(mesh))
    return {"low": mesh.nodes.min(axis=0).tolist(), "high": mesh.nodes.max(axis=0).tolist(),
            "elements": len(mesh.elements), "nodes": len(mesh.nodes),
            "boundary_faces": 6 * len(mesh.elements) - 2 * inner,
            "volume": float(volume.sum()), "thinnest": float(thickness.min())}


def remarks(mesh: Mesh, scene: dict) -> list[str]:
    """All that the user should know, and the element that rules the step where it is far smaller than the others."""
    thickness = checking.smallest_thickness(mesh)
    e, middle = int(np.argmin(thickness)), float(np.median(thickness))
    if thickness[e] > SUSPICIOUSLY_SMALL * middle:
        return mesh.notes
    thin = f"{mesh.element(e)} sets the step of the ice: it is {1e3 * thickness[e]:.3g} mm thick, the middle one " \
           f"{1e3 * middle:.3g} mm"
    step = (scene.get("estimate") or {}).get("ice_step")
    if step:
        thin += f"; about {step:.3g} s instead of {step * middle / thickness[e]:.3g} s"
    return [*mesh.notes, thin]


def write(mesh: Mesh, file: Path) -> None:
    """`nodes` [n][3] (m), `elements` [e][8] in the order of VTK, `element_numbers` [e] as in the mesh's own file and
    the group `sets` with nodes by name."""
    with h5py.File(file, "w") as out:
        out.attrs["source"] = mesh.file
        out["nodes"] = mesh.nodes.astype("<f8")
        out["elements"] = mesh.elements.astype("<i4")
        out["element_numbers"] = mesh.numbers.astype("<i8")
        sets = out.create_group("sets")
        for name, nodes in mesh.sets.items():
            sets[name] = nodes.astype("<i4")
