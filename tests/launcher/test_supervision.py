"""`./polynya run` with invented programs: good ends, deaths, refusals, and that nothing is left behind."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FAKE = f"{sys.executable} {Path(__file__).with_name('fake_program.py')}"
PATIENCE = 5.0  # s in which everything must have ended after a death


class Run(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.out = self.folder / "run"
        self.programs = self.folder / "programs"
        self.programs.mkdir()
        self.program("resolve_scene", "resolve")
        for name in ("structure_solver", "ice_solver", "fluid_solver", "coupler"):
            self.program(name, "waits")

    def program(self, name: str, deed: str):
        path = self.programs / name
        path.write_text(f'#!/bin/sh\nexec {FAKE} {deed} "$@"\n')
        path.chmod(0o755)

    def scene(self, **deeds: str) -> Path:
        """A scene whose participants do these deeds; `coupler` is the coupler's."""
        if "coupler" in deeds:
            self.program("coupler", deeds.pop("coupler"))
        participants = {name: {"command": f"{FAKE} {deed}", "launch": ""} for name, deed in deeds.items()}
        return self.write({"name": "fake", "level": "quick", "run": {"end_time": 1e-3, "filter_frequency": 2e4},
                           "participants": participants, "effects": {}})

    def write(self, scene: dict) -> Path:
        path = self.folder / "scene.json"
        path.write_text(json.dumps(scene))
        return path

    def start(self, scene: Path, *words: str) -> subprocess.Popen:
        command = [str(ROOT / "polynya"), "run", str(scene), "--out", str(self.out), "--no-pictures", *words]
        popen = subprocess.Popen(command, env={**os.environ, "POLYNYA_PROGRAMS": str(self.programs)}, text=True,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(popen.kill)
        return popen

    def finish(self, popen: subprocess.Popen) -> subprocess.CompletedProcess:
        output, errors = popen.communicate(timeout=30)
        self.assert_nothing_left(popen.pid)
        return subprocess.CompletedProcess(popen.args, popen.returncode, output, errors)

    def run_scene(self, scene: Path, *words: str) -> subprocess.CompletedProcess:
        return self.finish(self.start(scene, *words))

    def processes(self) -> dict[str, int]:
        """Deed -> process id of the fake programs of this test."""
        found = {}
        for entry in Path("/proc").glob("[0-9]*/cmdline"):
            try:
                words = entry.read_bytes().decode(errors="replace").split("\0")
            except OSError:
                continue
            if "fake_program.py" in " ".join(words[:3]) and str(self.out) in words:
                found[words[2]] = int(entry.parent.name)
        return found

    def wait_for(self, *deeds: str) -> dict[str, int]:
        deadline = time.monotonic() + 15
        while not set(deeds) <= set(self.processes()):
            self.assertLess(time.monotonic(), deadline, "the programs did not start")
            time.sleep(0.02)
        time.sleep(0.3)
        return self.processes()

    def assert_nothing_left(self, launcher: int):
        self.assertEqual(self.processes(), {})
        self.assertEqual(list(Path("/tmp").glob(f"polynya-{launcher}-*")), [])

    def assert_one_message(self, result: subprocess.CompletedProcess, *parts: str):
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)

    def summary(self) -> dict:
        return json.loads((self.out / "summary.json").read_text())


class GoodEnd(Run):
    def test_coupled_run_prints_one_line_of_json(self):
        result = self.run_scene(self.scene(coupler="good", structure="good", ice="good"), "--json")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(len(result.stdout.splitlines()), 1)
        summary = json.loads(result.stdout)
        self.assertEqual(summary, self.summary())
        self.assertEqual((summary["state"], summary["run"]), ("done", str(self.out)))
        self.assertEqual(set(summary["processes"]), {"coupler", "structure", "ice"})
        self.assertEqual(summary["processes"]["ice"]["waiting_time"], 0.1)
        self.assertGreater(summary["processes"]["ice"]["peak_memory"], 1e6)

    def test_one_participant_runs_alone(self):
        result = self.run_scene(self.scene(ice="good"), "--threads", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(set(self.summary()["processes"]), {"ice"})
        told = (self.out / "logs" / "ice.stderr").read_text()
        self.assertIn("ice with 3 threads, passive, glibc.malloc.hugetlb=1", told)

    def test_a_run_may_be_repeated_in_its_folder_and_loses_what_was_there(self):
        self.run_scene(self.scene(ice="good"))
        (self.out / "fields" / "old.vtkhdf").touch()
        (self.out / "notes.txt").write_text("mine")
        self.assertEqual(self.run_scene(self.scene(ice="good")).returncode, 0)
        self.assertFalse((self.out / "fields" / "old.vtkhdf").exists())
        self.assertEqual((self.out / "notes.txt").read_text(), "mine")


class Refusal(Run):
    def test_of_the_resolver_comes_through(self):
        result = self.run_scene(self.write({"refusal": "scene.toml: ice.thickness: must be positive"}))
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertEqual(result.stderr, "polynya: scene.toml: ice.thickness: must be positive\n")
        self.assertFalse(self.out.exists())

    def test_of_a_folder_that_is_not_a_run(self):
        self.out.mkdir()
        (self.out / "thesis.tex").write_text("years of work")
        result = self.run_scene(self.scene(ice="good"))
        self.assertEqual(result.returncode, 2)
        self.assert_one_message(result, "is not a run")
        self.assertEqual([path.name for path in self.out.iterdir()], ["thesis.tex"])

    def test_of_a_folder_in_use(self):
        first = self.start(self.scene(ice="waits"))
        self.wait_for("waits")
        second = self.start(self.scene(ice="good"))
        _, errors = second.communicate(timeout=30)
        self.assertEqual(second.returncode, 2)
        self.assertIn("another run is using this folder", errors)
        self.assertEqual(set(self.processes()), {"waits"})
        first.send_signal(signal.SIGINT)
        self.finish(first)

    def test_of_a_command_that_does_not_exist(self):
        scene = self.write({"name": "fake", "participants": {"ice": {"command": "no_such_solver -x"}}})
        result = self.run_scene(scene)
        self.assertEqual(result.returncode, 2)
        self.assert_one_message(result, "participants.ice.command", "no_such_solver")

    def test_of_a_scene_that_does_not_exist(self):
        result = self.run_scene(self.folder / "nowhere.toml")
        self.assertEqual(result.returncode, 2)
        self.assert_one_message(result, "nowhere.toml")

    def test_by_a_solver_gives_its_exit_code_and_its_words(self):
        result = self.run_scene(self.scene(coupler="waits", structure="waits", ice="wrong_input"))
        self.assertEqual(result.returncode, 2)
        self.assert_one_message(result, "ice ended with exit code 2: no material 'ice.nowhere'")
        self.assertEqual(self.summary()["state"], "failed")


class Death(Run):
    def test_of_one_process_from_outside_ends_the_run_within_seconds(self):
        popen = self.start(self.scene(coupler="waits", structure="has_child", ice="stubborn"))
        victims = self.wait_for("waits", "has_child", "stubborn")
        os.kill(victims["has_child"], signal.SIGKILL)
        killed = time.monotonic()
        result = self.finish(popen)
        self.assertLess(time.monotonic() - killed, PATIENCE)
        self.assertEqual(result.returncode, 1)
        self.assert_one_message(result, "structure was killed by SIGKILL")
        self.assertEqual(self.summary()["state"], "failed")
        self.assertIn("SIGKILL", self.summary()["reason"])
        self.assertTrue((self.out / "series" / "coupler.csv").is_file())

    def test_is_blamed_on_the_dead_even_if_another_complains_first(self):
        result = self.run_scene(self.scene(coupler="loses_partner", structure="waits", ice="dies"))
        self.assertEqual(result.returncode, 1)
        self.assert_one_message(result, "ice was killed by SIGKILL")

    def test_with_own_words_is_told_from_complaints_about_others(self):
        result = self.run_scene(self.scene(coupler="loses_partner", structure="waits", ice="fails"), "--json")
        self.assertEqual(result.returncode, 1)
        self.assert_one_message(result, "ice ended with exit code 1: element 7 turned inside out")
        self.assertEqual(json.loads(result.stdout)["state"], "failed")

    def test_behind_a_shell_is_still_a_signal(self):
        scene = json.loads(self.scene(ice="dies").read_text())
        scene["participants"]["ice"]["launch"] = "sh -c '\"$@\"; exit $?' sh"
        result = self.run_scene(self.write(scene))
        self.assertEqual(result.returncode, 1)
        self.assert_one_message(result, "ice was killed by SIGKILL")

    def test_of_the_launcher_takes_the_processes_along(self):
        popen = self.start(self.scene(coupler="waits", ice="stubborn", fluid="good"))
        self.wait_for("waits", "stubborn")
        popen.kill()
        popen.communicate()
        deadline = time.monotonic() + PATIENCE
        while self.processes() and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(self.processes(), {})
        self.run_scene(self.scene(coupler="good", ice="good", fluid="good"))
        self.assert_nothing_left(popen.pid)  # the next run removed the socket's folder


    def test_before_the_first_step_is_one_too(self):
        (self.programs / "ice_solver").unlink()
        scene = self.write({"name": "fake", "participants": {"ice": {}, "structure": {"command": f"{FAKE} waits"}}})
        result = self.run_scene(scene)
        self.assertEqual(result.returncode, 1)
        self.assert_one_message(result, "ice_solver could not be started")
        self.assertEqual(self.summary()["state"], "failed")


class Interruption(Run):
    def test_stops_everything_and_leaves_a_summary(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            popen = self.start(self.scene(coupler="waits", structure="waits", ice="stubborn"))
            self.wait_for("waits", "stubborn")
            popen.send_signal(number)
            asked = time.monotonic()
            result = self.finish(popen)
            self.assertLess(time.monotonic() - asked, PATIENCE)
            self.assertEqual(result.returncode, 1)
            self.assert_one_message(result, f"interrupted by {number.name}")
            self.assertEqual(self.summary()["state"], "failed")


if __name__ == "__main__":
    unittest.main()
