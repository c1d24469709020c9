"""Polynya's launcher: builds the programs, resolves a scene, starts and watches the processes, draws, sums up.

Nothing here computes physics. The only numbers made in Python are the reported quantities of `definitions`.
"""
from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

DONE = 0
FAILED = 1
WRONG_INPUT = 2


class WrongInput(Exception):
    """The user asked for something that cannot be: one sentence, exit code 2."""


class Failure(Exception):
    """Something that should have worked did not: one message, exit code 1."""
