"""Bodies whose motion a scene prescribes, water and air around them, one process: forces against potential flow."""

import json
import math
import unittest
from pathlib import Path

from runs import polynya, scratch, series, summary_of

RHO, DIAMETER, SPEED = 1000.05, 0.01, 1.0  # of the water under one atmosphere


def settings(values):
    return [word for value in values for word in ("--set", value)]


def run_sphere(run, *arguments):
    summary = summary_of(polynya("run", "cases/sphere_in_water", "--out", run, "--json", *arguments))
    return summary, series(Path(run, "series", "bodies.csv"))


def impulse(columns, axis):
    times, forces = columns["time"], columns[f"sphere_force_{axis}"]
    return sum(force * (b - a) for force, a, b in zip(forces[1:], times, times[1:]))


def block(length, width, height):
    """STL text of a box with a corner at the origin."""
    corners = [(x, y, z) for z in (0, height) for y in (0, width) for x in (0, length)]
    faces = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
             (1, 3, 7), (1, 7, 5)]
    lines = ["solid block"]
    for face in faces:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex {} {} {}".format(*corners[corner]) for corner in face] + ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid block"]) + "\n"


class BodiesInWater(unittest.TestCase):
    def test_sphere_takes_half_the_mass_of_the_water_it_displaces(self):
        """Impulse over 0.5 rho V U at 8 cells per diameter, from the scene and its one process alone."""
        with scratch() as folder:
            run = Path(folder, "run")
            summary, columns = run_sphere(run)
            half = 0.5 * RHO * math.pi / 6 * DIAMETER**3 * SPEED
            ratio = -impulse(columns, "z") / half
            print(f"impulse of a sphere at 8 cells per diameter: {ratio:.4f} of 0.5 rho V U")
            self.assertLess(abs(ratio - 1), 0.07)
            self.assertEqual(columns["sphere_velocity_z"][-1], SPEED)
            self.assertAlmostEqual(columns["sphere_position_z"][-1], 0.37e-3 + SPEED * 40e-6, delta=1e-12)
            for side in ("force_x", "force_y", "moment_x", "moment_y", "moment_z"):
                self.assertTrue(all(value == 0 for value in columns[f"sphere_{side}"]), side)
            self.assertEqual(list(summary["processes"]), ["fluid"])
            self.assertGreater(summary["overlap_cells"], 0)
            self.assertEqual(summary["overlap_cells_two_bodies"], 0)
            self.assertTrue((run / "pictures" / "forces.png").is_file())
            self.assertGreater(len(json.loads((run / "fields" / "fluid.json").read_text())["frames"]), 5)

    def test_whole_sphere_feels_what_its_quarter_says(self):
        """The full model has all four quarters of the cut; only the order of its sums differs, and what sleeps."""
        with scratch() as folder:
            few = ["--no-pictures", *settings(["run.end_time=8 us", "fluid.length=60 mm", "fluid.width=60 mm"])]
            _, quarter = run_sphere(Path(folder, "quarter"), *few)
            _, full = run_sphere(Path(folder, "full"), *few, "--set", "symmetry=full")
            largest = max(map(abs, quarter["sphere_force_z"]))
            for a, b in zip(quarter["sphere_force_z"], full["sphere_force_z"], strict=True):
                self.assertAlmostEqual(a, b, delta=1e-5 * largest)
            for side in ("x", "y"):
                self.assertLess(max(map(abs, full[f"sphere_force_{side}"])), 1e-5 * largest)

    def test_body_at_rest_is_carried_by_its_buoyancy(self):
        """rho g V (Archimedes) on bodies of every shape; the wedge is turned, the box a file in millimetres."""
        shapes = {"ball": (["shape=sphere", "diameter=10 mm", "position=-20 mm, 0, -30 mm"], math.pi / 6 * 1e-6),
                  "rod": (["shape=cylinder", "diameter=10 mm", "height=12 mm", "position=0, 0, -30 mm",
                           "angles=90 deg, 0, 0"], math.pi / 4 * 1.2e-6),
                  "roof": (["shape=wedge", "length=16 mm", "width=8 mm", "height=6 mm",
                            "position=22 mm, 1 mm, -33 mm", "angles=0, 20 deg, 0"], 0.5 * 16e-3 * 8e-3 * 6e-3)}
        shapes["file"] = (["shape=file", "file=block.stl", "file_unit=mm", "position=-20 mm, 14 mm, -32 mm"], 480e-9)
        text = "[run]\nend_time = \"4 us\"\n[water]\ndepth = \"60 mm\"\n[air]\n[fluid]\nlength = \"80 mm\"\nwidth = \"60 mm\"\n"
        for name, (keys, _) in shapes.items():
            words = (key.split("=") for key in keys)
            text += f"[body.{name}]\n" + "".join(f"{key} = \"{value}\"\n" for key, value in words)
        with scratch() as folder:
            scene = Path(folder, "scene.toml")
            scene.write_text(text)
            Path(folder, "block.stl").write_text(block(10, 8, 6))
            run = Path(folder, "run")
            summary_of(polynya("run", scene, "--out", run, "--json", "--no-pictures"))
            columns = series(run / "series" / "bodies.csv")
            for name, (_, volume) in shapes.items():
                weight = RHO * 9.81 * volume
                for force in columns[f"{name}_force_z"][1:]:
                    self.assertAlmostEqual(force / weight, 1, delta=5e-3, msg=name)
                for side in ("x", "y"):
                    self.assertLess(max(map(abs, columns[f"{name}_force_{side}"])), 5e-3 * weight, name)

    def test_run_that_goes_on_has_the_bits_of_one_that_did_not_stop(self):
        with scratch() as folder:
            long, short = Path(folder, "long"), Path(folder, "short")
            frames = ["--no-pictures", "--set", "run.frame_interval=5 us", "--set", "checkpoint.interval=10 us"]
            run_sphere(long, *frames, "--set", "run.end_time=20 us")
            kept = (long / "series" / "bodies.csv").read_bytes()
            run_sphere(short, *frames, "--set", "run.end_time=20 us")
            process = polynya("resume", short, "--no-pictures")
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertEqual((short / "series" / "bodies.csv").read_bytes(), kept)

    def test_explanation_shows_the_bodies(self):
        process = polynya("explain", "cases/sphere_in_water")
        self.assertEqual(process.returncode, 0, process.stderr)
        for part in ("sphere", "0.5236 cm³", "0, 0, 1 at 40.0 µs"):
            self.assertIn(part, process.stdout)


class WrongBodies(unittest.TestCase):
    def expect(self, values, *parts):
        process = polynya("run", "cases/sphere_in_water", "--out", "/tmp/polynya-never", *settings(values))
        self.assertEqual(process.returncode, 2, process.stdout + process.stderr)
        self.assertEqual(len(process.stderr.strip().splitlines()), 1, process.stderr)
        for part in parts:
            self.assertIn(part, process.stderr)

    def test_each_is_one_sentence(self):
        second = ["body.other.shape=sphere", "body.other.diameter=4 mm"]
        for values, parts in (
                (["body.sphere.shape=shpere"], ("body.sphere.shape", "did you mean sphere?")),
                (["body.sphere.diametre=1 mm"], ("unknown key 'body.sphere.diametre'", "body.NAME.diameter")),
                (["body.sphere.shape=box"], ("body.sphere.diameter", "has no meaning for a body of shape box")),
                (["body.other.shape=cylinder", "body.other.position=0, 0, -30 mm"], ("body.other.diameter", "missing")),
                (["body.other.shape=file", "body.other.file=a.stl"], ("body.other.file_unit", "missing", "m, cm, mm")),
                (["body.other.shape=file", "body.other.file=a.stl", "body.other.file_unit=mm",
                  "body.other.position=0, 0, 0"], ("body.other.file", "a.stl")),
                (["body.sphere.position=0, 0, 80 mm"], ("outside the fluid", "along z", "fluid from -60 mm to 70 mm")),
                (["body.sphere.position=0, 0"], ("body.sphere.position", "2 numbers", "must have 3")),
                (["body.sphere.position=0, 0, 3 s"], ("body.sphere.position", "is not a length")),
                ([*second, "body.other.position=0, 0, 6 mm"], ("meets", "at the start", "must stay apart")),
                ([*second, "body.other.position=0, 0, 0.4 mm"], ("meets", "at the start")),
                ([*second, "body.other.position=0, 0, 9 mm", "body.other.velocity=0, 0, -60 m/s"],
                 ("meets", " s;", "must stay apart")),
                (["body.sphere.velocity=0, 0, 0 at 0; 0, 0, 1 at 2 us; 0, 0, 2 at 1 us"],
                 ("body.sphere.velocity", "times must rise")),
                (["body.sphere.velocity=0, 0, 1 at 1 us"], ("the first time must be 0",)),
                (["body.sphere.position=1 mm, 0, 0", "symmetry=quarter"], ("plane x = 0", "symmetry = \"full\"")),
                (["vehicle.mass=5 g"], ("[vehicle] cannot stand beside [body]",))):
            with self.subTest(values=values):
                self.expect(values, *parts)


if __name__ == "__main__":
    unittest.main()
