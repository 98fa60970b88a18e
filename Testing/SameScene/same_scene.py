# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The scene of same_scene.cxx in Python: same_scene.py vtk|pyvista MESH MATERIAL ENVIRONMENT PICTURE.png"""

import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from scene_files import ANGLE, SIZE, get_camera_position
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter


def draw_with_vtk(mesh, material, environment, path):
    from vtkmeasuredbrdf import vtkBRDFReader, vtkEnvironmentReader, vtkMeasuredBRDFMapper

    surface = vtkXMLPolyDataReader()
    surface.SetFileName(mesh)
    brdf = vtkBRDFReader()
    brdf.SetFileName(material)
    brdf.Read()
    light = vtkEnvironmentReader()
    light.SetFileName(environment)
    light.Read()
    mapper = vtkMeasuredBRDFMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetBRDF(brdf.GetBRDF())
    mapper.SetEnvironment(light.GetEnvironment())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(get_camera_position())
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetViewUp(0.0, 1.0, 0.0)
    camera.SetViewAngle(ANGLE)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(SIZE, SIZE)
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


def draw_with_pyvista(mesh, material, environment, path):
    import pyvista as pv

    import vtkmeasuredbrdf.pyvista  # noqa: F401 (plotter.measured)

    pv.global_theme.multi_samples = 0
    plotter = pv.Plotter(off_screen=True, window_size=(SIZE, SIZE))
    actor = plotter.measured.add_mesh(pv.read(mesh), material)
    plotter.measured.set_environment(environment, up=(0.0, 1.0, 0.0))
    plotter.set_background("black")
    plotter.camera_position = [get_camera_position(), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
    plotter.camera.view_angle = ANGLE
    plotter.screenshot(path)
    return actor.mapper.plan


if __name__ == "__main__":
    print({"vtk": draw_with_vtk, "pyvista": draw_with_pyvista}[sys.argv[1]](*sys.argv[2:]))
