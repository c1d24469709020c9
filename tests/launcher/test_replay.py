"""What `polynya replay` refuses before any solver starts, and how it is asked for."""
import json
import tempfile
import unittest
from pathlib import Path

from launcher import WrongInput, command_line
from launcher.commands import replay_command


class Times(unittest.TestCase):
    def test_are_seconds_or_carry_a_unit(self):
        for text, value in (("2e-5", 2e-5), ("20 us", 2e-5), ("0.02ms", 2e-5), ("3", 3.0), ("1.5 ns", 1.5e-9)):
            self.assertAlmostEqual(replay_command.seconds(text, "--from"), value, delta=1e-12 * value)

    def test_that_are_none_are_refused(self):
        for text in ("soon", "20 mm", "-1", "1.2.3", ""):
            with self.assertRaisesRegex(WrongInput, "--until .*: is not a time"):
                replay_command.seconds(text, "--until")


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "logs").mkdir()
        self.write({"structure": {}, "ice": {"command": "python3 my_ice.py"}})

    def write(self, participants):
        (self.folder / "scene.json").write_text(json.dumps({"participants": participants}))

    def refused(self, name, words):
        with self.assertRaisesRegex(WrongInput, words):
            replay_command.check(self.folder, "RUN", name)

    def test_without_a_record_is_told_how_to_get_one(self):
        self.refused("structure", "RUN: has no record; run the scene again with --record")

    def test_of_others_is_refused(self):
        (self.folder / "record").mkdir()
        self.refused("fluid", "fluid_solver: took no part in RUN; there were ice_solver, structure_solver")
        self.refused("ice", "was played by 'python3 my_ice.py'")
        self.assertIn("structure", replay_command.check(self.folder, "RUN", "structure")["participants"])


class Words(unittest.TestCase):
    def test_record_is_a_setting_of_the_scene(self):
        arguments = command_line.parse(["run", "a", "--set", "x=1", "--record"])
        self.assertEqual(arguments.settings, ["x=1", "record.interface=true"])
        self.assertEqual(command_line.parse(["run", "a"]).settings, [])

    def test_tolerance_is_a_number_from_0_on(self):
        words = ["replay", "RUN", "--only", "ice_solver", "--tolerance"]
        self.assertEqual(command_line.parse([*words, "1e-6"]).tolerance, 1e-6)
        for wrong in ("-1", "nan", "some"):
            with self.assertRaises(SystemExit):
                command_line.parse([*words, wrong])


if __name__ == "__main__":
    unittest.main()
