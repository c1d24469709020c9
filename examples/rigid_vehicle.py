#!/usr/bin/python3
"""A rigid vehicle in one file: takes the place of the project's structure solver in any scene with a vehicle.

    ./polynya run cases/vehicle_drop --set participants.structure.command="/usr/bin/python3 examples/rigid_vehicle.py"

Follows docs/protocol.md. The launcher leaves the vehicle's surface, mass and inertia in RUN/vehicle_surface.json; a
program with a geometry of its own does not need that file. Needs pyzmq and numpy.
"""
import argparse
import json
import os
import sys

import numpy as np
import zmq

ACCOUNT = ["kinetic", "gravity_work", "momentum_z", "gravity_impulse_z", "mass", "centre_of_mass_z"]
STABLE_STEP = 1e300  # s: a rigid body takes any step, so a free window is one like the others


class Coupler:
    """Sections 1 to 3 of the protocol."""

    def __init__(self, endpoint, run, name):
        self.run = run
        self.socket = zmq.Context.instance().socket(zmq.DEALER)
        self.socket.set_hwm(0)
        self.socket.linger = 2000
        if endpoint.startswith("tcp:"):
            self.socket.heartbeat_ivl, self.socket.heartbeat_timeout, self.socket.heartbeat_ttl = 500, 3000, 3000
        self.poller = zmq.Poller()
        self.poller.register(self.socket, zmq.POLLIN)
        self.poller.register(self.socket.get_monitor_socket(zmq.EVENT_DISCONNECTED), zmq.POLLIN)
        self.socket.connect(endpoint)
        self.send("hello", name=name, pid=os.getpid())
        self.receive("welcome")

    def send(self, kind, arrays={}, **fields):
        arrays = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
        described = [{"name": n, "type": a.dtype.str[1:], "shape": a.shape} for n, a in arrays.items()]
        header = {"protocol": 2, "run": self.run, "kind": kind, "part": 1, "parts": 1, "arrays": described, **fields}
        self.socket.send_multipart([json.dumps(header).encode(), *arrays.values()])

    def receive(self, kind):
        """The next message: its header and its arrays by name. Ends the process if it is another than expected."""
        if self.socket not in dict(self.poller.poll()):
            sys.exit("the coupler is gone")
        frames = self.socket.recv_multipart()
        header = json.loads(frames[0])
        if header["kind"] != kind:
            sys.exit(f"{header['kind']} instead of {kind}: {header.get('reason', '')}")
        return header, {d["name"]: np.frombuffer(frame, "<" + d["type"]).reshape(d["shape"])
                        for d, frame in zip(header["arrays"], frames[1:])}


def rotation(angle):
    """Matrix of the rotation about the direction of `angle` by its length."""
    size = np.linalg.norm(angle)
    x, y, z = angle / size if size > 0 else angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(size) * cross + (1 - np.cos(size)) * cross @ cross


class RigidBody:
    """Positions at t(n), velocity and angular momentum at t(n+1/2). Symmetry takes away motions: of a half, those out
    of the plane y = 0; of a quarter, all but that along z."""

    def __init__(self, surface, symmetry, speed, gravity):
        self.mass, self.gravity = surface["mass"], gravity
        self.centre, self.inertia = np.array(surface["centre_of_mass"]), np.array(surface["inertia"])
        self.arms = np.array(surface["positions"]) - self.centre  # in the body's frame
        self.free = {"full": [1, 1, 1], "half": [1, 0, 1], "quarter": [0, 0, 1]}[symmetry]
        self.turns = {"full": [1, 1, 1], "half": [0, 1, 0], "quarter": [0, 0, 0]}[symmetry]
        self.velocity, self.spin_momentum = np.array([0, 0, speed]), np.zeros(3)
        self.frame, self.frame_rate = np.eye(3), np.zeros((3, 3))
        self.gravity_impulse, self.start_z = 0.0, self.centre[2]
        self.push(np.zeros_like(self.arms), 0, 0)

    def spin(self, momentum):
        """Angular velocity that belongs to an angular momentum, both in the body's frame, as symmetry allows."""
        free = np.all(self.turns)
        return np.linalg.solve(self.inertia, momentum) if free else self.turns * momentum / np.diag(self.inertia)

    def resistance(self):
        """The least mass with which the body resists a force at each vertex, by direction: how stiff contacts may be."""
        turns = np.column_stack([self.spin(axis) for axis in np.eye(3)]) if any(self.turns) else np.zeros((3, 3))
        x, y, z = self.arms.T
        zero = np.zeros_like(x)
        cross = np.moveaxis(np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]), 2, 0)
        yielding = np.diag(self.free) / self.mass + np.swapaxes(cross, 1, 2) @ turns @ cross
        return 1 / np.linalg.eigvalsh(yielding)[:, -1]

    def advance(self, dt):
        """x(n+1) = x(n) + dt v(n+1/2). The frame turns by the spin that belongs to the mean momentum of the step."""
        before, self.centre = self.frame, self.centre + dt * self.velocity
        at_start = before.T @ self.spin_momentum
        spin = self.spin(at_start)
        for _ in range(50 if at_start.any() else 0):  # contracts by dt times the spin at each pass
            last, spin = spin, self.spin(0.5 * (at_start + rotation(-dt * spin) @ at_start))
            if np.linalg.norm(spin - last) <= 1e-16 * np.linalg.norm(spin):
                break
        self.frame = before @ rotation(dt * spin)
        self.frame_rate = (self.frame - before) / dt

    def push(self, forces, dt, dt_next):
        """v(n+3/2) = v(n+1/2) + (dt + dt_next)/2 F/m for the forces on the vertices and the weight."""
        offsets = self.arms @ self.frame.T
        force = (forces.sum(axis=0) + [0, 0, -self.mass * self.gravity]) * self.free
        torque = np.cross(offsets, forces).sum(axis=0) * self.turns
        middle = self.velocity + 0.5 * dt / self.mass * force                   # at the time of the force
        momentum = self.frame.T @ (self.spin_momentum + 0.5 * dt * torque)
        kinetic = 0.5 * self.mass * middle @ middle + 0.5 * momentum @ self.spin(momentum)
        gravity_work = -self.mass * self.gravity * (self.centre[2] - self.start_z)
        self.velocity = self.velocity + 0.5 * (dt + dt_next) / self.mass * force
        self.spin_momentum = self.spin_momentum + 0.5 * (dt + dt_next) * torque
        self.gravity_impulse -= 0.5 * (dt + dt_next) * self.mass * self.gravity
        upward = self.mass * self.velocity[2]  # of t(n+1/2), as all impulses; the rest is of t(n)
        self.account = np.array([kinetic, gravity_work, upward, self.gravity_impulse, self.mass, self.centre[2]])

    def state(self):
        """What goes into every message, as arrays of the protocol."""
        return {"positions": self.centre + self.arms @ self.frame.T,
                "velocities": self.velocity + self.arms @ self.frame_rate.T, "account": self.account}


def main():
    parser = argparse.ArgumentParser(description="A rigid vehicle as a participant of a coupled run.")
    for option in ("--scene", "--out", "--name", "--connect", "--run"):
        parser.add_argument(option, required=True)
    options = parser.parse_args()
    with open(options.scene) as file, open(os.path.join(options.out, "vehicle_surface.json")) as hull:
        scene, surface = json.load(file), json.load(hull)
    body = RigidBody(surface, scene["symmetry"], scene["vehicle"]["speed"], scene["run"]["gravity"])
    topology = {"surface.rigid_masses": body.resistance(), "surface.ids": np.array(surface["ids"], "i8"), "surface.masses": np.array(surface["masses"]),
                "surface.triangles": np.array(surface["triangles"], "i4"),
                **dict.fromkeys(("surface.radius", "surface.volume"), np.zeros(len(body.arms)))}
    coupler = Coupler(options.connect, options.run, options.name)
    coupler.send("ready", {**body.state(), **topology}, role="solid", body="vehicle", stable_step=STABLE_STEP,
                 can_subdivide=True, account=ACCOUNT)
    loads, arrays = coupler.receive("begin")
    time, dt, next_dt, window = loads["time"], 0, loads["step"], 0
    while True:
        forces = np.zeros_like(body.arms)
        forces[arrays["load.vertices"]] = arrays["load.forces"]
        body.push(forces, dt, next_dt)
        if loads.get("finish"):
            break
        dt, time = next_dt, time + next_dt
        body.advance(dt)
        coupler.send("surface", body.state(), window=window, time=time, stable_step=STABLE_STEP, topology_changed=False)
        loads, arrays = coupler.receive("loads")
        next_dt, window = loads["next_step"], window + 1
    coupler.send("finished", steps=window, speed=body.velocity[2])
    coupler.receive("bye")


if __name__ == "__main__":
    main()
