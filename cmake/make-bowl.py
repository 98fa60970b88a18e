#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a mesh whose hollow sends light back to itself: a bowl with a ball in it.

usage: make-bowl.py OUTPUT.vtp
"""

import sys

from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


def sphere(radius, y, opening):
    """A sphere about (0, y, 0), open from the top down to that angle in degrees."""
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(90)
    source.SetPhiResolution(60)
    source.SetStartPhi(opening)
    turn = vtkTransform()
    turn.Translate(0.0, y, 0.0)
    turn.RotateX(-90.0)
    turned = vtkTransformPolyDataFilter()
    turned.SetTransform(turn)
    turned.SetInputConnection(source.GetOutputPort())
    turned.Update()
    return turned.GetOutput()


def main():
    both = vtkAppendPolyData()
    both.AddInputData(sphere(1.0, 0.0, 75.0))
    both.AddInputData(sphere(0.35, -0.63, 0.0))
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(sys.argv[1])
    writer.SetInputConnection(both.GetOutputPort())
    writer.Write()


main()
