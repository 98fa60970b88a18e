#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Simulated photographs of a flat sample -> materials and weights, drawn beside the original.

Nothing here was photographed: the photographs are computed from known materials, with noise.
"""

import argparse

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401 (text)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter

from vtkmeasuredbrdf import (
    vtkEmbeddedEnvironments,
    vtkEmbeddedMaterials,
    vtkMaterialMap,
    vtkMaterialMapFitter,
    vtkMeasuredBRDFMapper,
    vtkPhotographSet,
)

MATERIALS = ("nickel", "red-fabric2", "blue-metallic-paint")


def make_sample(size):
    """A sheet of metal, partly painted, with rust at the edges of the paint."""
    y, x = np.mgrid[0:size, 0:size] / (size - 1.0)
    field = np.sin(7.0 * x + 2.0 * np.sin(6.0 * y)) + np.cos(5.0 * y - 3.0 * x * y) + 0.25 * np.sin(31.0 * x) * np.sin(27.0 * y)
    paint = np.clip(2.5 * field + 0.5, 0.0, 1.0)
    rust = np.clip(1.3 - np.abs(2.5 * field - 1.2), 0.0, 1.0)
    weights = np.dstack([np.clip(1.0 - paint - rust, 0.0, 1.0), rust, paint * (1.0 - 0.5 * rust)])
    weights /= weights.sum(axis=2, keepdims=True)
    image = vtkImageData()
    image.SetDimensions(size, size, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(weights.reshape(-1, 3).astype(np.float32), deep=True))
    sample = vtkMaterialMap()
    sample.SetModeToTextures()
    sample.AddWeightImage(image)
    for name in MATERIALS:
        sample.AddMaterial(vtkEmbeddedMaterials.NewBRDF(name), name)
    return sample


def radical_inverse(index, base):
    """Low-discrepancy numbers (van der Corput)."""
    result, digit = 0.0, 1.0 / base
    while index:
        result, index, digit = result + index % base * digit, index // base, digit / base
    return result


def directions(count):
    """Light and view by half and difference angles, dense about the mirror direction, none beyond 80 degrees."""
    index = 0
    while count:
        index += 1
        h = 0.5 * np.pi * radical_inverse(index, 2) ** 2
        d, p, turn = np.array([0.5, 2.0, 2.0]) * np.pi * [radical_inverse(index, base) for base in (3, 5, 7)]
        half = np.array([np.sin(h), 0.0, np.cos(h)])
        light = np.array([np.cos(h) * np.sin(d) * np.cos(p) + np.sin(h) * np.cos(d), np.sin(d) * np.sin(p),
                          np.cos(h) * np.cos(d) - np.sin(h) * np.sin(d) * np.cos(p)])
        view = 2.0 * half.dot(light) * half - light
        if min(light[2], view[2]) > 0.1736:
            c, s = np.cos(turn), np.sin(turn)
            rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])  # lights come from all sides
            count -= 1
            yield rotation @ light, rotation @ view


def photograph(sample, count):
    """Photographs with noise of 0.5 % of full scale, each exposed for its brightest material."""
    random = np.random.default_rng(1)
    weights = vtk_to_numpy(sample.GetWeightImage(0).GetPointData().GetScalars())
    photographs = vtkPhotographSet()
    for light, view in directions(count):
        values = np.zeros((len(MATERIALS), 3))
        for k, value in enumerate(values):
            sample.GetBRDF(k).Evaluate(light, view, value)
        exposure = 0.9 / (photographs.GetIrradiance() * light[2] * values.max())
        pixels = exposure * photographs.GetIrradiance() * light[2] * weights @ values
        pixels += random.normal(scale=0.005, size=pixels.shape)
        picture = vtkImageData()
        picture.SetDimensions(sample.GetWeightImage(0).GetDimensions())
        picture.GetPointData().SetScalars(numpy_to_vtk(pixels.astype(np.float32), deep=True))
        photographs.AddPhotograph(picture, light, view, exposure)
    return photographs


def find(photographs, tables):
    """A map from the photographs: of built-in materials, or of tables that are found, too."""
    fitter = vtkMaterialMapFitter()
    fitter.SetPhotographs(photographs)
    fitter.SetMaximumNumberOfMaterials(3 if tables else 6)
    if tables:
        fitter.SetMethodToTables()
    else:
        for k in range(vtkEmbeddedMaterials.GetNumberOfMaterials()):
            name = vtkEmbeddedMaterials.GetName(k)
            fitter.AddMaterial(vtkEmbeddedMaterials.NewBRDF(name), name)
    if not fitter.Fit():
        raise SystemExit("the fit failed")
    found = fitter.GetOutput()
    print("found", [found.GetName(k) for k in range(found.GetNumberOfMaterials())],
          f"errors: mean {fitter.GetMeanError():.4f}, 95 % {fitter.GetError95():.4f}, worst {fitter.GetWorstError():.4f}")
    for k in range(fitter.GetNumberOfFindings()):
        print("note:", fitter.GetFinding(k))
    return fitter


def draw(material_map, title, size):
    """The picture of a sheet, slightly bent towards the viewer, and its pixels in linear light."""
    plane = vtkPlaneSource()
    plane.SetResolution(60, 60)
    plane.Update()
    sheet = plane.GetOutput()
    x, y, _ = vtk_to_numpy(sheet.GetPoints().GetData()).astype(float).T
    normals = np.stack([0.9 * x, 0.9 * y, np.ones_like(x)], axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    sheet.GetPointData().SetNormals(numpy_to_vtk(normals.astype(np.float32), deep=True))
    mapper = vtkMeasuredBRDFMapper()
    mapper.SetInputData(sheet)
    mapper.SetMaterialMap(material_map)
    mapper.SetErrorTolerance(options.tolerance)
    mapper.SetEnvironment(vtkEmbeddedEnvironments.NewEnvironment("room"))
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    renderer.SetBackground(0.16, 0.17, 0.2)
    renderer.GetActiveCamera().SetPosition(0.0, -0.6, 1.9)
    renderer.GetActiveCamera().SetViewUp(0.0, 1.0, 0.0)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Zoom(1.5)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(size, size)
    window.AddRenderer(renderer)
    pixels = grab(window)
    label = vtkTextActor()
    label.SetInput(title)
    label.GetTextProperty().SetFontSize(max(size // 20, 8))
    label.SetPosition(8, 6)
    renderer.AddActor2D(label)
    labelled = grab(window)
    linear = (vtk_to_numpy(pixels.GetPointData().GetScalars()).astype(float) / 255.0) ** 2.2
    return labelled, linear


def grab(window):
    """The window's pixels."""
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    image = vtkImageData()
    image.DeepCopy(picture.GetOutput())
    return image


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("-o", "--output", default="photographs-to-map.png", help="the picture")
parser.add_argument("--photographs", type=int, default=200, help="how many (default 200)")
parser.add_argument("--texels", type=int, default=96, help="along an edge of the sample (default 96)")
parser.add_argument("--size", type=int, default=360, help="of each picture in pixels (default 360)")
parser.add_argument("--tolerance", type=float, default=0.02, help="of the mappers' plans (default 0.02)")
options = parser.parse_args()

original = make_sample(options.texels)
taken = photograph(original, options.photographs)
reference, reference_pixels = draw(original, "the sample", options.size)
pictures = [reference]
for tables, title in ((False, "found: built-in materials"), (True, "found: new materials")):
    picture, pixels = draw(find(taken, tables).GetOutput(), title, options.size)
    error = np.abs(pixels - reference_pixels).sum() / reference_pixels.sum()
    print(f"{title}: relative L1 of the picture {error:.4f}")
    pictures.append(picture)
parts = [vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(options.size, options.size, 3) for picture in pictures]
row = np.ascontiguousarray(np.concatenate(parts, axis=1))
image = vtkImageData()
image.SetDimensions(row.shape[1], row.shape[0], 1)
image.GetPointData().SetScalars(numpy_to_vtk(row.reshape(-1, 3), deep=True))
writer = vtkPNGWriter()
writer.SetInputData(image)
writer.SetFileName(options.output)
writer.Write()
print(f"wrote {options.output}")
