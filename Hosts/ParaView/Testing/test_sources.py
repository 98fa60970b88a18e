# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Materials as data: lobes, slices and images from the sources menu."""
import math

from paraview import servermanager, simple

from common import draw, load_plugin, look, make_view

load_plugin()
LOBE = simple.BRDFLobe(ThetaI=30.0, Normalize=1)
LOBE.UpdatePipeline()
information = LOBE.GetDataInformation().DataInformation
assert information.GetNumberOfPoints() == 1 + 128 * 128
assert abs(max(map(abs, information.GetBounds())) - 1) < 0.2, information.GetBounds()
view = make_view()
look(view, direction=(0, -1, 0.3), up=(0, 0, 1))
view.CameraFocalPoint = [0, 0, 0.5]
display = simple.Show(LOBE, view)
simple.ColorBy(display, ("POINTS", "Luminance"))
display.RescaleTransferFunctionToDataRange()
assert draw(view, "lobe").std() > 10

# A Lambert-like profile is flat, a metal's falls by orders of magnitude.
SLICE = simple.BRDFSlice(Material="nickel")
table = servermanager.Fetch(SLICE)
assert table.GetNumberOfRows() == 181
values = [table.GetValueByName(row, "luminance").ToDouble() for row in range(181)]
assert values[0] > 100 * values[60] > 0, (values[0], values[60])
assert all(math.isfinite(value) and value >= 0 for value in values)

IMAGE = simple.BRDFImage(Material="pink-felt", Resolution=64)
image = servermanager.Fetch(IMAGE)
assert image.GetDimensions() == (64, 64, 1)
red, green, blue = image.GetPointData().GetScalars().GetTuple(32 * 64 + 32)
assert red > blue > 0, (red, green, blue)
view = make_view()
display = simple.Show(IMAGE, view, "UniformGridRepresentation")
display.Representation = "Slice"
simple.ResetCamera(view)
assert draw(view, "image").std() > 5
print("passed")
