"""The critical path of a coupled run and its share of exchange, on waits whose path is known."""
import tempfile
import unittest
from pathlib import Path

from launcher import critical_path

# One span by hand, in s. The coupler sends loads at 1 and waits for both solids. The structure answers at 2, the ice at
# 3; messages take 0.1. The coupler cuts until 4 and waits for the fluid, which works from 4.1 to 8; then it works to 9.
WAITS = {
    "coupler": [(0.5, 0.9, "ice"), (1.0, 2.1, "structure"), (2.1, 3.1, "ice"), (4.0, 8.1, "fluid"), (9.0, 11.1, "ice")],
    "structure": [(0.0, 0.2, "coupler"), (0.4, 1.1, "coupler"), (2.5, 9.1, "coupler")],
    "ice": [(0.0, 0.2, "coupler"), (0.8, 1.1, "coupler"), (3.5, 9.1, "coupler")],
    "fluid": [(0.0, 0.1, "coupler"), (0.3, 4.1, "coupler")],
}


class CriticalPath(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "logs").mkdir()

    def write(self, waits):
        for name, rows in waits.items():
            text = "from [s],to [s],for\n" + "".join(f"{a},{b},{whom}\n" for a, b, whom in rows)
            (self.folder / "logs" / f"{name}_waits.csv").write_text(text)

    def summary(self, seconds=None):
        return critical_path.summary(self.folder, {name: {"seconds": (seconds or {}).get(name, {})} for name in WAITS})

    def test_follows_whoever_was_waited_for(self):
        self.write(WAITS)
        path = self.summary()["critical_path"]
        # From the end: ice 9.1 - 11.1, woken by the coupler's message, coupler 8.1 - 9, fluid 4.1 - 8.1 ...
        self.assertAlmostEqual(path["ice"], 2.0 + 2.0 + 0.6)  # 9.1 - 11.1, 1.1 - 3.1, 0.2 - 0.8
        self.assertAlmostEqual(path["fluid"], 4.0)
        self.assertAlmostEqual(path["coupler"], 0.9 + 0.9 + 0.1)  # 8.1 - 9, 3.1 - 4, 0.9 - 1
        self.assertAlmostEqual(path["messages"], 0.4)             # after 9, 4, 1 and 0.8
        self.assertEqual(path["structure"], 0)                    # it was never the last

    def test_covers_the_run_without_gap_or_overlap(self):
        self.write(WAITS)
        stretches = list(critical_path.walk(critical_path.read_waits(self.folder, list(WAITS))))
        self.assertEqual((stretches[0].end, stretches[-1].begin), (11.1, 0.2))
        for later, earlier in zip(stretches, stretches[1:]):
            self.assertEqual(later.begin, earlier.end)

    def test_exchange_is_the_coupler_the_messages_and_what_solvers_pack(self):
        self.write(WAITS)
        half_packing = {"fluid": {"messages": 2.0, "lagrange": 2.0}}
        self.assertAlmostEqual(self.summary()["exchange_share"], 2.3 / 10.9)
        self.assertAlmostEqual(self.summary(half_packing)["exchange_share"], 4.3 / 10.9)

    def test_cutting_of_the_grid_counts_where_the_others_waited_for_it(self):
        self.write(WAITS)
        self.assertEqual(self.summary()["overlap_share"], 0)
        # Until 3.1 the ice was what the others waited for, after 4 the fluid.
        (self.folder / "logs/coupler_cuts.csv").write_text("from [s],to [s]\n2.9,3.7\n3.8,4.4\n5,6\n8.5,8.6\n")
        told = self.summary()
        self.assertAlmostEqual(told["overlap_share"], (0.6 + 0.2 + 0.1) / 10.9)
        self.assertAlmostEqual(told["exchange_share"], 2.3 / 10.9)  # it is a part of this

    def test_is_unknown_when_a_process_tells_nothing(self):
        self.write({name: rows for name, rows in WAITS.items() if name != "ice"})
        self.assertIsNone(self.summary())


if __name__ == "__main__":
    unittest.main()
