# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A client of a parallel server: `test_server.py PORT`. The same picture by remote and by local rendering."""
import sys

from paraview import simple

from common import connect, draw, get_difference, get_plan, look, make_view, show

connect(int(sys.argv[1]))
view = make_view()
look(view, direction=(0.3, 0.4, 0.87))
sphere = simple.Sphere(ThetaResolution=128, PhiResolution=128)
display = show(sphere, view)
pictures = {}
for name, threshold in (("remote", 0.0), ("local", 1e6)):
    view.RemoteRenderThreshold = threshold
    pictures[name] = draw(view, "server-" + name)
    print(name, get_plan(display))
largest, mean = get_difference(pictures["remote"], pictures["local"])
print(f"remote and local: largest difference {largest}, mean {mean:.4f}")
assert pictures["local"].std() > 10
assert largest <= 3 and mean < 0.1, (largest, mean)
display.MeasuredMaterial = "nickel"
nickel = draw(view, "server-nickel")
assert get_difference(nickel, pictures["local"])[0] > 20
simple.Disconnect()
print("passed")
