#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Components of Module/ use the components that docs/architecture.md allows them, units form no circles, public headers show no
private type, and no two headers share a name: tests see several folders of them, where the first one found wins. CMake's files
ask VTK how it names the module's targets: 9.7 changed that.

usage: TestComponents.py REPOSITORY
"""

import os
import re
import sys

ALLOWED = {
    "Core": [],
    "Material": ["Core"],
    "Lighting": ["Core"],
    "Integration": ["Core", "Material", "Lighting", "Visibility"],
    "Visibility": ["Core"],
    "Metrics": ["Core", "Material", "Lighting"],
    "Fitting": ["Core", "Material", "Lighting"],
    "IO": ["Core", "Material", "Lighting"],
    "Planning": ["Core", "Material", "Lighting", "Visibility", "Integration"],
    "Rendering": ["Core", "Material", "Lighting", "Visibility", "Integration", "Fitting", "Planning"],
    "Sources": ["Core", "Material"],
}


def find_files(module):
    """{file name: (component, path, whether it is private)}"""
    files = {}
    for component in ALLOWED:
        for path, _, names in os.walk(os.path.join(module, component)):
            for name in sorted(names):
                if name.endswith((".h", ".cxx", ".txx")):
                    files[name] = (component, os.path.join(path, name), "Private" in path)
    return files


def get_circles(uses):
    """Strongly connected components of more than one unit (Tarjan 1972)."""
    index, low, stack, circles = {}, {}, [], []

    def visit(unit):
        index[unit] = low[unit] = len(index)
        stack.append(unit)
        for other in sorted(uses.get(unit, ())):
            if other not in index:
                visit(other)
                low[unit] = min(low[unit], low[other])
            elif other in stack:
                low[unit] = min(low[unit], index[other])
        if low[unit] == index[unit]:
            circle = []
            while not circle or circle[-1] != unit:
                circle.append(stack.pop())
            if len(circle) > 1:
                circles.append(sorted(circle))

    sys.setrecursionlimit(10000)
    for unit in sorted(uses):
        if unit not in index:
            visit(unit)
    return circles


def find_same_headers(repository):
    """Problems: headers of one name in several folders."""
    folders = {}
    for top in ("Module", "Applications", "Testing"):
        for folder, _, names in os.walk(os.path.join(repository, top)):
            for name in names:
                if name.endswith(".h"):
                    folders.setdefault(name, []).append(os.path.relpath(folder, repository))
    return [f"{name} is in {' and in '.join(sorted(where))}" for name, where in sorted(folders.items()) if len(where) > 1]


def find_missing_for_fuzzing(repository):
    """Problems: a component that the fuzz targets' components use and their build leaves out; no test compiles it with libFuzzer."""
    path = os.path.join(repository, "Testing", "Fuzz", "CMakeLists.txt")
    with open(path, encoding="utf-8") as file:
        components = re.search(r"^set\(components ([^)]*)\)", file.read(), re.MULTILINE).group(1).split()
    return [f"{path}: {component} uses {used}, which is not among the components"
            for component in components for used in ALLOWED[component] if used not in components]


def find_guessed_targets(repository):
    """Problems: a target that VTK names, by the name that it has in some versions of VTK."""
    guessed = re.compile(r"(TARGET_\w+:|target_propert(y\(\s*\w+|ies\()\s*|target_\w+\(|add_dependencies\(|--target |DEPENDS )\s*"
                         r"(Py)?(vtk)?MeasuredBRDF(Python)?[\s,>)]")
    problems = []
    for folder, folders, names in os.walk(repository):
        folders[:] = [name for name in folders if not name.startswith((".", "build"))]
        for name in names:
            if name == "CMakeLists.txt" or name.endswith(".cmake"):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    problems += [f"{folder}/{name}: {found[0].strip()}: ask for the target (ALIASED_TARGET of VTK::MeasuredBRDF)"
                                 for found in guessed.finditer(file.read())]
    return problems


def main(repository):
    files = find_files(os.path.join(repository, "Module"))
    problems, uses = find_same_headers(repository) + find_missing_for_fuzzing(repository), {}
    problems += find_guessed_targets(repository)
    for name, (component, path, private) in files.items():
        with open(path, encoding="utf-8") as file:
            text = file.read()
        included = re.findall(r'#include "([^"]+)"', text)
        if name.startswith("vtk") and name.endswith(".h") and not private:
            if "measuredbrdf" in text:
                problems.append(f"{path}: a public header shows a type of the private namespace measuredbrdf")
        for other in included:
            if other not in files:
                continue
            other_component, _, other_private = files[other]
            if other_component != component and other_component not in ALLOWED[component]:
                problems.append(f"{path}: {component} may not use {other_component} ({other})")
            if name.endswith(".h") and not private and other_private:
                problems.append(f"{path}: a public header includes the private {other}")
            unit, used = name.split(".")[0], other.split(".")[0]
            if unit != used:
                uses.setdefault(unit, set()).add(used)
    for component in ALLOWED:
        if not os.path.isfile(os.path.join(repository, "Module", component, "README.md")):
            problems.append(f"Module/{component}: there is no README.md")
    for circle in get_circles(uses):
        problems.append("units form a circle: " + ", ".join(circle))
    print("\n".join(problems) or f"{len(files)} files in {len(ALLOWED)} components keep to the directions")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
