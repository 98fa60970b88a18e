# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a pixel of a radiance table pays: frames with one group of the shader's instructions replaced by next to nothing.

They are drawn in turns with the whole shader and VTK's PBR: the tables of docs/methods/pixel-cost.md and docs/graphics-card.md.
Frames are for software renderers, and take processor time of all threads. `--pixels` is for graphics cards: time by the clock
of layers of squares in a large window, of which all pixels are shaded.
"""

import argparse
import time

import vtkmeasuredbrdf as measured
from common import Material, Picture, make_bumps, make_layers, make_mapper, make_sphere, tell_header, tell_row, time_in_turns
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

LAYERS = 16
WINDOW = (1920, 1080)  # for pixels

# Text of the shader and what stands in its place.
TABLE = {
    "two fetches of the table": {"texture(brdfTableRadiance0, at).rgb": "at"},
    "the fetch of irradiance, and its octahedron": {"texture(brdfTableIrradiance0, normalAt).rgb": "vec3(0.5)"},
    "the profile's texels": {
        "texelFetch(brdfTableProfile0, ivec2(view, 0), 0)": "vec4(rest)",
        "texelFetch(brdfTableProfile0, ivec2(view, 1), 0)": "vec4(0.5)",
    },
    "the view's angle: an arc tangent, a root, a power": {
        "max(1.0 - brdfQuadrant(sine, o.z) / brdfTableLastView0, 0.0)": "o.z",
        "(1.0 - sqrt(rest))": "rest",
        "pow(rest, 2.0 / 3.0)": "rest",
    },
    "the axis' azimuth and polar angle: two arc tangents": {
        "return vec2(brdfTurn(azimuth), 0.5 * (d.y >= 0.0 ? polar : 2.0 - polar));": "return azimuth;",
    },
    "psi: an arc tangent": {"float psi = brdfTurn(turn);": "float psi = turn.x;"},
    "the output's powers": {"pow(brdfRadiance, vec3(1.0 / 2.2))": "brdfRadiance"},
}
TABLE["all of these"] = {text: other for group in TABLE.values() for text, other in group.items()}
LAMPS = {
    "the material's values": {"brdfMember0Evaluate(i.z > 0.0 ? i : vec3(0.0, 0.0, 1.0), o)": "i"},
    "lamps after the first that is found": {"while (found != 0)": "while (false)"},
    "lamps": {"brdfAddLamps0(frame, o, d, lambert)": "vec3(0.0)"},
}
CASES = (("A table", "gold-paint", 0, TABLE), ("A table and lamps", "nickel", 16, LAMPS))


def time_groups(case, surface, rounds, now, **view):
    """Median frames of VTK's PBR, of the whole shader, and without each group."""
    _, name, lights, groups = case
    hall = measured.vtkEmbeddedEnvironments.NewEnvironment("hall")
    table = measured.vtkHybridRadianceIntegrator()
    table.SetSizes([33, 12, 16, 0, lights, 12])
    pictures = [Picture(vtkPolyDataMapper(), surface, pbr=hall, **view)]
    for texts in ({}, *groups.values()):
        picture = Picture(make_mapper(Material(name).brdf, hall, table), surface, **view)
        for text, other in texts.items():
            picture.actor.GetShaderProperty().AddFragmentShaderReplacement(text, False, other, True)
        pictures.append(picture)
    return time_in_turns(pictures, rounds, now)


def tell(case, title, unit, times):
    print(f"\n{case[0]}: {title}\n")
    tell_header("", unit, "relative to PBR", "share of the whole")
    names = ["VTK's PBR", "whole", *("without " + group for group in case[3])]
    for name, value in zip(names, times):
        tell_row(name, f"{value:.3g}", f"{value / times[0]:.3g}", f"{100.0 * (times[1] - value) / times[1]:.3g} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--pixels", action="store_true")
    options = parser.parse_args()
    for case in CASES:
        if options.pixels:
            view = {"now": time.perf_counter, "size": WINDOW, "radius": 1.0}
            one = time_groups(case, make_layers(1), options.rounds, **view)  # what a frame takes besides
            many = time_groups(case, make_layers(LAYERS), options.rounds, **view)
            scale = 1e6 / (WINDOW[0] * WINDOW[1] * (LAYERS - 1))
            tell(case, f"a pixel, of {LAYERS} layers", "ns", [scale * (b - a) for a, b in zip(one, many)])
            continue
        for surface in (make_sphere(), make_bumps(0.03, 25.0, 20.0)):
            times = time_groups(case, surface, options.rounds, time.process_time)
            tell(case, f"frames of a sphere of {surface.GetNumberOfPolys()} triangles", "ms of processor time", times)


if __name__ == "__main__":
    main()
