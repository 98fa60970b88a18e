# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pixels from Python: a Lambert square shows the radiance that theory says, and follows changes."""

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow

from vtkmeasuredbrdf import (
    vtkEnvironment,
    vtkLambertBRDF,
    vtkLightSetRadianceIntegrator,
    vtkMeasuredBRDFMapper,
    vtkMedianCutLightSetGenerator,
)

ALBEDO = (0.9, 0.5, 0.1)


def uniform_environment(radiance):
    image = vtkImageData()
    image.SetDimensions(64, 32, 1)
    image.AllocateScalars(VTK_FLOAT, 3)
    image.GetPointData().GetScalars().Fill(radiance)
    environment = vtkEnvironment()
    assert environment.SetImage(image)
    return environment


def center_pixel(window):
    window.Render()
    pixel = vtkUnsignedCharArray()
    window.GetPixelData(50, 50, 50, 50, 0, pixel, 0)
    return [pixel.GetValue(k) for k in range(3)]


def check(window, expected_radiance):
    shown = center_pixel(window)
    expected = [255.0 * min(r, 1.0) ** (1.0 / 2.2) for r in expected_radiance]
    # 1.5 for rounding and the 16-bit frame buffer, 1 % of radiance for the light set's cosines.
    for s, e in zip(shown, expected):
        assert abs(s - e) < 1.5 + 0.005 * e, (shown, expected)


brdf = vtkLambertBRDF()
brdf.SetAlbedo(ALBEDO)
plane = vtkPlaneSource()
mapper = vtkMeasuredBRDFMapper()
mapper.SetInputConnection(plane.GetOutputPort())
mapper.SetBRDF(brdf)
mapper.SetEnvironment(uniform_environment(1.0))
lights = vtkLightSetRadianceIntegrator()
lights.SetGenerator(vtkMedianCutLightSetGenerator())
lights.SetNumberOfLights(1024)
mapper.SetIntegrator(lights)
actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
renderer.AutomaticLightCreationOff()
window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetSize(100, 100)
window.AddRenderer(renderer)

# Under radiance L from everywhere, a Lambert surface shows albedo x L.
check(window, ALBEDO)
mapper.SetEnvironment(uniform_environment(0.5))
check(window, [0.5 * a for a in ALBEDO])
brdf.SetAlbedo(0.2, 0.2, 0.2)
check(window, (0.1, 0.1, 0.1))
