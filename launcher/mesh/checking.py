"""What a mesh must not have, each answered by one sentence with file, element and place; and what is only remarked."""
from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from launcher import WrongInput
from launcher.mesh.reading import Mesh, place

FACES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
# The three edges that leave each corner, right-handed.
CORNER_EDGES = np.array([[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]])
FLAT = 1e-9  # Jacobian of a corner over the cube of the element's longest edge
SAME = 1e-9  # of the mesh's diagonal: nodes closer than this lie in one place


def check(mesh: Mesh, pieces: int) -> None:
    """Drops unused nodes, repairs a mesh that is left-handed throughout, refuses what cannot be computed with and
    remarks what may be meant. Raises WrongInput."""
    drop_unused(mesh)
    orient(mesh)
    faces = shared_faces(mesh)
    check_pieces(mesh, faces, pieces)
    remark_coincident(mesh)


def drop_unused(mesh: Mesh) -> None:
    used = np.zeros(len(mesh.nodes), dtype=bool)
    used[mesh.elements] = True
    if used.all():
        return
    number = np.cumsum(used) - 1
    mesh.notes.append(f"{mesh.file}: {np.count_nonzero(~used)} nodes belong to no hexahedron and are left out, "
                      f"the first at {place(mesh.nodes[np.argmin(used)])}")
    mesh.nodes, mesh.elements = mesh.nodes[used], number[mesh.elements]
    mesh.sets = {name: number[nodes[used[nodes]]] for name, nodes in mesh.sets.items()}


def corner_jacobians(mesh: Mesh) -> np.ndarray:
    """[e][8], m^3: triple product of the three edges at every corner, eight times the Jacobian there."""
    corners = mesh.nodes[mesh.elements]
    result = np.empty((len(corners), 8))
    for a, (i, j, k) in enumerate(CORNER_EDGES):
        u, v, w = (corners[:, b] - corners[:, a] for b in (i, j, k))
        result[:, a] = np.einsum("ij,ij->i", np.cross(u, v), w)
    return result


def longest_edges(mesh: Mesh) -> np.ndarray:
    corners = mesh.nodes[mesh.elements]
    return np.max([np.linalg.norm(corners[:, CORNER_EDGES[:, i]] - corners, axis=2).max(axis=1) for i in range(3)],
                  axis=0)


def orient(mesh: Mesh) -> None:
    """Every corner of every element right-handed, as VTK and the solvers have it."""
    jacobians, size = corner_jacobians(mesh), longest_edges(mesh)
    relative = jacobians / np.maximum(size, 1e-300)[:, None] ** 3
    flat = np.flatnonzero((np.abs(relative) < FLAT).all(axis=1))
    if flat.size:
        raise WrongInput(f"{mesh.element(flat[0])} has no volume ({flat.size} such); its eight nodes must span a "
                         "hexahedron: remove it or move its nodes")
    if (relative < -FLAT).all():
        mesh.elements = mesh.elements[:, [4, 5, 6, 7, 0, 1, 2, 3]]
        mesh.notes.append(f"{mesh.file}: all hexahedra are numbered left-handed; their lower and upper faces are "
                          "exchanged")
        return
    bad = np.flatnonzero((relative < FLAT).any(axis=1))
    if bad.size == 0:
        return
    e = bad[0]
    corner = int(np.argmin(relative[e]))
    turned = (relative[e] < -FLAT).all()
    what = "is turned inside out" if turned else f"has a Jacobian that is not positive at its corner {corner + 1}"
    raise WrongInput(f"{mesh.element(e)} {what}, {place(mesh.nodes[mesh.elements[e, corner]])} ({bad.size} such of "
                     f"{len(mesh.elements)} elements); nodes 1-4 must run counter-clockwise seen from 5-8, and the "
                     "element must be convex there")


def shared_faces(mesh: Mesh) -> np.ndarray:
    """[k][2], pairs of elements with a face in common. Raises WrongInput where a face has more than two."""
    keys = np.sort(mesh.elements[:, FACES].reshape(-1, 4), axis=1)
    owner = np.repeat(np.arange(len(mesh.elements)), len(FACES))
    order = np.lexsort(keys.T)
    keys, owner = keys[order], owner[order]
    same = (keys[1:] == keys[:-1]).all(axis=1)
    thrice = np.flatnonzero(same[1:] & same[:-1])
    if thrice.size:
        k = thrice[0]
        raise WrongInput(f"{mesh.element(owner[k])} shares a face with two others, {mesh.numbers[owner[k + 1]]} and "
                         f"{mesh.numbers[owner[k + 2]]}; a face bounds one element or two: remove the double one")
    pairs = np.stack([owner[:-1][same], owner[1:][same]], axis=1)
    ordered = np.sort(pairs, axis=1)
    _, first, times = np.unique(ordered, axis=0, return_index=True, return_counts=True)
    if (times > 1).any():
        a, b = pairs[first[np.argmax(times > 1)]]
        raise WrongInput(f"{mesh.element(a)} shares more than one face with element {mesh.numbers[b]}; they lie in one "
                         "place: remove one of them")
    return pairs


def check_pieces(mesh: Mesh, pairs: np.ndarray, allowed: int) -> None:
    """Pieces: elements joined by faces. More than `allowed` are refused, the smallest one is named."""
    count = len(mesh.elements)
    graph = sparse.coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    found, piece = connected_components(graph, directed=False)
    if found <= allowed:
        return
    sizes = np.bincount(piece)
    small = int(np.argmin(sizes))
    mine = np.flatnonzero(piece == small)
    touching = np.intersect1d(mesh.elements[piece == small], mesh.elements[piece != small]).size
    how = (f"hangs on the rest by {touching} node{'s' if touching > 1 else ''} and no face" if touching else
           "is not connected to the rest")
    others = f"and {len(mine) - 1} others " if len(mine) > 1 else ""
    raise WrongInput(f"{mesh.element(mine[0])} {others}{how}: {found} pieces that no face joins; merge coincident "
                     f"nodes, or set ice.mesh_pieces = {found}")


def remark_coincident(mesh: Mesh) -> None:
    """Nodes in one place that are not one node: a crack, or a seam that was to be merged."""
    extent = np.linalg.norm(np.ptp(mesh.nodes, axis=0))
    pairs = cKDTree(mesh.nodes).query_pairs(SAME * extent, output_type="ndarray")
    if len(pairs):
        first = mesh.nodes[pairs[:, 0]][np.lexsort(mesh.nodes[pairs[:, 0]].T)[0]]
        mesh.notes.append(f"{mesh.file}: {len(np.unique(pairs[:, 0]))} nodes lie where others lie, the first at "
                          f"{place(first)}; the faces between them are free, as of a crack: merge them if none is "
                          "meant")


def check_symmetry(mesh: Mesh, planes: list[int]) -> None:
    """Where a plane of symmetry (axis 0 or 1) cuts, the mesh must begin at it; nodes are put on it exactly."""
    for axis in planes:
        name = "xy"[axis]
        tolerance = 1e-6 * float(smallest_thickness(mesh).min())
        low = mesh.nodes[:, axis].min()
        if abs(low) > tolerance:
            raise WrongInput(f"{mesh.file}: begins at {name} = {1e3 * low:.6g} mm, but the plane of symmetry is {name} "
                             "= 0; move or cut the mesh, or set symmetry = \"full\"")
        mesh.nodes[np.abs(mesh.nodes[:, axis]) <= tolerance, axis] = 0.0


def smallest_thickness(mesh: Mesh) -> np.ndarray:
    """[e], m: volume over the largest face, the length that sets an element's time step."""
    return volumes(mesh) / face_areas(mesh).max(axis=1)


def volumes(mesh: Mesh) -> np.ndarray:
    """[e], m^3, of the trilinear hexahedron: mean of its half edges' products, exact for parallelepipeds."""
    corners = mesh.nodes[mesh.elements]
    points = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]) / np.sqrt(3)
    signs = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1],
                      [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
    total = np.zeros(len(corners))
    for point in points:
        terms = 1 + signs * point
        slopes = [signs[:, a] * np.delete(terms, a, axis=1).prod(axis=1) / 8 for a in range(3)]
        total += np.linalg.det(np.stack([np.einsum("a,eai->ei", slope, corners) for slope in slopes], axis=1))
    return total


def face_areas(mesh: Mesh) -> np.ndarray:
    """[e][6], m^2: half the product of the diagonals."""
    corners = mesh.nodes[mesh.elements][:, FACES]
    return 0.5 * np.linalg.norm(np.cross(corners[:, :, 2] - corners[:, :, 0], corners[:, :, 3] - corners[:, :, 1]),
                                axis=2)
