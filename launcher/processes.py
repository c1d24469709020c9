"""Which processes a run consists of: their commands, threads and the private folder of their socket."""
from __future__ import annotations

import os
import shlex
import shutil
import tempfile
import uuid
from dataclasses import dataclass, field
from pathlib import Path

from launcher import WrongInput

PROGRAMS = {"structure": "structure_solver", "ice": "ice_solver", "fluid": "fluid_solver", "coupler": "coupler"}
SOCKET_PREFIX = "polynya-"


@dataclass(frozen=True)
class Plan:
    """One process to start. `setting`: the scene's key that named the command, if one did."""

    name: str
    command: list[str]
    environment: dict[str, str] = field(default_factory=dict)
    setting: str | None = None


def programs_for(names: list[str]) -> list[str]:
    """The programs (build targets) of these participants."""
    return [PROGRAMS[name] for name in names] + ([PROGRAMS["coupler"]] if len(names) > 1 else [])


def threads_for(name: str, cores: int, coupled: bool) -> int:
    """The fluid and the coupler work while all others wait and get every core; the solids work at the same time."""
    if not coupled or name in ("fluid", "coupler"):
        return cores
    return max(1, cores // 2)


def plan(scene: dict, names: list[str], folder: Path, binaries: Path, cores: int, socket: Path | None) -> list[Plan]:
    """The processes of a run in the order of starting; `socket` is the endpoint's file of a coupled run."""
    coupled = socket is not None
    run_id = uuid.uuid4().hex[:16]
    common = ["--scene", str(folder / "scene.json"), "--out", str(folder)]
    plans = []
    for name in (["coupler"] if coupled else []) + names:
        arguments = list(common)
        if name == "coupler":
            arguments += ["--bind", f"ipc://{socket}", "--run", run_id]
        else:
            arguments += ["--name", name]
            arguments += ["--connect", f"ipc://{socket}", "--run", run_id] if coupled else []
        front, setting = executable(scene, name, binaries)
        environment = {"OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": str(threads_for(name, cores, coupled))}
        plans.append(Plan(name, front + arguments, environment, setting))
    return plans


def executable(scene: dict, name: str, binaries: Path) -> tuple[list[str], str | None]:
    """The words before the arguments: `launch`, then `command` or the project's own program."""
    wishes = (scene.get("participants") or {}).get(name) or {}
    words = {key: split(wishes.get(key) or "", f"participants.{name}.{key}") for key in ("launch", "command")}
    setting = next((f"participants.{name}.{key}" for key in ("launch", "command") if words[key]), None)
    front = words["launch"] + (words["command"] or [str(binaries / PROGRAMS[name])])
    if setting and shutil.which(front[0]) is None:
        raise WrongInput(f"{setting}: there is no program '{front[0]}' that can be started")
    return front, setting


def split(text: str, key: str) -> list[str]:
    try:
        return shlex.split(text)
    except ValueError as error:
        raise WrongInput(f"{key}: {error} in {text!r}") from None


def make_socket_folder() -> Path:
    """A private folder right under /tmp: paths of sockets are limited to 107 characters. Its name carries our id."""
    remove_orphans()
    return Path(tempfile.mkdtemp(prefix=f"{SOCKET_PREFIX}{os.getpid()}-", dir="/tmp"))


def remove_orphans() -> None:
    """Removes socket folders whose launcher was killed before it could do so itself."""
    for folder in Path("/tmp").glob(f"{SOCKET_PREFIX}*-*"):
        owner = folder.name[len(SOCKET_PREFIX):].split("-")[0]
        if owner.isdigit() and not Path("/proc", owner).exists() and folder.stat().st_uid == os.getuid():
            shutil.rmtree(folder, ignore_errors=True)
