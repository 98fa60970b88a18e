#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Three surfaces of several measured materials: strata of a rock, wet hills, rust on a metal."""

import argparse
import os

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401 (text)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import (
    vtkParametricRandomHills,
    vtkParametricSuperEllipsoid,
    vtkParametricTorus,
)
from vtkmodules.vtkCommonDataModel import vtkPerlinNoise
from vtkmodules.vtkFiltersCore import vtkCellCenters
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource
from vtkmodules.vtkImagingHybrid import vtkSampleFunction
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

from vtkmeasuredbrdf import (
    vtkEmbeddedEnvironments,
    vtkEmbeddedMaterials,
    vtkMaterialLegendActor,
    vtkMaterialMap,
    vtkMeasuredBRDFMapper,
)

material = vtkEmbeddedMaterials.NewBRDF


def with_array(surface, name, values, cells=False):
    """The surface with another array."""
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    (surface.GetCellData() if cells else surface.GetPointData()).AddArray(array)
    return surface


def points_of(dataset):
    """The coordinates of a data set's points."""
    return vtk_to_numpy(dataset.GetPoints().GetData()).astype(float)


def classes():
    """A class per cell: strata of a rock, exact up to the cells' borders."""
    rock = vtkParametricSuperEllipsoid()
    rock.SetN1(0.8)
    rock.SetN2(0.85)
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(rock)
    source.SetUResolution(400)
    source.SetVResolution(400)
    source.SetScalarModeToNone()
    source.Update()
    surface = source.GetOutput()

    centers = vtkCellCenters()
    centers.SetInputData(surface)
    centers.Update()
    x, y, z = points_of(centers.GetOutput()).T
    depth = z + 0.3 * x + 0.08 * np.sin(5.0 * x + 2.0 * z) + 0.05 * np.sin(9.0 * y)
    surface = with_array(surface, "stratum", np.digitize(depth, (-0.8, -0.5, -0.4, 0.1, 0.45, 0.85)), cells=True)

    strata = vtkMaterialMap()
    strata.SetArrayName("stratum")
    for number, name in enumerate(("white-marble", "hematite", "gold-paint", "delrin", "blue-rubber", "alum-bronze",
                                   "pink-felt")):
        strata.AddMaterial(material(name), number, name)
    return surface, strata, "strata"


def values():
    """A scalar between two materials: how wet the hills are."""
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(vtkParametricRandomHills())
    for resolution in (source.SetUResolution, source.SetVResolution):
        resolution(200)
    source.SetScalarModeToNone()
    source.Update()
    surface = source.GetOutput()
    height = points_of(surface)[:, 2]
    surface = with_array(surface, "wetness", 1.0 - (height - height.min()) / np.ptp(height))

    wetness = vtkMaterialMap()
    wetness.SetModeToValues()
    wetness.SetArrayName("wetness")
    wetness.AddMaterial(material("yellow-matte-plastic"), 0.4, "dry")
    wetness.AddMaterial(material("blue-car-paint"), 0.9, "wet")
    return surface, wetness, "wetness"


def images():
    """Weights in an image over the texture coordinates: rust on a metal."""
    torus = vtkParametricTorus()
    torus.SetRingRadius(1.0)
    torus.SetCrossSectionRadius(0.45)
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(torus)
    source.GenerateTextureCoordinatesOn()
    for resolution in (source.SetUResolution, source.SetVResolution):
        resolution(150)
    source.SetScalarModeToNone()
    source.Update()

    size = 256
    noise = vtkPerlinNoise()
    noise.SetFrequency(16.0, 9.0, 1.0)
    sample = vtkSampleFunction()
    sample.SetImplicitFunction(noise)
    sample.SetModelBounds(0.0, 1.0, 0.0, 1.0, 0.0, 0.0)
    sample.SetSampleDimensions(size, size, 1)
    sample.ComputeNormalsOff()
    sample.Update()
    image = sample.GetOutput()
    rust = np.clip(0.5 + 5.0 * vtk_to_numpy(image.GetPointData().GetScalars()), 0.0, 1.0)
    weights = numpy_to_vtk(np.stack((1.0 - rust, rust), axis=1).astype(np.float32), deep=True)
    image.GetPointData().SetScalars(weights)

    surface = vtkMaterialMap()
    surface.SetModeToTextures()
    surface.AddWeightImage(image)
    surface.AddMaterial(material("nickel"), "metal")
    surface.AddMaterial(material("red-fabric2"), "rust")
    return source.GetOutput(), surface, "surface"


def draw(surface, material_map, title, path, camera, tolerance):
    """A picture with a legend."""
    mapper = vtkMeasuredBRDFMapper()
    mapper.SetErrorTolerance(tolerance)
    mapper.SetInputData(surface)
    mapper.SetMaterialMap(material_map)
    mapper.SetEnvironment(vtkEmbeddedEnvironments.NewEnvironment("room"))
    actor = vtkActor()
    actor.SetMapper(mapper)
    legend = vtkMaterialLegendActor()
    legend.SetMaterialMap(material_map)
    legend.SetTitle(title)
    legend.SetPosition(0.72, 0.1 if material_map.GetNumberOfMaterials() > 2 else 0.55)
    legend.SetPosition2(0.26, 0.8 if material_map.GetNumberOfMaterials() > 2 else 0.35)
    renderer = vtkRenderer()
    renderer.SetBackground(0.16, 0.17, 0.2)
    renderer.AddActor(actor)
    renderer.AddActor2D(legend)
    renderer.GetActiveCamera().SetPosition(*camera)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Zoom(1.1)
    renderer.GetActiveCamera().SetWindowCenter(0.25, 0.0)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(480, 400)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()
    print(f"wrote {path}\n{mapper.GetPlan()}\n")


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("-o", "--output", default=".", help="a folder for the pictures (default: this one)")
parser.add_argument("--tolerance", type=float, default=0.02, help="relative error of the reflected light (default: %(default)s)")
options = parser.parse_args()
os.makedirs(options.output, exist_ok=True)
for made, camera in ((classes, (1.5, -4.0, 1.2)), (values, (0.0, -4.0, 3.0)), (images, (0.5, -3.0, 3.0))):
    draw(*made(), os.path.join(options.output, f"map-{made.__name__}.png"), camera, options.tolerance)
