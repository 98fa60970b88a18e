# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether plans keep what they say: the figures of docs/methods/promises.md.

Materials under maps, one plan for all views (or one for each picture, --for-view), and the error of the chosen method in pictures
of several shapes, against the reference. A line of CSV for each picture, then how many promises were broken, by how much, and how
far the predictions were off. Minutes for each tolerance; errors, not times.
"""

import argparse
import collections
import math
import os
import statistics
import time

import numpy as np
import vtkmeasuredbrdf as measured
from common import find_environment, find_material, get_error, get_stem, integrate, make, make_everywhere_pairs, to_array
from meshes import make_shape
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

PLANNED = 16384  # pixels that a plan for the view is given: others than are compared
EVERYWHERE = "everywhere"


def look(shape, count, turn):
    """Normals and views of about so many pixels in perspective, from an oblique direction; turn: of the camera about y."""
    if shape == EVERYWHERE:
        return make_everywhere_pairs(count)
    mesh = make_shape(shape)
    scene = measured.vtkTracedScene()
    scene.AddSurface(mesh)
    radius, c, s = 0.5 * mesh.GetLength(), math.cos(math.radians(turn)), math.sin(math.radians(turn))
    towards = np.array([c + 2.0 * s, 0.8, 2.0 * c - s])
    towards /= np.linalg.norm(towards)
    right = np.cross((0.0, 1.0, 0.0), towards)  # shorter than 1: pictures are wider than high
    side = int(math.sqrt(2.0 * count))
    at = 2.0 * (np.arange(side) + 0.5) / side - 1.0
    directions = radius * (at[None, :, None] * right + at[:, None, None] * np.cross(towards, right) - 4.0 * towards)
    eye = np.array(mesh.GetCenter()) + 4.0 * radius * towards
    hits = vtkPolyData()
    directions = directions.reshape(-1, 3)
    assert scene.CastRays(to_array(np.tile(eye, (len(directions), 1))), to_array(directions), hits)
    seen = vtk_to_numpy(hits.GetPointData().GetArray("Surface")) >= 0
    normals = vtk_to_numpy(hits.GetPointData().GetArray("Normals")).astype(float)[seen]
    views = eye - vtk_to_numpy(hits.GetPoints().GetData())[seen]
    views /= np.linalg.norm(views, axis=1, keepdims=True)
    normals *= np.where((normals * views).sum(axis=1) < 0.0, -1.0, 1.0)[:, None]  # as VTK turns them
    return normals, views


def get_reference(case, pairs, file):
    """It takes nearly all of the time, and does not change with the planner: it is kept in a file for the next run."""
    if file and os.path.exists(file):
        kept = np.load(file)
        if kept.shape == pairs[0].shape:
            return kept
    reference = integrate(*case, *pairs)
    if file:
        np.save(file, reference)
    return reference


def tell_ratios(name, ratios, sure):
    ratios = sorted(ratios)

    def share(low, high):
        return f"{100.0 * sum(low < ratio <= high for ratio in ratios) / len(ratios):.1f} %"

    print(f"# {name}: {len(ratios)}; measured / predicted: median {statistics.median_high(ratios):.2f}, worst {ratios[-1]:.2f}; "
          f"above 1: {share(1.0, 1e9)} ({sure} by more than two standard errors of the measurement), "
          f"above 1.25: {share(1.25, 1e9)}, within a factor of 2: {share(0.5, 2.0)}")  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--materials", nargs="+", required=True, help="files or embedded names")
    parser.add_argument("--environments", nargs="+", required=True, help="files or embedded names")
    parser.add_argument("--shapes", nargs="+", default=[EVERYWHERE, "sphere", "torus", "box", "isosurface", "plate"],
                        help="those above, knob, bumps or .vtp files")  # fmt: skip
    parser.add_argument("--tolerances", nargs="+", type=float, default=[0.02])
    parser.add_argument("--pixels", type=int, default=1000, help="of each picture, about")
    parser.add_argument("--for-view", action="store_true", help="one plan for each picture")
    parser.add_argument("--references", help="a folder that keeps the reference for the next run, of the same meshes and pixels")
    parser.add_argument("--refine", type=int, default=1, help="where an error plus two standard errors is above the promise, "
                        "measure it again with so many times the pixels; where it is still above, with the square of that")  # fmt: skip
    parser.add_argument("--turn", type=float, default=0.0, help="of the camera, in degrees: other pictures than usual")
    options = parser.parse_args()

    pictures = {}
    for shape in options.shapes:
        finer = [options.pixels * options.refine**k for k in range(3 if options.refine > 1 else 1)]
        pictures[shape] = [look(shape, count, options.turn) for count in (PLANNED, *finer)]
    print("material,environment,shape,pixels,tolerance,method,sizes,MB,cost,predicted,uncertainty,measured,deviation,tried,cpu")
    ratios, sure = collections.defaultdict(list), collections.Counter()
    for light in options.environments:
        for name in options.materials:
            material, environment = find_material(name), find_environment(light)
            if not material or not environment:
                parser.error(f"{name}, {light}: not found")
            tell_case(options, pictures, (material, environment), (get_stem(name), get_stem(light)), ratios, sure)
    for shape in options.shapes:
        tell_ratios(shape, ratios[shape], sure[shape])
    tell_ratios("all pictures", sum(ratios.values(), []), sum(sure.values()))


def tell_case(options, pictures, case, names, ratios, sure):
    """A material under a map: a line for each picture and tolerance."""
    material, environment = case
    planners = [make(measured.vtkRadiancePlanner, BRDF=material.brdf, Environment=environment.environment, ErrorTolerance=t)
                for t in options.tolerances]  # fmt: skip
    for shape, (planned, *compared) in pictures.items():
        for planner, tolerance in zip(planners, options.tolerances):
            if options.for_view:
                planner.SetPairs(*map(to_array, planned))
            begin = time.process_time()
            assert planner.Update()
            seconds = time.process_time() - begin
            choice = planner.GetChoice()
            predicted = planner.GetPredictedError(choice)
            for level, pairs in enumerate(compared):
                stem = "-".join((*names, get_stem(shape), str(level)))
                reference = get_reference(case, pairs, options.references and os.path.join(options.references, stem + ".npy"))
                radiance = integrate(*case, *pairs, method=planner.NewIntegrator())
                error, deviation = get_error(radiance, reference)
                if error + (2.0 * deviation if level == 0 else 0.0) <= predicted:
                    break
            print(f"{','.join(names)},{get_stem(shape)},{len(reference)},{tolerance:g},{planner.GetMethodName(choice)},"
                  f"\"{planner.GetDescription(choice)}\",{1e-6 * planner.GetTextureBytes(choice):.2f},"
                  f"{planner.GetPredictedCost(choice):.2f},{predicted:.5f},{planner.GetErrorUncertainty(choice):.5f},"
                  f"{error:.5f},{deviation:.5f},{planner.GetNumberOfCandidates()},{seconds:.2f}", flush=True)  # fmt: skip
            ratios[shape].append(error / max(predicted, 1e-6))
            sure[shape] += error - 2.0 * deviation > predicted


if __name__ == "__main__":
    main()
