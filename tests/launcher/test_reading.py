"""Series, frames and summaries as they are found after good and bad ends."""
import json
import tempfile
import unittest
from pathlib import Path

import numpy

from launcher import fields, live, summary, units
from launcher.series import Tail, read_series
from launcher.supervise import Outcome
from tests.launcher import synthetic_run as invented


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)


class Series(Folder):
    def test_columns_are_found_by_name_and_know_their_units(self):
        path = self.folder / "a.csv"
        path.write_text("time [s],vehicle_speed [m/s],cells [-]\n0,40,7\n1e-6,39.9,8\n")
        series = read_series(path)
        self.assertEqual(series.units, {"time": "s", "vehicle_speed": "m/s", "cells": ""})
        numpy.testing.assert_array_equal(series["vehicle_speed"], [40, 39.9])

    def test_a_row_that_a_crash_cut_off_is_left_out(self):
        path = self.folder / "a.csv"
        for rest in ("2,3", "2,35.", "2"):
            path.write_text("time [s],x [m]\n0,1\n1,2\n" + rest)
            self.assertEqual(len(read_series(path)), 2)
            self.assertEqual(Tail(path).latest(), {"time": 1.0, "x": 2.0})

    def test_nothing_yet_is_nothing(self):
        path = self.folder / "a.csv"
        self.assertIsNone(read_series(path))
        self.assertEqual(Tail(path).latest(), {})
        for text in ("", "time [s],x", "time [s],x [m]\n"):
            path.write_text(text)
            self.assertIsNone(read_series(path))
            self.assertEqual(Tail(path).latest(), {})

    def test_the_tail_of_a_long_file_is_its_last_row(self):
        path = self.folder / "a.csv"
        path.write_text("time [s],x\n" + "".join(f"{i},{2 * i}\n" for i in range(20000)))
        self.assertEqual(Tail(path).latest(), {"time": 19999.0, "x": 39998.0})


class TimeLeft(unittest.TestCase):
    def share(self, time: float, **run) -> float:
        scene = {**invented.SCENE, "run": {**invented.SCENE["run"], **run}}
        rows = [{"time": t, "vehicle_speed": 40.0, "vehicle_position": -0.05 + 40.0 * t} for t in (1e-6, time)]
        return live.finished_share(scene, rows[1], rows[0])

    def test_follows_the_position_that_ends_the_run(self):
        """Steady flight from 4 mm below 10 mm of ice until the 10 mm head and one diameter are above it: 34 mm."""
        self.assertAlmostEqual(self.share(2.125e-4, end_time=9.0), 0.25)
        self.assertAlmostEqual(self.share(2.85e-4, end_time=9.0, end="exited"), 0.1)

    def test_without_ice_follows_the_tail_to_the_waterline(self):
        """Steady flight from 4 mm below the waterline, taken as 6 mm up, until 100 mm of vehicle are above it: 110 mm."""
        scene = {"vehicle": invented.SCENE["vehicle"], "fluid": {"waterline": 0.006},
                 "run": {"end_time": 9.0, "end": "exited"}}
        rows = [{"time": t, "vehicle_speed": 40.0, "vehicle_position": -0.05 + 40.0 * t} for t in (1e-6, 2.75e-4)]
        self.assertAlmostEqual(live.finished_share(scene, rows[1], rows[0]), 0.1)

    def test_follows_the_latest_end_when_that_comes_first(self):
        self.assertAlmostEqual(self.share(1e-4, end_time=4e-4), 0.25)
        self.assertAlmostEqual(self.share(1e-4, end_time=8e-4, end="time"), 0.125)


class Summary(Folder):
    NAMES = ["structure", "ice", "fluid"]

    def merge(self, outcome=Outcome(0, None, {"ice": {"cpu_time": 1.0}})) -> dict:
        scene = json.loads((self.folder / "scene.json").read_text())
        result = summary.merge(self.folder, scene, self.NAMES, outcome, 9.0)
        self.assertEqual(result, json.loads((self.folder / "summary.json").read_text()))
        return result

    def test_holds_what_was_found_and_what_it_cost(self):
        invented.write_run(self.folder, frames=0)
        seconds = {"elements": 4.0, "particles": 2.0, "conversion": 0.5}
        (self.folder / "logs" / "ice.json").write_text(json.dumps({"peak_memory": 5, "seconds": seconds}))
        found = self.merge()
        self.assertEqual((found["state"], found["energy_error"], found["particles"]), ("done", 1.2e-3, 480))
        self.assertEqual(found["processes"]["ice"], {"cpu_time": 1.0, "peak_memory": 5, "seconds": seconds})
        self.assertEqual((found["effects"]["conversion"]["state"], found["effects"]["conversion"]["time"]), ("on", 2.5))
        self.assertEqual(found["effects"]["cavitation"]["time"], 0)
        self.assertIsNone(found["effects"]["fluid"]["time"])
        self.assertIn("reported", found["effects"]["fluid"]["time_note"])
        self.assertAlmostEqual(found["peak_head_stress"], 99.8e6, delta=1e5)
        self.assertAlmostEqual(found["residual_speed"], 36.0, delta=0.01)
        self.assertIsNone(found["mass_error"])

    def test_of_a_run_that_left_nothing_has_all_keys(self):
        invented.write_run(self.folder, frames=0)
        for path in ("coupler_summary.json", "series/coupler.csv"):
            (self.folder / path).unlink()
        found = self.merge(Outcome(1, "ice was killed by SIGKILL", {}))
        self.assertEqual((found["state"], found["reason"]), ("failed", "ice was killed by SIGKILL"))
        for key in ("residual_speed", "peak_deceleration", "through_time", "steps", "energy_error"):
            self.assertIn(key, found)
            self.assertIsNone(found[key])

    def test_damaged_rows_and_repeated_times_do_no_harm(self):
        invented.write_run(self.folder, frames=0)
        path = self.folder / "series" / "coupler.csv"
        lines = path.read_text().splitlines()
        broken = lines[900].split(",")
        broken[3] = "nan"
        path.write_text("\n".join(lines[:900] + [",".join(broken)] + lines[899:]) + "\n")
        self.assertAlmostEqual(self.merge()["residual_speed"], 36.0, delta=0.01)


class Frames(Folder):
    def test_a_cut_through_a_block_has_its_area_wherever_the_plane_lies(self):
        points, cells = invented.box(numpy.array([0, 1, 3.0]), numpy.array([-1, 0, 2.0]), numpy.array([0, 0.5]))
        for height in (-0.7, -0.001, 0.3):
            polygons, which = fields.cut(points, cells, height)
            self.assertAlmostEqual(sum(map(area, polygons)), 1.5)
            self.assertEqual(len(set(which)), 2)

    def test_an_oblique_cut_has_the_area_of_its_projection(self):
        """A unit cube turned by 45 degrees about x and cut through its middle: 1 x sqrt(2)."""
        points, cells = invented.box(*[numpy.array([-0.5, 0.5])] * 3)
        c = numpy.sqrt(0.5)
        turned = points @ numpy.array([[1, 0, 0], [0, c, -c], [0, c, c]])
        polygons, _ = fields.cut(turned, cells, 1e-9)
        self.assertAlmostEqual(area(polygons[0]), numpy.sqrt(2), places=6)

    def test_a_plane_that_holds_faces_cuts_one_layer(self):
        points, cells = invented.box(numpy.arange(4.0), numpy.arange(-2.0, 3.0), numpy.arange(3.0))
        height = fields.cut_height(points, cells)
        _, which = fields.cut(points, cells, height)
        self.assertEqual(len(which), 6)
        self.assertTrue((points[cells[which], 1].min(axis=1) == 0).all())

    def test_grid_lines_are_found_from_nodes_when_they_are_not_stored(self):
        lines = (numpy.array([0, 1, 2.5]), numpy.array([-1.0, 0, 1, 2]), numpy.array([0, 0.1, 0.3]))
        points, cells = invented.box(*lines)
        invented.write_frame(self.folder / "f", points, cells, {"y": points[cells, 1].mean(axis=1)})
        frame = fields.read_frame(self.folder / "f")
        for found, line in zip(fields.grid_lines(frame), lines):
            numpy.testing.assert_allclose(found, line, atol=1e-8)
        numpy.testing.assert_allclose(fields.grid_row(frame, lines, "y"), 0.5)


def area(polygon: numpy.ndarray) -> float:
    x, z = polygon.T
    return 0.5 * abs(numpy.dot(x, numpy.roll(z, 1)) - numpy.dot(z, numpy.roll(x, 1)))


class Units(unittest.TestCase):
    def test_numbers_read_well(self):
        self.assertEqual(units.readable(9.48e7, "Pa"), "94.8 MPa")
        self.assertEqual(units.readable(4.2e-4, "s"), "420 µs")
        self.assertEqual(units.readable(1000, "m"), "1.00 km")
        self.assertEqual(units.readable(-0.5, "N"), "-500 mN")
        self.assertEqual(units.readable(None, "N"), "-")
        self.assertEqual([units.duration(s) for s in (0.5, 42, 185, 7800)],
                         ["0.5 s", "42 s", "3 min 05 s", "2 h 10 min"])
        self.assertEqual(units.memory(123.4e6), "123 MB")


if __name__ == "__main__":
    unittest.main()
