# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A display of two tiles, each drawn by a rank of a server: `test_tiles.py PORT`. Together they are one process's picture."""
import os
import sys

import numpy as np
from paraview import simple

from common import OUTPUT, connect, draw, get_difference, load_plugin, look, make_view, read, show


def make_scene(width, height):
    view = make_view()
    view.ViewSize = [width, height]
    view.RemoteRenderThreshold = 0
    look(view, direction=(0.3, 0.4, 0.87))
    show(simple.Sphere(ThetaResolution=128, PhiResolution=128), view)
    return view


def draw_tiles():
    """The tiles beside each other."""
    connect(int(sys.argv[1]))
    view = make_scene(800, 400)  # the windows have their own size
    simple.AssignViewToLayout(view)
    layout = simple.GetLayout(view)
    layout.SMProxy.ShowViewsOnTileDisplay()
    simple.Render(view)
    tiles = []
    for rank in range(2):
        path = os.path.join(OUTPUT, f"tile-{rank}.png")
        layout.SMProxy.SaveAsPNG(rank, path)
        tiles.append(read(path))
    simple.Disconnect()
    return np.concatenate(tiles, axis=1)


together = draw_tiles()
height, width, _ = together.shape
simple.Connect()
load_plugin()
one = draw(make_scene(width, height), "tiles-one", (width, height))
largest, mean = get_difference(together, one)
print(f"two tiles of {width // 2} x {height} pixels and one process: largest difference {largest}, mean {mean:.4f}")
assert one[:, : width // 2].std() > 10 and one[:, width // 2 :].std() > 10
assert largest <= 1, largest
print("passed")
