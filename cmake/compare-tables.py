#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The error of radiance tables of a few sizes, over materials and maps, to compare two builds.

    compare-tables.py DATA OUT.json               DATA: materials/rgl, materials/mbsdf and environments
    compare-tables.py --against BEFORE.json OUT.json

Each figure is over 400 pairs of normal and view of a sphere that is seen from everywhere, against
vtkAdaptiveRadianceIntegrator: relative L1, and the 98th percentile of single pairs' errors, relative to their
radiance and a twentieth of the mean. PYTHONPATH: the build's lib/python3/dist-packages.
"""

import json
import math
import sys
from pathlib import Path

ENVIRONMENTS = ("studio.exr", "interior.exr", "city.exr")
PUBLISHED = ("blue-fabric", "gold-metallic-paint3", "nickel", "pink-felt", "gold-paint", "violet-rubber")
SIZES = ((33, 8, 8), (33, 12, 16), (33, 24, 16), (65, 12, 16))
PAIRS = 400


def make_pairs():
    import numpy as np

    random = np.random.default_rng(5)
    normals = random.normal(size=(PAIRS, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    tangents = np.cross(normals, random.normal(size=(PAIRS, 3)))
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    cosine = np.sqrt(random.random(PAIRS))[:, None]  # the disc of a sphere
    turn = 2.0 * np.pi * random.random(PAIRS)[:, None]
    level = np.cos(turn) * tangents + np.sin(turn) * np.cross(normals, tangents)
    return normals, cosine * normals + np.sqrt(1.0 - cosine**2) * level


def measure(data, out):
    import numpy as np
    from vtkmeasuredbrdf import (
        vtkAdaptiveRadianceIntegrator,
        vtkBRDFReader,
        vtkEmbeddedMaterials,
        vtkEnvironmentReader,
        vtkTableRadianceIntegrator,
    )
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkDoubleArray

    normals, views = make_pairs()
    files = sorted((data / "materials/rgl").glob("*.bsdf")) + sorted((data / "materials/mbsdf").glob("*.mbsdf"))
    figures = {}
    for name in ENVIRONMENTS:
        reader = vtkEnvironmentReader()
        reader.SetFileName(str(data / "environments" / name))
        reader.Read()
        for material in [*files, *PUBLISHED]:
            if isinstance(material, Path):
                brdf_reader = vtkBRDFReader()
                brdf_reader.SetFileName(str(material))
                brdf_reader.Read()
                brdf = brdf_reader.GetBRDF()
            else:
                brdf = vtkEmbeddedMaterials.NewBRDF(material)

            def integrate(integrator):
                integrator.SetBRDF(brdf)  # noqa: B023 (called at once)
                integrator.SetEnvironment(reader.GetEnvironment())  # noqa: B023
                radiance = vtkDoubleArray()
                if not integrator.Integrate(numpy_to_vtk(normals), numpy_to_vtk(views), radiance):
                    sys.exit(f"{integrator.GetClassName()} failed")
                return vtk_to_numpy(radiance).copy()

            reference = integrate(vtkAdaptiveRadianceIntegrator())
            scale = reference.mean(1) + 0.05 * reference.mean()
            row = []
            for sizes in SIZES:
                table = vtkTableRadianceIntegrator()
                table.SetNumberOfRows(sizes[0])
                table.SetNumberOfViewAngles(sizes[1])
                table.SetNumberOfAzimuths(sizes[2])
                difference = np.abs(integrate(table) - reference)
                row.append(100.0 * difference.sum() / reference.sum())
                row.append(100.0 * float(np.percentile(difference.mean(1) / scale, 98)))
            label = f"{Path(str(material)).stem} {Path(name).stem}"
            figures[label] = row
            print(f"{label:40}", *(f"{value:6.2f}" for value in row), flush=True)
    out.write_text(json.dumps(figures, indent=1))


def compare(before, after):
    old, new = json.loads(before.read_text()), json.loads(after.read_text())
    labels = [label for label in old if label in new]
    for k, what in enumerate(f"{sizes}, {kind}" for sizes in SIZES for kind in ("mean", "98th percentile")):
        ratios = [new[label][k] / old[label][k] for label in labels]
        mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
        worst = max(labels, key=lambda label: new[label][k] / old[label][k])
        print(f"{what}: {mean:.3f} of what it was; worst {max(ratios):.2f}, {worst}")


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[1] == "--against":
        compare(Path(sys.argv[2]), Path(sys.argv[3]))
    elif len(sys.argv) == 3:
        measure(Path(sys.argv[1]), Path(sys.argv[2]))
    else:
        sys.exit(__doc__)
