# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Importing the package does not load OpenImageIO, and what it brings along; reading an image does."""
import os
import sys
import tempfile

import vtkmeasuredbrdf


def is_loaded(name):
    with open("/proc/self/maps", encoding="utf-8") as maps:
        return any(name in line for line in maps)


if not os.path.exists("/proc/self/maps"):
    sys.exit("/proc/self/maps: there is no such file, so nothing can be tested here")
assert is_loaded("libvtkMeasuredBRDF.so")
assert not is_loaded("libOpenImageIO"), "OpenImageIO is loaded when the package is imported"
room = vtkmeasuredbrdf.vtkEmbeddedEnvironments.NewEnvironment("room")
assert room.GetWidth() == 512
assert not is_loaded("libOpenImageIO"), "OpenImageIO is loaded for embedded environments"

with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "two-texels.ppm")
    with open(path, "w", encoding="ascii") as file:
        file.write("P3 2 1 255\n255 0 0 0 255 0\n")
    reader = vtkmeasuredbrdf.vtkEnvironmentReader()
    reader.SetFileName(path)
    assert reader.Read(), reader.GetErrorMessage()
    assert reader.GetEnvironment().GetWidth() == 2
assert is_loaded("libOpenImageIO") and is_loaded("libvtkMeasuredBRDFImages")
