"""Nodes and elements in an order in which neighbours in space are neighbours in memory."""
from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.csgraph import reverse_cuthill_mckee

from launcher.mesh.reading import Mesh


def renumber(mesh: Mesh) -> None:
    """Elements by reverse Cuthill-McKee (Cuthill & McKee 1969, George 1971) of the graph of elements with a node in
    common; nodes in the order in which the elements meet them. Elements keep the order of their nodes."""
    mesh.elements, mesh.numbers = reordered(mesh, element_order(mesh))
    number, order = first_use(mesh.elements, len(mesh.nodes))
    mesh.nodes, mesh.elements = mesh.nodes[order], number[mesh.elements]
    mesh.sets = {name: np.sort(number[nodes]) for name, nodes in mesh.sets.items()}


def element_order(mesh: Mesh) -> np.ndarray:
    count, nodes = len(mesh.elements), len(mesh.nodes)
    incidence = sparse.csr_matrix((np.ones(8 * count, dtype=np.int8),
                                   (np.repeat(np.arange(count), 8), mesh.elements.ravel())), shape=(count, nodes))
    return reverse_cuthill_mckee((incidence @ incidence.T).tocsr(), symmetric_mode=True)


def reordered(mesh: Mesh, order: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return mesh.elements[order], mesh.numbers[order]


def first_use(elements: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The new number of every old node, and the old number of every new one."""
    old, first = np.unique(elements.ravel(), return_index=True)
    order = old[np.argsort(first)]
    number = np.full(count, -1, dtype=np.int64)
    number[order] = np.arange(len(order))
    return number, order


def node_distance(elements: np.ndarray) -> float:
    """Mean over the elements of the largest difference between node numbers: the bandwidth as a mean."""
    return float(np.ptp(elements, axis=1).mean())


def element_distance(elements: np.ndarray, nodes: int) -> float:
    """Mean over the nodes of the difference between the last and the first element around it."""
    owner = np.repeat(np.arange(len(elements)), 8)
    low, high = np.full(nodes, len(elements)), np.full(nodes, -1)
    np.minimum.at(low, elements.ravel(), owner)
    np.maximum.at(high, elements.ravel(), owner)
    return float((high - low)[high >= 0].mean())
