"""`polynya bench`: the speed of the kernels on this machine."""
from __future__ import annotations

import argparse
import os
import subprocess

from launcher import DONE, FAILED, WRONG_INPUT, build
from launcher.program_environment import program_environment

PROGRAM = "polynya_bench"


def run(arguments: argparse.Namespace) -> int:
    build.build([PROGRAM])
    command = [str(build.program_folder() / PROGRAM)]
    command += ["--only", arguments.name] if arguments.name else []
    command += ["--json"] if arguments.json else []
    environment = {**os.environ, **program_environment()}
    code = subprocess.run(command, env=environment, check=False).returncode
    return code if code in (DONE, WRONG_INPUT) else FAILED
