# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The scene that all hosts of the module draw, to be compared between them. Saved under the name in
MEASUREDBRDF_PARAVIEW_PICTURE, by pvbatch or in ParaView's window."""
import os

from paraview import simple

from common import draw, get_plan, load_plugin, look, make_sphere, make_view, show

load_plugin()
view = make_view()
if simple.GetLayout(view) is None:
    simple.AssignViewToLayout(view)
view.RemoteRenderThreshold = 0
look(view, distance=2.4)
sphere = make_sphere(Radius=0.5)
display = show(
    sphere,
    view,
    MeasuredMaterial="gold-paint",
    MeasuredEnvironment="room",
    UseViewLights=0,
    ErrorTolerance=0.02,
    PlanInBackground=0,
)
simple.SetActiveView(view)
simple.SetActiveSource(sphere)
simple.Render(view)
picture = draw(view, os.environ["MEASUREDBRDF_PARAVIEW_PICTURE"])
assert picture.std() > 10, picture.std()
print(simple.GetParaViewVersion(), get_plan(display), flush=True)
