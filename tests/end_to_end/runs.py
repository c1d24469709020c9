"""What the end-to-end tests share: run the program as a user would, read what it leaves."""

import csv
import json
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def polynya(*arguments, timeout=600):
    """Runs ./polynya; returns the finished process with its text output."""
    return subprocess.run([str(ROOT / "polynya"), *map(str, arguments)], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, timeout=timeout)


def scratch():
    return tempfile.TemporaryDirectory(prefix="polynya-end-to-end-")


def summary_of(process):
    """The one line that --json prints."""
    lines = process.stdout.strip().splitlines()
    assert process.returncode == 0, process.stderr
    assert len(lines) == 1, process.stdout
    return json.loads(lines[0])


def series(path):
    """A CSV series as {name without unit: list of numbers}."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    names = [title.split(" ")[0] for title in rows[0]]
    columns = zip(*[[float(value) for value in row] for row in rows[1:]])
    return dict(zip(names, map(list, columns)))
