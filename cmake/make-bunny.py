#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A scanned mesh with normals, 70,000 triangles of the Stanford bunny: make-bunny.py FILE.vtp [BUNNY.obj].

BUNNY.obj: the one that Debian's package glmark2-data installs (the default).
"""

import sys
from pathlib import Path

from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

bunny = Path(sys.argv[2] if len(sys.argv) > 2 else "/usr/share/glmark2/models/bunny.obj")
if not bunny.is_file():
    sys.exit(f"{bunny}: there is no such file; the package glmark2-data has it")
reader = vtkOBJReader()
reader.SetFileName(str(bunny))
clean = vtkCleanPolyData()  # points that triangles share
clean.SetInputConnection(reader.GetOutputPort())
normals = vtkPolyDataNormals()
normals.SetInputConnection(clean.GetOutputPort())
normals.SplittingOff()
writer = vtkXMLPolyDataWriter()
writer.SetFileName(sys.argv[1])
writer.SetInputConnection(normals.GetOutputPort())
if not writer.Write():
    sys.exit(f"{sys.argv[1]}: cannot be written")
