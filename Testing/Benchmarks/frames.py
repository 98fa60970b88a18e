# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frames of every method beside VTK's PBR under image-based light, on the renderer at hand: docs/graphics-card.md's tables.

A sphere of 64,000 triangles and a mesh of half a million in windows of several sizes (time by the clock, as an application waits
for it), what one pixel costs, and what self-occlusion adds.
"""

import argparse
import math
import statistics
import tempfile
import time

import numpy as np
import vtkmeasuredbrdf as measured
from common import (
    Material,
    Picture,
    make,
    make_brushed,
    make_bumps,
    make_layers,
    make_mapper,
    make_sphere,
    tell_header,
    tell_row,
    time_in_turns,
)
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

SIZES = ((500, 500), (1920, 1080), (3840, 2160))
SLOWEST = 1000.0  # ms: frames beyond are not drawn again


def make_table(*sizes, maps=0, lights=0):
    table = make(measured.vtkHybridRadianceIntegrator, NumberOfMaps=maps)
    table.SetSizes(list(sizes))
    table.SetMaximumNumberOfLights(lights)
    return table


def make_anisotropic_table():
    table = measured.vtkTableRadianceIntegrator()
    table.SetSizes([33, 8, 32, 8])
    return table


def make_samples(count):
    return make(measured.vtkFilteredRadianceIntegrator, NumberOfSamples=count)


def make_lights(count, soft=False):
    lights = make(measured.vtkLightSetRadianceIntegrator, NumberOfLights=count, SoftLights=soft)
    if not soft:
        lights.SetGenerator(measured.vtkLightSetGenerator())
    return lights


def make_large_table():
    """A material of MERL's size; values do not matter for the time."""
    with tempfile.NamedTemporaryFile(suffix=".binary") as file:
        np.array([90, 90, 180], np.int32).tofile(file)
        (0.1 + 0.05 * np.sin(0.001 * np.arange(3 * 90 * 90 * 180))).tofile(file)
        file.flush()
        return Material(file.name).brdf


def make_basis(order):
    """The thesis's functions, (order + 1)^2 of them."""
    projector = make(measured.vtkBasisProjector, Input=Material("blue-fabric").brdf,
                     Basis=measured.vtkBasisBRDF.SPHERICAL_HARMONICS, Order=order)  # fmt: skip
    projector.Project()
    return projector.GetOutput()


def get_methods():
    """(name, material, integrator): no material is VTK's PBR, no integrator is the planner's choice."""
    paint, nickel = Material("gold-paint").brdf, Material("nickel").brdf
    brushed = make_brushed(0.1, 0.4)
    return [
        ("VTK's PBR", None, None),
        ("AUTO, gold paint", paint, None),
        ("AUTO, nickel", nickel, None),
        ("AUTO, Lambert", measured.vtkLambertBRDF(), None),
        ("table, 33 x 12 x 16", paint, make_table(33, 12, 16, 0, 0, 12)),
        ("table, 129 x 20 x 16", paint, make_table(129, 20, 16, 0, 0, 12)),
        ("table and 16 lamps", nickel, make_table(33, 12, 16, 0, 0, 12, lights=16)),
        ("table, 16 maps and 16 lamps", nickel, make_table(128, 12, 8, maps=16, lights=16)),
        ("anisotropic table, 33 x 8 x 32 x 8", brushed, make_anisotropic_table()),
        ("16 filtered samples", paint, make_samples(16)),
        ("64 filtered samples", paint, make_samples(64)),
        ("16 lights, closed form", paint, make_lights(16)),
        ("64 lights, closed form", paint, make_lights(64)),
        ("256 lights, closed form", paint, make_lights(256)),
        ("64 lights, table of MERL's size", make_large_table(), make_lights(64)),
        ("64 lights, thesis, order 6", make_basis(6), make_lights(64)),
        ("64 soft lights, brushed", brushed, make_lights(64, soft=True)),
    ]


def make_picture(method, surface, size):
    _, material, integrator = method
    hall = measured.vtkEmbeddedEnvironments.NewEnvironment("hall")
    if material is None:
        return Picture(vtkPolyDataMapper(), surface, size, 1.0, pbr=hall)
    mapper = make_mapper(material, hall, integrator)
    mapper.GlobalWarningDisplayOff()  # brushed metal on surfaces without tangents
    return Picture(mapper, surface, size, 1.0)


def time_methods(methods, surface, size, rounds):
    return time_in_turns([make_picture(method, surface, size) for method in methods], rounds, slowest=SLOWEST)


def tell(value):
    return "-" if math.isnan(value) else f"{value:.3g}"


def tell_frames(title, methods, surface, sizes, rounds):
    columns = [time_methods(methods, surface, size, rounds) for size in sizes]
    print(f"\n{title}, {surface.GetNumberOfPolys()} triangles; ms\n")
    tell_header("", *(word for size in sizes for word in ("%d x %d" % size, "/ PBR")))
    for k, (name, _, _) in enumerate(methods):
        tell_row(name, *(tell(value) for column in columns for value in (column[k], column[k] / column[0])))


def tell_pixels(methods, size, layers, rounds):
    few = time_methods(methods, make_layers(1), size, rounds)  # what a frame takes besides
    many = time_methods(methods, make_layers(layers), size, rounds)
    pixels = size[0] * size[1] * (layers - 1)
    print("\nA pixel, of %d layers of %d x %d; ns\n" % (layers, *size))
    tell_header("", "ns", "/ PBR")
    for k, (name, _, _) in enumerate(methods):
        tell_row(name, tell(1e6 * (many[k] - few[k]) / pixels), tell((many[k] - few[k]) / (many[0] - few[0])))


def tell_occlusion(methods, size, rounds):
    """What a surface hides from itself: without its arrays, with them while the light rests, and while it turns."""
    visibility = measured.vtkSurfaceVisibilityFilter()
    visibility.SetInputData(make_bumps(0.05, 12.0, 10.0, 1.0))
    begin = time.perf_counter()
    visibility.Update()
    surface = visibility.GetOutput()
    print("\nSelf-occlusion, %d x %d, %d triangles, traced in %.3g s; ms\n"
          % (*size, surface.GetNumberOfPolys(), time.perf_counter() - begin))  # fmt: skip
    tell_header("", "without", "light rests", "light turns")
    for method in methods:
        if method[1] is None or method[2] is not None:
            continue  # AUTO only
        pictures = [make_picture(method, surface, size) for _ in range(3)]
        pictures[0].mapper.SetOcclusionModeToOff()
        pictures[1].mapper.SetOcclusionModeToOn()
        pictures[2].mapper.SetOcclusionModeToOn()
        times = [[], [], []]
        for turn in range(-2, rounds):
            for found, picture in zip(times, pictures):
                picture.draw()
                if picture is pictures[2]:
                    picture.mapper.GetEnvironment().SetRotationY(2.0 * turn)
                found.append(picture.draw())
        tell_row(method[0], *(tell(statistics.median(found[2:])) for found in times))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15, help="frames of each kind in turns")
    parser.add_argument("--largest", type=int, default=2160, help="height of the largest window; 500 for software renderers")
    parser.add_argument("--part", choices=("occlusion", "sphere", "bumps", "pixels"))
    options = parser.parse_args()
    sizes = [size for size in SIZES if size[1] <= options.largest] or SIZES[:1]
    methods = get_methods()
    probe = make_picture(methods[0], make_layers(1), (100, 100))
    probe.draw()
    renderer = next(line for line in probe.window.ReportCapabilities().splitlines() if "renderer string" in line)
    print("Renderer:", renderer.partition(":")[2])
    if options.part in (None, "occlusion"):
        tell_occlusion(methods, sizes[-1], options.rounds)
    if options.part in (None, "sphere"):
        tell_frames("A sphere", methods, make_sphere(1.0), sizes, options.rounds)
    if options.part in (None, "bumps"):
        tell_frames("A sphere with bumps", methods, make_bumps(0.05, 12.0, 10.0, 1.0), sizes, options.rounds)
    if options.part in (None, "pixels"):
        tell_pixels(methods, sizes[:2][-1], 8 if options.largest > 1080 else 3, options.rounds)


if __name__ == "__main__":
    main()
