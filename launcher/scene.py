"""Finds a scene file and has it resolved: `resolve_scene` checks it and fills in every default."""
from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from launcher import ROOT, WRONG_INPUT, Failure, WrongInput, build, swap

if TYPE_CHECKING:
    from launcher.mesh.reading import Mesh

SCENE_FILE = "scene.toml"
RESOLVED = "scene.json"
SOLVERS = ("structure", "ice", "fluid")


def find(words: str) -> Path:
    """The scene file meant by a path: a file, one without its .toml, or a folder holding one. Raises WrongInput."""
    for start in (Path(words).resolve(), *(folder / words for folder in (ROOT, ROOT / "cases", ROOT / "examples"))):
        for candidate in candidates(start):
            if candidate.is_file():
                return candidate
    raise WrongInput(f"no scene '{words}': give a scene file, a folder with one, or a name that ./polynya list shows")


def candidates(start: Path) -> list[Path]:
    return [start, start.parent / f"{start.name}.toml", start / SCENE_FILE, start / f"{start.name}.toml"]


def resolve(file: Path, level: str | None, settings: list[str], explain: bool = False) -> dict:
    """The resolved scene, all in SI, programs of participants found; `explain` adds an estimate of size and cost.

    The resolver's own sentence and exit code come through when it refuses. The mesh of a file is read on the way."""
    return resolve_with_mesh(file, level, settings, explain)[0]


def resolve_with_mesh(file: Path, level: str | None, settings: list[str], explain: bool = False
                      ) -> tuple[dict, Mesh | None]:
    """The same and the ice's mesh, if the scene takes it from a file; what is to be said of it goes to the user."""
    words = [str(file)] + (["--explain"] if explain else []) + (["--level", level] if level else [])
    for setting in settings:
        words += ["--set", setting]
    scene, mesh = ask_resolver(words), None
    if "wanted_mesh" in scene:
        from launcher.mesh import importing  # meshio and scipy take a moment to load: only now

        mesh = importing.load(scene["wanted_mesh"])
        scene = ask_resolver([*words, "--mesh", json.dumps(importing.facts(mesh))])
        for remark in importing.remarks(mesh, scene):
            print(f"polynya: {remark}", file=sys.stderr)
    swap.settle(scene, file.parent, settings)
    return scene, mesh


def ask_resolver(words: list[str]) -> dict:
    """What `resolve_scene` writes; its own sentence when it refuses."""
    program = build.program_folder() / "resolve_scene"
    try:
        result = subprocess.run([str(program), *words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                check=False)
    except OSError as error:
        raise Failure(f"{program}: {error.strerror}") from None
    if result.returncode != 0:
        sentence = result.stderr.strip() or f"resolve_scene ended with exit code {result.returncode}"
        raise (WrongInput if result.returncode == WRONG_INPUT else Failure)(sentence.removeprefix("resolve_scene: "))
    try:
        return json.loads(result.stdout)
    except ValueError as error:
        raise Failure(f"resolve_scene wrote something that is not JSON: {error}") from None


def refuse_what_does_not_fit(scene: dict) -> None:
    """Raises WrongInput if the estimate says that memory or disk do not suffice."""
    estimate = scene.get("estimate") or {"fits": True}
    if not estimate["fits"]:
        raise WrongInput(f"{scene['name']} does not fit this machine: {estimate['reason']}; coarser cells "
                         "(resolution.cell, --level) or a smaller domain would")


def participants(scene: dict) -> list[str]:
    """The solvers that a resolved scene needs, in the order in which they are started."""
    named = scene.get("participants") or {}
    names = [name for name in SOLVERS if name in named]
    if not names:
        raise WrongInput("the scene holds no vehicle, no ice and no fluid: nothing to run")
    return names
