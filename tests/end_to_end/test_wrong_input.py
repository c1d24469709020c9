"""Wrong input: one line that says what, where and what would be right; exit code 2."""

import os
import subprocess
import unittest
from pathlib import Path

from runs import ROOT, polynya, scratch


class WrongInput(unittest.TestCase):
    def refused(self, *arguments, says):
        process = polynya(*arguments)
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertEqual(len(process.stderr.strip().splitlines()), 1, process.stderr)
        for word in says:
            self.assertIn(word, process.stderr)

    def test_missing_scene(self):
        self.refused("run", "cases/no_such_case", says=["no_such_case"])

    def test_unknown_key_names_file_line_and_the_right_spelling(self):
        with scratch() as folder:
            text = (ROOT / "cases/water_exit/scene.toml").read_text().replace("diameter =", "diametre =")
            Path(folder, "scene.toml").write_text(text)
            line = 1 + text[: text.index("diametre")].count("\n")
            self.refused("run", f"{folder}/scene.toml", says=["scene.toml", str(line), "diametre", "diameter"])

    def test_wrong_dimension(self):
        self.refused("explain", "cases/water_exit", "--set", "vehicle.speed=40 mm", says=["vehicle.speed", "m/s"])

    def test_impossible_value(self):
        self.refused("explain", "cases/water_exit", "--set", "ice.thickness=-1 mm", says=["ice.thickness"])

    def test_scene_that_does_not_fit_the_machine(self):
        for command in ("run", "explain"):
            self.refused(command, "cases/water_exit", "--set", "resolution.cell=0.02 mm", says=["memory", "fit"])

    def test_participant_that_never_comes(self):
        """A coupler alone names those that are missing."""
        with scratch() as folder:
            programs = Path(os.environ["POLYNYA_PROGRAMS"])
            scene = f"{folder}/scene.json"
            subprocess.run([programs / "resolve_scene", ROOT / "cases/vehicle_drop", "--output", scene], check=True)
            coupler = subprocess.run([programs / "coupler", "--scene", scene, "--out", folder, "--bind",
                                      f"ipc://{folder}/socket", "--run", "x", "--connect-timeout", "0.5"],
                                     capture_output=True, text=True, timeout=30)
        self.assertEqual(coupler.returncode, 1)
        self.assertEqual(len(coupler.stderr.strip().splitlines()), 1, coupler.stderr)
        for name in ("structure", "ice"):
            self.assertIn(name, coupler.stderr)


if __name__ == "__main__":
    unittest.main()
