# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""One scene gives one picture, in every host.

    TestSameScene.py FOLDER CXX TOOL [EXPLORER]  draw FOLDER/*.png by each program and in Python, and compare them
    TestSameScene.py --write FOLDER              write the scene's files, for other hosts
    TestSameScene.py --compare A.png B.png...    compare pictures that are there with the first one

For each picture it prints how many pixels differ from the first one, and the largest difference of a channel in levels of
255. More than one level is a failure.
"""

import importlib.util
import json
import os
import subprocess
import sys

from scene_files import (
    ANGLE,
    AZIMUTH,
    ELEVATION,
    ENVIRONMENT,
    MATERIAL,
    MESH,
    PLAIN_ENVIRONMENT,
    SIZE,
    get_camera_position,
    write_scene,
)
from vtkmodules.vtkIOImage import vtkPNGReader

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "same_scene.py")


def read(path):
    """The RGB pixels of a picture, row by row from the bottom, in levels of 255."""
    if path.endswith(".exr"):  # radiance, shown as the mapper shows it
        from vtkmeasuredbrdf import vtkPictureReader

        reader = vtkPictureReader()
        reader.SetFileName(path)
        assert reader.Read(), path
        image = reader.GetPicture()
    else:
        reader = vtkPNGReader()
        reader.SetFileName(path)
        reader.Update()
        image = reader.GetOutput()
    assert image.GetDimensions() == (SIZE, SIZE, 1), f"{path}: expected {SIZE} x {SIZE} pixels"
    scalars = image.GetPointData().GetScalars()
    count = scalars.GetNumberOfComponents()
    values = memoryview(scalars).cast("B").cast("f" if path.endswith(".exr") else "B")
    if path.endswith(".exr"):
        values = [round(255.0 * min(1.0, max(0.0, value)) ** (1.0 / 2.2)) for value in values]
    return [tuple(values[k:k + 3]) for k in range(0, len(values), count)]


def is_inside(pixels, k):
    """Whether a pixel and its neighbors show one smooth surface."""
    if pixels[k] == (0, 0, 0):
        return False
    near = [pixels[k + SIZE * y + x] for y in (-1, 0, 1) for x in (-1, 0, 1)]
    return max(pixel[0] for pixel in near) - min(pixel[0] for pixel in near) <= 16


def compare(paths):
    """Whether all pictures are the first one."""
    first = read(paths[0])
    assert first[0] == (0, 0, 0), f"{paths[0]}: found a background of {first[0]}, expected black"
    levels = [pixel[0] for pixel in first if pixel != (0, 0, 0)]
    assert len(levels) > 10000 and min(levels) + 100 < max(levels), f"{paths[0]}: found no lit surface"
    same = True
    for path in paths[1:]:
        # The explorer smooths edges and writes labels over the background; the tool's camera is computed, so that a
        # pixel on an edge may fall on the other side.
        inside = path.startswith(("explorer", "tool"))
        differences = [
            max(abs(a - b) for a, b in zip(p, q))
            for k, (p, q) in enumerate(zip(first, read(path)))
            if not inside or is_inside(first, k)
        ]
        different = sum(difference > 0 for difference in differences)
        print(f"{path}: {different} pixels of {len(differences)} differ, by at most {max(differences)} of 255")
        same = same and max(differences) <= 1
    return same


def write_explorer_state(path):
    state = {
        "format": "measured-brdf explorer state",
        "version": 2,
        "material_files": [MATERIAL],
        "environment_files": [ENVIRONMENT],
        "material": MATERIAL,
        "environment": ENVIRONMENT,
        "mesh": MESH,
        "methods": ["planned", "planned"],
        "split": 1.0,
        "backdrop": False,
        "camera": {
            "position": get_camera_position(),
            "focal_point": (0.0, 0.0, 0.0),
            "view_up": (0.0, 1.0, 0.0),
            "view_angle": ANGLE,
        },
    }
    with open(path, "w") as file:
        json.dump(state, file)


def main():
    if sys.argv[1] == "--compare":
        return 0 if compare(sys.argv[2:]) else 1
    if sys.argv[1] == "--write":
        write_scene(sys.argv[2])
        return 0
    folder, cxx, tool, *explorer = sys.argv[1:]
    write_scene(folder)
    os.chdir(folder)
    python = [sys.executable, "-B", SCRIPT]
    scene = [MESH, MATERIAL, ENVIRONMENT]
    commands = {
        "cxx.png": [cxx, *scene, ",".join(map(str, get_camera_position()))],
        "python.png": [*python, "vtk", *scene],
        # The same light without the header's factor and order of pixels.
        "plain.png": [*python, "vtk", MESH, MATERIAL, PLAIN_ENVIRONMENT],
        "tool.exr": [
            *[tool, "render", MATERIAL, "--environment", ENVIRONMENT, "--mesh", MESH],
            *["--size", f"{SIZE}x{SIZE}", "--view", f"{AZIMUTH},{ELEVATION},{ANGLE}", "-o"],
        ],
    }
    if importlib.util.find_spec("pyvista"):
        commands["pyvista.png"] = [*python, "pyvista", *scene]
    else:
        print("PyVista is not installed: not compared")
    if explorer:
        write_explorer_state("state.json")
        commands["explorer.png"] = [*explorer, "state.json", str(SIZE)]
    else:
        print("The explorer is not built: not compared")
    for name, command in commands.items():
        print(f"{name}: ", end="", flush=True)
        if name == "cxx.png":
            plan = subprocess.run([*command, name], check=True, capture_output=True, text=True).stdout
            print(plan)
            assert ", modeled" in plan, "self-shadowing is left out of the scene that is to show it"
        else:
            subprocess.run([*command, name], check=True)
    return 0 if compare(list(commands)) else 1


if __name__ == "__main__":
    sys.exit(main())
