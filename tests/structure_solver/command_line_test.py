"""The structure solver as a process: a flight alone, and wrong input."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

BIN = Path(os.environ["POLYNYA_BIN"])
SOURCE = Path(os.environ["POLYNYA_SOURCE"])


def run(folder, *arguments):
    return subprocess.run([BIN / "structure_solver", "--scene", folder / "scene.json", "--out", folder, *arguments],
                          capture_output=True, text=True, timeout=120)


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)
        self.folder = Path(self.directory.name)
        (self.folder / "logs").mkdir()
        subprocess.run([BIN / "resolve_scene", SOURCE / "cases/vehicle_drop", "--output", self.folder / "scene.json"],
                       check=True, capture_output=True)
        scene = json.loads((self.folder / "scene.json").read_text())
        scene["run"].update(end_time=2e-5, frame_interval=1e-5, gravity=0)
        scene["vehicle"]["speed"] = 40
        self.write(scene)

    def write(self, scene):
        self.scene = scene
        (self.folder / "scene.json").write_text(json.dumps(scene))

    def test_flies_alone_and_leaves_its_results(self):
        done = run(self.folder, "--threads", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        header, *rows = (self.folder / "series/structure.csv").read_text().splitlines()
        names = [name.split(" [")[0] for name in header.split(",")]
        last = dict(zip(names, map(float, rows[-1].split(","))))
        self.assertAlmostEqual(last["time"], 2e-5, delta=1e-15)
        self.assertAlmostEqual(last["speed_z"], 40, delta=1e-10)
        frames = json.loads((self.folder / "fields/vehicle.json").read_text())["frames"]
        self.assertEqual([frame["file"] for frame in frames], [f"vehicle_{n:04}.vtkhdf" for n in range(3)])
        report = json.loads((self.folder / "logs/structure.json").read_text())
        self.assertGreater(report["counts"]["steps"], 100)

    def test_wrong_material_is_exit_code_2_and_one_line(self):
        self.scene["materials"][self.scene["vehicle"]["material"]]["law"] = "ideal_gas"
        self.write(self.scene)
        done = run(self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("elastic", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_absent_scene_is_exit_code_2(self):
        (self.folder / "scene.json").unlink()
        done = run(self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("scene.json", done.stderr)


if __name__ == "__main__":
    unittest.main()
