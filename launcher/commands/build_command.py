"""`polynya build`: every program and test of a preset."""
from __future__ import annotations

import argparse
import time

from launcher import DONE, build, units


def run(arguments: argparse.Namespace) -> int:
    started = time.monotonic()
    build.build([], arguments.preset)
    build.say(f"built {build.program_folder(arguments.preset)} in {units.duration(time.monotonic() - started)}")
    return DONE
