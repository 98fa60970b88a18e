#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's own Python rendering tests with vtkMeasuredBRDFMapper in the place of vtkPolyDataMapper, and its
composite sister in that of the stock composite mapper.

    run_vtk_tests.py VTK-SOURCE [-D DATA] [--only TEXT] [--report FILE.json] [--timeout SECONDS]

runs every Testing/Python/*.py below VTK-SOURCE that makes a vtkPolyDataMapper or a composite one, three times:
    stock      as it is
    plain      ours without a material: the same exit, messages and render windows, pixel for pixel
    material   ours with a material and an environment: the same exit, no message that stock has not
VTK keeps its tests' data apart: -D takes the folder that holds Data/ (ExternalData/Testing of a build of VTK);
without it surfaces and images from files become a sphere and a ripple, and tests of other data are left out. A
test that fails with the stock mapper already must fail in the same way. One that gives different pictures in
stock runs is no evidence ("changes by itself"). Mappers that VTK makes in C++ stay stock. Exit status 1 if a test differs.
"""

import argparse
import collections
import contextlib
import json
import os
import re
import runpy
import signal
import sys
import tempfile
import time
import traceback

WINDOWS = []  # in the order of their making
SHOTS = []  # what a test compares with a baseline picture in between


def substitute(vtk, modules, name, cls):
    for module in modules:
        if hasattr(module, name):
            setattr(module, name, cls)


SURFACES = ("BYU", "PolyData", "STL", "XMLPolyData", "PLY", "OBJ", "MCubes")
IMAGES = ("PNG", "TIFF", "BMP", "JPEG", "PNM", "StructuredPoints", "Volume16", "Image", "SLC", "DEM")


def stand_ins(vtk, modules):
    """What takes the place of files that are not there: sources that ignore what is set on a reader."""

    class Anything:
        def __getattr__(self, name):
            if name.startswith(("Set", "Read", "Swap", "File", "Can", "CanRead")) or name.endswith(("On", "Off")):
                return lambda *arguments: 1
            raise AttributeError(name)

    class Surface(Anything, vtk.vtkSphereSource):
        def __init__(self):
            vtk.vtkSphereSource.SetThetaResolution(self, 24)
            vtk.vtkSphereSource.SetPhiResolution(self, 24)

    class Image(Anything, vtk.vtkRTAnalyticSource):
        def __init__(self):
            vtk.vtkRTAnalyticSource.SetWholeExtent(self, 0, 31, 0, 31, 0, 15)

    class Picture(Anything, vtk.vtkImageMandelbrotSource):
        def __init__(self):
            vtk.vtkImageMandelbrotSource.SetWholeExtent(self, 0, 31, 0, 31, 0, 0)

    for names, cls in ((SURFACES, Surface), (IMAGES[:5], Picture), (IMAGES[5:], Image)):
        for name in names:
            substitute(vtk, modules, "vtk%sReader" % name, cls)


def prepare(mode, data, script):
    """Patches VTK before the script begins."""
    import random

    import vtkmodules.all as vtk
    import vtkmodules.test.Testing as testing
    from vtkmodules import vtkRenderingCore, vtkRenderingOpenGL2

    modules = [vtk, vtkRenderingCore, vtkRenderingOpenGL2]
    random.seed(1)

    class Window(vtkRenderingCore.vtkRenderWindow):
        def __init__(self):
            self.SetOffScreenRendering(1)
            self.SetMultiSamples(0)
            WINDOWS.append(self)

    class Interactor(vtkRenderingCore.vtkRenderWindowInteractor):
        def Start(self):
            pass

    substitute(vtk, modules, "vtkRenderWindow", Window)
    substitute(vtk, modules, "vtkRenderWindowInteractor", Interactor)

    if mode != "stock":
        import vtkmeasuredbrdf as measured

        def with_material(cls):
            class Mapper(cls):
                def __init__(self):
                    self.SetBRDF(BRDF)
                    self.SetEnvironment(ENVIRONMENT)
                    self.SetErrorTolerance(0.1)

            return Mapper if mode == "material" else cls

        if mode == "material":
            BRDF = measured.vtkEmbeddedMaterials.NewBRDF("gold-paint")
            image = vtk.vtkImageData()
            image.SetDimensions(64, 32, 1)
            image.AllocateScalars(vtk.VTK_FLOAT, 3)
            for k in range(64 * 32 * 3):
                image.GetPointData().GetScalars().SetValue(k, (0.4, 0.6, 0.9)[k % 3] * (2.0 if k < 3000 else 1.0))
            ENVIRONMENT = measured.vtkEnvironment()
            ENVIRONMENT.SetImage(image)
        mapper = with_material(measured.vtkMeasuredBRDFMapper)
        substitute(vtk, modules, "vtkPolyDataMapper", mapper)
        substitute(vtk, modules, "vtkOpenGLPolyDataMapper", mapper)
        # Until VTK 9.2 vtkCompositePolyDataMapper is another class, one that ours does not stand for.
        version = vtk.vtkVersion.GetVTKMajorVersion() * 100 + vtk.vtkVersion.GetVTKMinorVersion()
        composite = "vtkCompositePolyDataMapper" + ("2" if version < 903 else "")
        substitute(vtk, modules, composite, with_material(measured.vtkCompositeMeasuredBRDFMapper))

    if not data:
        stand_ins(vtk, modules)

    # Baseline pictures are not compared: what is drawn is compared with stock's.
    testing.compareImage = lambda window, *rest, **more: SHOTS.append(grab(window))
    testing.compareImageWithSavedImage = lambda *rest, **more: None
    sys.argv = [script] + (["-D", data] if data else []) + ["-T", tempfile.mkdtemp(dir=os.environ["TMPDIR"])]
    sys.path.insert(0, os.path.dirname(script))


def grab(window):
    from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

    window.Render()
    width, height = window.GetSize()
    pixels = vtkUnsignedCharArray()
    window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels)
    return bytes(memoryview(pixels))


def pictures():
    """The pictures that were compared, and every window's last."""
    return SHOTS + [grab(window) for window in WINDOWS if window.GetRenderers().GetNumberOfItems()]


def perform(mode, data, script, folder):
    """The child's work. Leaves result.json, messages and the pictures in folder."""
    from vtkmodules.vtkCommonCore import vtkFileOutputWindow, vtkOutputWindow

    messages = os.path.join(folder, "messages")
    log = vtkFileOutputWindow()
    log.SetFileName(messages)
    log.FlushOn()
    vtkOutputWindow.SetInstance(log)
    result = {"exit": 0}
    with open(os.path.join(folder, "output"), "w") as output:
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            try:
                prepare(mode, data, script)
                import vtkmodules.all as vtk
                from vtkmodules.util.misc import vtkGetDataRoot, vtkGetTempDir

                # What VTK's own driver gives to the older scripts.
                known = {"vtk": vtk, "vtkGetDataRoot": vtkGetDataRoot, "vtkGetTempDir": vtkGetTempDir}
                runpy.run_path(script, init_globals=known, run_name="__main__")
            except SystemExit as problem:
                result["exit"] = problem.code if isinstance(problem.code, int) else int(problem.code is not None)
            except BaseException as problem:  # the test's own failure is a result
                result["exit"] = type(problem).__name__
                traceback.print_exc()
            for number, pixels in enumerate(pictures()):
                with open(os.path.join(folder, "%d.rgba" % number), "wb") as file:
                    file.write(pixels)
    result["pictures"] = len([name for name in os.listdir(folder) if name.endswith(".rgba")])
    with open(os.path.join(folder, "result.json"), "w") as file:
        json.dump(result, file)


def run(mode, data, script, timeout):
    """A fork of this process, in which VTK is imported but nothing was drawn."""
    folder = tempfile.mkdtemp(dir=os.environ["TMPDIR"])
    child = os.fork()
    if child == 0:
        try:
            null = os.open(os.devnull, os.O_RDWR)
            for stream in (0, 1, 2):
                os.dup2(null, stream)
            os.chdir(folder)
            signal.alarm(timeout)
            perform(mode, data, script, folder)
        finally:
            os._exit(0)  # without VTK's own end, which is not what is tested
    _, status = os.waitpid(child, 0)
    result = {"exit": "killed by signal %d" % (status & 127), "pictures": 0}
    path = os.path.join(folder, "result.json")
    if not status & 127 and os.path.exists(path):
        with open(path) as file:
            result = json.load(file)
    elif not status & 127:
        result["exit"] = "no result"
    result["pixels"] = []
    for number in range(result["pictures"]):
        with open(os.path.join(folder, "%d.rgba" % number), "rb") as file:
            result["pixels"].append(file.read())
    result["messages"] = []
    if os.path.exists(os.path.join(folder, "messages")):
        with open(os.path.join(folder, "messages"), errors="replace") as file:
            result["messages"] = [part.strip() for part in re.split(r"\n\s*\n", file.read()) if part.strip()]
    return result


def strip(messages):
    """Messages without addresses, numbers and names of files, each once."""
    return {re.sub(r"0x[0-9a-f]+|\([^)]*\)|In \S+|/\S*/|vtk\w*Mapper\w*|\d+", "", m) for m in messages}


def differing(one, other):
    if len(one) != len(other):
        return "sizes differ"
    count = sum(one[k : k + 4] != other[k : k + 4] for k in range(0, len(one), 4))
    return "%d of %d pixels, by up to %d" % (count, len(one) // 4, max(abs(a - b) for a, b in zip(one, other)))


def black(pixels):
    return sum(sum(p[k : k + 3] == b"\0\0\0" for k in range(0, len(p), 4)) for p in pixels)


def vanished(pixels, stock):
    """Pixels that show the background (stock's commonest color) where stock shows something."""
    count = 0
    for ours, theirs in zip(pixels, stock):
        colors = [theirs[k : k + 3] for k in range(0, len(theirs), 4)]
        background = collections.Counter(colors).most_common(1)[0][0] if colors else b""
        if len(ours) == len(theirs):
            count += sum(c != background and ours[4 * k : 4 * k + 3] == background for k, c in enumerate(colors))
    return count


def judge(script, data, timeout):
    """(verdict, reasons) of one test."""
    stock = run("stock", data, script, timeout)
    if stock["exit"] == "killed by signal %d" % signal.SIGALRM:
        return "left out", ["takes longer than the limit with the stock mapper"]
    if not data and any("returned failure for request" in m or "open file" in m for m in stock["messages"]):
        return "left out", ["reads data"]
    plain = run("plain", data, script, 3 * timeout)
    reasons = []
    if plain["pixels"] != stock["pixels"]:
        # Composites, for one: the order of what lies on top of each other follows addresses in memory.
        if any(run("stock", data, script, timeout)["pixels"] != stock["pixels"] for _ in range(4)):
            return "left out", ["changes by itself"]
        if len(plain["pixels"]) != len(stock["pixels"]):
            reasons.append("without: %d pictures instead of %d" % (len(plain["pixels"]), len(stock["pixels"])))
        for one, other in zip(plain["pixels"], stock["pixels"]):
            if one != other:
                reasons.append("without: " + differing(one, other))
    if plain["exit"] != stock["exit"]:
        reasons.append("without: exit %s instead of %s" % (plain["exit"], stock["exit"]))
    if strip(plain["messages"]) - strip(stock["messages"]):
        reasons.append("without: says " + "; ".join(sorted(strip(plain["messages"]) - strip(stock["messages"])))[:400])
    material = run("material", data, script, 3 * timeout)
    if material["exit"] != stock["exit"]:
        reasons.append("material: exit %s instead of %s" % (material["exit"], stock["exit"]))
    if strip(material["messages"]) - strip(stock["messages"]):
        said = "; ".join(sorted(strip(material["messages"]) - strip(stock["messages"])))
        reasons.append("material: says " + said[:400])
    drawn = any(len(set(p[k : k + 3] for k in range(0, len(p), 4))) > 1 for p in stock["pixels"])
    note = ["ends with %s in each case" % stock["exit"]] if stock["exit"] else []
    if black(material["pixels"]) > black(stock["pixels"]) * 1.02 + 20:
        note.append("look: %d black pixels, stock %d" % (black(material["pixels"]), black(stock["pixels"])))
    gone = vanished(material["pixels"], stock["pixels"])
    if gone > 20:
        note.append("look: %d pixels show the background, where stock has something" % gone)
    changed = material["pixels"] != stock["pixels"]
    note.append("material shows" if changed else "material shows nowhere")
    if reasons:
        return "differs", reasons + note
    return ("same" if drawn else "same, nothing drawn"), note


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source")
    parser.add_argument("-D", "--data", default="")
    parser.add_argument("--only", default="", help="paths that contain this")
    parser.add_argument("--report", default="")
    parser.add_argument("--timeout", type=int, default=60)
    options = parser.parse_args()

    scripts, without_data = [], 0
    for folder, _, files in os.walk(options.source):
        if folder.endswith(os.path.join("Testing", "Python")):
            for name in files:
                path = os.path.join(folder, name)
                if name.endswith(".py") and options.only in path:
                    with open(path, errors="replace") as file:
                        text = file.read()
                    if not re.search(r"vtk(OpenGL|Composite)?PolyDataMapper2?\(", text):
                        continue
                    readers = set(re.findall(r"vtk(\w+)Reader(?:Factory)?\(", text))
                    if not options.data and "/Data/" in text and not readers <= set(SURFACES + IMAGES):
                        without_data += 1
                    else:
                        scripts.append(os.path.abspath(path))
    counts, report = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        os.environ["TMPDIR"] = tempfile.tempdir = folder
        os.environ["VTK_DATA_ROOT"] = options.data
        import vtkmodules.all  # noqa: F401 (once, before the forks)

        import vtkmeasuredbrdf  # noqa: F401

        for script in sorted(scripts):
            begin = time.monotonic()
            verdict, reasons = judge(script, options.data, options.timeout)
            name = os.path.relpath(script, options.source)
            counts[verdict] = counts.get(verdict, 0) + 1
            report[name] = {"verdict": verdict, "reasons": reasons}
            print("%-20s %s (%.1f s)%s" % (verdict, name, time.monotonic() - begin,
                                           "".join("\n    " + r for r in reasons)), flush=True)  # fmt: skip
            if options.report:
                with open(options.report, "w") as file:
                    json.dump(report, file, indent=1)
            os.system("rm -rf '%s'/tmp*" % folder)
    counts["left out, they read data"] = without_data
    print(", ".join("%s: %d" % item for item in sorted(counts.items())))
    return 1 if counts.get("differs") else 0


if __name__ == "__main__":
    sys.exit(main())
