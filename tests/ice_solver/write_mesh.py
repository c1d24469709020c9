"""write_mesh.py OUT FAULT: a distorted block of 4 x 3 x 5 mm, shuffled, through an Abaqus file into the solver's file.
FAULT: none, or what is then spoilt in it: index, numbers, nodes."""
import random
import sys
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from launcher.mesh import importing  # noqa: E402
from tests.launcher.meshes import Block  # noqa: E402

out, fault = Path(sys.argv[1]), sys.argv[2]
block = Block((4, 3, 5), (4.0, 3.0, 5.0)).name_nodes("floor", lambda x, y, z: z == 0)
jitter = random.Random(2)
for point in block.points.values():
    point[:] = [x + 0.2 * jitter.uniform(-1, 1) for x in point]
out.with_suffix(".inp").write_text(block.shuffle().inp("C3D8R"))
mesh = importing.load({"file": str(out.with_suffix(".inp")), "unit": "mm", "pieces": 1, "planes": [], "sets": []})
importing.write(mesh, out)
with h5py.File(out, "a") as file:
    if fault == "index":
        file["elements"][3, 5] = 5000
    elif fault == "numbers":
        del file["element_numbers"]
    elif fault == "nodes":
        del file["nodes"]
        file["nodes"] = mesh.nodes.ravel()[:-1]
