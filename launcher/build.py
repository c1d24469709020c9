"""Configures and builds with CMake and ninja: quiet, one build at a time, the compiler's errors if it fails."""
from __future__ import annotations

import contextlib
import fcntl
import os
import re
import subprocess
import sys
import time
from collections import deque
from collections.abc import Iterator
from pathlib import Path

from launcher import ROOT, Failure

NINJA_PROGRESS = re.compile(r"^\[(\d+)/(\d+)\]")
MEMORY_PER_COMPILER = 1.5e9  # bytes; CGAL needs about that much


def program_folder(preset: str = "release") -> Path:
    """Where the programs lie. POLYNYA_PROGRAMS names a folder of ready programs instead; then nothing is built."""
    ready = os.environ.get("POLYNYA_PROGRAMS")
    return Path(ready) if ready else build_folder(preset) / "bin"


def build_folder(preset: str) -> Path:
    return ROOT / "build" / preset


def build(targets: list[str], preset: str = "release") -> None:
    """Builds the targets (none: everything). Raises Failure with the compiler's errors."""
    if os.environ.get("POLYNYA_PROGRAMS"):
        return
    with locked(preset):
        if needs_configuring(preset):
            configure(preset)
        run_ninja(targets, preset)


@contextlib.contextmanager
def locked(preset: str) -> Iterator[None]:
    """Keeps other builds of the same preset waiting. The lock goes with the process, however it ends."""
    build_folder(preset).mkdir(parents=True, exist_ok=True)
    with open(build_folder(preset) / ".lock", "w", encoding="utf-8") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say("waiting for another build to end")
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def needs_configuring(preset: str) -> bool:
    """Ninja notices changed CMake files by itself; what is left is a first, a failed or a moved configuration."""
    rules, cache = build_folder(preset) / "build.ninja", build_folder(preset) / "CMakeCache.txt"
    if not rules.exists() or not cache.exists():
        return True
    if f"CMAKE_HOME_DIRECTORY:INTERNAL={ROOT}\n" not in cache.read_text(errors="replace"):
        cache.unlink()
        return True
    return (ROOT / "CMakePresets.json").stat().st_mtime > cache.stat().st_mtime


def configure(preset: str) -> None:
    say(f"configuring build/{preset}")
    result = subprocess.run(["cmake", "--preset", preset], cwd=ROOT, text=True, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if result.returncode == 0:
        return
    (build_folder(preset) / "build.ninja").unlink(missing_ok=True)
    lines = result.stdout.splitlines()
    first = next((i for i, line in enumerate(lines) if "CMake Error" in line), max(0, len(lines) - 25))
    raise Failure("CMake could not configure the build:\n    " + "\n    ".join(lines[first:first + 25]))


def jobs() -> int:
    """Compilers at a time: one per core, fewer where memory is short."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return max(1, min(len(os.sched_getaffinity(0)), int(memory / MEMORY_PER_COMPILER)))


def run_ninja(targets: list[str], preset: str) -> None:
    command = ["ninja", "-C", str(build_folder(preset)), f"-j{jobs()}", *targets]
    environment = {**os.environ, "NINJA_STATUS": "[%f/%t] "}
    failed: deque[str] = deque(maxlen=40)  # the block of the latest failure
    last: deque[str] = deque(maxlen=10)
    failing = False
    with open(build_folder(preset) / "build.log", "w", encoding="utf-8") as log, subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True, errors="replace", env=environment) as ninja, Progress() as progress:
        for line in ninja.stdout:
            log.write(line)
            last.append(line.rstrip())
            count = NINJA_PROGRESS.match(line)
            if count:
                progress.show(int(count[1]), int(count[2]))
                failing = False
            if line.startswith("FAILED:"):
                failing = True
                failed.clear()
            if failing and not is_command_echo(line):
                failed.append(line.rstrip())
    if ninja.returncode != 0:
        text = "\n    ".join(failed or last)
        raise Failure(f"the build failed (all of it: {build_folder(preset) / 'build.log'}):\n    {text}")


def is_command_echo(line: str) -> bool:
    """Ninja repeats the whole command of a failed step: a line of thousands of letters that says nothing."""
    return len(line) > 300 and " -o " in line


class Progress:
    """One line that rewrites itself on a terminal; elsewhere a line now and then."""

    def __init__(self) -> None:
        self.terminal = sys.stderr.isatty()
        self.spoken = time.monotonic()
        self.shown = False

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, *_: object) -> None:
        if self.shown and self.terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)

    def show(self, done: int, total: int) -> None:
        now = time.monotonic()
        if self.terminal:
            print(f"\r\033[Kpolynya: building {done} of {total}", end="", file=sys.stderr, flush=True)
            self.shown = True
        elif now - self.spoken > 15:
            self.spoken = now
            say(f"building {done} of {total}")


def say(text: str) -> None:
    print(f"polynya: {text}", file=sys.stderr, flush=True)
