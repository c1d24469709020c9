"""Ice whose mesh comes from a file: the plate that is built in, in any order of the file; and what is refused."""

import json
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

from runs import ROOT, polynya, scratch, series, summary_of

sys.path.insert(0, str(ROOT))
from tests.launcher.meshes import Block  # noqa: E402

CELLS, SIZE = (8, 6, 2), (80.0, 60.0, 20.0)  # mm
PLATE = 'length = "80 mm"\nwidth = "60 mm"\nthickness = "20 mm"\nsides = "clamped"\n'
SCENE = """title = "A plate under its weight"
symmetry = "full"
[run]
end_time = "0.2 ms"
frame_interval = "0.1 ms"
gravity = "1e5 m/s^2"
[ice]
%s
[resolution]
ice_element = "10 mm"
ice_fine_radius = "1 m"
[effects]
ice_failure = "off"
conversion = "off"
"""
STRIKE = """title = "A vehicle strikes a plate"
symmetry = "quarter"
[run]
end = "time"
end_time = "40 us"
frame_interval = "40 us"
[vehicle]
mass = "5 g"
speed = "40 m/s"
nose_position = "-0.1 mm"
[ice]
%s
[resolution]
cell = "5 mm"
vehicle_element = "5 mm"
ice_fine_radius = "1 m"
[contact]
friction = %s
"""
SPEED = "vehicle_speed"


def plate():
    """The plate in other numbers, with its lateral faces as a set."""
    block = Block(CELLS, SIZE, (-40, -30, 0))
    return block.name_nodes("rim", lambda x, y, z: abs(x) == 40 or abs(y) == 30).shuffle()


def mesh_keys(name, supports='rim = "xyz"'):
    return f'mesh = "{name}"\nmesh_unit = "mm"\n[ice.supports]\n{supports}\n'


def run(folder, name, keys, *arguments):
    """Series of the run and its last frame's points sorted by place in the reference."""
    scene = Path(folder, f"{name}.toml")
    scene.write_text(SCENE % keys)
    process = polynya("run", scene, "--out", f"{folder}/{name}", "--json", "--no-pictures", *arguments)
    summary_of(process)
    frame = sorted(Path(folder, name, "fields").glob("ice*.vtkhdf"))[-1]
    with h5py.File(frame) as file:
        points = file["VTKHDF/Points"][:]
    return series(f"{folder}/{name}/series/ice.csv"), points[np.lexsort(np.round(points, 5).T)], process.stderr


class MeshedIce(unittest.TestCase):
    def test_a_plate_from_any_file_bends_and_stores_energy_as_the_built_in_one(self):
        """Only the order of sums differs: ten digits remain after some hundred steps."""
        with scratch() as folder:
            built, shape, _ = run(folder, "built", PLATE)
            sag = np.ptp(shape[:, 2]) - 0.02
            self.assertGreater(built["kinetic"][-1], 0)
            for file, text in (("plate.inp", plate().inp()), ("two.msh", plate().msh2()), ("four.msh", plate().msh4())):
                Path(folder, file).write_text(text)
                read, points, _ = run(folder, file.split(".")[0] + "-" + file.split(".")[1], mesh_keys(file))
                self.assertEqual(len(read["time"]), len(built["time"]))
                for key in ("kinetic", "internal", "gravity_work", "hourglass"):
                    largest = max(map(abs, built[key]))
                    difference = max(abs(a - b) for a, b in zip(read[key], built[key])) / largest
                    print(f"{file} {key}: {difference:.1e} of {largest:.3g} J")
                    self.assertLess(difference, 1e-10)
                moved = np.abs(points - shape).max()
                print(f"{file}: places differ by {moved:.1e} m; the plate's depth has changed by {sag:.1e} m")
                self.assertLess(moved, 1e-10 * max(abs(sag), 1e-9) + 4e-17)

    def test_named_faces_let_waves_leave_as_the_sides_of_the_built_in_plate_do(self):
        with scratch() as folder:
            Path(folder, "plate.inp").write_text(plate().inp())
            built, _, _ = run(folder, "built", PLATE.replace("clamped", "non_reflecting"))
            read, _, _ = run(folder, "read", mesh_keys("plate.inp", 'rim = "non_reflecting"'))
            for key in ("kinetic", "boundary_flux", "gravity_work"):
                largest = max(map(abs, built[key]))
                self.assertGreater(largest, 0)
                self.assertLess(max(abs(a - b) for a, b in zip(read[key], built[key])), 1e-10 * largest)

    def test_a_vehicle_meets_a_quarter_from_a_file_as_it_meets_the_built_in_one(self):
        """Brittle ice that takes damage; the coupler meets its vertices in another order."""
        lost, difference, damage = self.strike(friction=0)
        self.assertGreater(lost, 0.1)
        self.assertGreater(min(damage), 0.1)
        self.assertLess(difference, 1e-10 * lost)

    def test_friction_follows_the_first_of_two_triangles_that_share_the_touched_edge(self):
        """A vertex over an edge carries its slip in the frame of one triangle; which one the file's order decides.

        The two frames turn apart with the shear of the surface within a step, which is all that may differ.
        """
        lost, difference, damage = self.strike(friction=0.1)
        self.assertGreater(min(damage), 0.1)
        self.assertLess(difference, 1e-7 * lost)

    def strike(self, friction):
        """Speed the vehicle loses, largest difference between the two plates, and their largest damage."""
        keys = ('length = "60 mm"\nwidth = "60 mm"\nthickness = "10 mm"\nsides = "non_reflecting"\n',
                mesh_keys("quarter.msh", 'rim = "non_reflecting"'))
        block = Block((6, 6, 2), (30, 30, 10)).name_nodes("rim", lambda x, y, z: x == 30 or y == 30).shuffle()
        speeds, damage = [], []
        with scratch() as folder:
            Path(folder, "quarter.msh").write_text(block.msh4())
            for name, ice in zip(("built", "read"), keys):
                Path(folder, f"{name}.toml").write_text(STRIKE % (ice, friction))
                process = polynya("run", f"{folder}/{name}.toml", "--out", f"{folder}/{name}", "--json",
                                  "--no-pictures", "--threads", "1")
                summary_of(process)
                speeds.append(series(f"{folder}/{name}/series/coupler.csv")[SPEED])
                with h5py.File(sorted(Path(folder, name, "fields").glob("ice*.vtkhdf"))[-1]) as file:
                    damage.append(file["VTKHDF/CellData/damage"][:].max())
        self.assertEqual(len(speeds[0]), len(speeds[1]))
        lost = speeds[0][0] - speeds[0][-1]
        difference = max(abs(a - b) for a, b in zip(*speeds))
        print(f"friction {friction}: loses {lost:.4g} m/s, damage {damage}; the two differ by {difference:.1e} m/s")
        return lost, difference, damage

    def test_the_example_is_read_and_counted(self):
        """It lies beside its scene, wherever the program is started."""
        told = summary_of(polynya("explain", "examples/ice_disc", "--json"))
        self.assertEqual((told["estimate"]["ice_elements"], told["symmetry"]), (576, "quarter"))

    def test_the_case_with_a_mesh_resolves_at_all_levels(self):
        told = [summary_of(polynya("explain", "cases/elastic_wedge", "--level", level, "--json"))["estimate"]
                for level in ("quick", "standard", "fine")]
        self.assertEqual([estimate["ice_elements"] for estimate in told], [240, 240, 240])
        self.assertLess(2 * told[0]["cells"], told[1]["cells"])
        self.assertLess(2 * told[1]["cells"], told[2]["cells"])

    def test_a_block_under_pressure_shortens_by_pressure_over_modulus(self):
        """On a smooth floor, the pressure raised slowly and waves damped: uniaxial stress."""
        pressed = SCENE.replace('gravity = "1e5 m/s^2"\n', "").replace("0.2 ms", "1 ms")
        with scratch() as folder:
            block = Block(CELLS, SIZE, (-40, -30, 0)).name_nodes("floor", lambda x, y, z: z == 0)
            block.name_nodes("top", lambda x, y, z: z == 20)
            Path(folder, "block.inp").write_text(block.shuffle().inp())
            keys = 'material = "aluminium"\ndamping = "50 kHz"\n' + mesh_keys("block.inp", 'floor = "z"')
            for load in ('[ice.pressures]\ntop = "0 at 0; 10 MPa at 0.2 ms"\n',
                         '[ice.forces]\ntop = "0, 0, 0 at 0; 0, 0, -48 kN at 0.2 ms"\n'):
                Path(folder, "scene.toml").write_text(pressed % (keys + load))
                summary_of(polynya("run", f"{folder}/scene.toml", "--out", f"{folder}/{load[5]}", "--json", "--no-pictures"))
                with h5py.File(sorted(Path(folder, load[5], "fields").glob("ice*.vtkhdf"))[-1]) as file:
                    heights = file["VTKHDF/Points"][:, 2]
                card = json.loads(Path(folder, load[5], "scene.json").read_text())["materials"]["aluminium"]["values"]
                exact = 10e6 * 0.02 / card["youngs_modulus"]
                top = heights[heights > 0.015]
                print(f"shortened by {1e6 * (0.02 - top.mean()):.4f} um, pressure over modulus {1e6 * exact:.4f} um")
                self.assertLess(np.abs(0.02 - top - exact).max(), 0.005 * exact)

    def test_the_work_and_the_impulse_of_loads_stand_in_the_books_of_a_coupled_run(self):
        """A free plate that a pressure throws upwards while a vehicle strikes it: the pressure does most of the work."""
        block = Block((6, 6, 2), (30, 30, 10)).name_nodes("floor", lambda x, y, z: z == 0)
        scene = STRIKE.replace("[ice]", '[effects]\nice_failure = "off"\nconversion = "off"\n[ice]')
        with scratch() as folder:
            Path(folder, "block.inp").write_text(block.shuffle().inp())
            keys = 'mesh = "block.inp"\nmesh_unit = "mm"\n[ice.pressures]\nfloor = "0 at 0; 30 MPa at 10 us"\n'
            Path(folder, "scene.toml").write_text(scene % (keys, 0.1))
            summary = summary_of(polynya("run", f"{folder}/scene.toml", "--out", f"{folder}/out", "--json", "--no-pictures"))
            work = json.loads(Path(folder, "out", "summary.json").read_text())["accounts"]["ice"]["set_load_work"]
        print(f"work {work:.4g} J, errors of energy {summary['energy_error']:.1e}, momentum {summary['momentum_error']:.1e}")
        self.assertGreater(4 * work, 0.1 * 0.5 * 0.005 * 40**2)  # four quarters, beside the vehicle's kinetic energy
        self.assertLess(summary["energy_error"], 0.01)
        self.assertLess(summary["momentum_error"], 1e-3)

    def test_a_pressure_on_a_set_without_faces_is_refused_by_the_name_of_the_set(self):
        with scratch() as folder:
            block = Block(CELLS, SIZE, (-40, -30, 0)).name_nodes("edge", lambda x, y, z: x == 40 and y == 30)
            Path(folder, "plate.inp").write_text(block.inp())
            keys = 'mesh = "plate.inp"\nmesh_unit = "mm"\n[ice.pressures]\nedge = "1 kPa"\n'
            Path(folder, "scene.toml").write_text(SCENE % keys)
            process = polynya("run", f"{folder}/scene.toml", "--out", f"{folder}/out", "--no-pictures")
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertIn("ice.pressures.edge: the set has no face", process.stderr)

    def test_wrong_words_and_wrong_files_are_refused_in_one_line(self):
        with scratch() as folder:
            Path(folder, "plate.inp").write_text(plate().inp())
            given = mesh_keys("plate.inp")
            for keys, words in (
                    (mesh_keys("none.inp"), ("none.inp", "no such file")),
                    (given.replace('mesh_unit = "mm"\n', ""), ("ice.mesh_unit", "mm")),
                    (given.replace('"xyz"', '"xw"'), ("ice.supports.rim", '"xyz"', "non_reflecting")),
                    (given.replace("rim", "edge"), ("'edge'", "ALL, rim")),
                    ('thickness = "1 mm"\n' + given, ("ice.thickness", "leave it out")),
                    (given + '[ice.pressures]\nedge = "1 kPa"\n', ("'edge'", "ALL, rim")),
                    (given + '[ice.forces]\nrim = "1 N"\n', ("ice.forces.rim", "must have 3")),
                    ('[ice.supports]\nrim = "z"\n', ("ice.supports.rim", "ice.mesh"))):
                Path(folder, "scene.toml").write_text(SCENE % keys)
                process = polynya("run", f"{folder}/scene.toml", "--out", f"{folder}/out")
                self.assertEqual(process.returncode, 2, process.stderr)
                self.assertEqual(len(process.stderr.strip().splitlines()), 1, process.stderr)
                for word in words:
                    self.assertIn(word, process.stderr)
                self.assertFalse(Path(folder, "out").exists())

    def test_the_log_names_the_element_that_sets_the_step(self):
        with scratch() as folder:
            block = plate()
            for point in block.points.values():
                point[0] = 39.8 if point[0] == 30 else point[0]
            Path(folder, "plate.inp").write_text(block.inp())
            _, _, told = run(folder, "thin", mesh_keys("plate.inp"))
            log = Path(folder, "thin", "logs", "ice.log").read_text()
        ends = {e for e, c in block.cells.items() if np.mean([block.points[n][0] for n in c]) > 39}
        named = {e for e in block.cells if f"element {e} of the mesh" in log}
        self.assertEqual(len(named), 1)
        self.assertLessEqual(named, ends)
        self.assertIn("sets the step", log)
        self.assertIn("sets the step of the ice", told)


if __name__ == "__main__":
    unittest.main()
