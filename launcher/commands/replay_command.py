"""`polynya replay`: one solver of a coupled run against the record of that run, with no other process."""
from __future__ import annotations

import argparse
import os
import re
import shutil
import sys
from pathlib import Path

from launcher import WrongInput, build, processes, run_folder, scene
from launcher.program_environment import program_environment

SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
TIME = re.compile(r"([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*([a-z]*)")
# The debugger stops where the replay reaches --from: symbols of the program are there in every preset.
GDB = ["gdb", "-q", "-ex", "set breakpoint pending on", "-ex", "break polynya_replay_reached", "-ex", "run", "--args"]


def run(arguments: argparse.Namespace) -> int:
    """Does not return: the solver, or the debugger with the solver in it, takes the place of this process."""
    source = Path(arguments.run).resolve()
    name = next(name for name, program in processes.PROGRAMS.items() if program == arguments.only)
    resolved = check(source, arguments.run, name)
    limits = [word for key in ("from", "until") if (text := getattr(arguments, f"{key}_time")) is not None
              for word in (f"--{key}", repr(seconds(text, f"--{key}")))]
    if arguments.gdb and shutil.which("gdb") is None:
        raise WrongInput("--gdb: gdb is not installed (Debian package gdb)")
    folder = Path(arguments.out).resolve() if arguments.out else source / "replay" / name
    run_folder.check(folder)
    build.build([arguments.only], arguments.preset)
    lock = run_folder.prepare(folder, resolved)
    os.set_inheritable(lock.fileno(), True)  # held by the solver from here on

    program = str(build.program_folder(arguments.preset) / arguments.only)
    command = [program, "--scene", str(source / scene.RESOLVED), "--out", str(folder), "--name", name,
               "--replay", str(source / run_folder.RECORD), *limits]
    if arguments.tolerance is not None:
        command += ["--tolerance", repr(arguments.tolerance)]
    if arguments.keep_going:
        command.append("--keep-going")
    if arguments.gdb:
        command = GDB + command
    threads = arguments.threads or len(os.sched_getaffinity(0))
    environment = {**os.environ, **program_environment(), "OMP_NUM_THREADS": str(threads)}
    sys.stdout.flush()
    try:
        os.execvpe(command[0], command, environment)
    except OSError as error:
        raise WrongInput(f"{command[0]} could not be started: {error.strerror}") from None


def check(source: Path, words: str, name: str) -> dict:
    """The resolved scene of a run with a record of this participant. Raises WrongInput."""
    if not run_folder.is_run(source):
        raise WrongInput(f"{words}: is not the folder of a run")
    if not (source / run_folder.RECORD).is_dir():
        raise WrongInput(f"{words}: has no record; run the scene again with --record")
    resolved = run_folder.read_json(source / scene.RESOLVED)
    participants = resolved.get("participants") or {}
    if name not in participants:
        raise WrongInput(f"--only {processes.PROGRAMS[name]}: took no part in {words}; "
                         f"there were {', '.join(processes.PROGRAMS[other] for other in sorted(participants))}")
    if foreign := participants[name].get("command"):
        raise WrongInput(f"--only {processes.PROGRAMS[name]}: {name} was played by '{foreign}' in {words}; "
                         "only the project's own programs can read a record")
    return resolved


def seconds(text: str, option: str) -> float:
    """"2e-5", "20 us" -> 2e-5. Raises WrongInput."""
    match = TIME.fullmatch(text.strip())
    if match is None or (match[2] or "s") not in SECONDS:
        raise WrongInput(f"{option} {text}: is not a time such as 2e-5 or '20 us'")
    try:
        return float(match[1]) * SECONDS[match[2] or "s"]
    except ValueError:
        raise WrongInput(f"{option} {text}: is not a time such as 2e-5 or '20 us'") from None
