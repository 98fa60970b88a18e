#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Brushed metals of three widths as materials, for the figures in docs/methods/anisotropic.md.

    make-brushed.py FOLDER    writes brushed-broad.exr, brushed.exr and brushed-narrow.exr

D-BRDFs with the distribution of Trowbridge and Reitz 1975 (GGX), whose widths along and across the tangent are
(0.2, 0.5), (0.1, 0.4) and (0.05, 0.3). PYTHONPATH: the build's lib/python3/dist-packages.
"""

import math
import sys
from pathlib import Path

from vtkmeasuredbrdf import vtkBRDFWriter, vtkDistributionBRDF

SAMPLES = 128  # of the half vector's polar angle and of its azimuth


def make(along, across):
    rgb = []
    for phi in range(SAMPLES):
        for theta in range(SAMPLES):
            angle = 0.5 * math.pi * ((theta + 0.5) / SAMPLES) ** 2
            azimuth = 2.0 * math.pi * (phi + 0.5) / SAMPLES
            x = math.sin(angle) * math.cos(azimuth) / along
            y = math.sin(angle) * math.sin(azimuth) / across
            d = x * x + y * y + math.cos(angle) ** 2
            rgb += 3 * [1.0 / (math.pi * along * across * d * d)]
    brdf = vtkDistributionBRDF()
    if not brdf.SetDistribution(SAMPLES, SAMPLES, rgb):
        sys.exit("the distribution was refused")
    brdf.SetSchlickFresnel((0.95, 0.7, 0.4))
    return brdf


def main(folder):
    for name, widths in (("brushed-broad", (0.2, 0.5)), ("brushed", (0.1, 0.4)), ("brushed-narrow", (0.05, 0.3))):
        writer = vtkBRDFWriter()
        writer.SetBRDF(make(*widths))
        writer.SetFileName(str(folder / f"{name}.exr"))
        if not writer.Write():
            sys.exit(f"{name}.exr cannot be written")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
