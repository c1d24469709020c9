"""Meshes from files: what is read, what is refused and with which words, and how near neighbours come to lie."""
from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from launcher import WrongInput
from launcher.mesh import checking, importing, reading, renumbering
from tests.launcher.meshes import Block


class MeshTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="polynya-mesh-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, text, name="block.inp"):
        path = self.folder / name
        path.write_text(text)
        return path

    def load(self, text, name="block.inp", unit="mm", pieces=1, planes=(), sets=()):
        return importing.load({"file": str(self.file(text, name)), "unit": unit, "pieces": pieces, "planes": planes,
                               "sets": sets})

    def refused(self, text, *words, **how):
        with self.assertRaises(WrongInput) as caught:
            self.load(text, **how)
        sentence = str(caught.exception)
        self.assertNotIn("\n", sentence)
        for word in (how.get("name", "block.inp"), *words):
            self.assertIn(word, sentence)


class Reading(MeshTest):
    def test_all_kinds_of_files_give_the_same_elements_numbers_and_sets(self):
        block = Block((3, 2, 2), (30, 20, 20)).name_nodes("floor", lambda x, y, z: z == 0).shuffle()
        meshes = [self.load(block.inp()), self.load(block.msh2(), "two.msh"), self.load(block.msh4(), "four.msh")]
        centres = {e: np.mean([block.points[n] for n in c], axis=0) * 1e-3 for e, c in block.cells.items()}
        for mesh in meshes:
            self.assertEqual(sorted(mesh.numbers), sorted(block.cells))
            for e, number in enumerate(mesh.numbers):
                np.testing.assert_allclose(mesh.nodes[mesh.elements[e]].mean(axis=0), centres[number], atol=1e-15)
            np.testing.assert_allclose(np.sort(mesh.nodes[mesh.sets["floor"]], axis=0),
                                       np.sort([np.array(block.points[n]) * 1e-3 for n in block.sets["floor"]], axis=0),
                                       atol=1e-15)

    def test_units_scale_the_box_and_the_volume(self):
        for unit, factor in (("m", 1), ("cm", 1e-2), ("in", 0.0254)):
            facts = importing.facts(self.load(Block((2, 2, 1), (2, 4, 1), (1, 0, -3)).inp(), unit=unit))
            np.testing.assert_allclose(facts["low"], np.array([1, 0, -3]) * factor)
            np.testing.assert_allclose(facts["high"], np.array([3, 4, -2]) * factor)
            self.assertAlmostEqual(facts["volume"] / factor ** 3, 8, places=12)
            self.assertAlmostEqual(facts["thinnest"] / factor, 1, places=12)
            self.assertEqual((facts["elements"], facts["nodes"], facts["boundary_faces"]), (4, 18, 16))

    def test_element_sets_of_abaqus_name_their_nodes(self):
        text = Block((3, 1, 1)).inp() + "*ELSET, ELSET=first\n1\n"
        mesh = self.load(text, sets=["first"])
        self.assertEqual(len(mesh.sets["first"]), 8)
        self.assertEqual(len(mesh.sets["ALL"]), 16)

    def test_the_neutral_file_holds_what_the_solver_reads(self):
        mesh = self.load(Block().name_nodes("floor", lambda x, y, z: z == 0).shuffle().inp())
        importing.write(mesh, self.folder / "mesh.h5")
        with h5py.File(self.folder / "mesh.h5") as file:
            np.testing.assert_array_equal(file["nodes"], mesh.nodes)
            np.testing.assert_array_equal(file["elements"], mesh.elements)
            np.testing.assert_array_equal(file["element_numbers"], mesh.numbers)
            np.testing.assert_array_equal(file["sets/floor"], mesh.sets["floor"])

    def test_a_mesh_that_is_left_handed_throughout_is_turned_with_a_remark(self):
        block = Block((2, 2, 2))
        block.cells = {e: c[4:] + c[:4] for e, c in block.cells.items()}
        mesh = self.load(block.inp())
        self.assertTrue((checking.corner_jacobians(mesh) > 0).all())
        self.assertIn("left-handed", mesh.notes[0])

    def test_unused_nodes_are_dropped_with_a_remark(self):
        block = Block().name_nodes("floor", lambda x, y, z: z == 0)
        block.points[777] = [9, 8, 7]
        block.sets["floor"].append(777)
        mesh = self.load(block.inp())
        self.assertEqual((len(mesh.nodes), len(mesh.sets["floor"])), (18, 9))
        self.assertIn("1 nodes belong to no hexahedron and are left out, the first at (9, 8, 7) mm", mesh.notes[0])

    def test_an_open_seam_is_remarked_with_its_count(self):
        """The middle of four by two elements is cut on half its width by nodes that lie in one place: a crack."""
        block = Block((4, 2, 1), (4, 2, 1))
        seam = {n: n + 1000 for n, p in block.points.items() if p[0] == 2 and p[1] == 0}
        block.points.update({new: block.points[old] for old, new in seam.items()})
        for e, cell in block.cells.items():
            if np.mean([block.points[n][0] for n in cell]) > 2:
                block.cells[e] = [seam.get(n, n) for n in cell]
        mesh = self.load(block.inp())
        self.assertIn("2 nodes lie where others lie, the first at (2, 0, 0) mm", mesh.notes[0])
        self.assertIn("crack", mesh.notes[0])

    def test_a_thin_element_is_named_with_the_step_that_it_sets(self):
        block = Block((5, 1, 1), (5, 1, 1))
        for p in block.points.values():
            p[0] = 3.9 if p[0] == 3 else p[0]
        mesh = self.load(block.inp())
        self.assertEqual(importing.remarks(mesh, {}), mesh.notes + importing.remarks(mesh, {})[-1:])
        remark = importing.remarks(mesh, {"estimate": {"ice_step": 2e-8}})[-1]
        for word in ("element 4 at (3.95, 0.5, 0.5) mm", "sets the step", "0.1 mm thick", "middle one 1 mm", "2e-08 s",
                     "2e-07 s"):
            self.assertIn(word, remark)
        self.assertEqual(importing.remarks(self.load(Block().inp()), {}), [])


class Refusing(MeshTest):
    def test_no_file_and_another_kind_of_file(self):
        with self.assertRaisesRegex(WrongInput, "none.inp: no such file"):
            reading.read(self.folder / "none.inp", "m")
        self.refused("x", "must be Gmsh's .msh or Abaqus' .inp", name="block.vtk")

    def test_damaged_files(self):
        text = Block().inp()
        self.refused(text.replace("*ELEMENT, TYPE=C3D8", "*ELEMENT, TYPE=C3D27"), "cannot be read", "C3D27")
        self.refused(text.replace("\n1, 0", "\n1, zero", 1), "cannot be read", "zero")
        self.refused(Block().msh2().replace("2.2", "1.0"), "cannot be read", "2.2 or 4.1", name="old.msh")
        block = Block()
        block.cells[2][3] = 4711
        self.refused(block.inp(), "4711", "does not define")
        self.refused(text + "*NODE\n99, 0, 0, 0\n", "several *NODE blocks")

    def test_no_hexahedra(self):
        head = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n"
        self.refused(head + "*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n", "holds no hexahedra, only tetrahedra", "C3D8")
        self.refused(head + "*ELEMENT, TYPE=S4\n1,1,2,3,4\n", "only quadrilaterals (shells)")
        nodes = "".join(f"{n},{n % 3},{n % 5},{n % 7}\n" for n in range(1, 21))
        self.refused("*NODE\n" + nodes + "*ELEMENT, TYPE=C3D20\n1," + ",".join(map(str, range(1, 21))) + "\n",
                     "only second-order hexahedra (20 nodes)")

    def test_mixed_cells(self):
        text = Block().inp()
        self.refused(text + "*ELEMENT, TYPE=C3D4\n50, 1, 2, 3, 5\n", "holds tetrahedra beside hexahedra")
        text = text.replace("*ELEMENT", "90, 5, 5, 5\n91, 6, 5, 5\n92, 6, 6, 5\n93, 5, 6, 5\n*ELEMENT", 1)
        self.refused(text + "*ELEMENT, TYPE=S4\n50, 90, 91, 92, 93\n", "quadrilaterals (shells)", "(5.5, 5.5, 5)")

    def test_an_inverted_element_is_named_with_its_number_and_place(self):
        block = Block((3, 1, 1), (3, 1, 1)).shuffle()
        e = next(e for e, c in block.cells.items() if np.mean([block.points[n][0] for n in c]) == 1.5)
        block.cells[e] = block.cells[e][4:] + block.cells[e][:4]
        for name, text in (("block.inp", block.inp()), ("a.msh", block.msh2()), ("b.msh", block.msh4())):
            self.refused(text, f"element {e} at (1.5, 0.5, 0.5) mm is turned inside out", "1 such of 3", name=name)

    def test_a_corner_that_is_pushed_in(self):
        block = Block((1, 1, 1), (1, 1, 1))
        block.points[block.cells[1][0]][:] = [0.8, 0.8, 0.8]
        self.refused(block.inp(), "element 1 at", "Jacobian that is not positive at its corner 1, (0.8, 0.8, 0.8) mm")

    def test_an_element_without_volume(self):
        block = Block((2, 1, 1), (2, 1, 1))
        for p in block.points.values():
            p[0] = min(p[0], 1)
        self.refused(block.inp(), "element 2 at (1, 0.5, 0.5) mm has no volume")

    def test_pieces_that_hang_by_an_edge_or_by_nothing(self):
        block = Block((2, 1, 2), (2, 1, 2))
        cells = {e: c for e, c in block.cells.items()}
        centre = {e: np.mean([block.points[n] for n in c], axis=0) for e, c in cells.items()}
        block.cells = {e: c for e, c in cells.items() if (centre[e][0] < 1) == (centre[e][2] < 1)}
        self.refused(block.inp(), "hangs on the rest by 2 nodes and no face", "2 pieces", "ice.mesh_pieces = 2")
        self.assertEqual(len(self.load(block.inp(), pieces=2).elements), 2)
        block = Block((3, 1, 1), (3, 1, 1))
        del block.cells[2]
        self.refused(block.inp(), "element 1 at (0.5, 0.5, 0.5) mm is not connected to the rest")

    def test_double_elements(self):
        block = Block((3, 1, 1), (3, 1, 1))
        block.cells[9] = list(block.cells[2])
        self.refused(block.inp(), "shares a face with two others")
        block = Block((1, 1, 1))
        block.cells[9] = list(block.cells[1])
        self.refused(block.inp(), "shares more than one face with element")

    def test_unknown_and_empty_sets(self):
        block = Block().name_nodes("floor", lambda x, y, z: z == 0).name_nodes("rim", lambda x, y, z: x == 0)
        block.points[777] = [9, 8, 7]
        block.sets["loose"] = [777]
        self.refused(block.inp(), "set 'bottom'", "the file's sets: ALL, floor, loose, rim", sets=["bottom"])
        self.refused(block.inp(), "'loose', which has no node of a hexahedron", sets=["loose"])

    def test_a_mesh_that_does_not_begin_at_the_plane_of_symmetry(self):
        for low in (-1.0, 0.5):
            self.refused(Block(origin=(0, low, 0)).inp(), f"begins at y = {low:g} mm", 'symmetry = "full"',
                         planes=[0, 1])
        mesh = self.load(Block(origin=(1e-9, 0, 0)).inp(), planes=[0])
        self.assertEqual(mesh.nodes[:, 0].min(), 0.0)


class Renumbering(MeshTest):
    def test_a_shuffled_mesh_gets_the_bandwidth_of_its_layers(self):
        """A bar of 40 x 5 x 5: neighbours lie at most about two layers of 6 x 6 nodes apart, whatever the file says."""
        block = Block((40, 5, 5), (40, 5, 5)).shuffle(step=1)
        raw = reading.read(self.file(block.inp()), "mm")
        shuffled = renumbering.node_distance(raw.elements), renumbering.element_distance(raw.elements, len(raw.nodes))
        mesh = self.load(block.inp())
        near = renumbering.node_distance(mesh.elements), renumbering.element_distance(mesh.elements, len(mesh.nodes))
        print(f"node distance {shuffled[0]:.0f} -> {near[0]:.0f}, element distance {shuffled[1]:.0f} -> {near[1]:.0f}")
        self.assertGreater(shuffled[0], 0.7 * len(mesh.nodes))
        self.assertLess(near[0], 2.5 * 36)
        self.assertLess(near[1], 2.5 * 25)

    def test_elements_keep_their_corners(self):
        block = Block((3, 2, 2), (3, 2, 2)).shuffle()
        mesh = self.load(block.inp(), unit="m")
        for number, nodes in zip(mesh.numbers, mesh.elements):
            np.testing.assert_array_equal(mesh.nodes[nodes], [block.points[n] for n in block.cells[number]])


if __name__ == "__main__":
    unittest.main()
