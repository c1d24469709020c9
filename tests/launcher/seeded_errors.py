"""A participant with errors that can be switched on: a rigid tetrahedron, or a fluid at rest, in plain Python.

    seeded_errors.py ERROR --scene ... --out ... --name ... --connect ... --run ...

ERROR is "none" or one of those that this file asks for by `seeded(...)`.
"""
import argparse
import json
import os
import struct
import sys
import time

import zmq

MASS = 1e-3  # kg, of each vertex
STEP = 1e-6  # s
TRIANGLES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
ERROR = sys.argv[1]


def seeded(name):
    return ERROR == name


class Leave(Exception):
    """Ends the process with an exit code and a word."""


class Coupler:
    def __init__(self, options):
        self.run = "not-this-run" if seeded("another_run") else options.run
        self.socket = zmq.Context.instance().socket(zmq.DEALER)
        self.socket.linger = 1000
        self.poller = zmq.Poller()
        self.poller.register(self.socket, zmq.POLLIN)
        if not seeded("ignores_closed_connection"):
            self.poller.register(self.socket.get_monitor_socket(zmq.EVENT_DISCONNECTED), zmq.POLLIN)
        self.socket.connect(options.connect)

    def send(self, kind, arrays=(), **fields):
        """arrays: (name, type, shape, flat values)"""
        described = [{"name": n, "type": t, "shape": list(s)} for n, t, s, _ in arrays]
        frames = [struct.pack(f"<{len(v)}{ {'f8': 'd', 'i8': 'q', 'i4': 'i'}[t] }", *v) for _, t, _, v in arrays]
        header = {"protocol": 1 if seeded("protocol") else 2, "run": self.run, "kind": kind, "part": 1, "parts": 1,
                  "arrays": described, **fields}
        if seeded("no_parts"):
            del header["parts"]
        if seeded("short_frame") and kind == "surface":
            frames[0] = frames[0][:-8]
        if seeded("lost_frame") and kind == "surface":
            frames.pop()
        delimiter = [b""] if seeded("delimiter") else []
        self.socket.send_multipart([*delimiter, json.dumps(header).encode(), *frames])

    def receive(self, kind):
        patience = 1000 if seeded("impatient") else None
        ready = dict(self.poller.poll(patience))
        if not ready:
            raise Leave(1, "no answer for 1 s")
        if self.socket not in ready:
            raise Leave(0 if seeded("content_with_closed_connection") else 1, "the coupler is gone")
        frames = self.socket.recv_multipart()
        header = json.loads(frames[0])
        if header["kind"] == "refuse":
            raise Leave(1, "refused" if seeded("silent_refusal") else header["reason"])
        if header["kind"] == "stop":
            raise Leave(0 if seeded("stop_is_success") else 1, "stopped")
        if header["kind"] != kind:
            raise Leave(1, f"{header['kind']} instead of {kind}")
        if seeded("unknown_field") and "conform_remark" in header:
            raise Leave(1, "a field that I do not know")
        if seeded("order_of_arrays") and header["arrays"] and header["arrays"][0]["name"] not in ("load.vertices", "cell"):
            raise Leave(1, "array 0 is not mine")
        if seeded("empty_arrays") and kind == "loads" and not frames[1]:
            raise Leave(1, "an empty frame")
        return header, {d["name"]: (d["shape"], frame) for d, frame in zip(header["arrays"], frames[1:])}


def vector(name, rows):
    return name, "f8", (len(rows), 3), [value for row in rows for value in row]


def play_solid(coupler):
    x = [(0.001, 0.001, -0.02), (0.011, 0.001, -0.02), (0.001, 0.011, -0.02), (0.001, 0.001, -0.01)]
    v, now = [[0.0, 0.0, 10.0] for _ in x], 0.0
    triangles = list(TRIANGLES)
    if seeded("index"):
        triangles[0] = (0, 2, 4)
    if seeded("one_turned_triangle"):
        triangles[0] = (0, 1, 2)
    if seeded("inside_out"):
        triangles = [(a, c, b) for a, b, c in triangles]
    if seeded("open_surface"):
        triangles = triangles[:3]
    masses = [MASS] * 3 if seeded("masses_missing") else [MASS] * 4
    topology = [("surface.ids", "i8", (4,), range(4)), ("surface.masses", "f8", (len(masses),), masses),
                ("surface.triangles", "i4", (len(triangles), 3), [i for t in triangles for i in t]),
                ("surface.radius", "f8", (4,), [0.0] * 4), ("surface.volume", "f8", (4,), [0.0] * 4)]
    names = ["kinetic", "momentum_z"]

    def motion(kind):
        positions = [p[:2] + (float("nan"),) if seeded("not_finite") and i == 2 and kind == "surface" else p
                     for i, p in enumerate(x)]
        arrays = [vector("positions", positions), vector("velocities", v)]
        if seeded("single_precision"):
            arrays[1] = ("velocities", "i4", (4, 3), [0] * 12)
        account = [sum(0.5 * MASS * u[2] ** 2 for u in v), sum(MASS * u[2] for u in v)]
        account += [1.0] if seeded("account_too_long") and kind == "surface" else []
        return arrays + [("account", "f8", (len(account),), account)]

    coupler.send("ready", motion("ready") + topology, role="solid", body="ice" if seeded("body") else "vehicle",
                 stable_step=0.0 if seeded("stable_step") else STEP, account=names)
    begin, arrays = coupler.receive("begin")
    dt, window, finish = begin["step"], 0, False

    def accelerate(arrays, acting):
        (count,), vertices = arrays["load.vertices"]
        forces = struct.unpack(f"<{3 * count}d", arrays["load.forces"][1])
        for n, i in enumerate(struct.unpack(f"<{count}q", vertices)):
            for c in range(3):
                v[i][c] += acting * forces[3 * n + c] / MASS

    if not seeded("deaf_at_start"):
        accelerate(arrays, 0.5 * dt)
    while not finish:
        x = [tuple(p + dt * u for p, u in zip(*pair)) for pair in zip(x, v)]
        if seeded("jump") and window == 2:
            x = [(p[0] + 1e-9, *p[1:]) for p in x]
        now += dt if not (seeded("clock") and window == 3) else 0.9 * dt
        changed = {"topology_changed": True} if seeded("topology") and window == 2 else {"topology_changed": False}
        coupler.send("surface", motion("surface"), window=window + (seeded("window_number") and window > 1), time=now,
                     stable_step=STEP, **changed)
        if seeded("does_not_wait"):
            coupler.send("surface", motion("surface"), window=window + 1, time=now, stable_step=STEP, **changed)
        loads, arrays = coupler.receive("loads")
        if seeded("leaves_early") and window == 1:
            raise Leave(3, "out of licences")
        if seeded("goes_mute") and window == 1:
            time.sleep(100)
        acting = 0.5 * (dt + loads["next_step"]) if not seeded("whole_step") else dt
        accelerate(arrays, -acting if seeded("wrong_sign") else acting)
        dt, finish, window = loads["next_step"], loads["finish"], window + 1
        finish = finish and not seeded("goes_on")


def play_fluid(coupler, scene):
    """A fluid whose pressure is hydrostatic for ever."""
    lines = {axis: [0.01 * i for i in range(13)] for axis in "xy"}
    lines["z"] = [-0.16 + 0.01 * i for i in range(20)]
    if seeded("grid_descends"):
        lines["z"].reverse()
    weight = 1000 * scene["run"]["gravity"]
    coupler.send("ready", [("account", "f8", (1,), [0.0])] +
                 [(f"grid.{axis}", "f8", (len(line),), line) for axis, line in lines.items()],
                 role="solid" if seeded("role") else "fluid", stable_step=STEP, account=["kinetic"])

    def pressures(overlap, prefix):
        (count,), frame = overlap["wall"]
        depth = [-(lines["z"][0] + 0.01 * (cell // 144 + 0.5)) for cell in struct.unpack(f"<{count}q", frame)]
        absolute = 101325 if seeded("absolute_pressure") else 0
        values = [absolute + weight * d for d in depth]
        if seeded("pressure_shape"):
            values.append(0.0)
        sign = -1 if seeded("gradient_sign") else 1
        return [(prefix + "values", "f8", (len(values),), values),
                (prefix + "gradient_z", "f8", (count,), [sign * weight] * count)]

    account = [("account", "f8", (1,), [0.0])]
    _, overlap = coupler.receive("begin")
    coupler.send("pressure", pressures(overlap, "pressure.") + account, stable_step=STEP)
    finish = False
    while not finish:
        span, after = coupler.receive("span")
        previous = after if seeded("previous_is_present") else overlap
        coupler.send("pressure", pressures(after, "pressure.") + pressures(previous, "pressure.previous_") + account,
                     stable_step=STEP, span=span["span"] + seeded("span_number"))
        overlap, finish = after, span["finish"]


def main():
    parser = argparse.ArgumentParser()
    for option in ("--scene", "--out", "--name", "--connect", "--run"):
        parser.add_argument(option)
    options = parser.parse_args(sys.argv[2:])
    coupler = Coupler(options)
    name = "structures" if seeded("name") else "structure" if seeded("name_of_another") else options.name
    if seeded("ready_first"):
        return play_solid(coupler)
    coupler.send("hello", name=name, pid=os.getpid())
    coupler.receive("welcome")
    if options.name == "fluid":
        with open(options.scene) as file:
            play_fluid(coupler, json.load(file))
    else:
        play_solid(coupler)
    coupler.send("finished")
    if not seeded("no_goodbye"):
        coupler.receive("bye")
    if seeded("exit_code"):
        raise Leave(4, "done")


try:
    main()
except Leave as leave:
    code, word = leave.args
    print(word, file=sys.stderr, flush=True)
    sys.exit(code)
