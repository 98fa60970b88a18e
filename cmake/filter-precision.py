#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the coarse weights of graphics cards' texture units cost each method (docs/methods/pixel-cost.md).

    filter-precision.py DATA    DATA: materials/rgl, materials/mbsdf and environments

Radiance with weights of 4, 6 and 8 bits against that with exact weights (SetFilterWeightBits), relative L1 over
compare-tables.py's pairs: the mean and the largest over materials and maps. PYTHONPATH: the build's
lib/python3/dist-packages.
"""

import importlib
import sys
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray

from vtkmeasuredbrdf import (
    vtkBasisRadianceIntegrator,
    vtkBRDFReader,
    vtkEmbeddedMaterials,
    vtkEnvironmentReader,
    vtkFactoredRadianceIntegrator,
    vtkFilteredRadianceIntegrator,
    vtkTableRadianceIntegrator,
)

sys.path.insert(0, str(Path(__file__).parent))
make_pairs = importlib.import_module("compare-tables").make_pairs

BITS = (4, 6, 8)
MATERIALS = (
    "rgl/acrylic_felt_white_rgb.bsdf",
    "rgl/satin_purple_rgb.bsdf",
    "rgl/irid_flake_paint2_rgb.bsdf",
    "rgl/chm_light_blue_rgb.bsdf",
    "mbsdf/carpaint_red.mbsdf",
    "nickel",
    "pink-felt",
)
METHODS = (
    ("table, 17 x 8 x 8", vtkTableRadianceIntegrator, (17, 8, 8)),
    ("table, 33 x 12 x 16", vtkTableRadianceIntegrator, (33, 12, 16)),
    ("table, 65 x 24 x 24", vtkTableRadianceIntegrator, (65, 24, 24)),
    ("factored, 128 rows, 8 maps", vtkFactoredRadianceIntegrator, (128, 8)),
    ("factored, 256 rows, 8 maps", vtkFactoredRadianceIntegrator, (256, 8)),
    ("filtered, 16 samples", vtkFilteredRadianceIntegrator, (16,)),
    ("basis, 25 functions", vtkBasisRadianceIntegrator, (25,)),
)


def read_brdf(data, name):
    if "/" not in name:
        return vtkEmbeddedMaterials.NewBRDF(name)
    reader = vtkBRDFReader()
    reader.SetFileName(str(data / "materials" / name))
    if not reader.Read():
        sys.exit(f"{name} cannot be read")
    return reader.GetBRDF()


def measure(integrator, arrays):
    result = vtkDoubleArray()
    if not integrator.Integrate(*arrays, result):
        sys.exit("integration failed")
    return vtk_to_numpy(result).copy()


def main(data):
    arrays = [numpy_to_vtk(a, deep=True) for a in make_pairs()]
    losses = {name: {bits: [] for bits in BITS} for name, _, _ in METHODS}
    for environment in ("studio.exr", "interior.exr", "city.exr"):
        reader = vtkEnvironmentReader()
        reader.SetFileName(str(data / "environments" / environment))
        if not reader.Read():
            sys.exit(f"{environment} cannot be read")
        for material in MATERIALS:
            brdf = read_brdf(data, material)
            for name, method, sizes in METHODS:
                integrator = method()
                integrator.SetBRDF(brdf)
                integrator.SetEnvironment(reader.GetEnvironment())
                integrator.SetSizes(sizes)
                exact = measure(integrator, arrays)
                for bits in BITS:
                    integrator.SetFilterWeightBits(bits)
                    loss = np.abs(measure(integrator, arrays) - exact).sum() / exact.sum()
                    losses[name][bits].append(100.0 * loss)
    print("| relative L1, %: mean, largest | " + " | ".join(f"{bits} bits" for bits in BITS) + " |")
    print("|---" * (1 + len(BITS)) + "|")
    for name, values in losses.items():
        cells = (f"{np.mean(values[bits]):.2g}, {np.max(values[bits]):.2g}" for bits in BITS)
        print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
