#!/usr/bin/python3
"""A solid in one screen: four mass points that span a tetrahedron and feel only the coupler's loads.

    ./polynya run cases/vehicle_drop --set participants.structure.command="/usr/bin/python3 examples/tetrahedron_solid.py"

Follows docs/protocol.md and stands in for the vehicle. Needs pyzmq and numpy.
"""
import argparse
import json
import os
import sys

import numpy as np
import zmq

STABLE_STEP = 1e-6  # s


class Coupler:
    def __init__(self, endpoint, run, name):
        self.run = run
        self.socket = zmq.Context.instance().socket(zmq.DEALER)
        self.socket.set_hwm(0)
        self.socket.linger = 2000
        self.poller = zmq.Poller()
        self.poller.register(self.socket, zmq.POLLIN)
        self.poller.register(self.socket.get_monitor_socket(zmq.EVENT_DISCONNECTED), zmq.POLLIN)
        self.socket.connect(endpoint)
        self.send("hello", name=name, pid=os.getpid())
        self.receive("welcome")

    def send(self, kind, arrays={}, **fields):
        arrays = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
        descriptors = [{"name": n, "type": a.dtype.str[1:], "shape": a.shape} for n, a in arrays.items()]
        header = {"protocol": 2, "run": self.run, "kind": kind, "part": 1, "parts": 1, "arrays": descriptors, **fields}
        self.socket.send_multipart([json.dumps(header).encode(), *arrays.values()])

    def receive(self, kind):
        if self.socket not in dict(self.poller.poll()):
            sys.exit("the coupler is gone")
        frames = self.socket.recv_multipart()
        header = json.loads(frames[0])
        if header["kind"] != kind:
            sys.exit(f"{header['kind']} instead of {kind}: {header.get('reason', '')}")
        arrays = {d["name"]: np.frombuffer(frame, "<" + d["type"]).reshape(d["shape"])
                  for d, frame in zip(header["arrays"], frames[1:])}
        return header, arrays


def main(endpoint, run, name):
    x = np.array([0.001, 0.001, -0.02]) + 0.01 * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    v = np.tile([0.0, 0.0, 40.0], (4, 1))
    masses = np.full(4, 1e-3)
    topology = {
        "surface.ids": np.arange(4, dtype="i8"), "surface.masses": masses,
        "surface.triangles": np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype="i4"),
        "surface.radius": np.zeros(4), "surface.volume": np.zeros(4)}
    account = lambda: np.array([0.5 * masses @ np.sum(v**2, axis=1), masses.sum(), masses @ v[:, 2]])

    coupler = Coupler(endpoint, run, name)
    coupler.send("ready", {"account": account(), "positions": x, "velocities": v, **topology}, role="solid",
                 body="vehicle", stable_step=STABLE_STEP, account=["kinetic", "mass", "momentum_z"])
    loads, arrays = coupler.receive("begin")
    time, step, next_step, window = loads["time"], 0, loads["step"], 0
    while True:
        forces = np.zeros_like(x)
        forces[arrays["load.vertices"]] = arrays["load.forces"]
        v += 0.5 * (step + next_step) * forces / masses[:, None]
        if loads.get("finish"):
            break
        step = next_step
        x += step * v
        time += step
        coupler.send("surface", {"positions": x, "velocities": v, "account": account()}, window=window, time=time,
                     stable_step=STABLE_STEP, topology_changed=False)
        loads, arrays = coupler.receive("loads")
        next_step, window = loads["next_step"], window + 1
    coupler.send("finished", windows=window)
    coupler.receive("bye")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Four mass points as a participant of a coupled run.")
    for option in ("--scene", "--out", "--name", "--connect", "--run"):
        parser.add_argument(option, required=True)
    options = parser.parse_args()
    main(options.connect, options.run, options.name)
