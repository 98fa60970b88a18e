# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be read is said once, and the surface is drawn as Surface draws it."""
import os

from paraview.vtk import vtkStringOutputWindow
from vtkmodules.vtkCommonCore import vtkOutputWindow

from common import OUTPUT, draw, get_difference, load_plugin, look, make_sphere, make_view, show

load_plugin()
view = make_view()
look(view)
display = show(make_sphere(), view)
gold = draw(view, "errors-gold")
display.Representation = "Surface"
stock = draw(view, "errors-surface")
display.Representation = "Measured Material"

said = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(said)
truncated = os.path.join(OUTPUT, "truncated.bsdf")
with open(truncated, "wb") as file:
    file.write(b"tensor_file\0\1\0")
for path, words in ((os.path.join(OUTPUT, "missing.bsdf"), "no such file"), (truncated, "truncated.bsdf")):
    before = len(said.GetOutput())
    display.MeasuredMaterial = "File"
    display.MeasuredMaterialFile = path
    for _ in range(3):
        picture = draw(view, "errors-" + os.path.basename(path))
    text = said.GetOutput()[before:]
    assert text.count("ERR|") + text.count("ERROR:") == 1, text
    assert words in text, text
    assert get_difference(picture, stock)[0] <= 1
display.MeasuredMaterial = "gold-paint"
assert get_difference(draw(view, "errors-again"), gold)[0] <= 1

before = len(said.GetOutput())
display.ErrorTolerance = 0.0
for _ in range(3):
    picture = draw(view, "errors-tolerance")
text = said.GetOutput()[before:]
assert text.count("expected a number from 0.001 to 1") == 1, text
assert get_difference(picture, gold)[0] <= 1
display.ErrorTolerance = 0.02

before = len(said.GetOutput())
display.MeasuredEnvironment = "File"
display.MeasuredEnvironmentFile = os.path.join(OUTPUT, "missing.exr")
for _ in range(3):
    picture = draw(view, "errors-environment")
text = said.GetOutput()[before:]
assert text.count("ERR|") + text.count("ERROR:") == 1 and "missing.exr: no such file" in text, text
assert get_difference(picture, stock)[0] <= 1
display.MeasuredEnvironment = "Automatic"
assert get_difference(draw(view, "errors-again"), gold)[0] <= 1

before = len(said.GetOutput())
display.BlockMaterials = ["/Root/Nowhere", "nickel"]
for _ in range(3):
    picture = draw(view, "errors-block")
text = said.GetOutput()[before:]
assert text.count("no block is called /Root/Nowhere") == 1, text
assert get_difference(picture, gold)[0] <= 1
vtkOutputWindow.SetInstance(None)
print("passed")
