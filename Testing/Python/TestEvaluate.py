# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Values come through the wrapping: in C++'s arrays, as Python's lists."""

import math

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

from vtkmeasuredbrdf import vtkBRDF, vtkEmbeddedMaterials, vtkEnvironment, vtkLambertBRDF

normal = (0.0, 0.0, 1.0)
value = [0.0, 0.0, 0.0]

lambert = vtkLambertBRDF()
lambert.SetAlbedo(0.9, 0.5, 0.1)
lambert.Evaluate((0.6, 0.0, 0.8), normal, value)
for v, albedo in zip(value, (0.9, 0.5, 0.1)):
    assert abs(v - albedo / math.pi) < 1e-12, value
lambert.Evaluate((0.6, 0.0, -0.8), normal, value)
assert value == [0.0, 0.0, 0.0], value

assert vtkEmbeddedMaterials.GetNumberOfMaterials() >= 7
names = [vtkEmbeddedMaterials.GetName(k) for k in range(vtkEmbeddedMaterials.GetNumberOfMaterials())]
for name in names:
    brdf = vtkEmbeddedMaterials.NewBRDF(name)
    assert isinstance(brdf, vtkBRDF), name
    brdf.Evaluate((0.6, 0.0, 0.8), (-0.6, 0.0, 0.8), value)
    assert min(value) >= 0.0 and max(value) > 0.0, (name, value)
    assert all(map(math.isfinite, value)), (name, value)
# A typo is said, with the nearest names; kept off the terminal, where this test looks for errors.
vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
said = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(said)
assert vtkEmbeddedMaterials.NewBRDF("gold_paint") is None
assert "'gold-paint'" in said.GetOutput(), said.GetOutput()
lambert.SetAlbedo(math.nan, 0.0, 0.0)
assert "SetAlbedo: found nan" in said.GetOutput(), said.GetOutput()
assert lambert.GetAlbedo() == (0.9, 0.5, 0.1), lambert.GetAlbedo()

environment = vtkEnvironment()
environment.SetToProceduralSky()
total = [0.0, 0.0, 0.0]
environment.GetTotal(total)
assert min(total) > 0.0, total
print(", ".join(names))
