#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes one Markdown page on the Python package vtkmeasuredbrdf, from its docstrings.

Exit status 3 and no page where the package cannot be imported.
"""

import argparse
import inspect
import sys

# Every VTK class has these.
BOILERPLATE = ("IsTypeOf", "IsA", "SafeDownCast", "NewInstance", "GetNumberOfGenerationsFromBase",
               "GetNumberOfGenerationsFromBaseType")


def fence(text):
    lines = [line.rstrip() for line in text.strip("\n").split("\n")]
    return ["~~~~{.unparsed}"] + lines + ["~~~~", ""]


def document(cls):
    """Markdown lines on one class."""
    name = cls.__name__
    lines = [f"## {name}", ""]
    bases = [base.__name__ for base in cls.__mro__[1:] if base.__name__.startswith("vtk")]
    if bases:
        lines += ["Bases: " + ", ".join(bases[:-1]) + (", " if bases[:-1] else "") + bases[-1] + ".", ""]
    text = inspect.getdoc(cls) or ""
    lines += fence(text)

    members = sorted(vars(cls).items())
    enums = [member for _, member in members
             if inspect.isclass(member) and issubclass(member, int)]
    for enum in enums:
        values = sorted((int(value), key) for key, value in members
                        if type(value) is enum)  # noqa: E721 (bool and int are bases)
        lines += [f"{enum.__name__}: " + ", ".join(f"`{key}` = {value}" for value, key in values), ""]
    constants = [(key, value) for key, value in members if type(value) in (int, float)  # noqa: E721
                 and key[0].isupper()]
    if constants:
        lines += ["Constants: " + ", ".join(f"`{key}` = {value}" for key, value in constants), ""]

    methods = [(key, member) for key, member in members
               if key[0].isupper() and key not in BOILERPLATE and callable(member)
               and not inspect.isclass(member)]
    for key, member in methods:
        lines += fence(inspect.getdoc(member) or key)
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("page", help="the Markdown file to write")
    options = parser.parse_args()
    try:
        import vtkmeasuredbrdf as package
    except ImportError as error:
        print(f"vtkmeasuredbrdf cannot be imported ({error}).", file=sys.stderr)
        return 3

    classes = [member for _, member in sorted(vars(package).items())
               if inspect.isclass(member) and member.__name__.startswith("vtk")]
    lines = ["# Python API", "",
             f"The package `vtkmeasuredbrdf` {package.__version__}: {len(classes)} classes, as their docstrings "
             "describe them. Each behaves as the C++ class of the same name.", ""]
    for cls in classes:
        lines += document(cls)
    with open(options.page, "w", encoding="utf-8") as file:
        file.write("\n".join(lines).rstrip("\n") + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
