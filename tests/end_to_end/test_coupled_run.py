"""The base scene at its quick level, to its end: what the project is for."""

import json
import unittest

import h5py
import numpy

from runs import polynya, scratch, series, summary_of

PROCESSES = {"coupler", "structure", "ice", "fluid"}


class BaseScene(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = scratch()
        cls.run_folder = f"{cls.folder.name}/run"
        cls.process = polynya("run", "cases/water_exit", "--out", cls.run_folder, "--json")
        cls.summary = summary_of(cls.process)
        cls.ledger = series(f"{cls.run_folder}/series/ledger.csv")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_vehicle_passes_the_ice_and_loses_speed(self):
        self.assertEqual(self.summary["end_reason"], "ice_passed")
        self.assertLess(self.summary["residual_speed"], 39)
        self.assertGreater(self.summary["residual_speed"], 20)
        self.assertGreater(self.summary["converted_elements"], 20)

    def test_books_close(self):
        self.assertLess(self.summary["energy_error"], 0.05)
        self.assertLess(self.summary["momentum_error"], 0.01)
        self.assertLess(self.summary["mass_error"], 1e-10)
        self.assertLess(self.summary["leak_fraction"], 1e-4)

    def test_contact_impulses_cancel_at_every_window(self):
        for axis in "xyz":
            vehicle = numpy.array(self.ledger[f"contact_impulse_vehicle_{axis}"])
            ice = numpy.array(self.ledger[f"contact_impulse_ice_{axis}"])
            self.assertLess(abs(vehicle + ice).max(), 1e-12 * max(abs(ice).max(), 1e-9))
        self.assertGreater(abs(numpy.array(self.ledger["contact_impulse_ice_z"])).max(), 1e-4)

    def test_what_the_fluid_gave_is_taken_or_outstanding_at_every_window(self):
        for body in ("vehicle", "ice"):
            for axis in "xyz":
                given, taken, held = (numpy.array(self.ledger[f"fluid_{what}_{body}_{axis}"])
                                      for what in ("given", "taken", "outstanding"))
                self.assertGreater(abs(given).max(), 0)
                self.assertLess(abs(given - taken - held).max(), 1e-11 * abs(given).max())

    def test_fluid_books_the_impulse_that_the_bodies_get(self):
        """The fluid's own sum over its cells, by absolute pressure, against the coupler's sum over pieces of wall."""
        for body in ("vehicle", "ice"):
            column = {what: numpy.array(self.ledger[f"fluid_{what}_{body}_z"])
                      for what in ("given", "start", "weight", "atmosphere", "carried", "reported")}
            by_pressure = column["given"] - column["start"] - column["weight"] - column["carried"] + column["atmosphere"]
            self.assertLess(abs(by_pressure - column["reported"]).max(), 1e-9 * abs(column["given"]).max())

    def index(self, name):
        with open(f"{self.run_folder}/fields/{name}.json") as file:
            return json.load(file)["frames"]

    def frames(self, name):
        """The field frames of a solver, opened, in the order of time."""
        for frame in self.index(name):
            yield h5py.File(f"{self.run_folder}/fields/{frame['file']}")

    def test_ice_has_a_hole_and_water_follows(self):
        """Around the vehicle, between the faces of the ice: open at the end, and full of water and its vapour before."""
        water_in_hole, open_at_end = [], 0
        for frame in self.frames("fluid"):
            cells = frame["VTKHDF/CellData"]
            corner = frame["VTKHDF/Points"][:][frame["VTKHDF/Connectivity"][:].reshape(-1, 8)[:, 0]]
            hole = (corner[:, 2] > -1e-9) & (corner[:, 2] < 7.9e-3) & (corner[:, 0] < 9e-3) & (corner[:, 1] < 9e-3)
            water_in_hole.append((cells["density"][:] * (1 - cells["solid_fraction"][:]))[hole].max())
            open_at_end = (1 - cells["solid_fraction"][:])[hole].mean()
            for name in cells:
                self.assertTrue(numpy.isfinite(cells[name][:]).all(), name)
        self.assertLess(water_in_hole[0], 0.01)  # kg/m^3: a film of nanometres under ice that yields to the start's pressure
        self.assertGreater(max(water_in_hole), 100)  # kg/m^3: air has 1.2, water that fills the cell 1000
        self.assertGreater(open_at_end, 0.3)

    def test_run_folder_is_complete(self):
        from pathlib import Path
        folder = Path(self.run_folder)
        for file in ("scene.json", "summary.json", "series/coupler.csv", "series/ledger.csv", "logs/ice.log"):
            self.assertTrue((folder / file).is_file(), file)
        pictures = sorted(file.name for file in (folder / "pictures").glob("*.png"))
        self.assertGreaterEqual(len(pictures), 4, pictures)
        self.assertEqual(set(self.summary["processes"]), PROCESSES)

    def test_fields_open_in_the_reader_of_paraview(self):
        from vtkmodules.vtkIOHDF import vtkHDFReader
        for name in ("vehicle", "ice", "fluid", "particles"):
            reader = vtkHDFReader()
            reader.SetFileName(f"{self.run_folder}/fields/{self.index(name)[-1]['file']}")
            reader.Update()
            self.assertGreater(reader.GetOutput().GetNumberOfCells(), 10, name)

    def test_summary_has_all_names_that_scripts_rely_on(self):
        for key in ("residual_speed initial_speed peak_deceleration mean_deceleration peak_head_stress through_time "
                    "shoulder_clear_time broken_ice_mass energy_error momentum_error mass_error leak_fraction "
                    "converted_elements particles cells elements steps wall_time processes effects").split():
            self.assertIn(key, self.summary)
        # What keeps a value within bounds is counted where scripts find it.
        self.assertIn("density_bounded", self.summary["participants"]["ice"])


stagnation_pressure = 0.5 * 1000 * 40**2  # Pa


class WithoutIce(unittest.TestCase):
    """A vehicle set into motion impulsively would radiate rho c V = 59 MPa; the potential flow does not."""

    @classmethod
    def setUpClass(cls):
        with scratch() as folder:
            summary_of(polynya("run", "cases/vehicle_in_water", "--set", "run.end_time=0.1 ms", "--out", f"{folder}/run",
                               "--json", "--no-pictures"))
            cls.columns = series(f"{folder}/run/series/coupler.csv")

    def test_start_transient_stays_below_the_stagnation_pressure_in_every_cell_of_the_wall(self):
        # Until a stress wave has run along the hull and back: what the start sends out, in water and hull, has passed.
        start = [p for t, p in zip(self.columns["time"], self.columns["wall_pressure"]) if t < 2 * 0.100 / 5052]
        self.assertGreater(len(start), 50)
        self.assertLess(max(start), 1.2 * stagnation_pressure)
        self.assertGreater(max(start), 0.5 * stagnation_pressure)

    def test_mean_pressure_on_the_head_stays_far_below_the_stagnation_pressure(self):
        self.assertLess(max(self.columns["head_pressure"]), 0.25 * stagnation_pressure)
        self.assertGreater(max(self.columns["head_pressure"]), 0.05 * stagnation_pressure)
        self.assertGreater(self.columns["vehicle_speed"][-1], 39)


if __name__ == "__main__":
    unittest.main()
