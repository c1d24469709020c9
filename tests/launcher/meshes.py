"""Hexahedral blocks as files of Abaqus and Gmsh, with nodes and elements in any order and under any numbers."""
from __future__ import annotations

import random

# Corners of an element in steps along x, y, z: the order of VTK, Abaqus and Gmsh.
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


class Block:
    """`points`: by node number, in the file's unit; `cells`: node numbers by element number; `sets`: node numbers."""

    def __init__(self, cells=(2, 2, 1), size=(2.0, 2.0, 1.0), origin=(0.0, 0.0, 0.0)):
        counts = [n + 1 for n in cells]

        def node(i, j, k):
            return 1 + k + counts[2] * (i + counts[0] * j)

        self.points = {node(i, j, k): [origin[a] + size[a] * (i, j, k)[a] / cells[a] for a in range(3)]
                       for j in range(counts[1]) for i in range(counts[0]) for k in range(counts[2])}
        places = [(i, j, k) for j in range(cells[1]) for i in range(cells[0]) for k in range(cells[2])]
        self.cells = {e: [node(i + a, j + b, k + c) for a, b, c in CORNERS] for e, (i, j, k) in enumerate(places, 1)}
        self.sets = {}

    def shuffle(self, seed=1, step=3):
        """Other numbers with gaps, and another order in the file; the shapes stay."""
        random_numbers = random.Random(seed)

        def renamed(keys):
            names = [10 + step * k for k in range(len(keys))]
            random_numbers.shuffle(names)
            return dict(zip(keys, names))

        node, element = renamed(list(self.points)), renamed(list(self.cells))
        points = [(node[n], p) for n, p in self.points.items()]
        cells = [(element[e], [node[n] for n in c]) for e, c in self.cells.items()]
        random_numbers.shuffle(points), random_numbers.shuffle(cells)
        self.points, self.cells = dict(points), dict(cells)
        self.sets = {name: [node[n] for n in nodes] for name, nodes in self.sets.items()}
        return self

    def name_nodes(self, name, condition):
        self.sets[name] = [n for n, p in self.points.items() if condition(*p)]
        return self

    def faces_of(self, name):
        """Quadrilaterals on the surface whose nodes are all in a set."""
        chosen, found = set(self.sets[name]), {}
        for cell in self.cells.values():
            for face in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
                nodes = [cell[a] for a in face]
                key = tuple(sorted(nodes))
                if chosen.issuperset(nodes):
                    found[key] = None if key in found else nodes
        return [nodes for nodes in found.values() if nodes]

    def inp(self, kind="C3D8"):
        lines = ["*HEADING", "block", "*NODE"]
        lines += [f"{n}, " + ", ".join(f"{x:.17g}" for x in p) for n, p in self.points.items()]
        lines += [f"*ELEMENT, TYPE={kind}, ELSET=ALL"]
        lines += [f"{e}, " + ", ".join(map(str, c)) for e, c in self.cells.items()]
        for name, nodes in self.sets.items():
            lines += [f"*NSET, NSET={name}"] + [", ".join(map(str, nodes[i:i + 8])) for i in range(0, len(nodes), 8)]
        return "\n".join(lines) + "\n"

    def groups(self):
        return [(tag, name, self.faces_of(name)) for tag, name in enumerate(self.sets, 1)]

    def physical_names(self):
        volume = len(self.sets) + 1
        return ["$PhysicalNames", str(volume), *(f'2 {tag} "{name}"' for tag, name, _ in self.groups()),
                f'3 {volume} "ice"', "$EndPhysicalNames"]

    def surface_numbers(self):
        """Quadrilaterals follow the hexahedra, as Gmsh numbers no element twice."""
        return max(self.cells) + 1

    def msh2(self):
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", *self.physical_names(), "$Nodes", str(len(self.points))]
        lines += [f"{n} " + " ".join(f"{x:.17g}" for x in p) for n, p in self.points.items()]
        elements, number = [], self.surface_numbers()
        for tag, _, faces in self.groups():
            for face in faces:
                elements.append(f"{number} 3 2 {tag} {tag} " + " ".join(map(str, face)))
                number += 1
        elements += [f"{e} 5 2 {len(self.sets) + 1} 1 " + " ".join(map(str, c)) for e, c in self.cells.items()]
        return "\n".join([*lines, "$EndNodes", "$Elements", str(len(elements)), *elements, "$EndElements"]) + "\n"

    def msh4(self):
        groups, volume = self.groups(), len(self.sets) + 1
        lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", *self.physical_names(), "$Entities",
                 f"0 0 {len(groups)} 1"]
        lines += [f"{tag} 0 0 0 1 1 1 1 {tag} 0" for tag, _, _ in groups] + [f"1 0 0 0 1 1 1 1 {volume} 0"]
        lines += ["$EndEntities", "$Nodes", f"1 {len(self.points)} {min(self.points)} {max(self.points)}",
                  f"3 1 0 {len(self.points)}", *map(str, self.points)]
        lines += [" ".join(f"{x:.17g}" for x in p) for p in self.points.values()]
        blocks, number, count = [], self.surface_numbers(), len(self.cells)
        for tag, _, faces in groups:
            blocks.append(f"2 {tag} 3 {len(faces)}")
            for face in faces:
                blocks.append(f"{number} " + " ".join(map(str, face)))
                number += 1
            count += len(faces)
        blocks += [f"3 1 5 {len(self.cells)}"] + [f"{e} " + " ".join(map(str, c)) for e, c in self.cells.items()]
        return "\n".join([*lines, "$EndNodes", "$Elements", f"{len(groups) + 1} {count} 1 {number}", *blocks,
                          "$EndElements"]) + "\n"
