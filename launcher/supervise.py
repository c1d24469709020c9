"""Starts the processes of a run and watches them. If one fails the others are stopped, and one sentence says who
failed first and why. Nothing outlives the launcher."""
from __future__ import annotations

import ctypes
import os
import re
import selectors
import signal
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from launcher import WRONG_INPUT, FAILED, Failure
from launcher.processes import PROGRAMS, Plan

TICK = 0.2            # s between two looks at the series
GRACE = 0.4           # s after the first failure in which a better explanation may still arrive
UNTIL_KILLED = 2.0    # s between SIGTERM and SIGKILL
UNTIL_MISSED = 60.0   # s that a solver may write results after the coupler has ended
PR_SET_PDEATHSIG = 1
LIBC = ctypes.CDLL(None, use_errno=True)
# Sentences of a process that fails only because another one did.
SECONDARY = re.compile(
    r"\b(lost|vanished|stopped|missing|refused|disconnected|gone|timed out|closed the connection|no coupler)\b",
    re.IGNORECASE)
LOG_PREFIX = re.compile(r"^(\[[^\]]*\]\s*)+")


@dataclass
class Child:
    """A started process and, once it has ended, how."""

    plan: Plan
    popen: subprocess.Popen
    stderr: Path
    handle: int                               # pidfd: readable when the process has ended
    status: int | None = None                 # exit code, or minus the number of the signal
    order: int = -1                           # how many had ended before
    peak_memory: int | None = None            # bytes, as seen while it ran
    usage: dict[str, float] = field(default_factory=dict)

    @property
    def name(self) -> str:
        return self.plan.name

    def note_memory(self) -> None:
        """The largest resident size so far. What the system tells at the end includes the launcher before the start."""
        try:
            status = Path(f"/proc/{self.popen.pid}/status").read_text(encoding="utf-8")
        except OSError:
            return
        if peak := re.search(r"^VmHWM:\s+(\d+) kB", status, re.MULTILINE):
            self.peak_memory = 1024 * int(peak[1])

    def reap(self, order: int) -> None:
        _, waited, usage = os.wait4(self.popen.pid, 0)
        self.status = self.popen.returncode = os.waitstatus_to_exitcode(waited)
        if self.status > 128 and self.plan.setting:  # a shell in front reports a signal in this way
            self.status = 128 - self.status
        self.order = order
        self.usage = {"cpu_time": usage.ru_utime + usage.ru_stime, "peak_memory": self.peak_memory}
        os.close(self.handle)

    def send(self, number: signal.Signals) -> None:
        """To the whole group of the process: a wrapper in front of the program included."""
        try:
            os.killpg(self.popen.pid, number)
        except ProcessLookupError:
            pass

    def last_words(self) -> str:
        """The last line on stderr, else on stdout, without the decoration of the log."""
        words = last_line(self.stderr) or last_line(self.stderr.with_suffix(".stdout"))
        return LOG_PREFIX.sub("", words).removeprefix(f"{self.name}: ").removeprefix(f"{PROGRAMS[self.name]}: ")

    def complains_about_others(self) -> bool:
        """Failed only because another did: it says so, names another first, or was told to stop and says nothing."""
        words = self.last_words()
        return not words or bool(SECONDARY.search(words)) or any(words.startswith(f"{name}:") for name in PROGRAMS)

    def why(self) -> str:
        words = self.last_words()
        if self.status < 0:
            reason = f"was killed by {signal_name(-self.status)}"
        else:
            reason = f"ended with exit code {self.status}"
        return f"{self.name} {reason}" + (f": {words}" if words else "")


@dataclass(frozen=True)
class Outcome:
    """How a run ended: exit code, the one sentence if it failed, and what each process used."""

    exit_code: int
    reason: str | None
    usage: dict[str, dict[str, float]]


def signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def last_line(file: Path) -> str:
    with open(file, "rb") as stream:
        stream.seek(max(0, os.path.getsize(file) - 4096))
        lines = [line.strip() for line in stream.read().decode("utf-8", "replace").splitlines()]
    return next((line for line in reversed(lines) if line), "")


def die_with_parent() -> None:
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def start(plan: Plan, logs: Path) -> Child:
    stderr = logs / f"{plan.name}.stderr"
    with open(stderr, "wb") as errors, open(logs / f"{plan.name}.stdout", "wb") as output:
        try:
            popen = subprocess.Popen(plan.command, stdin=subprocess.DEVNULL, stdout=output, stderr=errors,
                                     cwd=plan.folder,
                                     env={**os.environ, **plan.environment}, start_new_session=True,
                                     preexec_fn=die_with_parent)
        except OSError as error:
            raise Failure(f"{plan.name}: {plan.command[0]} could not be started: {error.strerror}") from None
    return Child(plan, popen, stderr, os.pidfd_open(popen.pid))


def wait(children: list[Child], seconds: float) -> None:
    """Until one of these processes ends or the time is over."""
    with selectors.DefaultSelector() as selector:
        for child in running(children):
            selector.register(child.handle, selectors.EVENT_READ, child)
        for key, _ in selector.select(max(0.0, seconds)):
            key.data.reap(sum(child.status is not None for child in children))


def running(children: list[Child]) -> list[Child]:
    return [child for child in children if child.status is None]


def end(children: list[Child]) -> None:
    """SIGTERM to what still runs, SIGKILL to what does not listen."""
    for number, patience in ((signal.SIGTERM, UNTIL_KILLED), (signal.SIGKILL, UNTIL_KILLED)):
        for child in running(children):
            child.send(number)
        deadline = time.monotonic() + patience
        while running(children) and time.monotonic() < deadline:
            wait(children, deadline - time.monotonic())
    for child in children:
        if child.plan.setting:  # what a wrapper left behind in its group
            child.send(signal.SIGKILL)


class Supervisor:
    """Runs a list of plans to their end. `has_begun`: whether the participants have met and time goes on."""

    def __init__(self, plans: list[Plan], logs: Path, on_tick: Callable[[], None],
                 has_begun: Callable[[], bool] = lambda: True) -> None:
        self.has_begun = has_begun
        self.plans = plans
        self.logs = logs
        self.on_tick = on_tick
        self.children: list[Child] = []
        self.interrupted: int | None = None

    def run(self) -> Outcome:
        """Returns when every process has ended, however that came."""
        before = {number: signal.signal(number, self.note_signal)
                  for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
        try:
            for plan in self.plans:
                self.children.append(start(plan, self.logs))
            reason, exit_code = self.watch()
        except Failure as error:
            reason, exit_code = str(error), FAILED
        finally:
            end(self.children)
            for number, handler in before.items():
                signal.signal(number, handler)
        return Outcome(exit_code, reason, {child.name: child.usage for child in self.children})

    def note_signal(self, number: int, _frame: object) -> None:
        self.interrupted = number

    def watch(self) -> tuple[str | None, int]:
        """Waits for the good end or the first failure; the sentence and the exit code."""
        coupler_ended: float | None = None
        while running(self.children):
            wait(self.children, TICK)
            for child in running(self.children):
                child.note_memory()
            if self.interrupted is not None:
                return f"interrupted by {signal_name(self.interrupted)}", FAILED
            if any(child.status for child in self.children):
                return self.explain_failure()
            if leaver := self.leaver():
                return f"before the run had begun, {leaver.why()}", FAILED
            self.on_tick()
            if coupler_ended is None and any(c.name == "coupler" and c.status == 0 for c in self.children):
                coupler_ended = time.monotonic()
            if coupler_ended is not None and running(self.children) and time.monotonic() - coupler_ended > UNTIL_MISSED:
                names = " and ".join(child.name for child in running(self.children))
                return f"{names} did not end within {UNTIL_MISSED:g} s of the coupler's end", FAILED
        return None, 0

    def explain_failure(self) -> tuple[str, int]:
        """The primary cause. A solver's death makes others fail too, and they may be faster to be noticed."""
        deadline = time.monotonic() + GRACE
        while running(self.children) and time.monotonic() < deadline:
            wait(self.children, deadline - time.monotonic())
        culprit = min((child for child in self.children if child.status), key=suspicion)
        return culprit.why(), WRONG_INPUT if culprit.status == WRONG_INPUT else FAILED

    def leaver(self) -> Child | None:
        """A participant that ended well before all had met: the coupler would wait for it in vain."""
        early = [child for child in self.children if child.status == 0 and child.name != "coupler"]
        coupled = any(child.name == "coupler" and child.status is None for child in self.children)
        if not early or not coupled or self.has_begun():
            return None
        wait(self.children, GRACE)  # what it saw of the run may show only now
        return None if self.has_begun() or any(child.status for child in self.children) else early[0]


def suspicion(child: Child) -> tuple:
    """Sorts the failed: killed by a signal, wrong input, own words, words about others; then by the order of ending."""
    if child.status < 0:
        rank = 0
    elif child.status == WRONG_INPUT:
        rank = 1
    else:
        rank = 3 if child.complains_about_others() else 2
    return rank, child.order
