#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The exported files of cases.json as MaterialX, OpenUSD and ParaView read them, written down for tests that do without them.

    pip install materialx==1.39.3 usd-core
    Testing/Export/validate_exports.py BUILD/bin/WriteExports --pvpython pvpython -o Testing/Export/recorded.json

.mtlx   MaterialX reads and validates the document; the inputs that it finds must have the case's values, within the ranges
        that the node definitions give (uimin, uimax).
.usda   OpenUSD opens the stage; the ball's bound material must be a UsdPreviewSurface with the case's values, of the types
        that the shader's definition in OpenUSD gives.
.py     ParaView runs the script; its sphere's representation must have the case's values (check_paraview.py).

recorded.json holds the hash of every file that was found right. A test compares today's files with it. VTK itself reads
the glTF files in that test.
"""

import argparse
import datetime
import hashlib
import json
import os
import subprocess
import sys
import tempfile

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


def check_paraview(program, paths):
    command = [program, os.path.join(HERE, "check_paraview.py"), os.path.join(HERE, "cases.json"), *paths]
    made = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return made.stdout.split("ParaView ")[1].strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("writer", metavar="WRITER", help="the program WriteExports of the build")
    parser.add_argument("-o", "--output", required=True, help="JSON file to write")
    parser.add_argument("--pvpython", required=True, metavar="PROGRAM", help="ParaView's Python; it needs a display")
    arguments = parser.parse_args()
    cases_path = os.path.join(HERE, "cases.json")
    with open(cases_path, encoding="ascii") as file:
        cases = {case["name"]: case for case in json.load(file)}
    record = {"format": "measured-brdf exports", "version": 1, "date": datetime.date.today().isoformat(), "files": {}}
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([arguments.writer, cases_path, folder], check=True)
        for name in sorted(os.listdir(folder)):
            stem, ending = os.path.splitext(name)
            check = {".mtlx": check_materialx, ".usda": check_usd}.get(ending)
            if not check:
                continue
            path = os.path.join(folder, name)
            record[{".mtlx": "materialx", ".usda": "usd"}[ending]] = check(path, cases[stem])
            with open(path, "rb") as file:
                record["files"][name] = hashlib.sha256(file.read()).hexdigest()
            print(f"{name}: valid")
        scripts = [name for name in sorted(os.listdir(folder)) if name.endswith(".py")]
        record["paraview"] = check_paraview(arguments.pvpython, [os.path.join(folder, name) for name in scripts])
        for name in scripts:
            with open(os.path.join(folder, name), "rb") as file:
                record["files"][name] = hashlib.sha256(file.read()).hexdigest()
            print(f"{name}: runs")
    with open(arguments.output, "w", encoding="ascii") as file:
        json.dump(record, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    sys.exit(main())
