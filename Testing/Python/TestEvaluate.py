# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Values come through the wrapping: in C++'s arrays, as Python's lists."""

import math
import os
import subprocess
import sys
import tempfile

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

from vtkmeasuredbrdf import (
    vtkBRDF,
    vtkBRDFReader,
    vtkBTDF,
    vtkEmbeddedMaterials,
    vtkEnvironment,
    vtkHybridRadianceIntegrator,
    vtkLambertBRDF,
)

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
# A typo is said, with the names; kept off the terminal, where this test looks for errors.
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
# What a file says of transmission, which is no BRDF.
block = """<WavelengthData><Wavelength>Visible</Wavelength><WavelengthDataBlock><WavelengthDataDirection>{}
</WavelengthDataDirection><ScatteringData>{{{}}}</ScatteringData></WavelengthDataBlock></WavelengthData>"""
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "sheet.xml")
    with open(path, "w") as file:
        file.write("<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>TensorTree3"
                   "</IncidentDataStructure></DataDefinition>" + block.format("Reflection Back", 0.1) +
                   block.format("Transmission Front", 0.05) + "</Layer></Optical></WindowElement>")
    reader = vtkBRDFReader()
    reader.SetFileName(path)
    assert reader.Read(), reader.GetErrorMessage()
    transmission = reader.GetTransmission()
    assert isinstance(transmission, vtkBTDF) and not isinstance(transmission, vtkBRDF)
    transmission.Evaluate((0.6, 0.0, 0.8), (0.0, 0.6, -0.8), value)
    assert all(abs(v - 0.05) < 1e-7 for v in value), value
    transmission.GetTransmittance(normal, value)
    assert all(abs(v - 0.05 * math.pi) < 1e-6 for v in value), value
    assert isinstance(transmission.GetFolded(vtkBTDF.FRONT), vtkBRDF)
    assert transmission.GetFolded(vtkBTDF.BACK) is None
    # The examples take a file by its name, without an error of the built-in materials first.
    examples = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples", "Python")
    for name in ("evaluate_material.py", "measured_sphere.py"):
        output = ["-o", os.path.join(folder, "x.png")] if name == "measured_sphere.py" else []
        text = subprocess.run([sys.executable, "-B", os.path.join(examples, name), path, *output], check=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
        assert "embedded material" not in text, text
    reader.SetFileName(path + "#nothing")
    assert not reader.Read() and reader.GetTransmission() is transmission
print(", ".join(names))

# Who aborts an integrator made of layers hears of it once, from the whole: a layer prints nothing.
sky = vtkEnvironment()
sky.SetToProceduralSky()
printed = said.GetOutput()
for maps in (0, 4):
    for first in (1, 3):
        integrator = vtkHybridRadianceIntegrator()
        integrator.SetNumberOfMaps(maps)
        integrator.SetBRDF(vtkEmbeddedMaterials.NewBRDF("gold-paint"))
        integrator.SetEnvironment(sky)
        steps, errors = [], []

        def stop(source, _event):
            steps.append(None)
            source.SetAbort(len(steps) >= first)

        integrator.AddObserver("ProgressEvent", stop)
        integrator.AddObserver("ErrorEvent", lambda *_: errors.append(None))
        assert not integrator.Prepare(), maps
        assert len(errors) == 1, (maps, errors)
assert said.GetOutput() == printed, said.GetOutput()[len(printed):]
