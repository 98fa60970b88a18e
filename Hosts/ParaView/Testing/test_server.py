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
method, own = (re.sub("set up in [0-9.]+ m?s", "", plans[name]) for name in ("remote", "local"))
assert method and method == own, plans
assert pictures["local"].std() > 10
assert largest <= 3 and mean < 0.1, (largest, mean)
display.MeasuredMaterial = "nickel"
view.RemoteRenderThreshold = 0.0
nickel = draw(view, "server-nickel")
assert get_plan(display) not in ("", plans["local"]), get_plan(display)
assert get_difference(nickel, pictures["local"])[0] > 20
simple.Disconnect()
print("passed")
