# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""One scene gives one picture, in C++, in Python and in PyVista.

    TestSameScene.py PROGRAM FOLDER            draw FOLDER/cxx.png, python.png, pyvista.png and compare them
    TestSameScene.py --compare A.png B.png...  compare pictures that are there with the first one

For each picture it prints how many pixels differ from the first one, and the largest difference of a channel in levels of
255. Any difference is a failure.
"""

import importlib.util
import os
import subprocess
import sys

from vtkmodules.vtkIOImage import vtkPNGReader

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "same_scene.py")
SIZE = 300
BACKGROUND = (51, 51, 51)


def read(path):
    """The RGB pixels of a picture, row by row."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    assert reader.GetOutput().GetDimensions() == (SIZE, SIZE, 1), f"{path}: expected {SIZE} x {SIZE} pixels"
    count = scalars.GetNumberOfComponents()
    values = bytes(memoryview(scalars))
    return [tuple(values[k:k + 3]) for k in range(0, len(values), count)]


def compare(paths):
    """Whether all pictures are the first one."""
    first = read(paths[0])
    center = first[(SIZE // 2) * (SIZE + 1)]
    assert first[0] == BACKGROUND, f"{paths[0]}: found a background of {first[0]}, expected {BACKGROUND}"
    assert center[0] > center[1] > center[2] > 0, f"{paths[0]}: found {center} in the middle, expected gold"
    same = True
    for path in paths[1:]:
        differences = [max(abs(a - b) for a, b in zip(p, q)) for p, q in zip(first, read(path))]
        different = sum(difference > 0 for difference in differences)
        print(f"{path}: {different} pixels of {len(first)} differ, by at most {max(differences)} of 255")
        same = same and different == 0
    return same


def main():
    if sys.argv[1] == "--compare":
        return 0 if compare(sys.argv[2:]) else 1
    program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    python = [sys.executable, "-B", SCRIPT]
    commands = {"cxx": [program], "python": [*python, "vtk"]}
    if importlib.util.find_spec("pyvista"):
        commands["pyvista"] = [*python, "pyvista"]
    else:
        print("PyVista is not installed: not compared")
    paths = []
    for name, command in commands.items():
        paths.append(os.path.join(folder, f"{name}.png"))
        print(f"{name}: ", end="", flush=True)
        subprocess.run([*command, paths[-1]], check=True)
    return 0 if compare(paths) else 1


if __name__ == "__main__":
    sys.exit(main())
