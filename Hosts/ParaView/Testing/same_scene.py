# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The scene of Testing/SameScene, with ParaView's and the plugin's own defaults, to be compared with other hosts. Saved under
the name in MEASUREDBRDF_PARAVIEW_PICTURE, by pvbatch or in ParaView's window. `same_scene.py Off`: without self-occlusion, and
distributed over the ranks."""
import os
import sys

from paraview import simple

from common import OUTPUT, draw, get_plan, load_plugin, make_view, show
from scene_files import ANGLE, ENVIRONMENT, MATERIAL, MESH, get_camera_position, write_scene

folder = os.path.join(OUTPUT, "same-scene")
write_scene(folder)
load_plugin()
view = make_view()
if simple.GetLayout(view) is None:
    simple.AssignViewToLayout(view)
view.Background = [0.0, 0.0, 0.0]
view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = get_camera_position()
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = ANGLE
balls = simple.OpenDataFile(os.path.join(folder, MESH))
properties = {}
if sys.argv[1:]:
    properties["OcclusionMode"] = sys.argv[1]
    view.RemoteRenderThreshold = 0
    balls = simple.RedistributeDataSet(balls)
display = show(
    balls,
    view,
    MeasuredMaterial="File",
    MeasuredMaterialFile=os.path.join(folder, MATERIAL),
    MeasuredEnvironment="File",
    MeasuredEnvironmentFile=os.path.join(folder, ENVIRONMENT),
    **properties,
)
simple.SetActiveView(view)
simple.SetActiveSource(balls)
simple.Render(view)
picture = draw(view, os.environ["MEASUREDBRDF_PARAVIEW_PICTURE"])
assert picture.std() > 10, picture.std()
print(simple.GetParaViewVersion(), get_plan(display), flush=True)
