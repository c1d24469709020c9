"""Every participant that we hand out follows docs/protocol.md, by the word of `./polynya conform`."""

import json
import os
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from runs import ROOT, polynya

PYTHON = "/usr/bin/python3"
COARSE = ["--set", "resolution.cell=5 mm", "--set", "resolution.vehicle_element=4 mm", "--set", "resolution.growth=1.3"]
PLATE = [*COARSE, "--set", "ice.length=80 mm", "--set", "ice.width=80 mm"]
BASIN = [*COARSE, "--set", "fluid.length=80 mm", "--set", "fluid.width=80 mm", "--set", "water.depth=130 mm"]


def conform(*words):
    return polynya("conform", "--json", *words, timeout=300)


def own(program):
    return str(Path(os.environ["POLYNYA_PROGRAMS"]) / program)


class Conformance(unittest.TestCase):
    def test_of_all_that_come_with_the_project(self):
        participants = {
            "structure": (*PLATE, "--", own("structure_solver")),
            "rigid structure": (*PLATE, "--set", "effects.deformable_vehicle=off", "--", own("structure_solver")),
            "ice": ("--name", "ice", *PLATE, "--", own("ice_solver")),
            "fluid": ("--role", "fluid", *BASIN, "--", own("fluid_solver")),
            "rigid vehicle": (*PLATE, "--", PYTHON, ROOT / "examples/rigid_vehicle.py"),
            "tetrahedron": (*PLATE, "--", PYTHON, ROOT / "examples/tetrahedron_solid.py"),
        }
        with ThreadPoolExecutor(6) as pool:
            processes = dict(zip(participants, pool.map(lambda words: conform(*words), participants.values())))
        for name, process in processes.items():
            with self.subTest(name):
                self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
                verdict = json.loads(process.stdout)
                self.assertTrue(verdict["conforms"])
                self.assertEqual(verdict["findings"], [])
        counts = json.loads(processes["ice"].stdout)["counts"]
        self.assertGreater(counts["topology changes"], 0)  # its new arrays were seen

    def test_is_denied_with_exit_code_1_and_the_section(self):
        process = conform(*PLATE, "--", PYTHON, ROOT / "tests/launcher/seeded_errors.py", "whole_step")
        self.assertEqual(process.returncode, 1)
        verdict = json.loads(process.stdout)
        self.assertFalse(verdict["conforms"])
        self.assertEqual([(finding["document"], finding["section"]) for finding in verdict["findings"]],
                         [("docs/protocol.md", "4")])

    def test_cannot_be_asked_for_what_is_not_there(self):
        for words, part in ((("--", "no_such_solver"), "no_such_solver"),
                            (("--name", "ice", "--scene", "cases/vehicle_in_water", "--", PYTHON), "ice"),
                            (("--role", "fluid", "--name", "ice", "--", PYTHON), "--name ice"),
                            (("--role", "fluid", "--scene", "cases/shock_tube", "--", PYTHON), "water"),
                            (("--patience", "0", "--", PYTHON), "number of seconds"),
                            (("--role", "solid"), "COMMAND")):
            process = conform(*words)
            self.assertEqual(process.returncode, 2, process.stderr)
            self.assertEqual(len(process.stderr.strip().splitlines()), 1, process.stderr)
            self.assertIn(part, process.stderr)


if __name__ == "__main__":
    unittest.main()
