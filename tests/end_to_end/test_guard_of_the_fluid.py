"""A fluid without meaning ends a run by one sentence and exit code 1, and leaves its last good state."""

import json
import unittest
from pathlib import Path

import h5py
import numpy
from runs import polynya, scratch

TORN = ["tube.left.material=water", "tube.left.density=1000", "tube.left.pressure=1 atm", "tube.left.velocity=-1000 m/s",
        "tube.right.material=water", "tube.right.density=1000", "tube.right.pressure=1 atm",
        "tube.right.velocity=1000 m/s", "run.end_time=0.1 ms"]


def settings(values):
    return [word for value in values for word in ("--set", value)]


class GuardOfTheFluid(unittest.TestCase):
    def test_water_torn_apart_where_nothing_can_cavitate(self):
        """rho c u = 1.5 GPa of tension: linear water has no sound speed from about half its density on."""
        with scratch() as folder:
            run = Path(folder, "run")
            process = polynya("run", "cases/shock_tube", "--out", run, *settings(TORN))
            self.assertEqual(process.returncode, 1, process.stderr)
            errors = (run / "logs" / "fluid.log").read_text().strip().splitlines()[-1]
            for part in ("equation of state of water", "out of its range", "no real sound speed", "in cell ", " m, time ",
                         "kg", "last good state"):
                self.assertIn(part, errors)
                self.assertIn(part, process.stderr)
            end = float(errors.split(" m, time ")[1].split(" s")[0])
            frames = json.loads((run / "fields" / "fluid.json").read_text())["frames"]
            last = frames[-1]
            self.assertLess(last["time"], end)
            with h5py.File(run / "fields" / last["file"]) as file:
                data = file["VTKHDF/CellData"]
                for name in ("pressure", "density", "velocity", "water_fraction"):
                    self.assertTrue(numpy.isfinite(data[name][:]).all(), name)
                self.assertGreater(data["density"][:].min(), 0)

    def test_state_that_a_run_goes_on_from_is_its_last_good_one(self):
        """It fails again, too soon after the checkpoint for another state to be kept."""
        with scratch() as folder:
            run = Path(folder, "run")
            process = polynya("run", "cases/shock_tube", "--out", run,
                              *settings(TORN + ["checkpoint.interval=0.2 us", "run.frame_interval=50 us"]))
            self.assertEqual(process.returncode, 1, process.stderr)
            last = sorted((run / "checkpoints").glob("*/manifest.json"))[-1]
            again = polynya("resume", run, "--no-pictures")
            self.assertEqual(again.returncode, 1, again.stderr)
            self.assertIn("last good state", again.stderr)
            frames = json.loads((run / "fields" / "fluid.json").read_text())["frames"]
            self.assertGreaterEqual(frames[-1]["time"], json.loads(last.read_text())["time"])

    def test_state_of_a_tube_that_its_law_does_not_know(self):
        with scratch() as folder:
            process = polynya("run", "cases/shock_tube", "--out", Path(folder, "run"),
                              *settings([value for value in TORN if "velocity" not in value]
                                        + ["tube.left.density=9000"]))
            self.assertEqual(process.returncode, 2, process.stderr)
            for part in ("water", "9000", "holds up to"):
                self.assertIn(part, process.stderr)


if __name__ == "__main__":
    unittest.main()
