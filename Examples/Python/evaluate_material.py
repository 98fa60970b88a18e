#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A material in numbers: its values in the plane of incidence and its albedo. Needs no display."""

import argparse
import math
import sys

from vtkmeasuredbrdf import vtkBRDFReader, vtkEmbeddedMaterials

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("material", nargs="?", default="gold-paint",
                    help="a built-in material's name or a BRDF file (default: %(default)s)")
parser.add_argument("--light", type=float, default=45.0, metavar="DEGREES",
                    help="angle between light and normal (default: %(default)s)")
options = parser.parse_args()

if set(options.material) & set("./#"):  # no built-in name has these
    reader = vtkBRDFReader()
    reader.SetFileName(options.material)
    reader.Read()
    brdf = reader.GetBRDF()
else:
    brdf = vtkEmbeddedMaterials.NewBRDF(options.material)
if not brdf:
    sys.exit(1)  # they have said why


def direction(degrees):
    """Local frame: z is the normal; positive angles lean towards +x."""
    return (math.sin(math.radians(degrees)), 0.0, math.cos(math.radians(degrees)))


to_light = direction(-options.light)
value = [0.0, 0.0, 0.0]
albedo = [0.0, 0.0, 0.0]
print(f"{options.material} ({brdf.GetSource()})")
print(f"f(i,o) in 1/sr, light at {options.light:g} degrees; and the albedo towards the viewer")
print("view angle         R         G         B     albedo R    G      B")
for angle in range(-75, 76, 15):
    to_viewer = direction(angle)
    brdf.Evaluate(to_light, to_viewer, value)
    brdf.GetDirectionalAlbedo(to_viewer, albedo)
    print(f"{angle:10d} " + " ".join(f"{v:9.5f}" for v in value) + "    "
          + " ".join(f"{a:6.4f}" for a in albedo))
