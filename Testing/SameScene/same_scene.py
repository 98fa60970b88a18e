# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The scene of same_scene.cxx in Python: same_scene.py vtk|pyvista PICTURE.png"""

import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter


def new_sphere():
    sphere = vtkSphereSource()
    sphere.SetRadius(0.5)
    sphere.SetThetaResolution(64)
    sphere.SetPhiResolution(64)
    return sphere


def draw_with_vtk(path):
    from vtkmeasuredbrdf import vtkEmbeddedEnvironments, vtkEmbeddedMaterials, vtkMeasuredBRDFMapper

    sphere = new_sphere()
    mapper = vtkMeasuredBRDFMapper()
    mapper.SetInputConnection(sphere.GetOutputPort())
    mapper.SetBRDF(vtkEmbeddedMaterials.NewBRDF("gold-paint"))
    mapper.SetEnvironment(vtkEmbeddedEnvironments.NewEnvironment("room"))
    mapper.SetErrorTolerance(0.02)
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    renderer.SetBackground(0.2, 0.2, 0.2)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.0, 0.0, 2.4)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetViewUp(0.0, 1.0, 0.0)
    camera.SetViewAngle(30.0)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(300, 300)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.ShouldRerenderOff()  # it would change the last digit of the view angle
    writer = vtkPNGWriter()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()
    return mapper.GetPlan()


def draw_with_pyvista(path):
    import pyvista as pv

    import vtkmeasuredbrdf.pyvista  # noqa: F401 (plotter.measured)

    pv.global_theme.multi_samples = 0
    plotter = pv.Plotter(off_screen=True, window_size=(300, 300))
    actor = plotter.measured.add_mesh(new_sphere(), "gold-paint", tolerance=0.02)
    plotter.measured.set_environment("room", up=(0.0, 1.0, 0.0))
    plotter.set_background((0.2, 0.2, 0.2))
    plotter.camera_position = [(0.0, 0.0, 2.4), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
    plotter.camera.view_angle = 30.0
    plotter.screenshot(path)
    return actor.mapper.plan


if __name__ == "__main__":
    print({"vtk": draw_with_vtk, "pyvista": draw_with_pyvista}[sys.argv[1]](sys.argv[2]))
