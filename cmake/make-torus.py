#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A mesh that curves both ways, with normals: make-torus.py FILE.vtp."""

import sys

from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

torus = vtkParametricTorus()
torus.SetRingRadius(0.7)
torus.SetCrossSectionRadius(0.35)
source = vtkParametricFunctionSource()
source.SetParametricFunction(torus)
source.SetUResolution(256)
source.SetVResolution(128)
writer = vtkXMLPolyDataWriter()
writer.SetFileName(sys.argv[1])
writer.SetInputConnection(source.GetOutputPort())
if not writer.Write():
    sys.exit(f"{sys.argv[1]}: cannot be written")
