"""Opens a frame with the reader that ParaView uses and prints what it found as JSON: open_frame.py FRAME."""

import json
import sys

import vtk
from vtk.util.numpy_support import vtk_to_numpy


def fields(attributes):
    return {
        attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i)).tolist()
        for i in range(attributes.GetNumberOfArrays())
    }


reader = vtk.vtkHDFReader()
if not reader.CanReadFile(sys.argv[1]):
    sys.exit("vtkHDFReader cannot read " + sys.argv[1])
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
print(
    json.dumps(
        {
            "class": grid.GetClassName(),
            "points": vtk_to_numpy(grid.GetPoints().GetData()).tolist(),
            "types": [grid.GetCellType(i) for i in range(grid.GetNumberOfCells())],
            "cells": [
                [grid.GetCell(i).GetPointId(k) for k in range(grid.GetCell(i).GetNumberOfPoints())]
                for i in range(grid.GetNumberOfCells())
            ],
            "point_fields": fields(grid.GetPointData()),
            "cell_fields": fields(grid.GetCellData()),
            "field_data": fields(grid.GetFieldData()),
        }
    )
)
