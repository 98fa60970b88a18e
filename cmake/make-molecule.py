#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a mesh that hides much of the sky from itself: caffeine as spheres of van der Waals radii.

usage: make-molecule.py OUTPUT.vtp

Positions in 1e-10 m are about those of the molecule, which is enough for a picture. Radii by Bondi (1964), of hydrogen 1.1.
"""

import sys

from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

RADII = {"C": 1.7, "N": 1.55, "O": 1.52, "H": 1.1}
ATOMS = """
O 0.4700 2.5688 0.0006    O -3.1271 -0.4436 -0.0003  N -0.9686 -1.3125 0.0000  N 2.2182 0.1412 -0.0003
N -1.3477 1.0797 -0.0001  N 1.4119 -1.9372 0.0002    C 0.8579 0.2592 -0.0008   C 0.3897 -1.0264 -0.0004
C 0.0307 1.4220 -0.0006   C -1.9061 -0.2495 -0.0004  C 2.5032 -1.1998 0.0003   C -1.4276 -2.6960 0.0008
C 3.1926 1.2061 0.0003    C -2.2969 2.1881 0.0007    H 3.5163 -1.5787 0.0008   H -1.0451 -3.1973 -0.8937
H -2.5186 -2.7596 0.0011  H -1.0447 -3.1963 0.8957   H 4.1992 0.7801 0.0002    H 3.0468 1.8092 -0.8992
H 3.0466 1.8083 0.9004    H -1.8087 3.1651 -0.0003   H -2.9322 2.1027 0.8881   H -2.9346 2.1021 -0.8849
"""


def main():
    words = ATOMS.split()
    spheres = vtkAppendPolyData()
    for k in range(0, len(words), 4):
        sphere = vtkSphereSource()
        sphere.SetCenter(*map(float, words[k + 1 : k + 4]))
        sphere.SetRadius(RADII[words[k]])
        sphere.SetThetaResolution(64)
        sphere.SetPhiResolution(40)
        spheres.AddInputConnection(sphere.GetOutputPort())
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(spheres.GetOutputPort())
    writer.SetFileName(sys.argv[1])
    writer.Write()


if __name__ == "__main__":
    main()
