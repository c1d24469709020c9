"""A coupled run on record: each solver replayed alone, and every command of docs/debugging.md."""

import json
import os
import re
import shlex
import shutil
import subprocess
import textwrap
import time
import unittest
from pathlib import Path

import h5py
import numpy

from runs import ROOT, polynya, scratch, series

DOCUMENT = (ROOT / "docs/debugging.md").read_text()
PROGRAMS = os.environ["POLYNYA_PROGRAMS"]
SOLVERS = {"structure": "structure_solver", "ice": "ice_solver", "fluid": "fluid_solver"}


def commands():
    """The command lines of the document, in their order."""
    return [line.strip() for line in re.findall(r"^    (?:\./polynya|gdb|build/).*$", DOCUMENT, re.M)]


def words_of(command, folder):
    """A command of the document as a list, with the document's /tmp in a folder of the test."""
    words = shlex.split(command.replace("/tmp/", f"{folder}/").replace("build/release/bin", PROGRAMS))
    return [str(ROOT / "polynya")] + words[1:] if words[0] == "./polynya" else words


def execute(words, text=None, timeout=300):
    return subprocess.run(words, input=text or "", capture_output=True, text=True, timeout=timeout)


def setUpModule():
    """Runs the document's commands but those of the debugger."""
    global FOLDER, RUN, RESULTS
    FOLDER = scratch()
    RUN = Path(FOLDER.name, "run")
    RESULTS = {}
    for command in commands():
        if "gdb" not in command:
            more = ["--no-pictures"] if command.startswith("./polynya run") else []
            RESULTS[command] = execute(words_of(command, FOLDER.name) + more)


def tearDownModule():
    FOLDER.cleanup()


def files_of(name):
    return sorted((RUN / "record").glob(f"{name}-*.h5"))


def tampered_record(name, change):
    """A copy of the run in which change(file) was applied to each file of one participant's record."""
    copy = Path(FOLDER.name, "tampered")
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(RUN, copy, ignore=shutil.ignore_patterns("replay", "fields"))
    for path in files_of(name):
        with h5py.File(copy / "record" / path.name, "r+") as file:
            change(file)
    return copy


class Replay(unittest.TestCase):
    def test_equals_the_coupled_run_bit_for_bit(self):
        for name, program in SOLVERS.items():
            with self.subTest(name):
                process = RESULTS[f"./polynya replay /tmp/run --only {program}"]
                self.assertEqual(process.returncode, 0, process.stderr)
                self.assertRegex(process.stdout, r"the end of the run: \d\d+ messages, all equal bit for bit")
                again = RUN / "replay" / name
                if name != "ice":  # which writes no series of its own in a coupled run
                    self.assertEqual((again / f"series/{name}.csv").read_bytes(), (RUN / f"series/{name}.csv").read_bytes())
                body = "vehicle" if name == "structure" else name
                for number in range(2):
                    file = f"fields/{body}_{number:04d}.vtkhdf"
                    self.assertEqual(self.fields(again / file), self.fields(RUN / file))

    def fields(self, file):
        """Every array of a frame, as bytes."""
        found = {}
        with h5py.File(file) as frame:
            frame.visititems(lambda name, item: found.update({name: item[()].tobytes()} if hasattr(item, "shape") else {}))
        self.assertGreater(len(found), 10)
        return found

    def test_is_one_process(self):
        """The launcher becomes the solver: a debugger or a profiler holds everything there is."""
        launcher = subprocess.Popen([ROOT / "polynya", "replay", RUN, "--only", "fluid_solver"], stdout=subprocess.DEVNULL)
        try:
            end = time.monotonic() + 30
            while Path(f"/proc/{launcher.pid}/comm").read_text().strip() != "fluid_solver" and time.monotonic() < end:
                time.sleep(0.01)
            self.assertEqual(os.readlink(f"/proc/{launcher.pid}/exe"), str(Path(PROGRAMS, "fluid_solver").resolve()))
            self.assertEqual(Path(f"/proc/{launcher.pid}/task/{launcher.pid}/children").read_text(), "")
        finally:
            launcher.kill()
            launcher.wait()

    def test_one_changed_bit_of_a_load_is_found_one_window_later(self):
        def loads_of(file):
            """Window and first row of each `loads` with forces, and the forces."""
            load = file.get("arrays/loads/load.forces", {"rows": [], "values": numpy.zeros((0, 3))})
            for message, first, last in load["rows"]:
                yield int(file["messages/window"][message]), first, load["values"][first:last]

        peaks = {}
        for path in files_of("structure"):
            with h5py.File(path) as file:
                peaks.update({window: abs(forces).max() for window, _, forces in loads_of(file) if forces.size})
        chosen = max(sorted(peaks)[:-5], key=peaks.get)  # the next window is on record too

        def flip(file):
            for window, first, forces in loads_of(file):
                if window == chosen:
                    vertex, axis = numpy.unravel_index(abs(forces).argmax(), forces.shape)
                    forces.view(numpy.uint64)[vertex, axis] ^= numpy.uint64(1 << 44)
                    file["arrays/loads/load.forces/values"][first + vertex] = forces[vertex]

        copy = tampered_record("structure", flip)
        process = polynya("replay", copy, "--only", "structure_solver")
        self.assertEqual(process.returncode, 1, process.stdout)
        self.assertRegex(process.stderr, rf"^structure_solver: window {chosen + 1}, t = .* s: 'surface', array "
                                         r"'(positions|velocities)', value \[\d+\]\[\d\] is \S+, on record is \S+\n$")
        process = polynya("replay", copy, "--only", "structure_solver", "--keep-going")
        self.assertEqual(process.returncode, 1)
        self.assertIn("largest:", process.stderr)
        self.assertEqual(polynya("replay", copy, "--only", "structure_solver", "--tolerance", "0.01").returncode, 0)

    def test_a_solver_that_sends_something_else_is_named(self):
        """The ice of another density: its very first message differs."""
        copy = tampered_record("ice", lambda file: None)
        scene = json.loads((copy / "scene.json").read_text())
        scene["materials"][scene["ice"]["material"]]["values"]["density"] *= 1.01
        (copy / "scene.json").write_text(json.dumps(scene))
        process = polynya("replay", copy, "--only", "ice_solver")
        self.assertEqual(process.returncode, 1)
        self.assertRegex(process.stderr, r"^ice_solver: before window 0, t = 0 s: 'ready', \S+ 'stable_step' is ")

    def test_wrong_input_is_one_sentence(self):
        def region(file):
            file.attrs["region"] = numpy.zeros(6)

        def refused(*arguments, says):
            process = polynya("replay", *arguments)
            self.assertEqual(process.returncode, 2, process.stderr)
            self.assertEqual(len(process.stderr.strip().splitlines()), 1, process.stderr)
            self.assertIn(says, process.stderr)

        refused(FOLDER.name, "--only", "ice_solver", says="is not the folder of a run")
        refused(RUN, "--only", "coupler", says="ice_solver")
        refused(RUN, "--only", "ice_solver", "--from", "6 mm", says="is not a time")
        refused(tampered_record("ice", region), "--only", "ice_solver", says="cannot be replayed")

    def test_record_gives_the_impulses_of_the_ledger(self):
        """Force on the ice from the record times the acting time of the window, against the coupler's own books."""
        ledger = {name: numpy.array(values) for name, values in series(RUN / "series/ledger.csv").items()}
        force, start = numpy.zeros((len(ledger["time"]), 3)), numpy.zeros(3)
        for path in files_of("ice"):
            with h5py.File(path) as file:
                window, load = file["messages/window"][:], file.get("arrays/loads/load.forces", {"rows": []})
                for message, first, last in load["rows"]:
                    force[window[message]] = load["values"][first:last].sum(axis=0)
                if "arrays/begin/load.forces" in file:
                    start += file["arrays/begin/load.forces/values"][:].sum(axis=0)  # for half of the first step
        for axis, name in enumerate("xyz"):
            given = ledger[f"contact_impulse_ice_{name}"] + ledger[f"fluid_taken_ice_{name}"]
            impulse = 0.5 * ledger["time"][0] * start[axis] + numpy.cumsum(force[:, axis] * ledger["acting_time"])
            self.assertGreater(abs(given).max(), 0)
            self.assertLess(abs(impulse - given).max(), 1e-12 * abs(given).max())


class Document(unittest.TestCase):
    def test_has_every_solver_alone_replayed_and_under_gdb(self):
        for program in SOLVERS.values():
            lines = [command for command in commands() if program in command]
            self.assertEqual(sum("replay" in line and "gdb" not in line for line in lines), 2)
            self.assertEqual(sum("gdb" in line for line in lines), 2)

    def test_commands_do_what_they_say(self):
        self.assertEqual(len(RESULTS), 10)
        for command, process in RESULTS.items():
            with self.subTest(command):
                self.assertEqual(process.returncode, 0, process.stderr)
                if "replay" in command:
                    self.assertIn("all equal bit for bit", process.stdout)

    @unittest.skipUnless(shutil.which("gdb"), "gdb IS NOT INSTALLED: its commands in docs/debugging.md were not run")
    def test_commands_of_the_debugger_do_what_they_say(self):
        for command in commands():
            if "gdb" not in command:
                continue
            with self.subTest(command):
                process = execute(words_of(command, FOLDER.name), "backtrace\nkill\nquit\n")
                output = process.stdout + process.stderr
                if "replay" in command:
                    self.assertRegex(output, r"Breakpoint 1, .* in polynya_replay_reached")
                    self.assertRegex(output, r"run_coupled")
                else:
                    self.assertIn("exited normally", output)

    def test_example_prints_the_force_on_the_ice(self):
        program = re.search(r"```python\n(.*?)```", DOCUMENT, re.S).group(1).replace("/tmp/", f"{FOLDER.name}/")
        process = execute(["/usr/bin/python3", "-c", textwrap.dedent(program)])
        self.assertEqual(process.returncode, 0, process.stderr)
        rows = numpy.array([line.split() for line in process.stdout.splitlines()], dtype=float)
        self.assertEqual(rows.shape[1], 4)
        self.assertGreater(len(rows), 50)
        self.assertTrue((numpy.diff(rows[:, 0]) > 0).all())


if __name__ == "__main__":
    unittest.main()
