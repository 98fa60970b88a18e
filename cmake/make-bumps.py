#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A sphere of half a million triangles with bumps, as FrameScene.h's: make-bumps.py FILE.vtp."""

import sys

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

sphere = vtkSphereSource()
sphere.SetThetaResolution(500)
sphere.SetPhiResolution(502)
sphere.SetRadius(1.0)
sphere.Update()
surface = sphere.GetOutput()
points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
x, y, z = points.T
bump = numpy.sin(12 * x) * numpy.sin(12 * y) + numpy.sin(10 * z)
points *= (1 - 0.05 * bump)[:, None]
surface.GetPoints().SetData(numpy_to_vtk(points.astype(numpy.float32), deep=True))
normals = vtkPolyDataNormals()
normals.SetInputData(surface)
normals.SplittingOff()
writer = vtkXMLPolyDataWriter()
writer.SetFileName(sys.argv[1])
writer.SetInputConnection(normals.GetOutputPort())
if not writer.Write():
    sys.exit(f"{sys.argv[1]}: cannot be written")
