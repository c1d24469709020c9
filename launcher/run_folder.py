"""The folder of a run: where it lies, what may be overwritten, who is using it."""
from __future__ import annotations

import fcntl
import json
import os
import shutil
import time
from pathlib import Path
from typing import IO

from launcher import ROOT, WrongInput

# What a run consists of. Nothing else in the folder is ever touched.
RECORD = "record"
CHECKPOINTS = "checkpoints"
ICE_MESH = "ice_mesh.h5"
PARTS = ("series", "fields", "logs", "pictures", "replay", RECORD, CHECKPOINTS, "summary.json", "scene.json",
         "vehicle_surface.json", ICE_MESH)
SUMMARIES = "*_summary.json"
ASIDE = ".before"  # what a run that goes on replaces, until its programs have taken up the state
LOCK = ".lock"


def choose(out: str | None, scene: dict) -> Path:
    """The folder named by --out, or a fresh one under runs/."""
    if out:
        return Path(out).resolve()
    words = [scene.get("name") or "scene", scene.get("level") or "", time.strftime("%Y%m%d-%H%M%S")]
    base = ROOT / "runs" / "-".join(word for word in words if word)
    number, folder = 1, base
    while folder.exists():
        number += 1
        folder = base.with_name(f"{base.name}-{number}")
    return folder


def is_run(folder: Path) -> bool:
    return (folder / "scene.json").is_file() and (folder / "logs").is_dir()


def check(folder: Path) -> None:
    """Raises WrongInput unless the folder is new, empty or an earlier run."""
    if folder.exists() and not folder.is_dir():
        raise WrongInput(f"--out {folder}: is a file; a folder is needed")
    if folder.is_dir() and any(entry.name != LOCK for entry in folder.iterdir()) and not is_run(folder):
        raise WrongInput(f"--out {folder}: holds something that is not a run; name a new, an empty or a run's folder")


def prepare(folder: Path, scene: dict) -> IO[str]:
    """Empties an earlier run, makes the sub-folders and writes scene.json. Returns the lock to hold during the run."""
    check(folder)
    lock = hold(folder)
    for part in PARTS:
        remove(folder / part)
    for summary in folder.glob(SUMMARIES):
        remove(summary)
    drop_aside(folder)
    for part in ("logs", "series", "fields"):
        (folder / part).mkdir()
    write_json(folder / "scene.json", scene)
    return lock


def told(folder: Path) -> list[Path]:
    """What a run says of itself as a whole."""
    return [folder / "scene.json", folder / "summary.json", *folder.glob(SUMMARIES)]


def replace_told(folder: Path, scene: dict) -> None:
    """For a run that goes on: its scene is this one, and its summaries are put aside. The caller holds the folder."""
    drop_aside(folder)
    for file in told(folder):
        if file.exists():
            shutil.copy2(file, file.with_name(file.name + ASIDE))
    write_json(folder / "scene.json", scene)
    for file in told(folder):
        if file.name != "scene.json":
            remove(file)


def restore_told(folder: Path) -> None:
    """As if the run had never been asked to go on."""
    for file in folder.glob("*" + ASIDE):
        os.replace(file, file.with_name(file.name.removesuffix(ASIDE)))


def drop_aside(folder: Path) -> None:
    for file in folder.glob("*" + ASIDE):
        remove(file)


def hold(folder: Path) -> IO[str]:
    """The folder, made if it is new, for us alone."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = open(folder / LOCK, "w", encoding="utf-8")
    except OSError as error:
        raise WrongInput(f"--out {folder}: {error.strerror}") from None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        lock.close()
        raise WrongInput(f"--out {folder}: another run is using this folder") from None
    return lock


def remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def write_json(path: Path, content: dict) -> None:
    """Written aside and renamed: a reader never sees half of it."""
    aside = path.with_name(path.name + ".tmp")
    aside.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    os.replace(aside, path)


def read_json(path: Path) -> dict:
    """The object in a JSON file; empty if it is missing or damaged, as after a crash."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return content if isinstance(content, dict) else {}
