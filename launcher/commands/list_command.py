"""`polynya list`: the scenes that come with the program and the runs made so far. Standard library only."""
from __future__ import annotations

import argparse
import json
import re
from pathlib import Path

from launcher import DONE, ROOT

TITLE = re.compile(r'^\s*title\s*=\s*"([^"]*)"', re.MULTILINE)
LEVEL = re.compile(r"^\s*\[level\.([A-Za-z0-9_-]+)[.\]]", re.MULTILINE)


def run(_arguments: argparse.Namespace) -> int:
    for folder in ("cases", "examples"):
        rows = [(command_word(file), describe(file)) for file in scene_files(ROOT / folder)]
        show(folder, rows)
    show("runs", [(str(path.parent.relative_to(ROOT)), outcome(path)) for path in
                  sorted((ROOT / "runs").glob("*/summary.json"))])
    return DONE


def scene_files(folder: Path) -> list[Path]:
    return sorted(file for file in folder.rglob("*.toml") if TITLE.search(file.read_text(encoding="utf-8")))


def command_word(file: Path) -> str:
    """The shortest word that `run` understands for this scene."""
    short = file.parent if file.name == "scene.toml" or file.stem == file.parent.name else file.with_suffix("")
    return str(short.relative_to(ROOT))


def describe(file: Path) -> str:
    text = file.read_text(encoding="utf-8")
    levels = list(dict.fromkeys(LEVEL.findall(text)))
    return TITLE.search(text)[1] + (f"  (levels: {', '.join(levels)})" if levels else "")


def outcome(path: Path) -> str:
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return "unreadable summary"
    return f"{summary.get('title') or summary.get('scene') or ''}: {summary.get('reason') or summary.get('state')}"


def show(heading: str, rows: list[tuple[str, str]]) -> None:
    if not rows:
        return
    width = max(len(word) for word, _ in rows)
    print(heading)
    for word, text in rows:
        print(f"    {word:<{width}}  {text}")
