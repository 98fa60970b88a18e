#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a mesh that hides much of the sky from itself: make-mesh.py KIND OUTPUT.vtp [BUNNY.obj].

bowl        a hollow that sends light back to itself, with a ball in it
molecule    caffeine as spheres of van der Waals radii
bunny       a scan with normals: 70,000 triangles of the Stanford bunny. BUNNY.obj: the one that Debian's package
            glmark2-data installs (the default)
"""

import os
import sys

from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCleanPolyData, vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

# Positions in 1e-10 m are about those of the molecule, which is enough for a picture. Radii by Bondi (1964), of hydrogen 1.1.
RADII = {"C": 1.7, "N": 1.55, "O": 1.52, "H": 1.1}
ATOMS = """
O 0.4700 2.5688 0.0006    O -3.1271 -0.4436 -0.0003  N -0.9686 -1.3125 0.0000  N 2.2182 0.1412 -0.0003
N -1.3477 1.0797 -0.0001  N 1.4119 -1.9372 0.0002    C 0.8579 0.2592 -0.0008   C 0.3897 -1.0264 -0.0004
C 0.0307 1.4220 -0.0006   C -1.9061 -0.2495 -0.0004  C 2.5032 -1.1998 0.0003   C -1.4276 -2.6960 0.0008
C 3.1926 1.2061 0.0003    C -2.2969 2.1881 0.0007    H 3.5163 -1.5787 0.0008   H -1.0451 -3.1973 -0.8937
H -2.5186 -2.7596 0.0011  H -1.0447 -3.1963 0.8957   H 4.1992 0.7801 0.0002    H 3.0468 1.8092 -0.8992
H 3.0466 1.8083 0.9004    H -1.8087 3.1651 -0.0003   H -2.9322 2.1027 0.8881   H -2.9346 2.1021 -0.8849
"""


def sphere(radius, resolution, opening=0.0):
    """A sphere, open from the top down to that angle in degrees."""
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(resolution[0])
    source.SetPhiResolution(resolution[1])
    source.SetStartPhi(opening)
    return source


def make_bowl():
    both = vtkAppendPolyData()
    for radius, y, opening in ((1.0, 0.0, 75.0), (0.35, -0.63, 0.0)):
        turn = vtkTransform()
        turn.Translate(0.0, y, 0.0)
        turn.RotateX(-90.0)
        turned = vtkTransformPolyDataFilter()
        turned.SetTransform(turn)
        source = sphere(radius, (90, 60), opening)
        turned.SetInputConnection(source.GetOutputPort())
        turned.Update()
        both.AddInputData(turned.GetOutput())
    return both


def make_molecule():
    words = ATOMS.split()
    spheres = vtkAppendPolyData()
    for k in range(0, len(words), 4):
        atom = sphere(RADII[words[k]], (64, 40))
        atom.SetCenter(*map(float, words[k + 1 : k + 4]))
        spheres.AddInputConnection(atom.GetOutputPort())
    return spheres


def make_bunny(path="/usr/share/glmark2/models/bunny.obj"):
    if not os.path.isfile(path):
        sys.exit(f"{path}: there is no such file; the package glmark2-data has it")
    reader = vtkOBJReader()
    reader.SetFileName(path)
    clean = vtkCleanPolyData()  # points that triangles share
    clean.SetInputConnection(reader.GetOutputPort())
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(clean.GetOutputPort())
    normals.SplittingOff()
    return normals


def main():
    kinds = {"bowl": make_bowl, "molecule": make_molecule, "bunny": make_bunny}
    if len(sys.argv) < 3 or sys.argv[1] not in kinds:
        sys.exit(__doc__)
    mesh = kinds[sys.argv[1]](*sys.argv[3:])
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(sys.argv[2])
    writer.SetInputConnection(mesh.GetOutputPort())
    if not writer.Write():
        sys.exit(f"{sys.argv[2]}: cannot be written")


main()
