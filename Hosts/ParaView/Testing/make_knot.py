# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A knotted tube with normals, for pictures: `make_knot.py FILE.vtk`."""
import math
import sys

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter

COUNT = 600
points = vtkPoints()
line = vtkCellArray()
line.InsertNextCell(COUNT + 2)  # a little beyond a turn: the tube has no gap
for k in range(COUNT + 2):
    t = 2 * math.pi * k / COUNT
    points.InsertNextPoint(
        math.sin(t) + 2 * math.sin(2 * t), math.cos(t) - 2 * math.cos(2 * t), -math.sin(3 * t)
    )
    line.InsertCellPoint(k)
knot = vtkPolyData()
knot.SetPoints(points)
knot.SetLines(line)
tube = vtkTubeFilter()
tube.SetInputData(knot)
tube.SetRadius(0.55)
tube.SetNumberOfSides(48)
writer = vtkPolyDataWriter()
writer.SetFileName(sys.argv[1])
writer.SetFileVersion(42)
writer.SetFileTypeToBinary()
writer.SetInputConnection(tube.GetOutputPort())
writer.Write()
