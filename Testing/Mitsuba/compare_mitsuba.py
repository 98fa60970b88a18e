#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Outgoing radiance of RGL materials by Mitsuba 3, written down for tests that do without it.

    pip install mitsuba==3.5.2 numpy
    Testing/Mitsuba/compare_mitsuba.py DATA -o Testing/Mitsuba/recorded.json

DATA holds materials/rgl/*_rgb.bsdf and environments/*.exr. For each (normal, view) pair:

sum             Mitsuba's `measured` BSDF times its `envmap` at the centers of the map's texels, times their exact solid
                angles: no noise. As this project does, negative values are taken as 0. What it checks: reading the
                file, the BSDF, which of the two directions is the light's, frames, how the map lies, solid angles.
integral        the same over POINTS x POINTS points of each texel, where `envmap` interpolates: what radiance is between
                texels, too.
sampled         the integral by Mitsuba's own sampling of its `envmap` (sample_direction); standard_error is that of the
                mean over independent runs. Negative values stay.
integral_unclamped
                the integral with negative values as they are, which is what `sampled` converges to.

In all, the light's direction is the first of `measured`, as the files have it. A path tracer puts the camera's there,
which gives something else: these measurements are not reciprocal.

Mitsuba's envmap and this project's both interpolate linearly between texels, but the first and last rows of Mitsuba's
lie on the poles. It gets a larger map, which has a row wherever one of this project's bends: the same function.
"""

import argparse
import datetime
import json
import os
import re
import sys

import numpy as np

MATERIALS = (
    "acrylic_felt_pink cardboard cc_ibiza_sunset chm_light_blue irid_flake_paint2 paper_blue satin_purple vch_ultra_pink"
).split()
ENVIRONMENTS = ["studio", "interior"]
NUMBER_OF_PAIRS = 12
POINTS = 4  # of each texel, per axis
ROWS, COLUMNS = 2, 3  # of the larger map, per texel
RUNS = 8


def make_pairs():
    """Normals all over the sphere; views from 5 to 75 degrees off them, in all azimuths: every second pair."""
    pairs = []
    for k in range(NUMBER_OF_PAIRS):
        y = 1.0 - (2.0 * k + 1.0) / NUMBER_OF_PAIRS
        phi = k * np.pi * (3.0 - np.sqrt(5.0))
        normal = np.array([np.sqrt(1.0 - y * y) * np.cos(phi), y, np.sqrt(1.0 - y * y) * np.sin(phi)])
        tangent, bitangent = make_frame(normal)
        theta = np.radians(5.0 + 70.0 * ((5 * k) % NUMBER_OF_PAIRS) / (NUMBER_OF_PAIRS - 1.0))
        turn = 2.4 * k
        across = np.cos(turn) * tangent + np.sin(turn) * bitangent
        pairs.append((normal, np.cos(theta) * normal + np.sin(theta) * across))
    return pairs[::2]


def make_frame(normal):
    tangent = np.cross([0.0, 1.0, 0.0] if abs(normal[1]) < 0.9 else [1.0, 0.0, 0.0], normal)
    tangent /= np.linalg.norm(tangent)
    return tangent, np.cross(normal, tangent)


class Light:
    """An environment as Mitsuba sees it, its texels and finer points."""

    def __init__(self, mi, path):
        image = mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        image = np.maximum(np.array(image), 0.0)
        height, width = image.shape[:2]
        # The first and the last row are the poles; both maps' columns begin half a column from the seam.
        up = np.clip(np.arange(ROWS * height + 1) / ROWS - 0.5, 0.0, height - 1.0)
        across = (np.arange(COLUMNS * width) + 0.5) / COLUMNS - 0.5
        low, left = np.floor(up).astype(int), np.floor(across).astype(int)
        rows = mix(image[low], image[np.minimum(low + 1, height - 1)], (up - low)[:, None, None])
        large = mix(rows[:, left % width], rows[:, (left + 1) % width], (across - left)[None, :, None])
        large = np.ascontiguousarray(large, dtype=np.float32)
        # Its azimuth starts elsewhere: u = atan2(x, -z) / 2 pi there, atan2(z, x) / 2 pi + 1/2 here.
        turn = mi.ScalarTransform4f(
            mi.ScalarMatrix4f([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
        )
        self.description = {"type": "envmap", "bitmap": mi.Bitmap(large), "to_world": turn}

        self.texels = Points(mi, self.description, width, height)
        self.points = Points(mi, self.description, POINTS * width, POINTS * height)


class Points:
    """Directions of a map's texels, their solid angles, and the radiance there."""

    def __init__(self, mi, description, width, height):
        polar = (np.arange(height) + 0.5) / height * np.pi
        azimuth = ((np.arange(width) + 0.5) / width - 0.5) * 2.0 * np.pi
        polar, azimuth = (a.ravel() for a in np.meshgrid(polar, azimuth, indexing="ij"))
        self.directions = np.stack(
            [np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)], axis=-1
        )
        edges = np.cos(np.arange(height + 1) / height * np.pi)
        self.solid_angles = np.repeat((edges[:-1] - edges[1:]) * 2.0 * np.pi / width, width)
        self.radiance = evaluate_envmap(mi, description, self.directions)


def mix(first, second, weight):
    return first.astype(np.float64) * (1.0 - weight) + second.astype(np.float64) * weight


def to_vectors(mi, array):
    return mi.Vector3f(*(mi.Float(np.ascontiguousarray(array[:, c], dtype=np.float32)) for c in range(3)))


def to_rows(array):
    array = np.array(array, dtype=np.float64)
    return array if array.shape[-1] == 3 else array.T


def evaluate_envmap(mi, description, directions):
    import drjit as dr

    interaction = dr.zeros(mi.SurfaceInteraction3f, len(directions))
    interaction.wi = to_vectors(mi, -directions)
    return to_rows(mi.load_dict(description).eval(interaction))


def evaluate_bsdf(mi, bsdf, lights, view):
    """f for rows of directions to the light; local frame."""
    import drjit as dr

    interaction = dr.zeros(mi.SurfaceInteraction3f, len(lights))
    interaction.wi = to_vectors(mi, lights)
    # eval takes the second direction's cosine in.
    return to_rows(bsdf.eval(mi.BSDFContext(), interaction, mi.Vector3f(*map(float, view)))) / view[2]


def sum_points(mi, bsdf, points, normal, view):
    """The radiance, and the same with negative values of the BSDF."""
    frame = np.stack([*make_frame(normal), normal], axis=-1)
    local = points.directions @ frame
    lit = local[:, 2] > 0.0
    f = evaluate_bsdf(mi, bsdf, local[lit], view @ frame)
    arriving = points.radiance[lit] * (points.solid_angles[lit] * local[lit, 2])[:, None]
    return (np.maximum(f, 0.0) * arriving).sum(axis=0), (f * arriving).sum(axis=0)


def sample(mi, bsdf, light, pairs, runs, samples):
    """Mean and standard error of the radiance of each pair, by sampling the light."""
    import drjit as dr

    emitter = mi.load_dict(light.description)
    means = np.zeros((len(pairs), runs, 3))
    for run in range(runs):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(run, samples)
        found, weight = emitter.sample_direction(dr.zeros(mi.Interaction3f, samples), sampler.next_2d())
        directions, weight = to_rows(found.d), to_rows(weight)
        for k, (normal, view) in enumerate(pairs):
            frame = np.stack([*make_frame(normal), normal], axis=-1)
            local = directions @ frame
            lit = local[:, 2] > 0.0
            f = evaluate_bsdf(mi, bsdf, local[lit], view @ frame)
            means[k, run] = (f * weight[lit] * local[lit, 2, None]).sum(axis=0) / samples
    return means.mean(axis=1), means.std(axis=1, ddof=1) / np.sqrt(runs)


def numbers(values):
    return [float(f"{value:.8g}") for value in values]


def write_record(path, record):
    """JSON with a line for each pair."""

    def join(match):
        return re.sub(r"\s+", " ", match[0])

    text = re.sub(r"\[[^][{}]*\]", join, json.dumps(record, indent=1))
    with open(path, "w", encoding="ascii") as file:
        file.write(re.sub(r"\{[^{}]*\}", join, text) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", metavar="DATA", help="folder with materials/rgl and environments")
    parser.add_argument("-o", "--output", required=True, help="JSON file to write")
    parser.add_argument("--samples", type=int, default=1 << 18, help="samples of the light a run, of 8 runs (default 2^18)")
    arguments = parser.parse_args()
    try:
        import mitsuba as mi
    except ImportError:
        sys.exit("compare_mitsuba.py: needs Mitsuba 3 (pip install mitsuba==3.5.2)")
    mi.set_variant("llvm_ad_rgb")
    mi.Thread.thread().logger().set_log_level(mi.LogLevel.Error)

    results = []
    for k, environment in enumerate(ENVIRONMENTS):
        light = Light(mi, os.path.join(arguments.data, "environments", environment + ".exr"))
        for name in MATERIALS[k :: len(ENVIRONMENTS)]:  # half of them under each
            path = os.path.join(arguments.data, "materials", "rgl", name + "_rgb.bsdf")
            bsdf = mi.load_dict({"type": "measured", "filename": path})
            means, errors = sample(mi, bsdf, light, make_pairs(), RUNS, arguments.samples)
            pairs = []
            for (normal, view), mean, error in zip(make_pairs(), means, errors):
                clamped, _ = sum_points(mi, bsdf, light.texels, normal, view)
                integral, unclamped = sum_points(mi, bsdf, light.points, normal, view)
                pairs.append(
                    {
                        "normal": numbers(normal),
                        "view": numbers(view),
                        "sum": numbers(clamped),
                        "integral": numbers(integral),
                        "integral_unclamped": numbers(unclamped),
                        "sampled": numbers(mean),
                        "standard_error": numbers(error),
                    }
                )
            results.append({"material": name, "environment": environment, "pairs": pairs})
            off = np.array([np.array(p["sampled"]) / p["integral_unclamped"] - 1.0 for p in pairs])
            noise = np.array([np.array(p["standard_error"]) / p["integral_unclamped"] for p in pairs])
            print(
                f"{name}, {environment}: sampled against integrated: median {np.median(np.abs(off)):.2%}, "
                f"worst {np.abs(off).max():.2%}, noise {np.median(noise):.2%}",
                flush=True,
            )
    record = {
        "format": "measured-brdf mitsuba comparison",
        "version": 2,
        "mitsuba": mi.__version__,
        "variant": mi.variant(),
        "date": datetime.date.today().isoformat(),
        "samples": RUNS * arguments.samples,
        "results": results,
    }
    write_record(arguments.output, record)


if __name__ == "__main__":
    main()
