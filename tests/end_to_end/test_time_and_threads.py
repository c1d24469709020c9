"""Results follow from the scene alone: not from threads, not from who is slow; and where the time of a run goes."""

import json
import os
import signal
import subprocess
import time
import unittest
from pathlib import Path

from runs import ROOT, polynya, scratch, series, summary_of
from test_loss_of_a_process import processes_of, wait_until

# A small part of the base scene in coarse cells that strikes the ice within a second or two of wall time.
SETTINGS = ("resolution.cell=4 mm", "resolution.vehicle_element=4 mm", "vehicle.nose_position=-0.2 mm",
            "ice.length=80 mm", "ice.width=80 mm", "run.end_time=0.02 ms")
SMALL = [word for setting in SETTINGS for word in ("--set", setting)]
SERIES = ("coupler.csv", "ledger.csv")


def command(run_folder, *more):
    return [str(ROOT / "polynya"), "run", "cases/water_exit", *SMALL, "--out", run_folder, "--json", "--no-pictures",
            *more]


def results(run_folder):
    return [(Path(run_folder) / "series" / name).read_bytes() for name in SERIES]


class SameBits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = scratch()
        cls.summary = summary_of(polynya(*command(f"{cls.folder.name}/one", "--threads", "1")[1:]))
        cls.expected = results(f"{cls.folder.name}/one")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_contact_and_fluid_took_part(self):
        self.assertGreater(self.summary["steps"], 200)
        self.assertIsNotNone(self.summary["first_contact_time"])

    def test_with_two_threads(self):
        run_folder = f"{self.folder.name}/two"
        fixed = [word for name in ("structure", "ice", "fluid") for word in ("--set", f"participants.{name}.threads=2")]
        summary = summary_of(polynya(*command(run_folder, *fixed, "--threads", "2")[1:]))
        for name in ("structure", "ice", "fluid"):
            self.assertEqual(summary["processes"][name]["threads"], 2)
        self.assertEqual(results(run_folder), self.expected)

    def test_with_cores_shared_by_trial(self):
        run_folder = f"{self.folder.name}/shared"
        summary_of(polynya(*command(run_folder, "--threads", "2")[1:]))
        self.assertEqual(results(run_folder), self.expected)

    def test_whichever_process_is_slow(self):
        for program in ("structure_solver", "ice_solver", "fluid_solver", "coupler"):
            run_folder = f"{self.folder.name}/slow_{program}"
            run = subprocess.Popen(command(run_folder, "--threads", "2"), stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, stdin=subprocess.DEVNULL)
            progress = Path(run_folder) / "series/coupler.csv"
            self.assertTrue(wait_until(lambda: progress.exists() and progress.read_text().count("\n") > 5, 60))
            held = 0
            try:
                pid = processes_of(run_folder)[program]
                for _ in range(8):  # held most of the time
                    os.kill(pid, signal.SIGSTOP)
                    time.sleep(0.08)
                    os.kill(pid, signal.SIGCONT)
                    held += 1
                    time.sleep(0.01)
            except (KeyError, ProcessLookupError):
                pass  # the run is over
            _, errors = run.communicate(timeout=300)
            self.assertEqual(run.returncode, 0, errors)
            self.assertGreater(held, 2, f"{program} was not held often enough to tell")
            self.assertEqual(results(run_folder), self.expected, f"while {program} was slow")


class WhereTheTimeGoes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with scratch() as folder:
            cls.summary = summary_of(polynya(*command(f"{folder}/run", "--threads", "2")[1:]))

    def test_parts_and_waiting_add_up_to_the_wall_time_of_each_process(self):
        for name, process in self.summary["processes"].items():
            told = process["waiting_time"] + sum(process["seconds"].values())
            self.assertLessEqual(told, process["wall_time"] + 0.02, name)
            self.assertGreater(told, 0.6 * process["wall_time"], name)  # the rest: loading, meshes, start of threads
            self.assertTrue(all(value >= 0 for value in process["seconds"].values()), process["seconds"])
            self.assertGreater(process["cpu_time"], 0)

    def test_critical_path_and_share_of_exchange(self):
        path = self.summary["critical_path"]
        self.assertEqual(set(path), {"coupler", "structure", "ice", "fluid", "messages"})
        self.assertLess(sum(path.values()), self.summary["wall_time"])
        self.assertGreater(path["fluid"], 0)
        self.assertTrue(0 < self.summary["overlap_share"] < self.summary["exchange_share"] < 1)

    def test_memory_is_that_of_the_process_not_of_the_launcher(self):
        """The launcher holds some 55 MB, which getrusage would pass on; the coupler needs about 12 MB."""
        self.assertLess(self.summary["processes"]["coupler"]["peak_memory"], 30e6)
        self.assertGreater(self.summary["processes"]["coupler"]["peak_memory"], 3e6)

    def test_every_effect_has_a_time_or_says_why_not(self):
        for name, effect in self.summary["effects"].items():
            self.assertTrue(effect["time"] is not None or effect["time_note"], name)
        for name in ("fluid", "deformable_vehicle", "conversion", "non_reflecting_boundaries"):
            self.assertGreater(self.summary["effects"][name]["time"], 0, name)


class Flight(unittest.TestCase):
    def test_a_drop_from_a_height_takes_few_windows_until_the_contact(self):
        """Without water nothing acts before the nose has risen by the gap h: v t - g t^2 / 2 = h, then v - g t."""
        gap, speed, gravity = 0.02, 40.0, 9.81
        with scratch() as folder:
            summary = summary_of(polynya("run", "cases/vehicle_drop", "--set", "vehicle.nose_position=-20 mm", "--set",
                                         "run.end_time=0.502 ms", "--out", f"{folder}/run", "--json", "--no-pictures"))
            rows = series(f"{folder}/run/series/coupler.csv")
        contact = (speed - (speed**2 - 2 * gravity * gap)**0.5) / gravity
        span = 0.5e-6  # rows are written once per span
        self.assertAlmostEqual(summary["first_contact_time"], contact, delta=span)
        before = [(t, v) for t, v in zip(rows["time"], rows["vehicle_speed"]) if t < contact - span]
        self.assertEqual(max(map(abs, rows["contact_force"][: len(before)])), 0)
        for t, v in before:
            self.assertAlmostEqual(v, speed - gravity * t, delta=gravity * 1e-7)  # half a step later than t
        windows = [w for w, t in zip(rows["window"], rows["time"]) if t < contact - span][-1]
        steps = contact / summary["participants"]["structure"]["smallest_step"]
        self.assertLess(windows, 0.02 * steps)
        self.assertLess(max(rows["momentum_error"]), 1e-9)
        self.assertLess(max(rows["energy_error"]), 1e-3)


class Alone(unittest.TestCase):
    def test_solvers_alone_leave_a_whole_summary(self):
        for scene, end, keys in (("beam_bending", "run.end_time=0.05 ms", ("peak_load", "energy_error", "elements")),
                                 ("shock_tube", "run.end_time=0.1 ms", ("density_error", "mass_error", "cells")),
                                 ("dam_break", "run.end_time=2 ms", ("energy_error", "mass_error", "cells"))):
            with scratch() as folder:
                summary = summary_of(polynya("run", f"cases/{scene}", "--set", end, "--out", f"{folder}/run", "--json",
                                             "--no-pictures"))
                name = next(iter(summary["processes"]))
                self.assertTrue(Path(f"{folder}/run/{name}_summary.json").is_file())
            self.assertEqual((summary["state"], summary["end_reason"]), ("done", "time"))
            for key in keys + ("end_time", "steps"):
                self.assertIsNotNone(summary[key], f"{scene}: {key}")
            self.assertGreater(sum(summary["processes"][name]["seconds"].values()), 0)


class Bench(unittest.TestCase):
    def test_measures_what_is_named(self):
        process = polynya("bench", "triad", "--json")
        self.assertEqual(process.returncode, 0, process.stderr)
        figures = json.loads(process.stdout.strip().splitlines()[-1])
        self.assertEqual(list(figures), ["machine.triad_GB_s"])
        self.assertGreater(figures["machine.triad_GB_s"], 0)


if __name__ == "__main__":
    unittest.main()
