"""A fluid grid that goes along with the vehicle, through all processes."""

import unittest
from pathlib import Path

import h5py

from runs import polynya, scratch, series, summary_of

END = 0.15e-3  # s, three cells of way


def run(folder, whom, cell="2 mm"):
    return summary_of(polynya("run", "cases/vehicle_in_water", "--set", f"fluid.grid_follows={whom}", "--set",
                              f"run.end_time={END}", "--set", f"resolution.cell={cell}", "--out", folder, "--json",
                              "--no-pictures"))


def speed_lost(folder):
    """By the vehicle, m/s."""
    speed = series(f"{folder}/series/coupler.csv")["vehicle_speed"]
    return speed[0] - speed[-1]


def planes(file):
    """z of the lines of the fluid's grid in a field frame."""
    with h5py.File(file) as frame:
        points = frame["VTKHDF/Points"][:]
    return points[:, 2].min(), points[:, 2].max()


class FollowingGrid(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with scratch() as folder:
            cls.summary, cls.first, cls.last = {}, {}, {}
            for whom in ("none", "vehicle"):
                cls.summary[whom] = run(f"{folder}/{whom}", whom)
                frames = sorted(Path(folder, whom, "fields").glob("fluid*.vtkhdf"))
                cls.first[whom], cls.last[whom] = planes(frames[0]), planes(frames[-1])

    def test_planes_go_as_far_as_the_vehicle(self):
        for end in (0, 1):
            self.assertEqual(self.first["none"][end], self.last["none"][end])
            way = self.last["vehicle"][end] - self.first["vehicle"][end]
            self.assertAlmostEqual(way, 40 * END, delta=0.01 * 40 * END)

    def test_books_close(self):
        for whom, summary in self.summary.items():
            self.assertLess(abs(summary["energy_error"]), 5e-4, whom)
            self.assertLess(abs(summary["momentum_error"]), 1e-5, whom)
            self.assertLess(abs(summary["mass_error"]), 1e-12, whom)


if __name__ == "__main__":
    unittest.main()
