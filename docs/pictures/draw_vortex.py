"""Draws the sphere in the deforming vortex, stretched furthest and returned, from what test_fluid_vortex wrote.

    TEST_TMPDIR=FOLDER build/release/bin/test_fluid_vortex
    /usr/bin/python3 docs/pictures/draw_vortex.py FOLDER docs/pictures/vortex.png

Surfaces where half a cell is full."""
from __future__ import annotations

import sys
from pathlib import Path

import numpy
from matplotlib import pyplot
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

LIGHT = numpy.array([0.3, -0.8, 0.5]) / numpy.linalg.norm([0.3, -0.8, 0.5])


def surface(file: Path) -> numpy.ndarray:
    """Corners of the triangles of the surface, (triangles, 3, 3), the cube having the length 1."""
    fractions = numpy.fromfile(file, dtype=numpy.float32)
    cells = round(len(fractions) ** (1 / 3))
    image = vtkImageData()
    image.SetDimensions(cells, cells, cells)
    image.SetSpacing(1 / cells, 1 / cells, 1 / cells)
    image.SetOrigin(0.5 / cells, 0.5 / cells, 0.5 / cells)
    image.GetPointData().SetScalars(numpy_to_vtk(fractions))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.5)
    contour.Update()
    mesh = contour.GetOutput()
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(mesh.GetPoints().GetData())[corners]


def draw(axes, triangles: numpy.ndarray, title: str) -> None:
    normals = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    bright = 0.35 + 0.65 * numpy.abs(normals @ LIGHT)
    colours = bright[:, None] * numpy.array([0.337, 0.706, 0.914])
    axes.add_collection3d(Poly3DCollection(triangles, facecolors=colours, edgecolors=colours, linewidths=0.1))
    axes.set(xlim=(0, 1), ylim=(0, 1), zlim=(0, 1), xlabel="x", ylabel="y", zlabel="z", title=title)
    axes.set_box_aspect((1, 1, 1))
    axes.view_init(elev=20, azim=-70)


def main() -> int:
    if len(sys.argv) != 3:
        print("usage: draw_vortex.py FOLDER PICTURE, FOLDER being where test_fluid_vortex wrote its files")
        return 2
    folder = Path(sys.argv[1])
    figure = pyplot.figure(figsize=(9, 4.5), dpi=110)
    for place, (name, title) in enumerate([("deformed", "t = 1.5, stretched furthest"), ("returned", "t = 3, returned")]):
        file = folder / f"vortex_{name}.f32"
        if not file.is_file():
            print(f"{file} is missing; run TEST_TMPDIR={folder} build/release/bin/test_fluid_vortex first")
            return 2
        draw(figure.add_subplot(1, 2, place + 1, projection="3d"), surface(file), title)
    figure.tight_layout()
    figure.savefig(sys.argv[2])
    return 0


if __name__ == "__main__":
    sys.exit(main())
