"""What a scene says about the programs of its participants: `command` replaces ours, `launch` is put in front.

Words are split as a shell does it. Relative paths start at the folder of the scene file, those of --set at the current
folder: the process is started there.
"""
from __future__ import annotations

import os
import shlex
import shutil
from pathlib import Path

from launcher import WrongInput

KEYS = ("launch", "command")


def settle(scene: dict, scene_folder: Path, settings: list[str]) -> None:
    """Makes the wishes of a resolved scene independent of where they were written, and checks that their program is
    there: full paths, and `folder`, where the process is started. Raises WrongInput."""
    for name, wishes in (scene.get("participants") or {}).items():
        given = {key: wishes.get(key) for key in KEYS if wishes.get(key)}
        for key, text in given.items():
            path = f"participants.{name}.{key}"
            folder = Path.cwd() if path in assigned(settings) else scene_folder
            words = split(text, path)
            if key == "command" and "launch" in given:
                words[0] = full_path(words[0], folder, must_exist=False)
            else:
                words[0] = full_path(words[0], folder)
                check_program(words[0], folder, path)
            wishes[key], wishes["folder"] = shlex.join(words), str(folder)


def assigned(settings: list[str]) -> set[str]:
    """The keys that --set gives a value, without the spaces and quotes that TOML allows in them."""
    return {setting.partition("=")[0].translate(str.maketrans("", "", " \"'")) for setting in settings}


def full_path(word: str, folder: Path, must_exist: bool = True) -> str:
    """As a shell in `folder` understands a program: with a slash a file, without one a name to look for on PATH.

    Behind a `launch` that brings its own files (a container) a path that is not here is left alone."""
    if "/" not in word or not (must_exist or (folder / word).exists()):
        return word
    return os.path.normpath(folder / word)


def check_program(word: str, folder: Path, path: str) -> None:
    if shutil.which(word) is not None:
        return
    hint = ""
    if "/" not in word and (folder / word).is_file():
        hint = f"; for the one in {folder} write ./{word}"
    elif Path(word).is_file():
        hint = "; it is a file that is not executable"
    raise WrongInput(f"{path}: there is no program '{word}' that can be started{hint}")


def split(text: str, path: str) -> list[str]:
    try:
        words = shlex.split(text)
    except ValueError as error:
        raise WrongInput(f"{path}: {error} in {text!r}") from None
    if not words or not words[0]:
        raise WrongInput(f"{path}: names no program in {text!r}")
    return words


def front(scene: dict, name: str, own_program: str) -> tuple[list[str], str | None, str | None]:
    """The words before the arguments; the key that named the program and the folder it starts in, None if it is ours."""
    wishes = (scene.get("participants") or {}).get(name) or {}
    words = {key: shlex.split(wishes.get(key) or "") for key in KEYS}
    setting = next((f"participants.{name}.{key}" for key in KEYS if words[key]), None)
    return words["launch"] + (words["command"] or [own_program]), setting, wishes.get("folder")


def is_replaced(scene: dict, name: str) -> bool:
    return bool(((scene.get("participants") or {}).get(name) or {}).get("command"))
