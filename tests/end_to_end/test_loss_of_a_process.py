"""SIGKILL of any process in mid run: one message, everybody stops, results so far stay readable."""

import os
import signal
import subprocess
import time
import unittest
from pathlib import Path

from runs import ROOT, scratch, series


def processes_of(run_folder):
    """{program name: pid} of the processes that work in a run folder."""
    found = {}
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            state = (entry / "stat").read_text().rsplit(")", 1)[1].split()[0]
        except OSError:
            continue
        if state != "Z" and run_folder.encode() in words and b"--scene" in words:
            found[Path(words[0].decode()).name] = int(entry.name)
    return found


def wait_until(condition, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.1)
    return False


class Kill(unittest.TestCase):
    def kill(self, program):
        with scratch() as folder:
            run_folder = f"{folder}/run"
            launcher = subprocess.Popen([str(ROOT / "polynya"), "run", "cases/water_exit", "--out", run_folder, "--json"],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        stdin=subprocess.DEVNULL)
            progress = Path(run_folder) / "series/coupler.csv"
            started = wait_until(lambda: progress.exists() and progress.read_text().count("\n") > 20, 60)
            self.assertTrue(started, "the run did not start")
            sockets = set(Path("/tmp").glob(f"polynya-{launcher.pid}-*/coupler"))
            self.assertEqual(len(sockets), 1)
            os.kill(processes_of(run_folder)[program], signal.SIGKILL)
            gone = wait_until(lambda: not processes_of(run_folder), 5)
            self.assertTrue(gone, f"still there 5 s after the kill: {processes_of(run_folder)}")
            _, errors = launcher.communicate(timeout=60)
            self.assertEqual(launcher.returncode, 1)
            name = {"structure_solver": "structure", "ice_solver": "ice", "fluid_solver": "fluid"}.get(program, program)
            self.assertEqual(len(errors.strip().splitlines()), 1, errors)
            self.assertIn(name, errors)
            self.assertIn("SIGKILL", errors)
            self.assertFalse([socket for socket in sockets if socket.exists()])
            self.assertGreater(len(series(progress)["time"]), 15)

    def test_coupler(self):
        self.kill("coupler")

    def test_structure(self):
        self.kill("structure_solver")

    def test_ice(self):
        self.kill("ice_solver")

    def test_fluid(self):
        self.kill("fluid_solver")


if __name__ == "__main__":
    unittest.main()
