"""What all participants do alike: hello, accounts, numbers of headers, the end."""
from __future__ import annotations

import math

import numpy

from launcher.conform.conversation import Conversation
from launcher.conform.surface_checks import check_finite
from launcher.conform.wire import Breach, Findings, Message

BEFORE_ANSWER = 0.1  # s in which nothing may come unasked
REASON = "the seat is taken by conform"


def welcome(talk: Conversation, findings: Findings) -> None:
    """Waits for `hello` and answers it."""
    hello = talk.receive("hello", "3")
    check_hello(talk, hello, findings)
    talk.expect_silence(BEFORE_ANSWER, "3", "'welcome'")
    talk.send("welcome")


def check_hello(talk: Conversation, hello: Message, findings: Findings) -> None:
    name = hello.field("3", "name", str, "a string")
    if name != talk.name:
        raise Breach("3", f"'hello' gives the name '{name}', the command line gave '{talk.name}'")
    pid = hello.header.get("pid", 1)
    if type(pid) is not int:
        findings.add("3", "pid", f"'hello': the field 'pid' is {pid!r}, it must be an integer or absent")


class Account:
    """The named numbers of a participant, section 6."""

    def __init__(self, ready: Message, findings: Findings) -> None:
        names = ready.field("6", "account", list, "a list of names")
        if not all(isinstance(name, str) for name in names):
            raise Breach("6", "'ready': the field 'account' must be a list of names")
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            findings.add("6", "names", f"'ready': the account has two entries '{twice}'")
        self.names, self.findings = names, findings
        self.values = self.read(ready)

    def read(self, message: Message) -> dict[str, float]:
        values = message.array("6", "account", "f8", (len(self.names),))
        check_finite(message, "6", "account", self.findings)
        self.values = dict(zip(self.names, map(float, values)))
        if self.values.get("mass", 1.0) <= 0:
            self.findings.add("6", "mass", f"'{message.kind}': 'mass' of the account is {self.values['mass']:g} kg, "
                                           "it must be above 0 or absent")
        return self.values


def stable_step(message: Message, section: str) -> float:
    value = message.field(section, "stable_step", float, "a number of seconds above 0")
    if not (math.isfinite(value) and value > 0):
        raise Breach(section, f"'{message.kind}': the field 'stable_step' is {value:g}, it must be above 0")
    return float(value)


def check_number(message: Message, section: str, name: str, due: int, findings: Findings) -> None:
    found = message.field(section, name, int, "an integer")
    if found != due:
        findings.add(section, name, f"'{message.kind}' has the number {found} in '{name}' where {due} is due")


def leave(talk: Conversation) -> None:
    """`finished`, `bye`, exit code 0. Raises Breach."""
    talk.receive("finished", "3")
    talk.expect_silence(3 * BEFORE_ANSWER, "3", "'bye'")
    talk.send("bye")
    talk.must_end(0, "3", "after 'bye'")


def refuse(talk: Conversation, findings: Findings) -> None:
    """A refusal by a coupler of another run and version: the reason is printed, the exit code is 1. Raises Breach."""
    check_hello(talk, talk.receive("hello", "3"), findings)
    talk.send("refuse", {"reason": REASON}, stranger=True)
    talk.must_end(1, "3", "after 'refuse'")
    if REASON not in talk.output():
        findings.add("3", "reason", "does not print the reason that came with 'refuse'")


def stop(talk: Conversation) -> None:
    """Raises Breach unless the participant ends with 1."""
    talk.send("stop", {"reason": "conform asks for an early end"})
    talk.must_end(1, "3", "after 'stop'")


def vanish(talk: Conversation) -> None:
    """Raises Breach unless the participant ends by itself, and not as if all were well."""
    talk.close_connection()
    talk.must_end(1, "3", "after the coupler closed the connection")


def strange(arrays: dict[str, numpy.ndarray]) -> dict[str, numpy.ndarray]:
    """The same arrays in another order, behind one that nobody knows."""
    return {"conform.unknown": numpy.zeros((0, 2)), **dict(reversed(arrays.items()))}
