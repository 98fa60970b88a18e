# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests have in common: the plugin, one view, pictures as arrays."""
import os
import time

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

OUTPUT = os.environ["MEASUREDBRDF_PARAVIEW_OUTPUT"]
SIZE = 300


def load_plugin(remote=False):
    simple.LoadPlugin(os.environ["MEASUREDBRDF_PARAVIEW_PLUGIN"], remote=remote, ns=vars(simple))


def connect(port):
    """Becomes a client of the server that listens or will listen there, with the plugin on both sides."""
    for _ in range(60):
        try:
            simple.Connect("localhost", port)
            break
        except RuntimeError:
            time.sleep(0.5)
    load_plugin(remote=False)
    load_plugin(remote=True)


def make_view():
    """A view that shows the same on every machine."""
    simple._DisableFirstRenderCameraReset()
    view = simple.CreateRenderView()
    view.ViewSize = [SIZE, SIZE]
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    if hasattr(view, "UseColorPaletteForBackground"):
        view.UseColorPaletteForBackground = 0
    view.Background = [0.2, 0.2, 0.2]
    view.MultiSamples = 0
    view.UseFXAA = 0
    return view


def make_sphere(**properties):
    sphere = simple.Sphere(ThetaResolution=64, PhiResolution=64, **properties)
    simple.Hide(sphere)
    return sphere


def show(source, view, **properties):
    display = simple.Show(source, view)
    if display.ColorArrayName[1]:
        simple.ColorBy(display, None)
    display.Representation = "Measured Material"
    for name, value in properties.items():
        setattr(display, name, value)
    return display


def look(view, direction=(0, 0, 1), up=(0, 1, 0), distance=2.4):
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = [distance * d for d in direction]
    view.CameraViewUp = list(up)
    view.CameraViewAngle = 30


def draw(view, name, size=(SIZE, SIZE)):
    """The view's picture, (height, width, 3) bytes, row 0 at the bottom; also kept as NAME.png."""
    path = os.path.join(OUTPUT, name + ".png")
    simple.SaveScreenshot(path, view, ImageResolution=list(size))
    return read(path)


def read(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars())
    width, height, _ = image.GetDimensions()
    return pixels.reshape(height, width, -1)[:, :, :3].astype(int)


def write(path, pixels):
    """A PNG file of bytes (height, width, components), row 0 at the bottom."""
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    flat = np.ascontiguousarray(pixels, np.uint8).reshape(-1, pixels.shape[2])
    image.GetPointData().SetScalars(numpy_to_vtk(flat, deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def get_plan(display):
    display.UpdatePropertyInformation()
    return display.GetProperty("MeasuredPlan")[0]


def get_selectors(source):
    """Selectors of the blocks below the root."""
    source.UpdatePipeline()
    hierarchy = source.GetDataInformation().DataInformation.GetHierarchy()
    root = hierarchy.GetRootNode()
    return [hierarchy.GetNodePath(node) for node in hierarchy.GetChildNodes(root, False)]


def get_difference(a, b):
    """Largest and mean difference of two pictures, in levels of 255."""
    difference = np.abs(a - b)
    return int(difference.max()), float(difference.mean())
