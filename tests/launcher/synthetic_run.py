"""Invents a finished run of the water exit: a folder as the solvers would leave it, without solving anything.

The motion has a closed form (a half-sine pulse of deceleration), so the tests know what the summary must say. The
fields only have the right shapes: they are there to be drawn.
"""
from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy

SPEED, LOSS = 40.0, 4.0              # m/s
CONTACT, PULSE = 1.0e-4, 4.0e-4      # s: first contact, length of the pulse
END, SPANS, FRAMES = 1.0e-3, 2000, 11
MASS, HEAD, LENGTH, RADIUS, NOSE = 0.005, 0.010, 0.100, 0.005, -0.004
THICKNESS, DRAUGHT, CELL = 0.010, 0.009, 0.002
PEAK = LOSS * numpy.pi / (2 * PULSE)  # m/s^2, of a half sine that takes LOSS from the speed

SCENE = {
    "title": "Water exit through floating ice (invented)", "name": "invented", "level": "quick", "symmetry": "quarter",
    "run": {"end": "ice_passed", "end_time": END, "frame_interval": END / 10, "step_factor": 0.6,
            "fluid_step_factor": 0.5, "filter_frequency": 50e3, "gravity": 9.81, "seed": 1},
    "resolution": {"cell": CELL, "ice_element": CELL, "vehicle_element": CELL, "fine_radius": 0.03,
                   "ice_fine_radius": 0.03, "growth": 1.1, "largest_ice_element": 0.005},
    "vehicle": {"head": "ogive", "head_length": HEAD, "diameter": 2 * RADIUS, "length": LENGTH, "interior": "hollow",
                "wall_thickness": 0.0, "mass": MASS, "material": "aluminium", "speed": SPEED, "nose_position": NOSE,
                "deformable": True},
    "ice": {"length": 0.2, "width": 0.2, "thickness": THICKNESS, "lower_face": 0.0, "material": "ice.paper",
            "critical_strain": 0.35, "sides": "non_reflecting", "particles": "element_centre"},
    "fluid": {"length": 0.2, "width": 0.2, "bottom": -0.12, "top": 0.039, "waterline": DRAUGHT, "water": "water",
              "air": "air", "atmospheric_pressure": 101325.0, "vapour_pressure": 2300.0, "start": "potential_flow",
              "outer_boundary": "non_reflecting"},
    "contact": {"friction": 0.1, "stiffness_factor": 0.1}, "materials": {},
    "participants": {name: {"command": "", "launch": ""} for name in ("structure", "ice", "fluid")},
    "effects": {"fluid": {"requested": "auto", "active": True, "reason": "the scene has water."},
                "conversion": {"requested": "auto", "active": True, "reason": "elements become particles."},
                "cavitation": {"requested": "auto", "active": False, "reason": "no pressure falls below vapour."}},
}


def deceleration(time: numpy.ndarray) -> numpy.ndarray:
    phase = (time - CONTACT) / PULSE
    return numpy.where((phase > 0) & (phase < 1), PEAK * numpy.sin(numpy.pi * numpy.clip(phase, 0, 1)), 0.0)


def speed(time: numpy.ndarray) -> numpy.ndarray:
    phase = numpy.clip((time - CONTACT) / PULSE, 0, 1)
    return SPEED - LOSS * (1 - numpy.cos(numpy.pi * phase)) / 2


def travel(time: numpy.ndarray) -> numpy.ndarray:
    phase = numpy.clip((time - CONTACT) / PULSE, 0, 1)
    after = numpy.maximum(0, time - CONTACT - PULSE)
    return SPEED * time - LOSS / 2 * PULSE * (phase - numpy.sin(numpy.pi * phase) / numpy.pi) - LOSS * after


def write_run(folder: Path, frames: int = FRAMES) -> Path:
    """A whole run folder; returns it."""
    for part in ("series", "fields", "logs"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    (folder / "scene.json").write_text(json.dumps(SCENE))
    (folder / "coupler_summary.json").write_text(json.dumps({"energy_error": 1.2e-3, "end_reason": "ice passed"}))
    write_series(folder / "series" / "coupler.csv")
    times = numpy.linspace(0, END, frames)
    for name, fields in (("vehicle", vehicle), ("ice", ice), ("particles", particles), ("fluid", fluid)):
        index = []
        for number, time in enumerate(times):
            content = fields(time)
            if content is not None:
                index.append({"file": f"{name}_{number:04d}.vtkhdf", "time": float(time)})
                write_frame(folder / "fields" / index[-1]["file"], *content)
        (folder / "fields" / f"{name}.json").write_text(json.dumps({"frames": index}))
    return folder


def write_series(path: Path) -> None:
    time = numpy.linspace(0, END, SPANS + 1)
    v, touching = speed(time), deceleration(time) > 0
    lost = 0.5 * MASS * (SPEED ** 2 - v ** 2)
    phase = numpy.clip((time - CONTACT) / PULSE, 0, 1)
    table = {
        "time [s]": time, "window": 4 * numpy.arange(len(time)), "span": numpy.arange(len(time)),
        "vehicle_speed [m/s]": v, "vehicle_momentum [kg m/s]": MASS * v, "vehicle_position [m]": NOSE + travel(time),
        "energy_error": 1.2e-3 * phase, "momentum_error": 1e-12 * phase,
        "contact_force [N]": numpy.where(touching, 0.8 * MASS * deceleration(time), 0),
        "fluid_force [N]": -6.0 - 2 * phase, "head_stress [Pa]": 94.8e6 * deceleration(time) / PEAK + 5e6,
        "vehicle_kinetic [J]": 0.5 * MASS * v ** 2, "vehicle_internal [J]": 0.05 * lost,
        "ice_kinetic [J]": 0.3 * lost, "ice_internal [J]": 0.3 * lost, "fluid_energy_change [J]": 0.2 * lost,
        "contact_energy [J]": 0.02 * lost, "dissipated [J]": 0.13 * lost, "broken_ice_mass [kg]": 8e-4 * phase,
        "converted_elements": (120 * phase).astype(int), "particles": (480 * phase).astype(int),
        "fluid_step [s]": numpy.full(len(time), 5e-7), "window_step [s]": numpy.full(len(time), 1.25e-7)}
    lines = [",".join(table)] + [",".join(f"{x:.12g}" for x in row) for row in zip(*table.values())]
    path.write_text("\n".join(lines) + "\n")


def write_frame(path: Path, points: numpy.ndarray, cells: numpy.ndarray, fields: dict[str, numpy.ndarray],
                grid: tuple[numpy.ndarray, ...] = ()) -> None:
    """VTKHDF UnstructuredGrid 1.0 with cells of one kind (hexahedra or vertices)."""
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = [1, 0]
        root.attrs["Type"] = numpy.bytes_("UnstructuredGrid")
        root["NumberOfPoints"], root["NumberOfCells"] = [len(points)], [len(cells)]
        root["NumberOfConnectivityIds"] = [cells.size]
        root["Points"], root["Connectivity"] = points, cells.ravel()
        root["Offsets"] = cells.shape[1] * numpy.arange(len(cells) + 1)
        root["Types"] = numpy.full(len(cells), 12 if cells.shape[1] == 8 else 1, numpy.uint8)
        for name, values in fields.items():
            root[f"CellData/{name}"] = values
        for name, line in zip("xyz", grid):
            file[f"Grid/{name}"] = line


def box(x: numpy.ndarray, y: numpy.ndarray, z: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Nodes and hexahedra of a grid; x runs fastest."""
    nz, ny, nx = len(z), len(y), len(x)
    zz, yy, xx = numpy.meshgrid(z, y, x, indexing="ij")
    number = numpy.arange(nx * ny * nz).reshape(nz, ny, nx)
    corners = [number[k:nz - 1 + k, j:ny - 1 + j, i:nx - 1 + i].ravel() for k in (0, 1)
               for j, i in ((0, 0), (0, 1), (1, 1), (1, 0))]
    return numpy.stack([xx, yy, zz], -1).reshape(-1, 3), numpy.stack(corners, 1)


def centres(points: numpy.ndarray, cells: numpy.ndarray) -> numpy.ndarray:
    return points[cells].mean(axis=1)


def hull(depth: numpy.ndarray) -> numpy.ndarray:
    """Radius at a depth below the nose."""
    share = numpy.clip(depth / HEAD, 0, 1)
    return RADIUS * numpy.sqrt(numpy.maximum(0, 1 - (1 - share) ** 2))


def vehicle(time: float):
    depth = numpy.concatenate([HEAD * numpy.linspace(0.02, 1, 8), numpy.linspace(HEAD, LENGTH, 46)[1:]])[::-1]
    points, cells = box(numpy.linspace(0.75, 1, 3), numpy.linspace(0, numpy.pi / 2, 9), -depth)
    radius = hull(-points[:, 2]) * points[:, 0]
    where = numpy.stack([radius * numpy.cos(points[:, 1]), radius * numpy.sin(points[:, 1]), points[:, 2]], 1)
    where[:, 2] += NOSE + travel(time)
    below = -centres(points, cells)[:, 2]
    stress = 95e6 * numpy.exp(-below / 0.015) * deceleration(time) / PEAK + 8e6 * numpy.exp(-((below - .06) / .01) ** 2)
    return where, cells, {"von_mises": stress}


def ice_grid() -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    points, cells = box(numpy.arange(0, 0.1001, CELL), numpy.arange(0, 0.1001, CELL),
                        numpy.arange(0, THICKNESS + 1e-6, CELL))
    return points, cells, centres(points, cells)


def broken(time: float, centre: numpy.ndarray) -> numpy.ndarray:
    return numpy.hypot(centre[:, 0], centre[:, 1]) < hull(NOSE + travel(time) - centre[:, 2] + 0.001) + 0.001


def ice(time: float):
    points, cells, centre = ice_grid()
    whole = ~broken(time, centre)
    distance, angle = numpy.hypot(centre[:, 0], centre[:, 1]), numpy.arctan2(centre[:, 1], centre[:, 0])
    hurt = numpy.clip((time - CONTACT) / PULSE, 0, 1)
    damage = numpy.clip(1.4 * hurt * numpy.exp(-distance / 0.012) + 0.8 * hurt * (numpy.sin(6 * angle) > 0.93) *
                        (distance < 0.05 * hurt), 0, 1)
    points = points + numpy.array([0, 0, 1]) * (0.003 * hurt * numpy.exp(-(numpy.hypot(*points[:, :2].T) / 0.02) ** 2)
                                                )[:, None]
    return points, cells[whole], {"damage": damage[whole], "effective_strain": 0.3 * damage[whole],
                                  "pressure": 1e6 * damage[whole]}


def particles(time: float):
    points, cells, centre = ice_grid()
    gone = centre[broken(time, centre)]
    if not len(gone):
        return None
    random = numpy.random.default_rng(1)
    age = numpy.maximum(0, time - CONTACT)
    velocity = random.normal(0, 6, gone.shape) * [1, 1, 0.5] + [0, 0, 30] + gone * [1500, 1500, 0]
    place = gone + velocity * age
    place[:, :2] = numpy.abs(place[:, :2])
    return place, numpy.arange(len(place))[:, None], {"damage": numpy.ones(len(place)), "velocity": velocity}


def fluid(time: float):
    fine = numpy.arange(0, 0.0301, CELL)
    side = numpy.concatenate([fine, 0.03 + 0.07 * (numpy.linspace(0, 1, 16)[1:]) ** 1.5])
    z = numpy.arange(-0.12, 0.0391, CELL)
    points, cells = box(side, side, z)
    centre = centres(points, cells)
    nose, distance = NOSE + travel(time), numpy.hypot(centre[:, 0], centre[:, 1])
    dome = 0.004 * numpy.clip(time / 5e-4, 0, 1) * numpy.exp(-(distance / 0.015) ** 2)
    water = numpy.clip((DRAUGHT + dome - centre[:, 2]) / CELL + 0.5, 0, 1)
    to_nose = numpy.sqrt(distance ** 2 + (centre[:, 2] - nose) ** 2)
    pressure = 8e5 * numpy.exp(-to_nose / 0.006) - 8e4 * numpy.exp(-((centre[:, 2] - nose + 0.014) / 0.006) ** 2 -
                                                                   (distance / 0.01) ** 2)
    pressure = water * (pressure + 9810 * (DRAUGHT - centre[:, 2]))
    solid = ((distance < hull(nose - centre[:, 2])) & (centre[:, 2] > nose - LENGTH)).astype(float)
    return points, cells, {"pressure": pressure, "water_fraction": water, "solid_fraction": solid,
                           "density": 1000 * water + 1.2 * (1 - water)}, (side, side, z)
