"""`polynya conform`: whether a participant follows docs/protocol.md, and if not, what it does wrong."""
from __future__ import annotations

import argparse
import json
import shlex
import shutil
import sys
import tempfile
from pathlib import Path

from launcher import DONE, FAILED, WrongInput, build, processes
from launcher import scene as scenes
from launcher.conform.examine import Trial, Verdict, examine

NAMES = {"solid": ("structure", "ice"), "fluid": ("fluid",)}
SCENES = {"structure": "cases/vehicle_drop", "ice": "cases/vehicle_drop", "fluid": "cases/vehicle_in_water"}
# Without weight the momentum of a solid changes by the loads alone.
SETTINGS = {"solid": ["effects.gravity=off"], "fluid": []}
PROTOCOL = "docs/protocol.md"


def run(arguments: argparse.Namespace) -> int:
    role = arguments.role
    name = arguments.name or NAMES[role][0]
    if name not in NAMES[role]:
        raise WrongInput(f"--name {name}: a {role} is called {' or '.join(NAMES[role])}")
    if shutil.which(arguments.participant[0]) is None:
        raise WrongInput(f"there is no program '{arguments.participant[0]}' that can be started")
    build.build(["resolve_scene"] + ([processes.PROGRAMS[name]] if name == "structure" else []))
    scene = scenes.resolve(scenes.find(arguments.scene or SCENES[name]), arguments.level,
                           arguments.settings + SETTINGS[role])
    if name not in scenes.participants(scene) or (name == "fluid" and scene["fluid"].get("tube")):
        raise WrongInput(f"{scene['name']} is no scene for {name}: " + ("it must hold water and air" if name == "fluid"
                         else "it must hold " + ("a vehicle" if name == "structure" else "ice")))
    with tempfile.TemporaryDirectory(prefix="polynya-conform-") as temporary:
        folder = Path(arguments.out).resolve() if arguments.out else Path(temporary)
        trial = Trial(arguments.participant, name, scene, folder, arguments.patience, arguments.slow)
        verdict = examine(trial, say=lambda title: tell_progress(title, arguments.json))
    if arguments.json:
        print(json.dumps(as_json(trial, verdict)))
    else:
        print_verdict(trial, verdict)
    return DONE if verdict.conforms else FAILED


def tell_progress(title: str, quiet: bool) -> None:
    if not quiet:
        print(f"polynya: conversation '{title}'", file=sys.stderr, flush=True)


def as_json(trial: Trial, verdict: Verdict) -> dict:
    return {"command": trial.command, "name": trial.name, "scene": trial.scene["name"], "conforms": verdict.conforms,
            "counts": verdict.counts,
            "findings": [{"document": PROTOCOL, "section": section, "sentence": sentence}
                         for section, sentence in verdict.findings]}


def print_verdict(trial: Trial, verdict: Verdict) -> None:
    for section, sentence in verdict.findings:
        print(f"{PROTOCOL}, section {section}: {sentence}")
    words = shlex.join(trial.command)
    if verdict.conforms:
        print(f"{words} conforms as '{trial.name}': a whole conversation "
              f"({', '.join(f'{count} {what}' for what, count in verdict.counts.items())}), stop, closed connection, "
              "refusal")
    else:
        print(f"{words} does not conform as '{trial.name}': {len(verdict.findings)} found")
