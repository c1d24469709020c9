"""The coupler's part towards a fluid: docs/protocol.md, section 5, with a box in the water that begins to rise."""
from __future__ import annotations

import numpy

from launcher.conform import greeting
from launcher.conform.box_overlap import box_in_water, depths, overlap
from launcher.conform.conversation import Conversation
from launcher.conform.greeting import Account
from launcher.conform.surface_checks import check_finite
from launcher.conform.wire import Breach, Findings

SECTION = "5"
SPEED = 0.05        # m/s of the box: 75 kPa of sound pressure in water
SHARE_OF_STEP = 0.5
AT_REST = 0.01      # largest share by which the pressure at rest may differ from density times gravity times depth


class Fluid:
    """A fluid and what was sent to it."""

    def __init__(self, talk: Conversation, scene: dict, findings: Findings) -> None:
        self.talk, self.scene, self.findings = talk, scene, findings
        self.span, self.time, self.walls_before = 0, 0.0, 0

    def join(self) -> None:
        """Up to the answer to `begin`, with the box at rest."""
        greeting.welcome(self.talk, self.findings)
        ready = self.talk.receive("ready", "3")
        role = ready.field(SECTION, "role", str, '"fluid"')
        if role != "fluid":
            raise Breach(SECTION, f"'ready': the field 'role' is '{role}', it must be 'fluid'")
        self.stable = greeting.stable_step(ready, SECTION)
        self.forecasts = ready.header.get("forecasts", False) is True
        self.account = Account(ready, self.findings)
        self.lines = [ready.array(SECTION, f"grid.{axis}", "f8", (None,)) for axis in "xyz"]
        for axis, line in zip("xyz", self.lines):
            if len(line) < 2 or not numpy.all(numpy.diff(line) > 0):
                raise Breach(SECTION, f"'ready': the coordinates of 'grid.{axis}' must ascend, two or more of them")
        self.box = box_in_water(self.lines, self.scene["fluid"]["waterline"])
        self.talk.expect_silence(greeting.BEFORE_ANSWER, SECTION, "'begin'")
        self.talk.send("begin", {"time": 0.0}, self.arrays(0.0))
        self.take_pressure(first=True)

    def arrays(self, speed: float) -> dict[str, numpy.ndarray]:
        arrays = overlap(self.lines, self.box, speed)
        self.walls = arrays["wall"]
        return arrays

    def take_pressure(self, first: bool = False) -> None:
        message = self.talk.receive("pressure", SECTION)
        if not first:
            greeting.check_number(message, SECTION, "span", self.span, self.findings)
        self.stable = greeting.stable_step(message, SECTION)
        expected = {"pressure.values": len(self.walls), "pressure.gradient_z": len(self.walls)}
        if not first:
            expected |= dict.fromkeys(("pressure.previous_values", "pressure.previous_gradient_z"), self.walls_before)
        if self.forecasts and not first:
            expected |= dict.fromkeys(("pressure.forecast", "pressure.impedance"), len(self.walls))
        for name, count in expected.items():
            message.array(SECTION, name, "f8", (count,))
            check_finite(message, SECTION, name, self.findings)
        if "pressure.impulse" in message.arrays:
            message.array(SECTION, "pressure.impulse", "f8", (len(self.walls), 2, 3))
            check_finite(message, SECTION, "pressure.impulse", self.findings)
        if numpy.any(message.arrays.get("pressure.impedance", numpy.zeros(0)) < 0):
            self.findings.add(SECTION, "impedance", "'pressure': 'pressure.impedance' has a negative value")
        self.account.read(message)
        if first:
            self.check_rest(message.arrays["pressure.values"], message.arrays["pressure.gradient_z"])

    def check_rest(self, values: numpy.ndarray, gradient: numpy.ndarray) -> None:
        """At the wall of a body at rest the gauge pressure is density times gravity times depth."""
        water, gravity = self.scene["fluid"]["water"], self.scene["run"]["gravity"]
        weight = self.scene["materials"][water]["values"]["density"] * gravity
        depth = depths(self.lines, self.walls, self.scene["fluid"]["waterline"])
        for name, found, due, unit in (("values", values, weight * depth, "Pa"),
                                       ("gradient_z", gradient, numpy.full(len(depth), weight), "Pa/m")):
            error = numpy.abs(found - due)
            if len(error) and not error.max() <= AT_REST * max(numpy.abs(due).max(), 1.0):
                e = int(numpy.argmax(error))
                self.findings.add(SECTION, f"rest {name}", f"'pressure': around a body at rest 'pressure.{name}' is "
                                  f"{found[e]:.6g} {unit} at a depth of {depth[e]:.4g} m, where the gauge pressure "
                                  f"gives {due[e]:.6g} {unit} (positive in compression, falling upward)")

    def advance(self, *, finish: bool = False, frame: int = -1, remark: str = "", odd_fields: bool = False,
                odd_arrays: bool = False) -> None:
        """Sends one span and takes its answer."""
        length = SHARE_OF_STEP * self.stable
        fields = {"span": self.span, "time0": self.time, "time1": self.time + length, "finish": finish, "frame": frame}
        if odd_fields:
            fields["conform_remark"] = {"unknown": ["fields", "are", "ignored"]}
        self.time, self.box, self.walls_before = self.time + length, self.box.raised(SPEED * length), len(self.walls)
        arrays = self.arrays(SPEED)
        self.talk.send("span", fields, greeting.strange(arrays) if odd_arrays else arrays,
                       remark=f"of span {self.span}{remark}")
        self.take_pressure()
        self.span += 1


def play_whole(talk: Conversation, scene: dict, findings: Findings, slow: float) -> dict[str, int]:
    """From `hello` to the exit code 0. Returns what happened, counted."""
    fluid = Fluid(talk, scene, findings)
    fluid.join()
    talk.expect_silence(greeting.BEFORE_ANSWER, SECTION, "'span'")
    for _ in range(3):
        fluid.advance()
    fluid.advance(remark=" with a field that nobody knows", odd_fields=True)
    fluid.advance(remark=" with its arrays in another order and one that nobody knows", odd_arrays=True)
    talk.expect_silence(slow, SECTION, "'span'")
    fluid.advance(finish=True, frame=0, remark=" with finish = true")
    greeting.leave(talk)
    return {"spans": fluid.span}


def play_some(talk: Conversation, scene: dict, findings: Findings) -> None:
    """Into the middle of the run."""
    fluid = Fluid(talk, scene, findings)
    fluid.join()
    fluid.advance()
