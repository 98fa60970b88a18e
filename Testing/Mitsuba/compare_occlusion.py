#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Radiance that leaves points of meshes, with what these hide, by Mitsuba 3: written down for a test that does without it.

    pip install mitsuba==3.5.2 numpy
    Testing/Mitsuba/compare_occlusion.py -o Testing/Mitsuba/occlusion.json

Three meshes with flat facets, two-sided and of a diffuse color, under a small map with a lamp. For each of some points:

direct          by Mitsuba's `direct` integrator: what is hidden is black
path            by its `path` integrator of depth 3: what is hidden reflects the sky's light once
...error        the standard error of the mean, from independent runs

The file holds all that the test needs: meshes, map, points, facets' normals, views.
"""

import argparse
import datetime
import json
import os
import sys
import tempfile

import numpy as np
from compare_mitsuba import Light, numbers, to_rows

WIDTH, HEIGHT = 32, 16  # of the map
COLOR = [0.8, 0.5, 0.3]
NUMBER_OF_POINTS = 40  # a mesh
RUNS = 8


def make_map():
    """Rows from the top, as Mitsuba's bitmaps: a sky that darkens downwards, and a lamp."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    sky = 0.2 + 0.8 * np.clip(1.0 - y / HEIGHT, 0.0, 1.0) ** 2 * (1.0 + 0.5 * np.cos(2.0 * np.pi * x / WIDTH))
    image = sky[:, :, None] * np.array([0.7, 0.8, 1.0])
    image[3:5, 20:22] += np.array([60.0, 50.0, 40.0])
    return image.astype(np.float32)


def make_grid(function, columns, rows, close_columns, close_rows):
    """Triangles of a parametric surface."""
    s, t = columns + (not close_columns), rows + (not close_rows)
    points = [function(a / columns, b / rows) for b in range(t) for a in range(s)]
    triangles = []
    for b in range(rows):
        for a in range(columns):
            p, q = b * s + a, b * s + (a + 1) % s
            r, u = ((b + 1) % t) * s + (a + 1) % s, ((b + 1) % t) * s + a
            triangles += [[p, q, r], [p, r, u]]
    return np.array(points, dtype=np.float32), np.array(triangles)


def torus(u, v):
    u, v = 2.0 * np.pi * u, 2.0 * np.pi * v
    return [(1.0 + 0.55 * np.cos(v)) * np.cos(u), -0.55 * np.sin(v), (1.0 + 0.55 * np.cos(v)) * np.sin(u)]


def hills(u, v):
    x, z = 4.0 * u - 2.0, 2.0 - 4.0 * v
    return [x, 0.5 * np.cos(3.0 * x) * np.cos(3.0 * z + 0.5 * x), z]


def box(low, high):
    """A closed box, facing outwards."""
    points = [[(low, high)[k >> c & 1][c] for c in range(3)] for k in range(8)]
    quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return points, [t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])]


def make_ribs():
    """A plate with ribs that stand on it."""
    points, triangles = [], []
    boxes = [([-2, -0.2, -1], [2, 0, 1])] + [([-1.8 + 0.7 * k, 0.001, -0.9], [-1.6 + 0.7 * k, 0.8, 0.9]) for k in range(6)]
    for low, high in boxes:
        more, faces = box(low, high)
        triangles += [[corner + len(points) for corner in face] for face in faces]
        points += more
    return np.array(points, dtype=np.float32), np.array(triangles)


def make_meshes():
    return {
        "torus": make_grid(torus, 32, 20, True, True),
        "hills": make_grid(hills, 32, 32, False, False),
        "ribs": make_ribs(),
    }


def write_ply(path, points, triangles):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n")
        file.write("property float x\nproperty float y\nproperty float z\n")
        file.write(f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines(" ".join(f"{value:.9g}" for value in point) + "\n" for point in points)
        file.writelines("3 " + " ".join(map(str, triangle)) + "\n" for triangle in triangles)


def draw_points(points, triangles, generator):
    """Points by area, inside triangles, on either side; views up to 60 degrees off the normal on that side."""
    corners = points[triangles].astype(np.float64)
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(cross, axis=1)
    chosen = generator.choice(len(area), NUMBER_OF_POINTS, p=area / area.sum())
    weights = 0.1 + 0.7 * generator.dirichlet([1.0, 1.0, 1.0], NUMBER_OF_POINTS)
    positions = (corners[chosen] * (weights / weights.sum(axis=1, keepdims=True))[:, :, None]).sum(axis=1)
    normals = cross[chosen] / area[chosen, None]
    tangents = corners[chosen, 1] - corners[chosen, 0]
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    theta = np.radians(60.0) * np.sqrt(generator.random(NUMBER_OF_POINTS))[:, None]
    phi = 2.0 * np.pi * generator.random(NUMBER_OF_POINTS)[:, None]
    across = np.cos(phi) * tangents + np.sin(phi) * np.cross(normals, tangents)
    return positions, normals, np.cos(theta) * normals + np.sin(theta) * across


def trace(mi, scene, integrator, origins, views, samples):
    """Mean and standard error for each point: rays from just before it."""
    import drjit as dr

    count = len(origins)
    means = np.zeros((RUNS, count, 3))
    for run in range(RUNS):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(run, count * samples)
        start = np.repeat(origins + 1e-3 * views, samples, axis=0)
        along = np.repeat(-views, samples, axis=0)
        ray = mi.RayDifferential3f(
            mi.Point3f(*(mi.Float(start[:, c].astype(np.float32)) for c in range(3))),
            mi.Vector3f(*(mi.Float(along[:, c].astype(np.float32)) for c in range(3))),
        )
        found, _, _ = integrator.sample(scene, sampler, ray)
        dr.eval(found)
        means[run] = to_rows(found).reshape(count, samples, 3).mean(axis=1)
    return means.mean(axis=0), means.std(axis=0, ddof=1) / np.sqrt(RUNS)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", required=True, help="JSON file to write")
    parser.add_argument("--samples", type=int, default=1 << 13, help="paths a point and run, of 8 runs (default 2^13)")
    arguments = parser.parse_args()
    try:
        import mitsuba as mi
    except ImportError:
        sys.exit("compare_occlusion.py: needs Mitsuba 3 (pip install mitsuba==3.5.2)")
    mi.set_variant("llvm_ad_rgb")
    mi.Thread.thread().logger().set_log_level(mi.LogLevel.Error)
    generator = np.random.default_rng(17)
    image = make_map()
    results = []
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "map.exr")
        mi.Bitmap(image).write(path)
        light = Light(mi, path)
        for name, (points, triangles) in make_meshes().items():
            mesh = os.path.join(folder, name + ".ply")
            write_ply(mesh, points, triangles)
            diffuse = {"type": "diffuse", "reflectance": {"type": "rgb", "value": COLOR}}
            surface = {"type": "ply", "filename": mesh, "face_normals": True}
            surface["bsdf"] = {"type": "twosided", "material": diffuse}
            scene = mi.load_dict({"type": "scene", "surface": surface, "light": light.description})
            positions, normals, views = draw_points(points, triangles, generator)
            # Half as many samples of each kind: their weights are combined.
            direct = mi.load_dict({"type": "direct"})
            paths = mi.load_dict({"type": "path", "max_depth": 3, "rr_depth": 100})
            figures = {}
            for kind, integrator in (("direct", direct), ("path", paths)):
                figures[kind], figures[kind + "_error"] = trace(mi, scene, integrator, positions, views, arguments.samples)
            noise = {kind: np.median(figures[kind + "_error"] / np.maximum(figures[kind], 1e-6)) for kind in ("direct", "path")}
            print(f"{name}: noise {noise['direct']:.2%} direct, {noise['path']:.2%} path", flush=True)
            record = {"position": positions, "normal": normals, "view": views, **figures}
            results.append(
                {
                    "mesh": name,
                    "points": [numbers(point) for point in points],
                    "triangles": triangles.tolist(),
                    "receivers": [{key: numbers(rows[k]) for key, rows in record.items()} for k in range(len(positions))],
                }
            )
    record = {
        "format": "measured-brdf mitsuba occlusion",
        "version": 1,
        "mitsuba": mi.__version__,
        "variant": mi.variant(),
        "date": datetime.date.today().isoformat(),
        "samples": RUNS * arguments.samples,
        "color": COLOR,
        "map": {"width": WIDTH, "height": HEIGHT, "rows_from_the_top": [numbers(pixel) for pixel in image.reshape(-1, 3)]},
        "results": results,
    }
    with open(arguments.output, "w", encoding="ascii") as file:
        json.dump(record, file)
        file.write("\n")


if __name__ == "__main__":
    main()
