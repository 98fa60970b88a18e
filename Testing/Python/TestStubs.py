# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The type stubs: every wrapped class and each of its methods is in vtkMeasuredBRDF.pyi, which Python can parse."""

import ast
import importlib.util
import inspect
import os
import sys

import vtkmeasuredbrdf
from vtkmeasuredbrdf import vtkMeasuredBRDF as wrapped

FOLDER = os.path.dirname(vtkmeasuredbrdf.__file__)
STUBS = os.path.join(FOLDER, "vtkMeasuredBRDF.pyi")


def read_stubs():
    """The names of methods in the stubs, by class."""
    with open(STUBS, encoding="utf-8") as file:
        tree = ast.parse(file.read(), STUBS)
    return {
        part.name: {method.name for method in part.body if isinstance(method, ast.FunctionDef)}
        for part in tree.body if isinstance(part, ast.ClassDef)
    }


def main():
    assert os.path.exists(os.path.join(FOLDER, "py.typed")), "py.typed is missing"
    if importlib.util.find_spec("vtkmodules.generate_pyi") is None:
        print("Skipped: this VTK has no generator of type stubs")
        sys.exit(125)
    found = read_stubs()
    classes = [member for _, member in inspect.getmembers(wrapped, inspect.isclass)
               if member.__module__ == wrapped.__name__]
    assert len(classes) > 50, classes
    for member in classes:
        assert member.__name__ in found, f"{STUBS} lacks {member.__name__}"
        methods = {name for name, method in vars(member).items()
                   if inspect.isroutine(method) and (method.__doc__ or "").startswith(name + "(")}
        missing = methods - found[member.__name__]
        assert not missing, f"{STUBS}: {member.__name__} lacks {sorted(missing)}"
    assert "SetErrorTolerance" in found["vtkMeasuredBRDFMapper"], found["vtkMeasuredBRDFMapper"]
    print(f"{len(classes)} classes, {sum(map(len, found.values()))} methods")


if __name__ == "__main__":
    main()
