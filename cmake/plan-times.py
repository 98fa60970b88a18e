#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""How long plans take for materials that are new under a map that is known: plan-times.py DATA [TOLERANCE].

DATA: materials/rgl, materials/mbsdf and environments. PYTHONPATH: the build's lib/python3/dist-packages. Plans on disk
are not used.
"""

import sys
import time
from pathlib import Path

from vtkmeasuredbrdf import vtkBRDFReader, vtkEmbeddedMaterials, vtkEnvironmentReader, vtkRadiancePlanner

ENVIRONMENTS = ("studio.exr", "interior.exr", "city.exr", "sunset.exr")
PUBLISHED = ("blue-fabric", "gold-metallic-paint3", "violet-rubber", "nickel", "pink-felt", "gold-paint")


def read(reader, path):
    reader.SetFileName(str(path))
    if not reader.Read():
        sys.exit(f"{path} can't be read")
    return reader


def plan(brdf, environment, tolerance):
    planner = vtkRadiancePlanner()
    planner.SetBRDF(brdf)
    planner.SetEnvironment(environment)
    planner.SetErrorTolerance(tolerance)
    start = time.perf_counter()
    if not planner.Update():
        sys.exit("no plan")
    return time.perf_counter() - start, planner


def main(data, tolerance):
    files = sorted((data / "materials/rgl").glob("*.bsdf")) + sorted((data / "materials/mbsdf").glob("*.mbsdf"))
    materials = {path.stem: read(vtkBRDFReader(), path).GetBRDF() for path in files}
    materials.update((name, vtkEmbeddedMaterials.NewBRDF(name)) for name in PUBLISHED)
    for name in ENVIRONMENTS:
        environment = read(vtkEnvironmentReader(), data / "environments" / name).GetEnvironment()
        plan(vtkEmbeddedMaterials.NewBRDF("pink-felt"), environment, tolerance)  # the map is known from here on
        for material, brdf in materials.items():
            brdf.Prepare()
            seconds, planner = plan(brdf, environment, tolerance)
            print(f"{material:26} {name:13} {seconds:5.2f} s  {planner.GetPlan().split(':')[0]}", flush=True)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) == 3 else 0.02)
