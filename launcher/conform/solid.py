"""The coupler's part towards a solid: docs/protocol.md, section 4, and how the solid answers a known force."""
from __future__ import annotations

import numpy

from launcher.conform import greeting
from launcher.conform.conversation import Conversation
from launcher.conform.greeting import Account
from launcher.conform.surface_checks import Surface, check_advance, read_surface
from launcher.conform.wire import Breach, Findings, Message

SECTION = "4"
LONGEST_STEP = 1e-6                   # s, for bodies that are stable with any step
STEPS = (0.5, 0.45, 0.49, 0.5, 0.47)  # of the stable step, window after window
PUSH = 1e7                            # m/s^2, what the loads would give to the loaded vertices alone
START_PUSH = 1e5                      # m/s^2, the same at time 0: what a solid may settle under is small
PUSHED = range(1, 4)                  # windows whose loads push
CRUSH_SPEED = 1000.0                  # m/s that loads give to one vertex of ice that may break
MOST_WINDOWS = 60                     # until it breaks
BODIES = {"structure": "vehicle", "ice": "ice"}


def load_arrays(forces: dict[int, float]) -> dict[str, numpy.ndarray]:
    """The arrays of `begin` and `loads`: vertical forces (N) on vertices."""
    values = numpy.zeros((len(forces), 3))
    values[:, 2] = list(forces.values())
    return {"load.vertices": numpy.array(list(forces), "i8"), "load.forces": values}


class Solid:
    """One solid and what is known of it while the windows go by."""

    def __init__(self, talk: Conversation, scene: dict, findings: Findings) -> None:
        self.talk, self.scene, self.findings = talk, scene, findings
        self.window, self.time, self.unsettled = 0, 0.0, 0.0
        self.impulses = 0.0  # N s, sum of the sizes of all impulses so far
        self.changes = 0     # of the topology

    def join(self) -> None:
        greeting.welcome(self.talk, self.findings)
        ready = self.talk.receive("ready", "3")
        role = ready.field(SECTION, "role", str, '"solid"')
        if role != "solid":
            raise Breach(SECTION, f"'ready': the field 'role' is '{role}', it must be 'solid'")
        body, due = ready.field(SECTION, "body", str, "a string"), BODIES[self.talk.name]
        if body != due:
            self.findings.add(SECTION, "body", f"'ready': the field 'body' is '{body}', it must be '{due}'")
        self.stable = greeting.stable_step(ready, SECTION)
        self.surface = read_surface(ready, None, self.scene["symmetry"], self.findings)
        self.account = Account(ready, self.findings)
        self.talk.expect_silence(greeting.BEFORE_ANSWER, SECTION, "'begin'")
        self.step = self.next_step()
        forces = self.push(START_PUSH)
        self.unsettled = 0.5 * self.step * sum(forces.values())
        self.talk.send("begin", {"time": 0.0, "step": self.step}, load_arrays(forces), remark="with loads")

    def next_step(self) -> float:
        return STEPS[self.window % len(STEPS)] * min(self.stable, LONGEST_STEP)

    def take_surface(self) -> None:
        """Receives the surface of this window and checks it against the one before and the loads since."""
        message = self.talk.receive("surface", SECTION)
        greeting.check_number(message, SECTION, "window", self.window, self.findings)
        self.time += self.step
        stated = message.field(SECTION, "time", float, "a number of seconds")
        if not abs(stated - self.time) <= 1e-9 * self.step + 1e-12 * self.time:
            self.findings.add(SECTION, "time", f"'surface' of window {self.window}: the field 'time' is "
                                               f"{stated:.9g} s, the window ends at {self.time:.9g} s")
        self.stable = greeting.stable_step(message, SECTION)
        self.changed = message.field(SECTION, "topology_changed", bool, "true or false")
        self.changes += self.changed
        before, self.surface = self.surface, read_surface(message, self.surface, self.scene["symmetry"], self.findings)
        check_advance(self.surface, before, self.step, self.window, self.findings)
        self.check_reaction(message, before)

    def check_reaction(self, message: Message, before: Surface) -> None:
        """Vertical momentum changes by the impulse of the loads; without such an entry in the account the surface,
        which has a part of the mass, takes a part of the impulse."""
        last, now = self.account.values, self.account.read(message)
        impulse, self.unsettled = self.unsettled, 0.0
        self.impulses += abs(impulse)
        said = "(dt + dt')/2 times the sum of the forces" if self.window else "dt/2 times the sum of the forces"
        given = f"the loads of window {self.window - 1} give" if self.window else "the loads of 'begin' give"
        if "momentum_z" in now:
            others = sum(now.get(name, 0.0) - last.get(name, 0.0)
                         for name in ("boundary_impulse_z", "gravity_impulse_z"))
            change = now["momentum_z"] - last["momentum_z"] - others
            allowed = 1e-9 * self.impulses + 1e-13 * abs(now["momentum_z"])
            if not abs(change - impulse) <= allowed:
                self.findings.add(SECTION, "reaction", f"{given} the impulse {impulse:.9g} N s, {said}; "
                                  f"'momentum_z' changes by {change:.9g} kg m/s")
        elif impulse != 0 and not self.changed:
            gained = float(self.surface.masses @ (self.surface.velocities - before.velocities)[:, 2])
            if not -1e-9 <= gained / impulse <= 1 + 1e-9 or gained == 0:
                self.findings.add(SECTION, "reaction", f"{given} the impulse {impulse:.9g} N s, {said}; the "
                                  f"momentum of the surface changes by {gained:.9g} kg m/s")

    def answer(self, forces: dict[int, float] | None = None, *, finish: bool = False, frame: int = -1,
               remark: str = "", odd_fields: bool = False, odd_arrays: bool = False) -> None:
        """`loads` of this window: vertical forces (N) on vertices."""
        arrays = load_arrays(forces or {})
        dt, self.window = self.step, self.window + 1
        self.step = self.next_step()
        self.unsettled = 0.5 * (dt + self.step) * float(arrays["load.forces"][:, 2].sum())
        fields = {"window": self.window - 1, "next_step": self.step, "finish": finish, "frame": frame}
        if odd_fields:
            fields["conform_remark"] = {"unknown": ["fields", "are", "ignored"]}
        self.talk.send("loads", fields, greeting.strange(arrays) if odd_arrays else arrays,
                       remark=f"of window {self.window - 1}{remark}")

    def push(self, push: float = PUSH) -> dict[int, float]:
        """The highest node is pressed down, the lowest one up with half of that."""
        z = numpy.where(self.surface.radius > 0, numpy.nan, self.surface.positions[:, 2])
        top, bottom = int(numpy.nanargmax(z)), int(numpy.nanargmin(z))
        return {bottom: 0.5 * push * float(self.surface.masses[bottom]), top: -push * float(self.surface.masses[top])}

    def crush(self) -> None:
        """Where ice may break, drives one vertex into it until the topology changes, if it ever does."""
        z = self.surface.positions[:, 2]
        nearest = numpy.argmin(numpy.hypot(*self.surface.positions[:, :2].T) + 1e3 * (z - z.min()))
        vertex = self.surface.ids[nearest]
        for _ in range(MOST_WINDOWS):
            self.take_surface()
            place = numpy.flatnonzero(self.surface.ids == vertex)
            if self.changed or not len(place):
                return self.answer()
            mass, v = float(self.surface.masses[place[0]]), float(self.surface.velocities[place[0], 2])
            self.answer({int(place[0]): mass * (CRUSH_SPEED - v) / self.step})


def play_whole(talk: Conversation, scene: dict, findings: Findings, slow: float) -> dict[str, int]:
    """From `hello` to the exit code 0. Returns what happened, counted."""
    solid = Solid(talk, scene, findings)
    solid.join()
    for window in range(5):
        solid.take_surface()
        if window == 0:
            talk.expect_silence(greeting.BEFORE_ANSWER, SECTION, "'loads'")
        pushes = window in PUSHED
        solid.answer(solid.push() if pushes else {}, remark="" if pushes else " with empty arrays")
    if talk.name == "ice" and ((scene.get("effects") or {}).get("conversion") or {}).get("active"):
        solid.crush()
    solid.take_surface()
    solid.answer(solid.push(), remark=" with a field that nobody knows", odd_fields=True)
    solid.take_surface()
    solid.answer(solid.push(), remark=" with its arrays in another order and one that nobody knows", odd_arrays=True)
    solid.take_surface()
    talk.expect_silence(slow, SECTION, "'loads'")
    solid.answer()
    solid.take_surface()
    solid.answer(finish=True, frame=0, remark=" with finish = true")
    greeting.leave(talk)
    return {"windows": solid.window, "topology changes": solid.changes}


def play_some(talk: Conversation, scene: dict, findings: Findings) -> None:
    """Into the middle of the run: two windows, and the surface of a third."""
    solid = Solid(talk, scene, findings)
    solid.join()
    for _ in range(2):
        solid.take_surface()
        solid.answer()
    solid.take_surface()
