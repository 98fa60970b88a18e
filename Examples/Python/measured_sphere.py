#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A sphere of a measured material under an environment, drawn offscreen into a PNG."""

import argparse
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)

from vtkmeasuredbrdf import (
    vtkBRDFReader,
    vtkEmbeddedMaterials,
    vtkEnvironment,
    vtkEnvironmentReader,
    vtkMeasuredBRDFMapper,
)

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("material", nargs="?", default="gold-paint",
                    help="a built-in material's name or a BRDF file (default: %(default)s)")
parser.add_argument("--environment", help="a lat-long HDR image (default: a built-in sky)")
parser.add_argument("--tolerance", type=float, default=0.02,
                    help="relative error to stay below (default: %(default)s)")
parser.add_argument("-o", "--output", default="measured_sphere.png", help="default: %(default)s")
options = parser.parse_args()

if set(options.material) & set("./#"):  # no built-in name has these
    reader = vtkBRDFReader()
    reader.SetFileName(options.material)
    reader.Read()
    brdf = reader.GetBRDF()
else:
    brdf = vtkEmbeddedMaterials.NewBRDF(options.material)
if not brdf:
    sys.exit(1)  # they have said why

environment = vtkEnvironment()
environment.SetToProceduralSky()
if options.environment:
    environment_reader = vtkEnvironmentReader()
    environment_reader.SetFileName(options.environment)
    if not environment_reader.Read():
        sys.exit(1)
    environment = environment_reader.GetEnvironment()

sphere = vtkSphereSource()
sphere.SetThetaResolution(128)
sphere.SetPhiResolution(64)

mapper = vtkMeasuredBRDFMapper()
mapper.SetInputConnection(sphere.GetOutputPort())
mapper.SetBRDF(brdf)
mapper.SetEnvironment(environment)
mapper.SetErrorTolerance(options.tolerance)

actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
renderer.ResetCamera()
renderer.GetActiveCamera().Zoom(1.5)
window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(400, 400)
window.AddRenderer(renderer)
window.Render()

grab = vtkWindowToImageFilter()
grab.SetInput(window)
grab.ReadFrontBufferOff()
writer = vtkPNGWriter()
writer.SetInputConnection(grab.GetOutputPort())
writer.SetFileName(options.output)
writer.Write()
print(f"{options.material}: {mapper.GetPlan()}\nwrote {options.output}")
