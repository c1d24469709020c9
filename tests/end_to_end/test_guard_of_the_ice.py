"""Ice whose elements invert ends a run by one sentence and exit code 1, and leaves its last good state."""

import json
import subprocess
import unittest
from pathlib import Path

import numpy
from runs import polynya, scratch
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

# Rollers that move 5 m/ms through an elastic beam 40 mm high.
CRUSHED = ["ice.material=aluminium", "effects.conversion=off", "ice.bending.speed=5000 m/s",
           "ice.bending.ramp_time=1 us", "run.end_time=1 ms", "run.frame_interval=50 us"]


class GuardOfTheIce(unittest.TestCase):
    def test_beam_whose_elements_invert(self):
        with scratch() as folder:
            run = Path(folder, "run")
            process = polynya("run", "cases/beam_bending", "--out", run, "--no-pictures",
                              *[word for value in CRUSHED for word in ("--set", value)])
            self.assertEqual(process.returncode, 1, process.stderr)
            error = (run / "logs" / "ice.log").read_text().strip().splitlines()[-1]
            for part in ("element ", "inverted", "centre (", " m, time ", "last good state"):
                self.assertIn(part, error)
                self.assertIn(part, process.stderr)
            failed = float(error.split(" m, time ")[1].split(" s")[0])
            last = json.loads((run / "fields" / "ice.json").read_text())["frames"][-1]
            kept = float(error.split("of time ")[1].split(" s")[0])
            self.assertAlmostEqual(last["time"] / kept, 1, delta=1e-5)
            self.assertLess(last["time"], failed)
            self.assertLess(failed - last["time"], 20.5 * 0.1e-6)  # twenty steps of at most 0.1 us
            reader = vtkHDFReader()
            reader.SetFileName(str(run / "fields" / last["file"]))
            reader.Update()
            grid = reader.GetOutput()
            self.assertEqual(grid.GetNumberOfCells(), 405)
            self.assertTrue(numpy.isfinite(vtk_to_numpy(grid.GetPoints().GetData())).all())
            for name in ("stress", "pressure", "damage"):
                values = vtk_to_numpy(grid.GetCellData().GetArray(name))
                self.assertTrue(numpy.isfinite(values).all(), name)
            left = subprocess.run(["pgrep", "-f", str(run)], capture_output=True, text=True)
            self.assertEqual(left.stdout, "")


if __name__ == "__main__":
    unittest.main()
