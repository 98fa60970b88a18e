# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs exported scripts in ParaView and compares what its sphere has: pvpython check_paraview.py CASES.json SCRIPT..."""

import json
import os
import runpy
import sys

from paraview.simple import GetActiveSource, GetActiveView, GetDisplayProperties, GetParaViewVersion, ResetSession

NAMES = {"Color": ("DiffuseColor", "AmbientColor")}


def main():
    with open(sys.argv[1], encoding="ascii") as file:
        cases = {case["name"]: case for case in json.load(file)}
    for path in sys.argv[2:]:
        ResetSession()
        runpy.run_path(path)
        display = GetDisplayProperties(GetActiveSource(), GetActiveView())
        assert display.Interpolation == "PBR", display.Interpolation
        case = cases[os.path.splitext(os.path.basename(path))[0]]
        for key, wanted in case["values"].items():
            for name in NAMES.get(key, (key,)):
                value = getattr(display, name)
                value = list(value) if isinstance(wanted, list) else float(value)
                assert value == wanted, (path, name, value, wanted)
    version = GetParaViewVersion()
    print(f"ParaView {version.major}.{version.minor}")


if __name__ == "__main__":
    main()
