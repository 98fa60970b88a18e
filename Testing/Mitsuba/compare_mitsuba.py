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
sampled         the integral by Mitsuba's own sampling of its `envmap` (sample_direction), whose radiance is a function
                of the direction, not of texels; standard_error is that of the mean over independent runs. Negative
                values stay.
sum_unclamped   the sum with negative values as they are, which is what `sampled` converges to but for the difference
                between texels' centers and texels.

In both the light's direction is the first of `measured`, as the files have it. A path tracer puts the camera's there,
which gives something else: these measurements are not reciprocal.

Mitsuba's envmap interpolates between texels, and its first and last rows lie on the poles. It gets each texel's value
several times instead, so that it is the piecewise constant map that this project takes an environment for.
"""

import argparse
import datetime
import json
import os
import sys

import numpy as np

MATERIALS = "acrylic_felt_pink cardboard cc_ibiza_sunset paper_blue satin_purple vch_ultra_pink".split()
ENVIRONMENTS = ["studio", "interior"]
NUMBER_OF_PAIRS = 12
REPEAT = 4  # of each texel, per axis
RUNS = 8


def make_pairs():
    """Normals all over the sphere; views from 5 to 75 degrees off them, in all azimuths."""
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
    return pairs


def make_frame(normal):
    tangent = np.cross([0.0, 1.0, 0.0] if abs(normal[1]) < 0.9 else [1.0, 0.0, 0.0], normal)
    tangent /= np.linalg.norm(tangent)
    return tangent, np.cross(normal, tangent)


class Light:
    """An environment as Mitsuba sees it, and its texels."""

    def __init__(self, mi, path):
        image = mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        image = np.maximum(np.array(image), 0.0)
        height, width = image.shape[:2]
        nodes = np.arange(REPEAT * height + 1) / (REPEAT * height)  # rows of the large map, 0 and 1 the poles
        rows = np.minimum((nodes * height).astype(int), height - 1)
        large = np.ascontiguousarray(np.repeat(image[rows], REPEAT, axis=1))
        # Its azimuth starts elsewhere: u = atan2(x, -z) / 2 pi there, atan2(z, x) / 2 pi + 1/2 here.
        turn = mi.ScalarTransform4f(
            mi.ScalarMatrix4f([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
        )
        self.description = {"type": "envmap", "bitmap": mi.Bitmap(large), "to_world": turn}

        polar = (np.arange(height) + 0.5) / height * np.pi
        azimuth = ((np.arange(width) + 0.5) / width - 0.5) * 2.0 * np.pi
        polar, azimuth = (a.ravel() for a in np.meshgrid(polar, azimuth, indexing="ij"))
        self.directions = np.stack(
            [np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)], axis=-1
        )
        edges = np.cos(np.arange(height + 1) / height * np.pi)
        self.solid_angles = np.repeat((edges[:-1] - edges[1:]) * 2.0 * np.pi / width, width)
        self.radiance = evaluate_envmap(mi, self.description, self.directions)


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


def sum_texels(mi, bsdf, light, normal, view):
    """The radiance, and the same with negative values of the BSDF."""
    frame = np.stack([*make_frame(normal), normal], axis=-1)
    local = light.directions @ frame
    lit = local[:, 2] > 0.0
    f = evaluate_bsdf(mi, bsdf, local[lit], view @ frame)
    arriving = light.radiance[lit] * (light.solid_angles[lit] * local[lit, 2])[:, None]
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
    for environment in ENVIRONMENTS:
        light = Light(mi, os.path.join(arguments.data, "environments", environment + ".exr"))
        for name in MATERIALS:
            path = os.path.join(arguments.data, "materials", "rgl", name + "_rgb.bsdf")
            bsdf = mi.load_dict({"type": "measured", "filename": path})
            means, errors = sample(mi, bsdf, light, make_pairs(), RUNS, arguments.samples)
            pairs = []
            for (normal, view), mean, error in zip(make_pairs(), means, errors):
                clamped, unclamped = sum_texels(mi, bsdf, light, normal, view)
                pairs.append(
                    {
                        "normal": numbers(normal),
                        "view": numbers(view),
                        "sum": numbers(clamped),
                        "sum_unclamped": numbers(unclamped),
                        "sampled": numbers(mean),
                        "standard_error": numbers(error),
                    }
                )
            results.append({"material": name, "environment": environment, "pairs": pairs})
            off = np.array([np.array(p["sampled"]) / p["sum_unclamped"] - 1.0 for p in pairs])
            noise = np.array([np.array(p["standard_error"]) / p["sum_unclamped"] for p in pairs])
            print(
                f"{name}, {environment}: sampled against summed: median {np.median(np.abs(off)):.2%}, "
                f"worst {np.abs(off).max():.2%}, noise {np.median(noise):.2%}",
                flush=True,
            )
    record = {
        "format": "measured-brdf mitsuba comparison",
        "version": 1,
        "mitsuba": mi.__version__,
        "variant": mi.variant(),
        "date": datetime.date.today().isoformat(),
        "samples": RUNS * arguments.samples,
        "results": results,
    }
    with open(arguments.output, "w", encoding="ascii") as file:
        json.dump(record, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
