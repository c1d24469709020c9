"""Other people's programs in the seats of our solvers: they run, and what goes wrong with them is one sentence."""

import json
import math
import os
import shutil
import unittest
import unittest.mock
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy

from runs import ROOT, polynya, scratch, series, summary_of

RIGID = ROOT / "examples/rigid_vehicle.py"
ACOUSTIC = ROOT / "tests/end_to_end/acoustic_fluid.py"
SEEDED = ROOT / "tests/launcher/seeded_errors.py"
MARK = "POLYNYA_TEST_MARK"
COARSE = ["resolution.cell=5 mm", "resolution.vehicle_element=4 mm", "resolution.growth=1.3", "run.end=time"]
DROP = ["cases/vehicle_drop", *COARSE, "ice.length=80 mm", "ice.width=80 mm"]
WATER = ["cases/vehicle_in_water", *COARSE, "fluid.length=80 mm", "fluid.width=80 mm", "water.depth=130 mm"]


def run(folder, case, *settings):
    words = [word for setting in [*case[1:], *settings] for word in ("--set", setting)]
    return polynya("run", case[0], *words, "--out", folder, "--no-pictures", "--json", timeout=120)


def left_of(mark):
    """Processes that inherited this mark, ours excepted: whatever their command lines became."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            marked = f"{MARK}={mark}".encode() in (entry / "environ").read_bytes().split(b"\0")
        except OSError:
            continue
        if marked and int(entry.name) != os.getpid():
            found.append((entry / "cmdline").read_bytes())
    return found


class RigidExample(unittest.TestCase):
    """examples/rigid_vehicle.py against our own solver, which integrates the same body in another language."""

    def both(self, case, *settings):
        with scratch() as folder, ThreadPoolExecutor(2) as pool:
            own, python = f"{folder}/own", f"{folder}/python"
            runs = [pool.submit(run, own, case, *settings, "effects.deformable_vehicle=off"),
                    pool.submit(run, python, case, *settings, f"participants.structure.command=/usr/bin/python3 {RIGID}")]
            summaries = [summary_of(process.result()) for process in runs]
            return summaries, [series(f"{path}/series/coupler.csv") for path in (own, python)]

    def check(self, case, *settings):
        summaries, (own, python) = self.both(case, *settings)
        for column in ("time", "vehicle_speed", "vehicle_position"):
            numpy.testing.assert_allclose(python[column], own[column], rtol=1e-6, err_msg=column)
        for summary in summaries:
            self.assertLess(summary["energy_error"], 0.01)
        return summaries, own

    def test_moves_as_our_own_rigid_vehicle_against_ice(self):
        # Contacts come and go at once, and where two of them tie rounding says which: 2e-16 until 0.159 ms (in the
        # full model 1e-12 until 0.19 ms), 2e-6 at the first such choice.
        for symmetry, end in (("quarter", "0.155 ms"), ("full", "0.18 ms")):
            with self.subTest(symmetry):
                summaries, own = self.check(DROP, f"symmetry={symmetry}", f"run.end_time={end}")
                self.assertGreater(max(map(abs, own["contact_force"])), 100)  # N
                self.assertLess(own["vehicle_speed"][-1], 39)
                for summary in summaries:  # nothing but contact acts, and it gives both sides the same
                    self.assertLess(summary["momentum_error"], 1e-11)

    def test_moves_as_our_own_rigid_vehicle_in_water(self):
        _, own = self.check(WATER, "run.end_time=0.02 ms")
        self.assertGreater(max(map(abs, own["fluid_force"])), 0.1)  # N


class Commands(unittest.TestCase):
    def setUp(self):
        temporary = scratch()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        marked = unittest.mock.patch.dict(os.environ, {MARK: temporary.name})
        marked.start()
        self.addCleanup(marked.stop)

    def refused(self, code, setting, *parts, more=()):
        """The run ends with this code and one line that has these parts; nothing is left."""
        process = run(self.folder / "run", DROP, f"participants.{setting}", "run.end_time=0.1 ms", *more)
        self.assertEqual(process.returncode, code, process.stderr)
        self.assertEqual(len(process.stderr.strip().splitlines()), 1, process.stderr)
        for part in parts:
            self.assertIn(part, process.stderr)
        self.assertEqual(left_of(self.folder), [])

    def test_start_in_the_folder_of_the_scene_with_quoted_words(self):
        here = self.folder / "my scene"
        here.mkdir()
        shutil.copy(RIGID, here / "my vehicle.py")
        (here / "my vehicle.py").chmod(0o755)
        text = (ROOT / "cases/vehicle_drop/scene.toml").read_text()
        for command in ("./'my vehicle.py'", "/usr/bin/python3 'my vehicle.py'"):
            (here / "scene.toml").write_text(f'{text}\n[participants.structure]\ncommand = "{command}"\n')
            case = [str(here), *DROP[1:]]
            process = run(self.folder / "run", case, "run.end_time=0.01 ms")
            self.assertEqual(summary_of(process)["state"], "done")
        wishes = json.loads((self.folder / "run/scene.json").read_text())["participants"]["structure"]
        self.assertEqual(wishes["folder"], str(here))

    def test_are_explained_before_the_run(self):
        process = polynya("explain", "cases/vehicle_drop", "--json", "--set", "participants.ice.launch=nice -n 5",
                          "--set", f"participants.structure.command=/usr/bin/python3 {RIGID}")
        self.assertEqual(json.loads(process.stdout)["commands"],
                         {"structure": ["/usr/bin/python3", str(RIGID)], "ice": ["nice", "-n", "5", "ice_solver"]})

    def test_that_die_at_once_are_named_with_code_and_last_words(self):
        self.refused(1, "ice.command=sh -c 'echo hello; echo no licence on this host >&2; exit 3'",
                     "ice ended with exit code 3: no licence on this host")

    def test_that_leave_with_success_before_the_run_do_not_make_it_wait(self):
        self.refused(1, "ice.command=sh -c 'echo nothing to do'",
                     "before the run had begun, ice ended with exit code 0: nothing to do")

    def test_that_never_join_are_named_after_the_join_timeout(self):
        self.refused(1, "ice.command=sh -c 'sleep 1000'", "ice did not join run", "within 1.5 s",
                     more=["run.join_timeout=1.5 s"])

    def test_that_take_the_name_of_another_are_refused(self):
        self.refused(1, f"ice.command=/usr/bin/python3 {SEEDED} name_of_another",
                     "a participant 'structure' has already joined this run")

    def test_that_do_not_exist_are_wrong_input(self):
        self.refused(2, "ice.command=no_such_solver --fast", "participants.ice.command", "'no_such_solver'")
        self.assertFalse((self.folder / "run").exists())

    def test_for_participants_that_do_not_exist_are_wrong_input(self):
        self.refused(2, "vehicel.command=true", "'participants.vehicel'", "participants.structure", "participants.ice",
                     "participants.fluid")


class FluidWithoutForecasts(unittest.TestCase):
    """tests/end_to_end/acoustic_fluid.py in the fluid's seat: its loads are held from one span to the next."""

    def test_slows_a_hull_by_its_impedance_times_what_the_hull_turns_to_it(self):
        mass, speed, end = 0.005, 40.0, 20e-6
        with scratch() as folder:
            case = ["cases/vehicle_in_water", "run.end=time", f"run.end_time={end} s", "effects.deformable_vehicle=off"]
            hull = ["vehicle.head=hemisphere", "vehicle.head_length=5 mm", "vehicle.nose_position=-20 mm"]
            summary = summary_of(run(folder + "/run", case, *hull, f"participants.fluid.command=/usr/bin/python3 {ACOUSTIC}"))
        # m dV/dt = -rho c S V; the fluid has integrated S of the quarter model over time.
        theory = 1.48e6 * 4 * summary["accounts"]["fluid"]["exposure"] / mass
        found = math.log(speed / summary["residual_speed"])
        print(f"{summary['spans']} spans: slowed to {summary['residual_speed']:.2f} m/s, logarithm {found:.4f}, theory {theory:.4f}")
        self.assertGreater(theory, 0.5)
        # Loads come a span late: the first and the last of some ninety make the difference.
        self.assertLess(abs(found / theory - 1), 0.01)


if __name__ == "__main__":
    unittest.main()
