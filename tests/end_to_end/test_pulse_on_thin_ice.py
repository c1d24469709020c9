"""Ice of one layer of elements, lighter than the water that moves with it, under an acoustic pulse: the water's
loads do not make it swing up."""

import json
import unittest
from pathlib import Path

import h5py

from runs import polynya, scratch, summary_of

SCENE = Path(__file__).parent / "scenes" / "pulse_on_thin_ice.toml"
SOUND_SPEED, SPEED, RADIUS, NOSE = 1480.0, 4.0, 0.005, 0.02


class PulseOnThinIce(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = scratch()
        run = Path(cls.folder.name) / "run"
        cls.summary = summary_of(polynya("run", SCENE, "--out", run, "--json"))
        cls.fastest = []
        for frame in json.loads((run / "fields" / "ice.json").read_text())["frames"]:
            with h5py.File(run / "fields" / Path(frame["file"]).name) as file:
                cls.fastest.append((frame["time"], abs(file["VTKHDF/PointData/velocity"][:]).max()))
        cls.fastest.sort()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_arrives_with_sound(self):
        arrival = NOSE / SOUND_SPEED
        peak = max(speed for _, speed in self.fastest)
        self.assertLess(max(speed for time, speed in self.fastest if time < 0.7 * arrival), 0.02 * peak)
        self.assertGreater(max(speed for time, speed in self.fastest if time < arrival + 6e-6), 0.9 * peak)

    def test_is_no_faster_than_a_free_surface_and_dies_out(self):
        """A sphere that starts at once moves the water on its axis with U a/r at the front; a free surface doubles it."""
        peak = max(speed for _, speed in self.fastest)
        late = max(speed for time, speed in self.fastest if time > 0.1e-3)
        print(f"ice moves with {peak:.3f} m/s at most, {late:.3f} m/s after 0.1 ms")
        self.assertLess(peak, 2 * SPEED * RADIUS / (RADIUS + NOSE))
        self.assertGreater(peak, 0.2 * 2 * SPEED * RADIUS / (RADIUS + NOSE))
        self.assertLess(late, 0.25 * peak)

    def test_books_close(self):
        self.assertLess(self.summary["energy_error"], 0.002)
        self.assertLess(self.summary["mass_error"], 1e-10)


if __name__ == "__main__":
    unittest.main()
