"""A run that was killed after a checkpoint goes on to the same bits as one that nobody disturbed."""

import json
import os
import shutil
import signal
import subprocess
import unittest
from pathlib import Path

import h5py
import numpy

from runs import ROOT, polynya, scratch, summary_of
from test_loss_of_a_process import wait_until

# Of the summary: what the wall clock, the memory and the folder say.
NOT_RESULTS = {"wall_time", "processes", "effects", "critical_path", "exchange_share", "overlap_share", "run", "threads",
               "peak_memory", "cpu_time", "estimate"}


def results_of(summary):
    return {key: value for key, value in summary.items() if key not in NOT_RESULTS and "time_by" not in key}


def series_of(folder):
    return {file.name: file.read_bytes() for file in sorted(Path(folder, "series").iterdir())}


def fields_of(folder):
    """Every data set of every field frame, as bytes."""
    found = {}
    for file in sorted(Path(folder, "fields").glob("*.vtkhdf")):
        with h5py.File(file) as frame:
            frame.visititems(lambda name, item: found.update({f"{file.name}/{name}": numpy.asarray(item).tobytes()})
                             if isinstance(item, h5py.Dataset) else None)
    return found


def manifests(folder):
    return sorted(Path(folder, "checkpoints").glob("*/manifest.json"))


class Comparison(unittest.TestCase):
    def compare(self, one, other):
        self.assertEqual(series_of(one).keys(), series_of(other).keys())
        for name, rows in series_of(one).items():
            self.assertEqual(rows, series_of(other)[name], name)
        fields, others = fields_of(one), fields_of(other)
        self.assertEqual(fields.keys(), others.keys())
        for name, values in fields.items():
            self.assertEqual(values, others[name], name)
        for index in Path(one, "fields").glob("*.json"):
            self.assertEqual(index.read_text(), Path(other, "fields", index.name).read_text())


class Resume(Comparison):
    def kill_and_resume(self, scene, *settings, checkpoints=1):
        words = [word for setting in settings for word in ("--set", setting)]
        with scratch() as folder:
            whole, broken = f"{folder}/whole", f"{folder}/broken"
            launcher = subprocess.Popen([str(ROOT / "polynya"), "run", scene, "--no-pictures", "--json", "--out", broken,
                                         *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        stdin=subprocess.DEVNULL)
            taken = wait_until(lambda: len(manifests(broken)) >= checkpoints or launcher.poll() is not None, 300)
            self.assertTrue(taken and launcher.poll() is None, "the run ended before it could be killed")
            os.kill(launcher.pid, signal.SIGKILL)  # all others die with it
            launcher.wait()
            undisturbed = summary_of(polynya("run", scene, "--no-pictures", "--json", "--out", whole, "--set",
                                             "checkpoint.interval=0", *words))
            # Another number of threads, as if on another machine.
            resumed = summary_of(polynya("resume", broken, "--no-pictures", "--json", "--threads", "1"))
            self.compare(whole, broken)
            self.maxDiff = None
            self.assertEqual(json.dumps(results_of(undisturbed), indent=1, sort_keys=True),
                             json.dumps(results_of(resumed), indent=1, sort_keys=True))

    def test_vehicle_and_ice_go_on_with_the_same_bits(self):
        self.kill_and_resume("cases/vehicle_drop", "vehicle.nose_position='-0.5 mm'", "run.end_time='100 us'",
                             "run.frame_interval='20 us'", "checkpoint.interval='25 us'")

    def test_vehicle_water_and_ice_go_on_with_the_same_bits(self):
        self.kill_and_resume("cases/water_exit", "run.end_time='6 us'", "run.frame_interval='2 us'",
                             "checkpoint.interval='2 us'")

    def test_a_grid_that_follows_the_vehicle_goes_on_with_the_same_bits(self):
        self.kill_and_resume("cases/vehicle_in_water", "fluid.grid_follows='vehicle'", "run.end_time='30 us'",
                             "run.frame_interval='10 us'", "checkpoint.interval='10 us'")

    def test_ice_alone_goes_on_with_the_same_bits(self):
        self.kill_and_resume("cases/beam_bending", "checkpoint.interval='25 us'", "run.end_time='200 us'",
                             "run.frame_interval='100 us'")

    def test_fluid_alone_goes_on_with_the_same_bits(self):
        self.kill_and_resume("cases/dam_break", "checkpoint.interval='20 ms'", "run.end_time='100 ms'",
                             "run.frame_interval='50 ms'")


def spoil(checkpoint: Path) -> None:
    """Overwrites values of the largest data set."""
    with h5py.File(checkpoint) as file:
        found = []
        file.visititems(lambda _, item: found.append(item) if isinstance(item, h5py.Dataset) else None)
        largest = max(found, key=lambda item: item.id.get_storage_size())
        place, size = largest.id.get_offset(), largest.id.get_storage_size()
    with open(checkpoint, "r+b") as file:
        file.seek(place)
        file.write(b"\xa5" * min(size, 1000))


class ALaterEnd(Comparison):
    def test_a_finished_run_goes_on_to_a_later_end_and_refuses_what_does_not_fit(self):
        drop = ["run", "cases/vehicle_drop", "--no-pictures", "--json", "--set", "vehicle.nose_position='-0.5 mm'",
                "--set", "run.frame_interval='10 us'", "--set", "checkpoint.interval='8 us'"]
        with scratch() as folder:
            run, whole, copy = f"{folder}/run", f"{folder}/whole", f"{folder}/copy"
            summary_of(polynya(*drop, "--set", "run.end_time='30 us'", "--out", run))
            self.assertEqual(len(manifests(run)), 2)

            shutil.copytree(run, copy)
            spoil(sorted(Path(copy, "checkpoints").glob("*/ice.h5"))[-1])
            refused = polynya("resume", copy, "--no-pictures", "--set", "run.end_time='50 us'")
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("is damaged", refused.stderr)
            # The finished run is as it was: its scene, its summary, and what the other programs had written.
            for name in ("scene.json", "summary.json", "coupler_summary.json"):
                self.assertEqual(Path(copy, name).read_bytes(), Path(run, name).read_bytes(), name)
            self.assertEqual([entry.name for entry in Path(copy).glob("*.before")], [])
            self.compare(run, copy)
            refused = polynya("resume", run, "--set", "vehicle.speed=60")
            self.assertEqual(refused.returncode, 2)
            self.assertIn("a run that goes on keeps its scene", refused.stderr)

            scene = Path(copy, "scene.json")
            changed = json.loads(scene.read_text())
            changed["vehicle"]["speed"] = 60
            scene.write_text(json.dumps(changed))
            refused = polynya("resume", copy, "--no-pictures", "--set", "run.end_time='50 us'")
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("vehicle.speed is 40.0 there and 60.0 here", refused.stderr)

            summary_of(polynya("resume", run, "--no-pictures", "--json", "--set", "run.end_time='50 us'"))
            summary_of(polynya(*drop, "--set", "run.end_time='50 us'", "--out", whole))
            for name in ("coupler.csv", "ledger.csv"):
                self.assertEqual(series_of(run)[name], series_of(whole)[name], name)
            self.assertEqual(fields_of(run), fields_of(whole))

    def test_windows_cut_to_the_end_are_in_no_checkpoint(self):
        """Apart, the solids take long windows of their own. Of the short ones that are left before the end, with a later
        end there would be none."""
        drop = ["run", "cases/vehicle_drop", "--no-pictures", "--json", "--set", "vehicle.nose_position='-2 mm'",
                "--set", "run.frame_interval='4 us'", "--set", "checkpoint.interval='0.1 us'"]
        with scratch() as folder:
            run = f"{folder}/run"
            self.assertGreater(summary_of(polynya(*drop, "--set", "run.end_time='4.1 us'", "--out", run))["steps"], 3)
            self.assertEqual(manifests(run), [])
            refused = polynya("resume", run, "--set", "run.end_time='9 us'")
            self.assertEqual(refused.returncode, 2)
            self.assertIn("no checkpoint yet", refused.stderr)

    def test_a_run_with_a_program_that_writes_no_checkpoints_says_so(self):
        with scratch() as folder:
            run = f"{folder}/run"
            summary_of(polynya("run", "cases/vehicle_drop", "--no-pictures", "--json", "--out", run,
                               "--set", "run.end_time='20 us'", "--set", "checkpoint.interval='5 us'", "--set",
                               f"participants.structure.command='/usr/bin/python3 {ROOT}/examples/rigid_vehicle.py'"))
            log = Path(run, "logs/coupler.log").read_text()
            self.assertEqual(log.count("there will be no checkpoints: 'structure' cannot write any"), 1)
            refused = polynya("resume", run)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("it has no checkpoint yet", refused.stderr)


if __name__ == "__main__":
    unittest.main()
