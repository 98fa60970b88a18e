# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be read is said once, and the surface is drawn as Surface draws it."""
import os

import numpy as np
from paraview.vtk import vtkStringOutputWindow
from vtkmodules.vtkCommonCore import vtkOutputWindow

from common import OUTPUT, draw, get_difference, load_plugin, look, make_sphere, make_view, show, write

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
display.BlockMaterials = []

# Weights of an image, or a material of weights, that cannot be read are not given to the others.
display.MaterialMapMode = "Images"
broken = os.path.join(OUTPUT, "broken.png")
with open(broken, "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n")
weights = os.path.join(OUTPUT, "white.png")
write(weights, np.full((8, 8, 3), 255))
for images, materials, words in (
    ([os.path.join(OUTPUT, "missing.png")], ["0", "nickel"], "missing.png: no such file"),
    ([broken], ["0", "nickel"], "broken.png"),
    ([weights], ["0", "nickel", "1", "missing.bsdf"], "missing.bsdf: no such file"),
    ([weights], ["0", "nickel", "one", "delrin"], 'Map Materials: found "one", expected a number'),
    ([weights], ["0", "nickel"], "no texture coordinates"),
):
    before = len(said.GetOutput())
    display.WeightImages = images
    display.MapMaterials = materials
    for _ in range(3):
        picture = draw(view, "errors-images")
    text = said.GetOutput()[before:]
    assert text.count(words) == 1, (words, text)
    assert get_difference(picture, gold)[0] <= 1, words
vtkOutputWindow.SetInstance(None)
print("passed")
