#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Measures how far pictures of other drivers, and of small real changes, are from a baseline.

make-diff-table.py PAGE [FOLDER]: draws each scene once as the baseline and once per variation, compares the pictures by every
metric, and replaces the table in PAGE (docs/image-tests.md) between its two marks. FOLDER keeps the pictures. It needs the
package vtkmeasuredbrdf on PYTHONPATH and Mesa's software renderers.
"""

import json
import os
import subprocess
import sys
import tempfile

BEGIN, END = "<!-- made by cmake/make-diff-table.py -->", "<!-- end of the table -->"
METRICS = ("flip", "hdr_flip", "ssim", "delta_e_2000", "relative_l1", "max_difference")
SIZE = 400

SCENES = {
    "sphere, blue-car-paint, room": {"material": "blue-car-paint", "environment": "room", "shape": "sphere"},
    "torus, gold-paint, hall": {"material": "gold-paint", "environment": "hall", "shape": "torus"},
    "torus, glossy lobe, room": {"material": "lobe", "environment": "room", "shape": "torus"},
}
# What another driver may do. Environment variables are Mesa's.
DRIVERS = {
    "the same again": {},
    "llvmpipe, vectors of 128 bits": {"env": {"LP_NATIVE_VECTOR_WIDTH": "128"}},
    "llvmpipe, one thread": {"env": {"LP_NUM_THREADS": "0"}},
    "softpipe": {"env": {"GALLIUM_DRIVER": "softpipe"}},
    "a tenth of the values ±1 of 255": {"edit": "rounding"},
    "every value 0 or ±1 of 255": {"edit": "noise"},
    "4 multisamples for 0": {"multisamples": 4},
}
CHANGES = {
    "tolerance 10 % for 2 %": {"tolerance": 0.1},
    "environment turned by 1 degree": {"turn": 1.0},
    "exponent 10 % larger": {"exponent": 1.1, "only": "lobe"},
    "2 % more light": {"edit": "brighter"},
    "object tilted by 1 degree": {"tilt": 1.0, "only": "torus"},
    "moved by one pixel": {"edit": "shift"},
    "another material": {"material": "gold-metallic-paint3"},
}


def make_mapper(scene):
    from vtkmeasuredbrdf import (
        vtkAshikhminShirleyBRDF,
        vtkEmbeddedEnvironments,
        vtkEmbeddedMaterials,
        vtkMeasuredBRDFMapper,
    )

    mapper = vtkMeasuredBRDFMapper()
    if scene["material"] == "lobe":
        lobe = vtkAshikhminShirleyBRDF()
        lobe.SetDiffuse(0.2, 0.05, 0.05)
        lobe.SetReflectance(0.2, 0.2, 0.2)
        exponent = 100.0 * scene.get("exponent", 1.0)
        lobe.SetExponents(exponent, exponent)
        mapper.SetBRDF(lobe)
    else:
        mapper.SetBRDF(vtkEmbeddedMaterials.NewBRDF(scene["material"]))
    environment = vtkEmbeddedEnvironments.NewEnvironment(scene["environment"])
    environment.SetRotationY(scene.get("turn", 0.0))
    mapper.SetEnvironment(environment)
    mapper.SetErrorTolerance(scene.get("tolerance", 0.02))
    return mapper


def make_shape(scene):
    from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
    from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource, vtkSphereSource

    if scene["shape"] == "torus":
        shape = vtkParametricFunctionSource()
        shape.SetParametricFunction(vtkParametricTorus())
        shape.SetUResolution(120)
        shape.SetVResolution(60)
        return shape
    shape = vtkSphereSource()
    shape.SetThetaResolution(128)
    shape.SetPhiResolution(64)
    return shape


def draw(scene, path):
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

    mapper = make_mapper(scene)
    shape = make_shape(scene)  # a port does not keep its algorithm alive
    mapper.SetInputConnection(shape.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.RotateX(-40.0 + scene.get("tilt", 0.0))
    renderer = vtkRenderer()
    renderer.SetBackground(0.2, 0.2, 0.2)
    renderer.AutomaticLightCreationOff()
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.0, 0.0, 6.0 if scene["shape"] == "torus" else 2.2)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(scene.get("multisamples", 0))
    window.SetSize(SIZE, SIZE)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()
    lines = [line for line in window.ReportCapabilities().splitlines() if "renderer string" in line]
    print(lines[0].split(":", 1)[1].strip() if lines else "?")


def run_draw(scene, path):
    environment = {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", **scene.get("env", {})}
    command = [sys.executable, __file__, "--draw", json.dumps(scene), path]
    done = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    return done.stdout.strip()


def edit(kind, source, path):
    """Writes a changed copy of a picture."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

    reader = vtkPNGReader()
    reader.SetFileName(source)
    reader.Update()
    image = reader.GetOutput()
    values = vtk_to_numpy(image.GetPointData().GetScalars()).astype(float)
    if kind in ("noise", "rounding"):
        random = numpy.random.default_rng(1)
        share = 1.0 if kind == "noise" else 0.15  # two thirds of the steps are not 0
        values += random.integers(-1, 2, values.shape) * (random.random(values.shape) < share)
    elif kind == "brighter":  # the mapper encodes by the power 1/2.2
        values *= 1.02 ** (1.0 / 2.2)
    else:
        values = numpy.roll(values.reshape(SIZE, SIZE, 3), 1, axis=1).reshape(-1, 3)
    values = numpy.clip(numpy.rint(values), 0, 255).astype(numpy.uint8)
    image.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(path)
    writer.Write()


def compare_by_vtk(path, baseline):
    """The error of VTK's own tests by the method LEGACY_VALID."""
    from vtkmodules.vtkImagingCore import vtkImageDifference
    from vtkmodules.vtkIOImage import vtkPNGReader

    readers = vtkPNGReader(), vtkPNGReader()
    for reader, name in zip(readers, (path, baseline)):
        reader.SetFileName(name)
        reader.Update()
    difference = vtkImageDifference()
    difference.SetInputConnection(readers[0].GetOutputPort())
    difference.SetImageConnection(readers[1].GetOutputPort())
    difference.Update()
    return difference.GetThresholdedError()


def measure(folder):
    """{(kind, variation): {scene: figures}}, and the renderers' names."""
    from vtkmeasuredbrdf.testing import compare_images

    rows, renderers = {}, set()
    for number, (name, scene) in enumerate(SCENES.items()):
        baseline = os.path.join(folder, f"{number}.png")
        renderers.add(run_draw(scene, baseline))
        for kind, variations in (("driver", DRIVERS), ("change", CHANGES)):
            for index, (title, variation) in enumerate(variations.items()):
                if variation.get("only", scene["material"]) not in (scene["material"], scene["shape"]):
                    continue
                path = os.path.join(folder, f"{number}-{kind}-{index}.png")
                if "edit" in variation:
                    edit(variation["edit"], baseline, path)
                else:
                    renderers.add(run_draw({**scene, **variation}, path))
                figures = {metric: compare_images(path, baseline, metric).value for metric in METRICS}
                figures["vtk"] = compare_by_vtk(path, baseline)
                rows.setdefault((kind, title), {})[name] = figures
                print(f"{name}: {title}: {figures}", flush=True)
    return rows, renderers


def show(values):
    low, high = (f"{value:.0f}" if value >= 100.0 else f"{value:.2g}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def show_ssim(values):
    low, high = (f"{value:.4f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def write(page, rows, renderers):
    head = ["", *METRICS, "vtkImageDifference"]
    lines = [head, ["---"] * len(head)]
    for kind, title in (("driver", "**the same scene**"), ("change", "**a changed scene**")):
        lines.append([title] + [""] * (len(head) - 1))
        for (found, name), scenes in rows.items():
            if found == kind:
                columns = {key: [figures[key] for figures in scenes.values()] for key in (*METRICS, "vtk")}
                lines.append([name] + [show_ssim(v) if k == "ssim" else show(v) for k, v in columns.items()])
    table = "\n".join("| " + " | ".join(line) + " |" for line in lines)
    with open(page, encoding="utf-8") as file:
        text = file.read()
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    note = f"Renderers: {'; '.join(sorted(renderers))}. {len(SCENES)} scenes: {'; '.join(SCENES)}."
    with open(page, "w", encoding="utf-8") as file:
        file.write(f"{before}{BEGIN}\n\n{table}\n\n{note}\n\n{END}{after}")


def main():
    if sys.argv[1] == "--draw":
        draw(json.loads(sys.argv[2]), sys.argv[3])
        return
    with tempfile.TemporaryDirectory() as temporary:
        folder = sys.argv[2] if len(sys.argv) > 2 else temporary
        os.makedirs(folder, exist_ok=True)
        write(sys.argv[1], *measure(folder))


if __name__ == "__main__":
    main()
