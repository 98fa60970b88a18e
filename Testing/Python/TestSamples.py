# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The Python samples of README.md, docs/guide.md, docs/svbrdf.md and docs/image-tests.md run, one after the other, and draw something.

Files that they read are made here: a material and an environment of those names.
"""

import importlib.util
import os
import re
import sys
import tempfile

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow

from vtkmeasuredbrdf import vtkBRDFWriter, vtkEmbeddedMaterials

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# What a test cannot do as a program of the reader's does: show a window, and wait for the user.
REPLACED = {
    "window.SetSize(": "window.SetOffScreenRendering(1); window.SetSize(",
    "interactor.Start()": "interactor.ProcessEvents()",
}


def samples(page):
    with open(os.path.join(ROOT, page), encoding="utf-8") as file:
        found = re.findall(r"^```python\n(.*?)^```", file.read(), re.DOTALL | re.MULTILINE)
    for text, replacement in REPLACED.items():
        found = [sample.replace(text, replacement) for sample in found]
    return found


def write_files():
    """Files are recognized by their first bytes, so that their names may be the samples'."""
    writer = vtkBRDFWriter()
    writer.SetBRDF(vtkEmbeddedMaterials.NewBRDF("gold-paint"))
    writer.SetFileName("material.exr")
    assert writer.Write()
    os.rename("material.exr", "satin_purple_rgb.bsdf")
    width, height = 64, 32  # Radiance's format without compression: 128/256 * 2, bright above
    pixels = b"".join(bytes((128, 128, 128, 130 - 4 * y // height)) * width for y in range(height))
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode()
    for name in ("studio.hdr", "studio.exr"):
        with open(name, "wb") as file:
            file.write(header + pixels)


def center(window):
    window.Render()
    width, height = window.GetSize()
    pixel = vtkUnsignedCharArray()
    window.GetPixelData(width // 2, height // 2, width // 2, height // 2, 0, pixel, 0)
    return [pixel.GetValue(k) for k in range(3)]


def check_lit_once(window, renderer):
    """The environment lights the surface, and VTK's automatic headlight adds nothing."""
    drawn = center(window)
    assert min(drawn) > 0
    renderer.AutomaticLightCreationOff()
    renderer.RemoveAllLights()
    assert center(window) == drawn


def check_image_test(test, name):
    """A sample's test asks for a baseline, passes with it, and fails where it is another picture."""
    for message in (f"{name}.png: ", None, "flip="):
        try:
            test()
            assert message is None
        except (AssertionError, ValueError) as error:
            assert message and message in str(error), error
        candidate = f"baselines/{name}.test.png"
        if message is not None and os.path.exists(candidate):
            os.rename(candidate, f"baselines/{name}.png")
        if message is None:
            darken(f"baselines/{name}.png")
    assert os.path.exists(f"baselines/{name}.diff.png")


def darken(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    half = vtkImageShiftScale()
    half.SetInputConnection(reader.GetOutputPort())
    half.SetScale(0.5)
    half.Update()
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(half.GetOutput())
    writer.Write()


def run(page, names):
    for number, sample in enumerate(samples(page), 1):
        if "import pyvista" in sample and importlib.util.find_spec("pyvista") is None:
            print(f"{page}: sample {number}: skipped: no PyVista", flush=True)
            continue
        print(f"{page}: sample {number}", flush=True)
        exec(compile(sample, f"{page}, sample {number}", "exec"), names)  # noqa: S102 (ours)
    return names


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        write_files()

        names = run("README.md", {"mesh": vtkSphereSource()})
        actor = vtkActor()
        actor.SetMapper(names["mapper"])
        renderer = vtkRenderer()
        renderer.AddActor(actor)
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.AddRenderer(renderer)
        check_lit_once(window, renderer)
        assert names["mapper"].GetPlan()

        names = run("docs/guide.md", {})
        names["actor"].SetMapper(names["composite"])
        assert max(center(names["window"])) > 0  # composite data with tone mapping
        assert names["composite"].GetPlan().count("\n") >= 1  # two materials
        names["actor"].SetMapper(names["mapper"])
        check_lit_once(names["window"], names["renderer"])
        assert names["mapper"].GetPlan()

        if importlib.util.find_spec("numpy") is None:
            print("docs/svbrdf.md: skipped: no NumPy", flush=True)
        else:
            found = run("docs/svbrdf.md", {})["fitter"].GetOutput()
            assert [found.GetName(k) for k in range(found.GetNumberOfMaterials())] == ["red-fabric2", "nickel"]

        names = run("docs/image-tests.md", {})
        os.mkdir("baselines")
        check_image_test(names["test_sphere"], "sphere")
        if "test_torus" in names:
            check_image_test(names["test_torus"], "torus")
        os.chdir(ROOT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
