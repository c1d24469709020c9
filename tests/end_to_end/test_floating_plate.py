"""Ice afloat on water at rest: it starts in equilibrium with water and weight and stays where it is."""

import json
import unittest
from pathlib import Path

import h5py
import numpy as np

from runs import ROOT, polynya, scratch, series, summary_of

SCENE = ROOT / "tests" / "end_to_end" / "scenes" / "floating_plate.toml"
WEIGHT = 900 * 0.12 * 0.12 * 0.02 * 9.81


def displacements(run):
    """Of all nodes of the ice at the last frame, m."""
    frames = json.loads((run / "fields" / "ice.json").read_text())["frames"]
    places = []
    for frame in (frames[0], frames[-1]):
        with h5py.File(run / "fields" / Path(frame["file"]).name) as file:
            places.append(file["VTKHDF/Points"][:])
    return places[1] - places[0]


class FloatingPlate(unittest.TestCase):
    def float_for(self, *settings):
        with scratch() as folder:
            run = Path(folder) / "run"
            summary_of(polynya("run", SCENE, "--out", run, "--no-pictures", "--json", *settings))
            ledger = series(run / "series" / "ledger.csv")
            time = sum(ledger["acting_time"])
            forces = [ledger[f"fluid_taken_ice_{axis}"][-1] / time for axis in "xyz"]
            return displacements(run), forces

    def test_stays_where_it_is_without_a_lateral_force(self):
        for method in ("newton", "relaxation"):
            with self.subTest(method):
                self.stay_at_rest("--set", f"ice.equilibrium={method}")

    def stay_at_rest(self, *settings):
        moved, (x, y, z) = self.float_for(*settings)
        print(f"{settings[-1]}, after 0.5 ms: drift {np.abs(moved).max():.1e} m, lateral force {max(abs(x), abs(y)) / WEIGHT:.1e} of the weight, "
              f"vertical {z / WEIGHT:.5f}")
        self.assertLess(np.abs(moved).max(), 1e-10)
        self.assertLess(max(abs(x), abs(y)), 1e-9 * WEIGHT)
        self.assertAlmostEqual(z, WEIGHT, delta=2e-3 * WEIGHT)

    def test_rings_if_it_starts_without_stress(self):
        moved, _ = self.float_for("--set", "ice.start=unloaded")
        self.assertGreater(np.abs(moved).max(), 5e-10)


if __name__ == "__main__":
    unittest.main()
