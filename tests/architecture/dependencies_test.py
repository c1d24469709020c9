"""Rooms include only what they say they depend on; some libraries stay inside one room."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ROOMS = ["core/compute", "core/continuum", "core/contact", "core/exchange", "core/scene", "core/results", "geometry",
         "structure_solver", "ice_solver", "fluid_solver", "coupler"]
EXECUTABLE_ROOMS = {"structure_solver", "ice_solver", "fluid_solver", "coupler"}
CONFINED = {  # library header -> the only rooms, or files of a room, that may include it
    r"zmq": {"core/exchange/transport.cpp"},
    r"hdf5\.h|H5\w*\.h": {"core/results", "core/exchange/record_file.cpp", "core/exchange/hdf5_handle.hpp"},
    r"CGAL/": {"geometry"},
    r"toml": {"core/scene"},
}


def room_of(path):
    """The innermost room a file of the project belongs to."""
    inside = [room for room in ROOMS if path == room or path.startswith(room + "/")]
    return max(inside, key=len) if inside else None


def sources(room):
    return [f for f in (ROOT / room).rglob("*") if f.suffix in (".cpp", ".hpp")]


def includes(file):
    return re.findall(r'^\s*#include\s+["<]([^">]+)[">]', file.read_text(), re.M)


def targets_of_rooms():
    """Target name -> room, read from the rooms' CMakeLists.txt."""
    owner = {}
    for room in ROOMS:
        for lists in (ROOT / room).rglob("CMakeLists.txt"):
            for name in re.findall(r"polynya_(?:library|executable)\(\s*(\w+)", lists.read_text()):
                owner[name] = room
    return owner


def declared_dependencies(room):
    text = "".join(lists.read_text() for lists in (ROOT / room).rglob("CMakeLists.txt"))
    owner = targets_of_rooms()
    return {owner[word] for word in re.findall(r"\bpolynya_\w+", text) if word in owner}


class Dependencies(unittest.TestCase):
    def test_rooms_include_only_their_declared_dependencies(self):
        for room in ROOMS:
            allowed = declared_dependencies(room) | {room}
            for file in sources(room):
                for include in includes(file):
                    target = room_of(include)
                    if target is not None:
                        self.assertIn(target, allowed, f"{file.relative_to(ROOT)} includes {include}, but "
                                                       f"{room}/CMakeLists.txt does not depend on {target}")

    def test_executables_never_include_one_another(self):
        for room in EXECUTABLE_ROOMS:
            for file in sources(room):
                for include in includes(file):
                    target = room_of(include)
                    self.assertFalse(target in EXECUTABLE_ROOMS and target != room,
                                     f"{file.relative_to(ROOT)} includes {include} of another executable")

    def test_libraries_of_others_stay_in_their_room(self):
        for room in ROOMS:
            for file in sources(room):
                for include in includes(file):
                    for pattern, homes in CONFINED.items():
                        if re.match(pattern, include) and room_of(include) is None:
                            name = str(file.relative_to(ROOT))
                            self.assertTrue({room, name} & homes, f"{name} includes {include}")

    def test_only_the_recorder_sees_its_own_hdf5(self):
        for room in ROOMS:
            for file in sources(room):
                if file.name != "record_file.cpp":
                    self.assertNotIn("core/exchange/hdf5_handle.hpp", includes(file), file)

    def test_physics_has_neither_transport_nor_files(self):
        """What a solver's library consists of, headers included, knows neither exchange nor results."""
        for room in ("structure_solver", "ice_solver", "fluid_solver"):
            lists = (ROOT / room / "CMakeLists.txt").read_text()
            listed = re.search(r"polynya_library\([^)]*SOURCES([^)]*)DEPENDS", lists).group(1)
            waiting, seen = [f"{room}/{name}" for name in listed.split()], set()
            while waiting:
                file = waiting.pop()
                if file in seen:
                    continue
                seen.add(file)
                for include in includes(ROOT / file):
                    self.assertFalse(include.startswith(("core/exchange/", "core/results/")),
                                     f"{file} is physics but includes {include}")
                    if include.startswith(room + "/"):
                        waiting.append(include)


if __name__ == "__main__":
    unittest.main()
