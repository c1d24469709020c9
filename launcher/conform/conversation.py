"""The coupler's end of one conversation with one freshly started participant."""
from __future__ import annotations

import shutil
import time
import uuid
from pathlib import Path

import numpy
import zmq

from launcher import processes, supervise
from launcher.conform import wire
from launcher.conform.wire import Breach, Message

UNTIL_ENDED = 10.0  # s in which a participant must end once it was told to
LOOK = 50           # ms between two looks whether its process still lives


class Conversation:
    """Use with `with`: starts the participant, and leaves no process and no socket behind."""

    def __init__(self, command: list[str], name: str, folder: Path, patience: float) -> None:
        self.command, self.name, self.folder, self.patience = command, name, folder, patience
        self.run = uuid.uuid4().hex[:16]
        self.route: bytes | None = None
        self.last_sent = "its start"

    def __enter__(self) -> Conversation:
        self.socket_folder = processes.make_socket_folder()
        self.context = zmq.Context()
        self.socket = self.context.socket(zmq.ROUTER)
        self.socket.set_hwm(0)
        self.socket.linger = 0
        endpoint = f"ipc://{self.socket_folder / 'coupler'}"
        self.socket.bind(endpoint)
        words = self.command + processes.arguments(self.name, self.folder, endpoint, self.run)
        environment = {"OMP_WAIT_POLICY": "passive"}
        self.child = supervise.start(processes.Plan(self.name, words, environment, "command"), self.folder / "logs")
        return self

    def __exit__(self, *_: object) -> None:
        supervise.end([self.child])
        self.close_connection()
        shutil.rmtree(self.socket_folder, ignore_errors=True)

    def close_connection(self) -> None:
        """As a coupler that was killed: no last word."""
        self.socket.close(linger=0)
        self.context.term()

    def send(self, kind: str, fields: dict | None = None, arrays: dict[str, numpy.ndarray] | None = None, *,
             remark: str = "", stranger: bool = False) -> None:
        """`remark` says what is special about this message; `stranger`: as from a coupler of another run."""
        run, protocol = ("another-run", wire.PROTOCOL + 98) if stranger else (self.run, wire.PROTOCOL)
        self.socket.send_multipart([self.route, *wire.encode(kind, run, fields or {}, arrays or {}, protocol)])
        self.last_sent = f"'{kind}'{' ' + remark if remark else ''}"

    def receive(self, kind: str, section: str) -> Message:
        """The next message, which must be of this kind. Raises Breach."""
        message = self.next_message(self.patience)
        if message is None and self.child.status is not None:
            words = self.child.last_words()
            raise Breach(section, f"{self.how_it_ended()} where '{kind}' was due, after {self.last_sent}"
                         + (f": {words}" if words else ""))
        if message is None:
            raise Breach(section, f"'{kind}' did not come within {self.patience:g} s after {self.last_sent}")
        if message.kind == "failed":
            raise Breach(section, f"gave up where '{kind}' was due, after {self.last_sent}: "
                                  f"{message.header.get('reason', 'without a reason')}")
        if message.kind != kind:
            raise Breach(section, f"sent '{message.kind}' where '{kind}' was due, after {self.last_sent}")
        return message

    def expect_silence(self, seconds: float, section: str, awaited: str) -> None:
        """A participant that waits for `awaited` says nothing and does not end. Raises Breach."""
        message = self.next_message(seconds)
        if message is not None and message.kind == "failed":
            raise Breach(section, f"gave up while the coupler let it wait {seconds:g} s for {awaited}: "
                                  f"{message.header.get('reason', 'without a reason')}")
        if message is not None:
            raise Breach(section, f"sent '{message.kind}' without waiting for {awaited}")
        if self.child.status is not None:
            raise Breach(section, f"{self.how_it_ended()} while the coupler let it wait {seconds:g} s for {awaited}")

    def next_message(self, seconds: float) -> Message | None:
        """None when the time is over or the participant has ended and nothing is left to read."""
        deadline = time.monotonic() + seconds
        while True:
            ended = self.child.status is not None
            if self.socket.poll(LOOK if not ended else 2 * LOOK):
                route, *frames = self.socket.recv_multipart()
                if self.route not in (None, route):
                    raise Breach("1", "opened a second connection; one socket with one connection is expected")
                self.route = route
                return wire.decode(frames, self.run)
            if ended or time.monotonic() > deadline:
                return None
            supervise.wait([self.child], 0)

    def exit_code(self) -> int | None:
        """How the process ended, minus the number of a signal; None if it did not in time. Drops last messages."""
        deadline = time.monotonic() + UNTIL_ENDED
        while self.child.status is None and time.monotonic() < deadline:
            if not self.socket.closed and self.socket.poll(0):
                self.socket.recv_multipart()
            supervise.wait([self.child], LOOK / 1000)
        return self.child.status

    def must_end(self, expected: int, section: str, occasion: str) -> None:
        """Raises Breach unless the process ends in time with this exit code."""
        if self.exit_code() is None:
            raise Breach(section, f"does not end {occasion}: it still ran {UNTIL_ENDED:g} s later")
        if self.child.status != expected:
            raise Breach(section, f"{self.how_it_ended()} {occasion}, the exit code must be {expected}")

    def how_it_ended(self) -> str:
        if self.child.status < 0:
            return f"was killed by {supervise.signal_name(-self.child.status)}"
        return f"ended with exit code {self.child.status}"

    def output(self) -> str:
        """All that it wrote to standard output and standard error so far."""
        return "".join((self.folder / "logs" / f"{self.name}.{stream}").read_text(errors="replace")
                       for stream in ("stdout", "stderr"))
