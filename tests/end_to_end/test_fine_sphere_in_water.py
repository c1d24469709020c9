"""The sphere of test_bodies_in_water at twice as many cells."""

import math
import unittest
from pathlib import Path

from runs import scratch
from test_bodies_in_water import DIAMETER, RHO, SPEED, impulse, run_sphere


class FineSphereInWater(unittest.TestCase):
    def test_sphere_takes_half_the_mass_of_the_water_it_displaces(self):
        """Impulse over 0.5 rho V U at 16 cells per diameter."""
        with scratch() as folder:
            _, columns = run_sphere(Path(folder, "run"), "--level", "standard", "--no-pictures")
            ratio = -impulse(columns, "z") / (0.5 * RHO * math.pi / 6 * DIAMETER**3 * SPEED)
            print(f"impulse of a sphere at 16 cells per diameter: {ratio:.4f} of 0.5 rho V U")
            self.assertLess(abs(ratio - 1), 0.03)


if __name__ == "__main__":
    unittest.main()
