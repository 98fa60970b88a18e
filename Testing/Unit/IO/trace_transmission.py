#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What Radiance's rtrace makes of the transmission in BSDF XML files: the values in Testing/Data/Transmission.

usage: trace_transmission.py FOLDER FILE.xml ...

It needs NumPy and Radiance: rtrace and oconv in PATH, or the package pyradiance (1.3.1 was used). A surface with the BSDF
material (up = +y) lies in z = 0. A source of 0.02 degrees is on one side of it, a ray comes from the other. What is seen,
divided by the source's irradiance, is f(i,o). Jitter and all other light are off.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

DIAMETER = 0.02  # degrees
RADIANCE = 1e8
OPTIONS = "-h -ab 0 -dj 0 -ds 0 -dt 0 -dc 1 -ss 0 -st 1 -lr 0 -ov".split()


def get_environment():
    try:
        import pyradiance
    except ImportError:
        return os.environ
    folder = pathlib.Path(pyradiance.__file__).parent
    return {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "RAYPATH": f".:{folder / 'lib'}"}


def draw(generator, sign):
    """A direction by the cosine, on that side."""
    radius, phi = 0.995 * np.sqrt(generator.random()), 2 * np.pi * generator.random()
    return np.round([radius * np.cos(phi), radius * np.sin(phi), sign * np.sqrt(1 - radius * radius)], 9)


def trace(xml, light, views, folder, environment):
    """f(light, view) for each view, 1/sr; green of the three equal channels."""
    scene = (f"void BSDF m 6 0 {xml} 0 1 0 .\n0\n0\nm polygon p 0 0 12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n"
             f"void light l 0 0 3 {RADIANCE} {RADIANCE} {RADIANCE}\n"
             f"l source s 0 0 4 {light[0]:.9f} {light[1]:.9f} {light[2]:.9f} {DIAMETER}\n")
    (folder / "s.rad").write_text(scene)
    with open(folder / "s.oct", "wb") as octree:
        subprocess.run(["oconv", "s.rad"], cwd=folder, stdout=octree, env=environment, check=True)
    rays = "".join(" ".join(f"{x:.9f}" for x in (*(0.5 * view), *-view)) + "\n" for view in views)
    seen = subprocess.run(["rtrace", *OPTIONS, "s.oct"], cwd=folder, input=rays, capture_output=True, text=True,
                          env=environment, check=True).stdout
    solid_angle = 2 * np.pi * (1 - np.cos(np.radians(DIAMETER / 2)))
    return [float(line.split()[1]) / (RADIANCE * solid_angle * abs(light[2])) for line in seen.splitlines()]


def main():
    target, environment, generator = pathlib.Path(sys.argv[1]), get_environment(), np.random.default_rng(16)
    for name in sys.argv[2:]:
        xml = pathlib.Path(name).resolve()
        lines = ["# f of transmission in 1/sr by Radiance rtrace; made by Testing/Unit/IO/trace_transmission.py. "
                 "+z is the side that Radiance calls front", "ix,iy,iz,ox,oy,oz,f"]
        with tempfile.TemporaryDirectory() as folder:
            for sign in (1, -1):
                for _ in range(10):
                    light = draw(generator, sign)
                    views = [draw(generator, -sign) for _ in range(5)][:2]
                    for view, f in zip(views, trace(xml, light, views, pathlib.Path(folder), environment)):
                        lines.append(",".join(f"{x:.9g}" for x in (*light, *view, f)))
        (target / f"{xml.stem}.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
