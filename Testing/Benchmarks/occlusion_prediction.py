# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether the error of leaving occlusion out is what a few hundred traced points foretell: docs/methods/occlusion.md.

Meshes, materials and maps, against many more points as cameras all around see them, with other rays. A line of CSV for each mesh,
material and map, then how far the predictions were off. Errors, not times.
"""

import argparse
import itertools
import time

import vtkmeasuredbrdf as measured
from common import find_environment, find_material, get_error, get_stem, make, to_array, with_normals
from meshes import TORUS, join, make_helix, make_isosurface, make_machine_part, make_parametric, read
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

WITHIN = 1.5
LEAST = 0.002  # errors below a tenth of the usual tolerance count as this much: nobody asks for their ratio
MOST_PREDICTED = 6400  # points that a prediction sees: the first
MESHES = {
    "torus": lambda: with_normals(make_parametric(make(vtkParametricTorus, **TORUS), 50, 50), FeatureAngle=40.0),
    "isosurface": lambda: with_normals(make_isosurface(157.0), FeatureAngle=40.0),
    "molecule": lambda: join(make_helix()),
    "machine-part": lambda: join(make_machine_part()),
}


def draw_points(scene, count):
    """The last so many of the points that cameras all around see, and their views."""
    drawn, views = vtkPolyData(), vtkDoubleArray()
    assert scene.DrawVisiblePoints(count + MOST_PREDICTED, (0.0, 0.0, 0.0), drawn, views)
    first = max(drawn.GetNumberOfPoints() - count, 0)
    hits = vtkPolyData()
    hits.DeepCopy(drawn)
    hits.GetPoints().SetData(to_array(vtk_to_numpy(drawn.GetPoints().GetData())[first:]))
    arrays = hits.GetPointData()
    for array in [arrays.GetArray(k) for k in range(arrays.GetNumberOfArrays())]:
        arrays.AddArray(to_array(vtk_to_numpy(array)[first:], array.GetName()))
    return hits, to_array(vtk_to_numpy(views)[first:])


def measure(scene, points, material, environment, samples):
    integrator = make(measured.vtkTracedRadianceIntegrator, Scene=scene, BRDF=material, Environment=environment,
                      NumberOfSamples=samples, UnoccludedReference=False, Seed=1)  # fmt: skip
    radiance, unoccluded = vtkDoubleArray(), vtkDoubleArray()
    assert integrator.Integrate(*points, radiance, unoccluded)
    return get_error(vtk_to_numpy(unoccluded), vtk_to_numpy(radiance))[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--materials", nargs="+", required=True, help="files or embedded names")
    parser.add_argument("--environments", nargs="+", required=True, help="files or embedded names")
    parser.add_argument("--shapes", nargs="+", default=list(MESHES), help="those, or .vtp and .ply files")
    parser.add_argument("--points", type=int, default=10000, help="that errors are measured at")
    parser.add_argument("--samples", type=int, default=64, help="directions a point")
    options = parser.parse_args()

    print("mesh,triangles,material,environment,predicted,uncertainty,measured,cpu_seconds")
    factors, sure = [], 0
    for shape in options.shapes:
        scene = measured.vtkTracedScene()
        scene.AddSurface(MESHES[shape]() if shape in MESHES else with_normals(read(shape), FeatureAngle=40.0))
        points = draw_points(scene, options.points)
        for light, name in itertools.product(options.environments, options.materials):
            material, environment = find_material(name), find_environment(light)
            if not material or not environment:
                parser.error(f"{name}, {light}: not found")
            material.brdf.Prepare()
            predictor = make(measured.vtkOcclusionPredictor, Scene=scene, BRDF=material.brdf,
                             Environment=environment.environment)  # fmt: skip
            begin = time.process_time()
            assert predictor.Update()
            seconds = time.process_time() - begin
            predicted = predictor.GetError()
            found = measure(scene, points, material.brdf, environment.environment, options.samples)
            print(f"{get_stem(shape)},{scene.GetNumberOfTriangles()},{get_stem(name)},{get_stem(light)},{predicted:.5f},"
                  f"{predictor.GetUncertainty():.5f},{found:.5f},{seconds:.3f}", flush=True)  # fmt: skip
            ratio = max(predicted, LEAST) / max(found, LEAST)
            factors.append(max(ratio, 1.0 / ratio))
            sure += abs(predicted - found) <= predictor.GetUncertainty()
    good = sum(factor <= WITHIN for factor in factors)
    print(f"# {len(factors)}: within a factor of {WITHIN}: {100.0 * good / len(factors):.1f} %; worst factor {max(factors):.2f}; "
          f"within two standard errors: {100.0 * sure / len(factors):.1f} %")  # fmt: skip


if __name__ == "__main__":
    main()
