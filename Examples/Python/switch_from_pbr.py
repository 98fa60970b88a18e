#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""From VTK's physically based rendering to a measured material: the mapper is all that changes.

Left: VTK's PBR under the renderer's environment texture. Right: the same scene, measured.
"""

import argparse
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTexture,
    vtkWindowToImageFilter,
)

from vtkmeasuredbrdf import (
    vtkEmbeddedMaterials,
    vtkEnvironment,
    vtkEnvironmentReader,
    vtkMeasuredBRDFMapper,
)

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("material", nargs="?", default="gold-paint",
                    help="a built-in material's name (default: %(default)s)")
parser.add_argument("--environment", help="a lat-long HDR image (default: a built-in sky)")
parser.add_argument("-o", "--output", default="switch_from_pbr.png", help="default: %(default)s")
options = parser.parse_args()

brdf = vtkEmbeddedMaterials.NewBRDF(options.material)
if not brdf:
    sys.exit(f"no built-in material {options.material}")

# The environment as VTK knows it: a texture. This reader takes any format; vtkHDRReader would do.
environment = vtkEnvironment()
environment.SetToProceduralSky()
if options.environment:
    environment_reader = vtkEnvironmentReader()
    environment_reader.SetFileName(options.environment)
    if not environment_reader.Read():
        sys.exit(1)
    environment = environment_reader.GetEnvironment()
image = environment.NewImageData()
texture = vtkTexture()
texture.SetInputData(image)
texture.SetColorModeToDirectScalars()
texture.InterpolateOn()
texture.MipmapOn()

sphere = vtkSphereSource()
sphere.SetThetaResolution(128)
sphere.SetPhiResolution(64)

pbr_mapper = vtkPolyDataMapper()
pbr_mapper.SetInputConnection(sphere.GetOutputPort())

measured_mapper = vtkMeasuredBRDFMapper()  # was: vtkPolyDataMapper
measured_mapper.SetInputConnection(sphere.GetOutputPort())
measured_mapper.SetBRDF(brdf)  # new

window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(800, 400)
for left, mapper in ((0.0, pbr_mapper), (0.5, measured_mapper)):
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToPBR()
    actor.GetProperty().SetColor(0.8, 0.6, 0.2)
    actor.GetProperty().SetMetallic(1.0)
    actor.GetProperty().SetRoughness(0.35)
    renderer = vtkRenderer()
    renderer.SetViewport(left, 0.0, left + 0.5, 1.0)
    renderer.AutomaticLightCreationOff()
    renderer.UseImageBasedLightingOn()
    renderer.SetEnvironmentTexture(texture)
    renderer.AddActor(actor)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Zoom(1.5)
    window.AddRenderer(renderer)
window.Render()

grab = vtkWindowToImageFilter()
grab.SetInput(window)
grab.ReadFrontBufferOff()
writer = vtkPNGWriter()
writer.SetInputConnection(grab.GetOutputPort())
writer.SetFileName(options.output)
writer.Write()
print(f"wrote {options.output}")
