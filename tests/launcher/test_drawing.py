"""Every picture of an invented run comes out, and what is missing leaves pictures out instead of failing."""
import json
import shutil
import struct
import tempfile
import unittest
from pathlib import Path

import numpy

from launcher import draw, style
from tests.launcher import synthetic_run as invented


def size(picture: Path) -> tuple[int, int]:
    return struct.unpack(">II", picture.read_bytes()[16:24])


class Drawing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.whole = invented.write_run(Path(cls.temporary.name) / "whole", frames=4)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.run_folder = Path(self.temporary.name) / "run"
        shutil.copytree(self.whole, self.run_folder)
        self.addCleanup(shutil.rmtree, self.run_folder)

    def names(self) -> set[str]:
        pictures, troubles = draw.draw_run(self.run_folder)
        self.assertEqual(troubles, [])
        for picture in pictures:
            self.assertGreater(min(size(picture)), 300)
        return {picture.name for picture in pictures}

    def change_scene(self, **parts):
        (self.run_folder / "scene.json").write_text(json.dumps({**invented.SCENE, **parts}))

    def test_a_whole_run(self):
        self.assertEqual(self.names(), {"motion.png", "energies.png", "cuts.png", "pressure.png", "last_cut.png"})

    def test_a_run_that_died_before_its_first_row(self):
        (self.run_folder / "series" / "coupler.csv").unlink()
        shutil.rmtree(self.run_folder / "fields")
        self.assertEqual(self.names(), set())

    def test_a_damaged_frame_is_reported_and_the_rest_is_drawn(self):
        (self.run_folder / "fields" / "ice_0001.vtkhdf").write_bytes(b"rubbish")
        pictures, troubles = draw.draw_run(self.run_folder)
        self.assertEqual({picture.name for picture in pictures}, {"motion.png", "energies.png"})
        self.assertEqual(len(troubles), 1)
        self.assertIn("cuts", troubles[0])

    def test_ice_alone_in_bending(self):
        for name in ("vehicle", "fluid", "particles"):
            (self.run_folder / "fields" / f"{name}.json").unlink()
        self.change_scene(vehicle=None, fluid=None, participants={"ice": {}})
        time = numpy.linspace(0, 1e-3, 50)
        rows = "".join(f"{t},{1e5 * t},{-t},{2 * t}\n" for t in time)
        (self.run_folder / "series" / "ice.csv").write_text("time [s],load [N],deflection [m],energy [J]\n" + rows)
        self.assertEqual(self.names(), {"series.png", "cuts.png", "last_cut.png"})

    def test_a_tube_beside_its_exact_solution(self):
        x = numpy.linspace(0, 1, 100)
        rows = "".join(f"{a},{1 - a},{1.01 - a},{a}\n" for a in x)
        (self.run_folder / "series" / "tube.csv").write_text(
            "x [m],density [kg/m^3],exact_density [kg/m^3],velocity [m/s]\n" + rows)
        self.change_scene(vehicle=None, ice=None, participants={"fluid": {}})
        self.assertEqual(self.names(), {"tube.png"})


class Moments(unittest.TestCase):
    def test_contact_and_shoulder_are_among_the_moments_shown(self):
        times = numpy.linspace(0, 1e-3, 31)
        wishes = draw.events({"first_contact_time": 1e-4, "shoulder_clear_time": 5e-4}, None)
        chosen = draw.choose(times, wishes)
        self.assertEqual(len(chosen), draw.SHEET)
        for wish in (0.0, 1e-4, 3.5e-4, 6e-4, 1e-3):
            self.assertLess(min(abs(numpy.array(chosen) - wish)), 2e-5)

    def test_few_frames_are_all_shown(self):
        self.assertEqual(draw.choose(numpy.array([0.0, 1.0]), []), [0.0, 1.0])


class Colours(unittest.TestCase):
    def test_damage_reads_in_grey(self):
        red, green, blue, _ = style.DAMAGE_MAP(numpy.linspace(0, 1, 50)).T
        self.assertTrue((numpy.diff(0.2126 * red + 0.7152 * green + 0.0722 * blue) < 0).all())


if __name__ == "__main__":
    unittest.main()
