"""What the pictures of the vertical cut show: one section per moment, and the view that all of them share."""
from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy
from matplotlib.colors import Normalize, SymLogNorm

from launcher import fields


@dataclass
class Section:
    """What one moment shows in the plane y = 0, ready to be drawn; lengths in m."""

    time: float
    vehicle: numpy.ndarray | None = None            # polygons [m][12][2]
    vehicle_stress: numpy.ndarray | None = None
    ice: numpy.ndarray | None = None
    ice_damage: numpy.ndarray | None = None
    particles: numpy.ndarray | None = None          # places [k][2]
    particle_damage: numpy.ndarray | None = None
    x: numpy.ndarray | None = None                           # grid lines of the fluid and values [nz][nx]
    z: numpy.ndarray | None = None
    fluid: dict[str, numpy.ndarray] = field(default_factory=dict)


@dataclass(frozen=True)
class View:
    """What is common to all pictures of a run."""

    scene: dict
    x: tuple[float, float]
    z: tuple[float, float]
    stress: Normalize
    pressure: SymLogNorm | None

    @property
    def mirrored(self) -> bool:
        return self.scene.get("symmetry") == "quarter"

    @property
    def particle_size(self) -> float:
        return 0.9 * self.scene.get("resolution", {}).get("ice_element", 1e-3)


def load_section(run: Path, time: float, tolerance: float) -> Section:
    """Reads the frames nearest to a time; a part that has none stays None."""
    section = Section(time)
    frames = {}
    for name in ("vehicle", "ice", "particles", "fluid"):
        moment = fields.nearest(fields.moments(run, name), time, tolerance)
        frames[name] = fields.read_frame(moment.path) if moment else None
    if frames["vehicle"]:
        section.vehicle, section.vehicle_stress = polygons(frames["vehicle"], "von_mises")
    if frames["ice"]:
        section.ice, section.ice_damage = polygons(frames["ice"], "damage")
    for frame in (frames["particles"], frames["ice"]):
        if frame is not None and len(frame.vertices) and section.particles is None:
            add_particles(section, frame)
    if frames["fluid"]:
        lines = fields.grid_lines(frames["fluid"])
        if lines:
            section.x, section.z = lines[0], lines[2]
            for name in ("water_fraction", "pressure", "solid_fraction"):
                row = fields.grid_row(frames["fluid"], lines, name)
                if row is not None:
                    section.fluid[name] = row
            share_of_fluid(section.fluid)
    return section


def share_of_fluid(fluid: dict[str, numpy.ndarray]) -> None:
    """Fractions of a cell's volume become shares of the part that no solid fills: no pale rim about the bodies."""
    if "water_fraction" in fluid and "solid_fraction" in fluid:
        free = 1 - fluid["solid_fraction"]
        share = numpy.clip(fluid["water_fraction"] / numpy.maximum(free, 1e-9), 0, 1)
        fluid["water_fraction"] = numpy.where(free > 1e-6, share, fluid["water_fraction"])


def polygons(frame: fields.Frame, name: str) -> tuple[numpy.ndarray, numpy.ndarray]:
    height = fields.cut_height(frame.points, frame.hexahedra)
    places, which = fields.cut(frame.points, frame.hexahedra, height)
    values = frame.hexahedron_fields.get(name)
    return places, values[which] if values is not None else numpy.zeros(len(which))


def add_particles(section: Section, frame: fields.Frame) -> None:
    """Particles within a slice about the plane as thick as they lie apart."""
    places = frame.points[frame.vertices]
    extent = numpy.ptp(places, axis=0)
    spacing = max((numpy.prod(numpy.maximum(extent, 1e-9)) / len(places)) ** (1 / 3), 1e-4)
    near = abs(places[:, 1]) < 2 * spacing
    section.particles = places[near][:, [0, 2]]
    damage = frame.vertex_fields.get("damage")
    section.particle_damage = damage[near] if damage is not None else numpy.ones(near.sum())


def make_view(scene: dict, sections: list[Section]) -> View:
    """The window: the ice about the hole and the vehicle's head from the first to the last picture."""
    tops = [s.vehicle[..., 1].max() for s in sections if s.vehicle is not None and len(s.vehicle)]
    stresses = [s.vehicle_stress.max() for s in sections if s.vehicle_stress is not None and len(s.vehicle_stress)]
    pressures = [abs(s.fluid["pressure"]).max() for s in sections if "pressure" in s.fluid]
    vehicle, ice, fluid = (scene.get(name) or {} for name in ("vehicle", "ice", "fluid"))
    if vehicle:
        diameter, thickness = vehicle["diameter"], ice.get("thickness", vehicle["diameter"])
        half = max(3.2 * diameter, 1.5 * thickness)
        low = (ice.get("lower_face", vehicle["nose_position"])) - 2.2 * max(diameter, thickness)
        high = max([*tops, ice.get("lower_face", 0) + thickness]) + 1.2 * diameter
    elif ice:
        half, thickness = 0.52 * ice["length"], ice["thickness"]
        low, high = ice["lower_face"] - 0.5 * thickness, ice["lower_face"] + 1.6 * thickness
    elif fluid.get("bodies"):
        half, low, high = about_bodies(fluid["bodies"].values())
        half, low, high = min(half, fluid["length"] / 2), max(low, fluid["bottom"]), min(high, fluid["top"])
    else:
        half, low, high = fluid["length"] / 2, fluid["bottom"], fluid["top"]
    window = (0, fluid["length"]) if fluid.get("dam") else (-half, half)
    largest = max(pressures, default=0.0)
    return View(scene, window, (low, high), Normalize(0, max(stresses, default=1.0) or 1.0),
                pressure_scale(largest) if largest > 0 else None)


def about_bodies(bodies) -> tuple[float, float, float]:
    """Half width and both ends in z of a window on all that bodies pass through, with two sizes of the largest around."""
    room = 2 * max(body["size"] for body in bodies)
    half = max(max(abs(body["low"][0]), abs(body["high"][0])) for body in bodies) + room
    return half, min(body["low"][2] for body in bodies) - room, max(body["high"][2] for body in bodies) + room


def pressure_scale(largest: float) -> SymLogNorm:
    """Logarithmic on both sides over two to three decades below the largest value, linear between."""
    linear = 10.0 ** numpy.floor(numpy.log10(largest / 200))
    return SymLogNorm(linthresh=linear, vmin=-largest, vmax=largest, base=10)


def whole_view(view: View, section: Section) -> View:
    """The same scales on a window that holds the vehicle down to its tail."""
    if section.vehicle is None or not len(section.vehicle):
        return view
    tail = section.vehicle[..., 1].min()
    return replace(view, z=(min(view.z[0], tail - 0.1 * (view.x[1] - view.x[0])), view.z[1]))
