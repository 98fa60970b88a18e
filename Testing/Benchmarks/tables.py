# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables beside what they compete with, at a thousand pairs of a sphere that is seen from everywhere.

The time to prepare, the error against the reference and the memory of the textures: the tables of docs/methods/hybrids.md (many
rows against maps of the sharp part, with lights for lamps in both) and docs/methods/anisotropic.md (brushed metal against sums
over soft lights). And the processor time of a pair of directions in arrays, for docs/pyvista.md.
"""

import argparse
import itertools
import time

import numpy as np
import vtkmeasuredbrdf as measured
from common import (
    Material,
    find_environment,
    find_material,
    get_stem,
    integrate,
    make,
    make_brushed,
    make_everywhere_pairs,
    tell_header,
    tell_prepare,
    tell_row,
)

HYBRIDS = ((129, 8, 8, 0), (129, 12, 16, 0), (257, 8, 8, 0), (128, 12, 8, 8), (128, 12, 8, 16), (256, 12, 8, 8))
CASES = (  # lights at most: none for chrome, which is narrower than a lamp
    *(("rgl/chm_light_blue_rgb.bsdf", light, 16) for light in ("studio.exr", "interior.exr", "sunset.exr")),
    *(("rgl/irid_flake_paint2_rgb.bsdf", light, 16) for light in ("studio.exr", "interior.exr")),
    ("mbsdf/carpaint_blue.mbsdf", "city.exr", 16),
    ("nickel", "room", 16),
    ("chrome", "sky", 0),
)
WIDTHS = ((0.2, 0.5), (0.1, 0.4), (0.05, 0.3))
MAPS = ("room", "sky", *(name + ".exr" for name in ("studio", "interior", "city", "forest", "sunset")), "pmndrs_sunrise.hdr")
ANISOTROPIC = ((17, 8, 16, 8), (25, 8, 20, 8), (33, 6, 24, 6), (33, 8, 32, 8), (49, 8, 32, 8))
LIGHTS = (16, 32, 64, 128, 256)
PAIRS = 1 << 16


def make_pairs(material, environment):
    normals, views = make_everywhere_pairs(1000)
    return normals, views, integrate(material, environment, normals, views)


def tell_hybrids():
    for name, light, lights in CASES:
        material, environment = find_material(name), find_environment(light)
        if not material or not environment:
            continue  # no measured data
        pairs = make_pairs(material, environment)
        for sizes in HYBRIDS:  # and lamps of 0.6 degrees
            tell_prepare(f"{get_stem(name)}, {get_stem(light)}", material.brdf, environment.environment,
                         measured.vtkHybridRadianceIntegrator(), (*sizes, lights, 6), pairs)  # fmt: skip


def tell_anisotropic():
    for widths, light in itertools.product(WIDTHS, MAPS):
        environment = find_environment(light)
        if not environment:
            continue
        material = make_brushed(*widths)
        pairs = make_pairs(material, environment)
        title = f"{widths}, {get_stem(light)}"
        for sizes in ANISOTROPIC:
            table = measured.vtkTableRadianceIntegrator()
            tell_prepare(title, material, environment.environment, table, sizes, pairs)
        for count in LIGHTS:
            lights = make(measured.vtkLightSetRadianceIntegrator, SoftLights=True)
            tell_prepare(title, material, environment.environment, lights, (count,), pairs)


def tell_arrays():
    random = np.random.default_rng(1)
    directions = random.normal(size=(2, PAIRS, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    directions[..., 2] = np.abs(directions[..., 2])
    for name in ("gold-paint", "blue-car-paint", "rgl/satin_purple_rgb.bsdf"):
        material = find_material(name)
        if not material:
            continue
        cells = []
        for kind in (np.float64, np.float32):
            i, o = directions.astype(kind)
            least = np.inf
            for _ in range(30):
                begin = time.process_time()
                Material.evaluate(material, i, o)
                least = min(least, time.process_time() - begin)
            cells.append(f"{1e9 * least / PAIRS:.0f} ns")
        tell_row(name, *cells)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", choices=("hybrids", "anisotropic", "arrays"))
    part = parser.parse_args().part
    if part == "arrays":
        tell_header("", "NumPy, double", "NumPy, float")
        tell_arrays()
        return
    tell_header("", "sizes", "prepare, ms", "error, %", "MB")
    tell_hybrids() if part == "hybrids" else tell_anisotropic()


if __name__ == "__main__":
    main()
