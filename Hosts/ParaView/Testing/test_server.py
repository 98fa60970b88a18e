# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A client of a parallel server: `test_server.py PORT`. The same picture by remote and by local rendering."""
import re
import sys

from paraview import simple

from common import connect, draw, get_difference, get_plan, look, make_view, show

connect(int(sys.argv[1]))
view = make_view()
look(view, direction=(0.3, 0.4, 0.87))
sphere = simple.Sphere(ThetaResolution=128, PhiResolution=128)
display = show(sphere, view)
pictures, plans = {}, {}
for name, threshold in (("remote", 0.0), ("local", 1e6)):
    view.RemoteRenderThreshold = threshold
    pictures[name] = draw(view, "server-" + name)
    plans[name] = get_plan(display)
    print(name, plans[name])
largest, mean = get_difference(pictures["remote"], pictures["local"])
print(f"remote and local: largest difference {largest}, mean {mean:.4f}")
# The server's plan while it draws, then the client's own: the same but for the time that each took.
assert "left out on several" in plans["remote"] and "left out" not in plans["local"], plans
method, own = (re.sub("set up in [0-9.]+ m?s|; occlusion .*", "", plans[name]) for name in ("remote", "local"))
assert method and method == own, plans
assert pictures["local"].std() > 10
assert largest <= 3 and mean < 0.1, (largest, mean)
display.MeasuredMaterial = "nickel"
view.RemoteRenderThreshold = 0.0
nickel = draw(view, "server-nickel")
assert get_plan(display) not in ("", plans["local"]), get_plan(display)
assert get_difference(nickel, pictures["local"])[0] > 20
# What the ranks' parts hide from each other, gathered on one of them; or by the client, which has the surface in one piece.
bowl = simple.Sphere(ThetaResolution=48, PhiResolution=32, EndPhi=115)
look(view, direction=(0.2, 0.3, -0.93))
simple.HideAll(view)
show(simple.AggregateDataset(Input=bowl), view, MeasuredMaterial="pink-felt", OcclusionMode="On")
traced = draw(view, "server-bowl-remote")
simple.HideAll(view)
show(bowl, view, MeasuredMaterial="pink-felt")
off = draw(view, "server-bowl-off")
view.RemoteRenderThreshold = 1e6
largest, mean = get_difference(traced, draw(view, "server-bowl-local"))
print(f"bowl, remote and local: largest difference {largest}, mean {mean:.4f}")
assert largest <= 12 and mean < 0.1, (largest, mean)
assert (off - traced)[130:170, 130:170].mean() > 20
simple.Disconnect()
print("passed")
