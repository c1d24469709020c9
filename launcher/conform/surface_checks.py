"""What docs/protocol.md, section 4, says about the surface of a solid."""
from __future__ import annotations

from dataclasses import dataclass

import numpy

from launcher.conform.wire import Findings, Message

SECTION = "4"
TOPOLOGY = {"surface.ids": "i8", "surface.masses": "f8", "surface.triangles": "i4", "surface.radius": "f8",
            "surface.volume": "f8"}
PLANES = {"full": (), "half": (1,), "quarter": (0, 1)}  # axes whose plane through the origin is one of symmetry
ROUNDING = numpy.finfo(float).eps


@dataclass
class Surface:
    """Vertices in the order of the messages, and what they did last."""

    ids: numpy.ndarray
    masses: numpy.ndarray
    radius: numpy.ndarray
    triangles: numpy.ndarray
    positions: numpy.ndarray
    velocities: numpy.ndarray


def read_surface(message: Message, before: Surface | None, symmetry: str, findings: Findings) -> Surface:
    """The surface of `ready` or of a window; `before`: the last one, whose vertices hold on unless they are sent again.

    Raises Breach where the message cannot be read."""
    if before is None or message.header.get("topology_changed") is True:
        ids = message.array(SECTION, "surface.ids", "i8", (None,))
        count = len(ids)
        arrays = {name: message.array(SECTION, name, kind, (None, 3) if name.endswith("triangles") else (count,))
                  for name, kind in TOPOLOGY.items()}
    else:
        ids, count, arrays = before.ids, len(before.ids), None
    positions = message.array(SECTION, "positions", "f8", (count, 3))
    velocities = message.array(SECTION, "velocities", "f8", (count, 3))
    if arrays is None:
        surface = Surface(ids, before.masses, before.radius, before.triangles, positions, velocities)
    else:
        if "surface.rigid_masses" in message.arrays:
            message.array(SECTION, "surface.rigid_masses", "f8", (count,))
        surface = Surface(ids, arrays["surface.masses"], arrays["surface.radius"], arrays["surface.triangles"],
                          positions, velocities)
        check_values(message.kind, surface, arrays["surface.volume"], findings)
        check_triangles(message.kind, surface, symmetry, findings)
    for name in ("positions", "velocities"):
        check_finite(message, SECTION, name, findings)
    return surface


def check_finite(message: Message, section: str, name: str, findings: Findings) -> None:
    bad = numpy.argwhere(~numpy.isfinite(message.arrays[name]))
    if len(bad):
        place = "".join(f"[{index}]" for index in bad[0])
        findings.add(section, f"finite {name}", f"'{message.kind}': array '{name}' holds a value that is not a finite "
                                                f"number at {place}")


def check_values(kind: str, surface: Surface, volume: numpy.ndarray, findings: Findings) -> None:
    ids, counts = numpy.unique(surface.ids, return_counts=True)
    if len(ids) < len(surface.ids):
        findings.add(SECTION, "ids", f"'{kind}': 'surface.ids' holds {ids[counts > 1][0]} more than once; "
                                     "every vertex needs an identifier of its own")
    for name, values, good, must in (("masses", surface.masses, surface.masses > 0, "positive"),
                                     ("radius", surface.radius, surface.radius >= 0, "0 or more"),
                                     ("volume", volume, volume >= 0, "0 or more")):
        if not numpy.all(good & numpy.isfinite(values)):
            v = int(numpy.argmin(good & numpy.isfinite(values)))
            findings.add(SECTION, name, f"'{kind}': 'surface.{name}' is {values[v]:g} at vertex {v}, it must be {must}")


def check_triangles(kind: str, surface: Surface, symmetry: str, findings: Findings) -> None:
    """Indices, particles, orientation, closure up to planes of symmetry, outward sense."""
    triangles, count = surface.triangles, len(surface.ids)
    wrong = triangles[(triangles < 0) | (triangles >= count)]
    if len(wrong):
        findings.add(SECTION, "index", f"'{kind}': 'surface.triangles' refers to vertex {wrong[0]}, "
                                       f"the vertices are 0 to {count - 1}")
        return
    if numpy.any(surface.radius[triangles] > 0):
        findings.add(SECTION, "particle", f"'{kind}': 'surface.triangles' refers to a vertex with a contact radius; "
                                          "particles are in no triangle")
    if not check_edges(kind, surface, symmetry, findings):
        return
    a, b, c = (surface.positions[triangles[:, corner]] for corner in range(3))
    volume = numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6
    if volume < 0:
        findings.add(SECTION, "sense", f"'{kind}': 'surface.triangles' encloses {volume:.3g} m^3: the triangles are "
                                       "clockwise seen from outside, they must be counter-clockwise")


def check_edges(kind: str, surface: Surface, symmetry: str, findings: Findings) -> bool:
    """Neighbours run through their common edge in opposite directions; an edge of one triangle lies on a plane of
    symmetry, where no triangle lies. Elements that touch in one edge may share it among four triangles."""
    triangles, count = surface.triangles.astype("i8"), len(surface.ids)
    size = max(float(numpy.abs(surface.positions).max(initial=0)), 1e-300)
    on_plane = [numpy.abs(surface.positions[:, axis]) <= 1e-9 * size for axis in PLANES[symmetry]]
    for axis, on in zip(PLANES[symmetry], on_plane):
        if numpy.any(on[triangles].all(axis=1)):
            findings.add(SECTION, "plane", f"'{kind}': a triangle lies on the plane of symmetry {'xy'[axis]} = 0; "
                                           "the surface has none there")
            return False
    start, end = triangles.ravel(), numpy.roll(triangles, -1, axis=1).ravel()
    low, high = numpy.minimum(start, end), numpy.maximum(start, end)
    edges, which = numpy.unique(low * count + high, return_inverse=True)
    surplus = numpy.bincount(which, weights=numpy.where(start < end, 1, -1), minlength=len(edges))
    low, high = edges // max(count, 1), edges % max(count, 1)
    twice = numpy.flatnonzero(numpy.abs(surplus) > 1)
    if len(twice):
        findings.add(SECTION, "orientation", f"'{kind}': two triangles run from vertex {low[twice[0]]} to "
                                             f"{high[twice[0]]} in the same direction: neighbours are oriented "
                                             "differently")
        return False
    inside = numpy.zeros(len(edges), bool)
    for on in on_plane:
        inside |= on[low] & on[high]
    open_edges = numpy.flatnonzero((surplus != 0) & ~inside)
    if len(open_edges):
        e = open_edges[0]
        findings.add(SECTION, "closed", f"'{kind}': the edge of vertices {low[e]} and {high[e]} has a triangle on one "
                                        "side only and lies on no plane of symmetry: the surface is not closed")
        return False
    return True


def check_advance(surface: Surface, before: Surface, step: float, window: int, findings: Findings) -> None:
    """x(n+1) = x(n) + dt v(n+1/2) for every vertex that was there before."""
    _, now, then = numpy.intersect1d(surface.ids, before.ids, return_indices=True)
    moved = before.positions[then] + step * surface.velocities[now]
    error = numpy.abs(surface.positions[now] - moved)
    allowed = 64 * ROUNDING * (numpy.abs(before.positions[then]).max(initial=0) + numpy.abs(moved).max(initial=0))
    if error.max(initial=0) > allowed:
        v = int(numpy.argmax(error.max(axis=1)))
        findings.add(SECTION, "advance", f"'surface' of window {window}: vertex {now[v]} is {error[v].max():.3g} m "
                                         "away from where its velocity carries it in the step: x(n+1) must be "
                                         "x(n) + dt v(n+1/2) with the velocity that is sent along")
