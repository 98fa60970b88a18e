#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The exported files of cases.json as MaterialX, OpenUSD and ParaView read them, written down for tests that do without them.

    pip install materialx==1.39.3 usd-core
    Testing/Export/validate_exports.py BUILD/bin/WriteExports --pvpython pvpython -o Testing/Export/recorded.json
    Testing/Export/validate_exports.py BUILD/bin/WriteExports

The second line is the test: it compares today's files with recorded.json, which holds the hash of every file that was found right.
It needs none of the three programs. VTK itself reads the glTF files in another test.

.mtlx   MaterialX reads and validates the document; the inputs that it finds must have the case's values, within the ranges
        that the node definitions give (uimin, uimax).
.usda   OpenUSD opens the stage; the ball's bound material must be a UsdPreviewSurface with the case's values, of the types
        that the shader's definition in OpenUSD gives.
.py     ParaView runs the script; its sphere's representation must have the case's values.
"""

import argparse
import datetime
import hashlib
import json
import os
import runpy
import subprocess
import sys
import tempfile

IN_PARAVIEW = "--in-paraview"
HERE = os.path.dirname(os.path.abspath(__file__))


def same(value, wanted):
    value = [float(x) for x in (value if hasattr(value, "__len__") else [value])]
    wanted = wanted if isinstance(wanted, list) else [wanted]
    return len(value) == len(wanted) and all(abs(a - b) <= 1e-6 * max(1.0, abs(b)) for a, b in zip(value, wanted))


def check_materialx(path, case):
    import MaterialX as mx

    library = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
    document = mx.createDocument()
    mx.readFromXmlFile(document, path)
    document.importLibrary(library)
    valid, message = document.validate()
    assert valid, message
    assert document.getColorSpace() == "lin_rec709"
    (material,) = document.getMaterialNodes()
    (shader,) = mx.getShaderNodes(material)
    definition = shader.getNodeDef()
    assert definition.getNodeString() == {"open_pbr": "open_pbr_surface"}.get(case["model"], case["model"])
    values = {}
    for given in shader.getInputs():
        name = given.getName()
        declared = definition.getActiveInput(name)
        assert declared and declared.getType() == given.getType(), name
        if not given.hasValueString():
            continue
        value = given.getValue()
        numbers = value.asTuple() if hasattr(value, "asTuple") else [value]
        for bound, wrong in (("uimin", float.__lt__), ("uimax", float.__gt__)):
            if declared.hasAttribute(bound):
                limit = min(map(float, declared.getAttribute(bound).split(",")))
                assert not any(wrong(float(x), limit) for x in numbers), (name, bound)
        values[name] = list(numbers)
    turn = case["values"].get("tangent_rotation")
    for name, wanted in case["values"].items():
        assert name == "tangent_rotation" or same(values.pop(name), wanted), name
    if turn is not None:
        rotate = shader.getConnectedNode("geometry_tangent")
        assert rotate.getCategory() == "rotate3d" and same(rotate.getInputValue("amount"), 360.0 * turn)
    assert set(values) <= {"base", "base_weight"}, values
    return mx.getVersionString()


def check_usd(path, case):
    from pxr import Sdr, Usd, UsdGeom, UsdShade

    stage = Usd.Stage.Open(path)
    ball = UsdGeom.Sphere.Get(stage, "/World/Ball")
    assert stage.GetDefaultPrim().GetName() == "World" and ball
    material = UsdShade.MaterialBindingAPI(ball).ComputeBoundMaterial()[0]
    shader = material.ComputeSurfaceSource()[0]
    assert shader.GetShaderId() == "UsdPreviewSurface"
    definition = Sdr.Registry().GetShaderNodeByIdentifier("UsdPreviewSurface")
    values = {}
    for given in shader.GetInputs():
        name = given.GetBaseName()
        if definition:
            declared = definition.GetShaderInput(name) if hasattr(definition, "GetShaderInput") else definition.GetInput(name)
            kind = declared.GetTypeAsSdfType()
            kind = kind.GetSdfType() if hasattr(kind, "GetSdfType") else kind[0]
            assert declared and kind == given.GetTypeName(), (name, kind, given.GetTypeName())
        values[name] = given.Get()
    assert values.pop("useSpecularWorkflow") == 0
    for name, wanted in case["values"].items():
        assert same(values.pop(name), wanted), name
    assert not values, values
    return ".".join(map(str, Usd.GetVersion()))


def run_in_paraview(paths):
    """What pvpython does with this file: runs exported scripts and compares what their sphere has."""
    from paraview.simple import GetActiveSource, GetActiveView, GetDisplayProperties, GetParaViewVersion, ResetSession

    with open(os.path.join(HERE, "cases.json"), encoding="ascii") as file:
        cases = {case["name"]: case for case in json.load(file)}
    for path in paths:
        ResetSession()
        runpy.run_path(path)
        display = GetDisplayProperties(GetActiveSource(), GetActiveView())
        assert display.Interpolation == "PBR", display.Interpolation
        for key, wanted in cases[os.path.splitext(os.path.basename(path))[0]]["values"].items():
            for name in ("DiffuseColor", "AmbientColor") if key == "Color" else (key,):
                value = getattr(display, name)
                value = list(value) if isinstance(wanted, list) else float(value)
                assert value == wanted, (path, name, value, wanted)
    print(f"ParaView {GetParaViewVersion().major}.{GetParaViewVersion().minor}")


def check_paraview(program, paths):
    made = subprocess.run([program, __file__, IN_PARAVIEW, *paths], stdout=subprocess.PIPE, text=True, check=True)
    return made.stdout.split("ParaView ")[1].strip()


def compare(files, record):
    """Whether today's files are those that were found right."""
    failures = 0
    for name in sorted(set(files) | set(record["files"])):
        if files.get(name) != record["files"].get(name):
            failures += 1
            print(f"{name}: not what MaterialX {record['materialx']}, USD {record['usd']} and ParaView {record['paraview']} "
                  "have read, or not there; run validate_exports.py")
    print(f"{len(record['files'])} files compared")
    return 1 if failures else 0


def main():
    if sys.argv[1:2] == [IN_PARAVIEW]:
        return run_in_paraview(sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("writer", metavar="WRITER", help="the program WriteExports of the build")
    parser.add_argument("-o", "--output", help="JSON file to write; without it, files are compared with recorded.json")
    parser.add_argument("--pvpython", default="pvpython", metavar="PROGRAM", help="ParaView's Python; it needs a display")
    arguments = parser.parse_args()
    cases_path = os.path.join(HERE, "cases.json")
    with open(cases_path, encoding="ascii") as file:
        cases = {case["name"]: case for case in json.load(file)}
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([arguments.writer, cases_path, folder], check=True)
        files = {}
        for name in sorted(os.listdir(folder)):
            if name.endswith((".mtlx", ".usda", ".py")):
                with open(os.path.join(folder, name), "rb") as file:
                    files[name] = hashlib.sha256(file.read()).hexdigest()
        if not arguments.output:
            with open(os.path.join(HERE, "recorded.json"), encoding="ascii") as file:
                return compare(files, json.load(file))
        record = {"format": "measured-brdf exports", "version": 1, "date": datetime.date.today().isoformat(), "files": files}
        for program, ending, check in (("materialx", ".mtlx", check_materialx), ("usd", ".usda", check_usd)):
            for name in filter(lambda name: name.endswith(ending), files):
                record[program] = check(os.path.join(folder, name), cases[os.path.splitext(name)[0]])
                print(f"{name}: valid")
        scripts = [os.path.join(folder, name) for name in files if name.endswith(".py")]
        record["paraview"] = check_paraview(arguments.pvpython, scripts)
    with open(arguments.output, "w", encoding="ascii") as file:
        json.dump(record, file, indent=1)
        file.write("\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
