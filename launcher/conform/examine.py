"""All conversations with one participant, and the verdict."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from launcher import build, processes, run_folder
from launcher.conform import fluid, greeting, solid
from launcher.conform.conversation import Conversation
from launcher.conform.wire import Breach, Findings

CONVERSATIONS = ("whole", "stop", "closed", "refuse")


@dataclass(frozen=True)
class Trial:
    """What is examined, and with how much patience (s)."""

    command: list[str]
    name: str
    scene: dict
    folder: Path           # one run folder per conversation is made in it
    patience: float = 60.0
    slow: float = 2.0      # s for which the coupler once says nothing


@dataclass
class Verdict:
    findings: list[tuple[str, str]]  # (section of docs/protocol.md, sentence)
    counts: dict[str, int]           # of the whole conversation, if it came to its end

    @property
    def conforms(self) -> bool:
        return not self.findings


def examine(trial: Trial, conversations: tuple[str, ...] = CONVERSATIONS,
            say: Callable[[str], None] = lambda _: None) -> Verdict:
    """Starts the participant once per conversation. A conversation that breaks off does not keep the next from being
    tried, unless the participant did not even say hello."""
    role = fluid if trial.name == "fluid" else solid
    findings = Findings()
    counts: dict[str, int] = {}
    for title in conversations:
        say(title)
        with Conversation(trial.command, trial.name, make_run_folder(trial, title), trial.patience) as talk:
            try:
                if title == "refuse":
                    greeting.refuse(talk, findings)
                elif title == "whole":
                    counts = role.play_whole(talk, trial.scene, findings, trial.slow)
                else:
                    role.play_some(talk, trial.scene, findings)
                    (greeting.stop if title == "stop" else greeting.vanish)(talk)
            except Breach as breach:
                findings.take(breach)
                if talk.route is None:
                    break
    return Verdict(findings.list, counts)


def make_run_folder(trial: Trial, title: str) -> Path:
    """A run folder as the launcher makes it."""
    folder = trial.folder / title
    run_folder.prepare(folder, trial.scene).close()
    if trial.name == "structure":
        processes.write_surface(trial.scene, folder, build.program_folder())
    return folder
