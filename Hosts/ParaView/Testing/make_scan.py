# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A fluted vase as a scanner would leave it, triangles with a little noise and without normals: `make_scan.py FILE.ply`."""
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOPLY import vtkPLYWriter

ACROSS, ALONG = 480, 320
# Radius and height of the wall: outside from the foot to the lip, then inside down again.
WALL = np.array(
    [(0.0, 0.0), (0.34, 0.0), (0.38, 0.04), (0.30, 0.14), (0.42, 0.40), (0.62, 0.80), (0.58, 1.20), (0.34, 1.52), (0.28, 1.70)]
    + [(0.40, 1.86), (0.42, 1.90), (0.37, 1.88), (0.24, 1.70), (0.29, 1.52), (0.50, 1.20), (0.50, 0.80), (0.30, 0.30), (0.0, 0.2)]
)


def interpolate(values, at):
    """A Catmull-Rom spline through the values."""
    padded = np.vstack((values[:1], values, values[-1:]))
    k = np.minimum(at.astype(int), len(values) - 2)
    t = (at - k)[:, None]
    a, b, c, d = (padded[k + shift] for shift in range(4))
    return 0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3)


at = np.linspace(0, len(WALL) - 1, ALONG)
radius, height = interpolate(WALL, at).T
angle = np.linspace(0, 2 * np.pi, ACROSS, endpoint=False)
# Flutes turn around the outside of the belly.
depth = 0.022 * np.clip(np.minimum(at - 2.5, 7.0 - at), 0, 1)
flutes = depth[:, None] * np.hypot(np.cos(9 * (angle[None, :] + 0.7 * height[:, None])), 0.15)
r = np.maximum(radius, 0)[:, None] - flutes
noise = np.random.default_rng(1).normal(0, 6e-5, (3, ALONG, ACROSS))
xyz = np.stack((r * np.cos(angle), np.broadcast_to(height[:, None], r.shape), r * np.sin(angle))) + noise
row, column = np.meshgrid(np.arange(ALONG - 1), np.arange(ACROSS), indexing="ij")
corner = [(row + i) * ACROSS + (column + j) % ACROSS for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
triangles = np.concatenate([np.stack([corner[k] for k in order], -1).reshape(-1, 3) for order in ((0, 1, 2), (0, 2, 3))])

points = vtkPoints()
points.SetData(numpy_to_vtk(np.ascontiguousarray(xyz.reshape(3, -1).T, dtype=np.float32), deep=True))
cells = vtkCellArray()
cells.SetData(3, numpy_to_vtkIdTypeArray(np.ascontiguousarray(triangles.reshape(-1), dtype=np.int64), deep=True))
vase = vtkPolyData()
vase.SetPoints(points)
vase.SetPolys(cells)
writer = vtkPLYWriter()
writer.SetFileName(sys.argv[1])
writer.SetInputData(vase)
writer.Write()
