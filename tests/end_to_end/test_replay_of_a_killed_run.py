"""SIGKILL of a coupler that records: what it had written can be read and replayed."""

import os
import signal
import subprocess
import unittest
from pathlib import Path

from runs import ROOT, polynya, scratch
from test_loss_of_a_process import processes_of, wait_until


class KilledRun(unittest.TestCase):
    def test_record_is_replayed_as_far_as_it_goes(self):
        with scratch() as folder:
            run = Path(folder, "run")
            launcher = subprocess.Popen([ROOT / "polynya", "run", "cases/vehicle_drop", "--record", "--out", run, "--json"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
            try:
                recorded = wait_until(lambda: (run / "record/structure-00002.h5").exists(), 120)
                self.assertTrue(recorded, "nothing was recorded")
                os.kill(processes_of(str(run))["coupler"], signal.SIGKILL)
                launcher.wait(timeout=60)
            finally:
                launcher.kill()
                launcher.wait()
            for program in ("structure_solver", "ice_solver"):
                process = polynya("replay", run, "--only", program)
                self.assertEqual(process.returncode, 0, process.stderr)
                self.assertRegex(process.stdout, r"where the record ends: \d{3,} messages, all equal bit for bit")


if __name__ == "__main__":
    unittest.main()
