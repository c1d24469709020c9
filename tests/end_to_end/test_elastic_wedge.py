"""An elastic wedge that falls into water, through coupler, ice solver and fluid solver, against Wagner's theory with Euler's beam."""

import json
import unittest
from pathlib import Path

import h5py
import numpy as np
import wagner_beam
from runs import polynya, scratch, summary_of


def course(run):
    """Time (s) and deflection (m) of the wedge's middle, lower face, for each frame: across the wedge, as seen from its ends."""
    angle, found, start = wagner_beam.DEADRISE, [], None
    for frame in sorted(json.loads((run / "fields" / "ice.json").read_text())["frames"], key=lambda frame: frame["time"]):
        with h5py.File(run / "fields" / Path(frame["file"]).name) as file:
            points = file["VTKHDF/Points"][:]
        if start is None:
            start = points
            middle = np.flatnonzero(abs(start[:, 0] - 0.5 * wagner_beam.LENGTH * np.cos(angle)) < 1e-4)
            middle = middle[np.argmin(start[middle, 2])]
        along, _, up = points[middle] - start[middle]
        found.append((frame["time"], (up + wagner_beam.SPEED * frame["time"]) * np.cos(angle) - along * np.sin(angle)))
    return np.array(found)


class ElasticWedge(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = scratch()
        cls.run_folder = Path(cls.folder.name) / "run"
        cls.summary = summary_of(polynya("run", "cases/elastic_wedge", "--level", "standard", "--out", cls.run_folder, "--json",
                                         "--no-pictures", timeout=1800))
        cls.times, cls.published = np.array(wagner_beam.PUBLISHED).T

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_theory_is_the_published_one(self):
        ours = wagner_beam.deflection(self.times)
        print("theory over published", np.round(ours / self.published, 3))
        self.assertLess(abs(ours / self.published - 1)[2:].max(), 0.06)  # before, less than 1 mm was read from a figure

    def test_bends_as_theory_says_for_compressible_water_and_an_exact_free_surface(self):
        """5 mm cells see the first 1.4 ms too coarsely: c is below 80 of them (docs/verification_solids.md has finer ones)."""
        times, deflections = course(self.run_folder).T
        ours = np.interp(self.times, times, deflections)
        theory = wagner_beam.deflection(self.times, wagner_beam.SIMILARITY * wagner_beam.ACOUSTICS, wagner_beam.ACOUSTICS)
        print("run over theory", np.round(ours / theory, 3), "over published", np.round(ours / self.published, 3))
        self.assertLess(abs(ours / theory - 1)[self.times > 1.4e-3].max(), 0.05)

    def test_the_account_closes_though_supports_work(self):
        """Nearly all energy comes from the supports: 3.4 kJ, six times the wedge's own at the start."""
        print({key: self.summary[key] for key in ("energy_error", "largest_energy_error", "momentum_error", "mass_error")})
        self.assertLess(self.summary["mass_error"], 1e-10)
        self.assertLess(self.summary["largest_energy_error"], 0.01)
        self.assertLess(self.summary["largest_momentum_error"], 0.01)


if __name__ == "__main__":
    unittest.main()
