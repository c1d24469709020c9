"""`polynya test`: builds everything and hands over to ctest, whose own summary comes last."""
from __future__ import annotations

import argparse
import os
import subprocess

from launcher import DONE, FAILED, ROOT, build


def run(arguments: argparse.Namespace) -> int:
    build.build([])
    return DONE if subprocess.run(ctest(arguments), cwd=ROOT, check=False).returncode == 0 else FAILED


def ctest(arguments: argparse.Namespace) -> list[str]:
    """One test per core, half as many on large machines: solvers under test bring threads of their own."""
    cores = len(os.sched_getaffinity(0))
    side_by_side = cores if cores < 4 else cores // 2
    command = ["ctest", "--test-dir", str(build.build_folder("release")), "--output-on-failure", "--no-tests=error",
               "--label-regex", "^(fast|long)$" if arguments.long else "^fast$", f"-j{side_by_side}"]
    return command + (["--tests-regex", arguments.regex] if arguments.regex else [])
