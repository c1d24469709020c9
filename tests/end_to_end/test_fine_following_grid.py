"""What a vehicle loses in water does not hang on whether the grid goes along, as far as the grid resolves the flow."""

import unittest

from runs import scratch
from test_following_grid import run, speed_lost


class FineFollowingGrid(unittest.TestCase):
    def test_grids_at_rest_and_following_agree_the_better_the_finer(self):
        apart = []
        for cell in ("2 mm", "1 mm"):
            with scratch() as folder:
                for whom in ("none", "vehicle"):
                    run(f"{folder}/{whom}", whom, cell)
                at_rest, follows = (speed_lost(f"{folder}/{whom}") for whom in ("none", "vehicle"))
            print(f"cells of {cell}: {at_rest:.3f} m/s at rest, {follows:.3f} m/s following")
            apart.append(abs(follows / at_rest - 1))
        self.assertLess(apart[1], 0.05)
        self.assertLess(apart[1], 0.5 * apart[0])


if __name__ == "__main__":
    unittest.main()
