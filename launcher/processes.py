"""Which processes a run consists of: their commands, threads and the private folder of their socket."""
from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import uuid
from dataclasses import dataclass, field
from pathlib import Path

from launcher import Failure, swap
from launcher.program_environment import program_environment

PROGRAMS = {"structure": "structure_solver", "ice": "ice_solver", "fluid": "fluid_solver", "coupler": "coupler"}
SOCKET_PREFIX = "polynya-"
SURFACE = "vehicle_surface.json"


@dataclass(frozen=True)
class Plan:
    """One process to start. `setting`: the scene's key that named the command, if one did; `folder`: where it starts,
    None: where the launcher was started."""

    name: str
    command: list[str]
    environment: dict[str, str] = field(default_factory=dict)
    setting: str | None = None
    folder: str | None = None


def programs_for(scene: dict, names: list[str]) -> list[str]:
    """Our own programs (build targets) that a run starts."""
    own = [PROGRAMS[name] for name in names if not swap.is_replaced(scene, name)]
    return own + ([PROGRAMS["coupler"]] if len(names) > 1 else [])


def threads_for(scene: dict, name: str, cores: int) -> int:
    """What the scene fixes; else all cores, which the coupler shares out once the run has begun."""
    return ((scene.get("participants") or {}).get(name) or {}).get("threads") or cores


def plan(scene: dict, names: list[str], folder: Path, binaries: Path, cores: int, socket: Path | None,
         resume: Path | None = None) -> list[Plan]:
    """The processes of a run in the order of starting; `socket` is the endpoint's file of a coupled run, `resume` the
    checkpoint to go on from."""
    coupled = socket is not None
    endpoint, run_id = f"ipc://{socket}", uuid.uuid4().hex[:16]
    plans = []
    for name in (["coupler"] if coupled else []) + names:
        if name == "coupler":
            words = [*common_arguments(folder), "--bind", endpoint, "--run", run_id]
        else:
            words = arguments(name, folder, endpoint if coupled else None, run_id)
        if resume:
            words += ["--resume", str(resume)]
        front, setting, start_folder = swap.front(scene, name, str(binaries / PROGRAMS[name]))
        environment = {**program_environment(), "OMP_NUM_THREADS": str(threads_for(scene, name, cores))}
        plans.append(Plan(name, front + words, environment, setting, start_folder))
    return plans


def common_arguments(folder: Path) -> list[str]:
    return ["--scene", str(folder / "scene.json"), "--out", str(folder)]


def arguments(name: str, folder: Path, endpoint: str | None, run_id: str) -> list[str]:
    """What every participant is given (docs/protocol.md, section 1); `endpoint`: None if it runs alone."""
    coupled = ["--connect", endpoint, "--run", run_id] if endpoint else []
    return [*common_arguments(folder), "--name", name, *coupled]


def write_surface(scene: dict, folder: Path, binaries: Path) -> None:
    """RUN/vehicle_surface.json: what our own solver would move, for a program that stands in for it. Raises Failure."""
    if not scene.get("vehicle"):
        return
    program = [str(binaries / PROGRAMS["structure"]), *common_arguments(folder)]
    result = subprocess.run([*program, "--write-surface", str(folder / SURFACE)], stdin=subprocess.DEVNULL,
                            capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise Failure(f"the vehicle's surface could not be written: {result.stderr.strip()}")


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
