"""A clamped elastic plate that carries water: its static deflection, through all processes that the scene needs."""

import json
import unittest
from pathlib import Path

import h5py

from runs import polynya, scratch, series, summary_of

YOUNGS_MODULUS, POISSON_RATIO, LENGTH, HEIGHT, GRAVITY, DEPTH = 67.5e9, 0.34, 1.0, 0.05, 9.81, 2.0
LOAD = GRAVITY * (1000.05 * DEPTH + 2700 * HEIGHT)


def theory():
    """Sinking of the middle: Kirchhoff's plate, and Timoshenko's shear on top of it."""
    stiffness = YOUNGS_MODULUS * HEIGHT**3 / 12 / (1 - POISSON_RATIO**2)
    shear_modulus = YOUNGS_MODULUS / 2 / (1 + POISSON_RATIO)
    return (LOAD * LENGTH**4 / (384 * stiffness), LOAD * LENGTH**2 / (8 * 5 / 6 * shear_modulus * HEIGHT))


def course(run):
    """Time and sinking (m) of the plate's lower face in the middle, for each frame."""
    found = []
    for frame in json.loads((run / "fields" / "ice.json").read_text())["frames"]:
        with h5py.File(run / "fields" / Path(frame["file"]).name) as file:
            points = file["VTKHDF/Points"][:]
        found.append((frame["time"], -HEIGHT - points[abs(points[:, 0]) < 1e-9][:, 2].min()))
    return sorted(found)


class PlateUnderWater(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = scratch()
        cls.run_folder = Path(cls.folder.name) / "run"
        cls.summary = summary_of(polynya("run", "cases/plate_under_water", "--out", cls.run_folder, "--json"))
        cls.course = course(cls.run_folder)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_sinks_as_plate_theory_says(self):
        bending, shear = theory()
        last = self.course[-1][1]
        print(f"sinks by {last:.4e} m; plate {bending:.4e} m, with shear {bending + shear:.4e} m")
        # Plane strain by finite elements of second order, written apart, 80 x 16 in the half plate.
        self.assertLess(abs(last / 70.46e-6 - 1), 0.005)
        # Published for the plate without shear (fsi_etvf).
        self.assertLess(abs(last / 68.49e-6 - 1), 0.03)

    def test_is_at_rest_at_the_end(self):
        last = self.course[-1][1]
        self.assertLess(max(abs(value / last - 1) for time, value in self.course if time > 0.9 * self.course[-1][0]), 0.01)

    def test_water_pushes_with_its_weight_and_nothing_is_lost(self):
        self.assertLess(self.summary["mass_error"], 1e-10)
        ledger = series(self.run_folder / "series" / "ledger.csv")
        time, given = ledger["time"], ledger["fluid_given_ice_z"]
        early = next(n for n, t in enumerate(time) if t > 0.8 * time[-1])
        force = (given[-1] - given[early]) / (time[-1] - time[early])  # on a quarter of the slice of 50 mm
        self.assertLess(abs(force / (-GRAVITY * 1000.05 * DEPTH * 0.5 * LENGTH * 0.025) - 1), 0.01)


if __name__ == "__main__":
    unittest.main()
