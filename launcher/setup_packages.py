"""Installs the Debian packages that are missing. Standard library only: it runs before anything else is there."""
from __future__ import annotations

import os
import shutil
import subprocess
import sys

from launcher import DONE, FAILED


def read_names(path: str) -> list[str]:
    """Package names of a list with one name per line and # comments."""
    with open(path, encoding="utf-8") as lines:
        return [name for name in (line.split("#")[0].strip() for line in lines) if name]


def installed(names: list[str]) -> set[str]:
    """Those of the names that dpkg reports as completely installed."""
    query = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${db:Status-Abbrev}\n", *names],
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
    rows = (line.split() for line in query.stdout.splitlines())
    return {row[0] for row in rows if len(row) > 1 and row[1].startswith("ii")}


def say(text: str) -> None:
    print(f"polynya: {text}", file=sys.stderr, flush=True)


def privilege() -> list[str] | None:
    """Words to put in front of a command that needs root; None if there is no way."""
    if os.geteuid() == 0:
        return []
    if shutil.which("sudo") is None:
        return None
    # Without a terminal nobody can type a password: sudo must then work at once or say no.
    return ["sudo"] if sys.stdin is not None and sys.stdin.isatty() else ["sudo", "-n"]


def apt_get(front: list[str], *words: str) -> subprocess.CompletedProcess:
    command = [*front, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-q", "-y",
               "-o", "DPkg::Lock::Timeout=600", "-o", "Acquire::Retries=3", *words]
    # stdin stays with the user: sudo may ask for a password.
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


def install_missing(path: str) -> int:
    """Installs what the list names and the machine lacks. Returns an exit code; says everything on stderr."""
    names = read_names(path)
    if shutil.which("dpkg-query") is None or shutil.which("apt-get") is None:
        say("set-up needs Debian or a relative of it: apt-get and dpkg-query were not found. Use a Debian 12 container; "
            "it needs " + " ".join(names))
        return FAILED
    present = installed(names)
    missing = [name for name in names if name not in present]
    if not missing:
        return DONE
    front = privilege()
    if front is None:
        say("these packages are missing and installing them needs root: as root, run  apt-get install "
            "--no-install-recommends " + " ".join(missing))
        return FAILED
    say(f"installing {len(missing)} Debian package{'s' if len(missing) > 1 else ''}: " + " ".join(missing))
    update = apt_get(front, "update")
    install = apt_get(front, "install", "--no-install-recommends", *missing)
    if install.returncode == 0:
        return DONE
    tail = (update.stdout if update.returncode else "").splitlines()[-5:] + install.stdout.splitlines()[-15:]
    say("apt-get could not install them:\n    " + "\n    ".join(tail))
    return FAILED
