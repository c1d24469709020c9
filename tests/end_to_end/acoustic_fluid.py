"""A fluid that answers to walls as plane sound does, p = rho c (speed into the fluid), and forecasts nothing.

Takes the fluid's place in a scene with a vehicle; examples/rigid_vehicle.py has the protocol.
"""
import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))
from rigid_vehicle import Coupler  # noqa: E402

IMPEDANCE = 1.48e6  # kg/(m^2 s)
CELL = 1e-3  # m
STEP = 0.25e-6  # s


def pressures(overlap, prefix, moving):
    """What presses on the walls of an overlap: nothing before anything moves."""
    velocity_into_body = overlap["wall_sweep"].sum(axis=1) / overlap["wall_size"]
    values = -IMPEDANCE * velocity_into_body if moving else np.zeros(len(overlap["wall"]))
    return {prefix + "values": values, prefix + "gradient_z": np.zeros(len(values))}


def section(overlap):
    """Integral of the squared cosine between wall and axis over the walls, cell by cell, m^2."""
    return (overlap["wall_area"][:, :, 2].sum(axis=1) ** 2 / overlap["wall_size"]).sum()


def main():
    parser = argparse.ArgumentParser()
    for option in ("--scene", "--out", "--name", "--connect", "--run"):
        parser.add_argument(option)
    options, _ = parser.parse_known_args()
    coupler = Coupler(options.connect, options.run, options.name)
    across, along = CELL * np.arange(9), CELL * np.arange(-135, 1)
    coupler.send("ready", {"grid.x": across, "grid.y": across, "grid.z": along, "account": np.zeros(1)}, role="fluid",
                 stable_step=STEP, account=["exposure"])
    _, before = coupler.receive("begin")
    coupler.send("pressure", {**pressures(before, "pressure.", False), "account": np.zeros(1)}, stable_step=STEP)
    exposure = 0.0
    finish = False
    while not finish:
        span, after = coupler.receive("span")
        exposure += 0.5 * (span["time1"] - span["time0"]) * (section(before) + section(after)) * (span["span"] > 0)
        coupler.send("pressure", {**pressures(after, "pressure.", True),
                                  **pressures(before, "pressure.previous_", span["span"] > 0),
                                  "account": np.array([exposure])}, stable_step=STEP, span=span["span"])
        before, finish = after, span["finish"]
    coupler.send("finished")
    coupler.receive("bye")


if __name__ == "__main__":
    main()
