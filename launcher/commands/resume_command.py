"""`polynya resume`: a run that was killed, or that is to end later, goes on from its last checkpoint."""
from __future__ import annotations

import argparse
import json
import os
import re
import sys
import time
from pathlib import Path

from launcher import WRONG_INPUT, WrongInput, build, processes, report, run_folder, scene, summary
from launcher.commands.replay_command import seconds
from launcher.commands.run_command import draw, supervise

THREADS = re.compile(r"participants\.(structure|ice|fluid)\.threads")


def run(arguments: argparse.Namespace) -> int:
    folder = Path(arguments.run).resolve()
    if not run_folder.is_run(folder):
        raise WrongInput(f"{arguments.run}: is not the folder of a run")
    with run_folder.hold(folder):
        return go_on(arguments, folder)


def go_on(arguments: argparse.Namespace, folder: Path) -> int:
    """Replaces nothing before all is checked that can be without the programs, and puts it back if these refuse."""
    resolved = run_folder.read_json(folder / scene.RESOLVED)
    names = scene.participants(resolved)
    for setting in arguments.settings:
        change(resolved, setting)
    if resolved.pop("record", None):
        print("polynya: the rest of the run is not recorded; the record ends with the run before", file=sys.stderr)
    checkpoint, begun = last_checkpoint(folder, arguments.run, names)
    if begun >= resolved["run"]["end_time"]:
        raise WrongInput(f"{arguments.run}: its last checkpoint is of t = {begun:g} s, the run ends at "
                         f"{resolved['run']['end_time']:g} s; --set run.end_time names a later end")
    cores = arguments.threads or len(os.sched_getaffinity(0))
    build.build(processes.programs_for(resolved, names))

    started = time.monotonic()
    run_folder.replace_told(folder, resolved)
    outcome = supervise(resolved, names, folder, cores, plain=arguments.json, resume=checkpoint)
    if outcome.exit_code == WRONG_INPUT:
        run_folder.restore_told(folder)
        raise WrongInput(f"{outcome.reason} (logs: {folder / 'logs'})")
    run_folder.drop_aside(folder)
    result = summary.merge(folder, resolved, names, outcome, time.monotonic() - started)
    if outcome.reason:
        print(f"polynya: {outcome.reason} (logs: {folder / 'logs'})", file=sys.stderr)
    pictures = draw(folder) if arguments.pictures else []
    if arguments.json:
        print(json.dumps(result, allow_nan=False))
    else:
        report.print_summary(result, pictures)
    return outcome.exit_code


def last_checkpoint(folder: Path, words: str, names: list[str]) -> tuple[Path, float]:
    """The newest checkpoint whose files are all there, and its time. Raises WrongInput."""
    wanted = {f"{name}.h5" for name in names} | ({"coupler.h5"} if len(names) > 1 else set())
    trouble = "it has no checkpoint yet"
    for candidate in sorted((folder / run_folder.CHECKPOINTS).glob("[0-9]*"), reverse=True):
        manifest = run_folder.read_json(candidate / "manifest.json")
        if not manifest:
            continue
        files = manifest.get("files") or {}
        if wanted <= set(files) and all(is_whole(candidate / name, size) for name, size in files.items()):
            return candidate, float(manifest["time"])
        trouble = f"{candidate.name} lacks files or they are cut short"
    raise WrongInput(f"{words}: cannot go on: {trouble} (checkpoint.interval, checkpoint.wall_interval in "
                     "docs/scene.md)")


def is_whole(file: Path, size: int) -> bool:
    return file.is_file() and file.stat().st_size == size


def change(resolved: dict, setting: str) -> None:
    """What may change on the way: the end, the checkpoints and threads. Raises WrongInput."""
    key, _, value = (part.strip() for part in setting.partition("="))
    text = value.strip("\"'")
    if key == "run.end_time":
        resolved["run"]["end_time"] = seconds(text, f"--set {key}")
    elif key in ("checkpoint.interval", "checkpoint.wall_interval"):
        resolved["checkpoint"][key.partition(".")[2]] = seconds(text, f"--set {key}")
    elif (match := THREADS.fullmatch(key)) and match[1] in resolved["participants"] and text.isdigit():
        resolved["participants"][match[1]]["threads"] = int(text)
    else:
        raise WrongInput(f"--set {setting}: a run that goes on keeps its scene; only run.end_time, "
                         "checkpoint.interval, checkpoint.wall_interval and participants.NAME.threads may change")
