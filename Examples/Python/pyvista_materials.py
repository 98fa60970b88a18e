#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Measured materials in PyVista: a still life in a photographed room, drawn offscreen into a PNG."""

import argparse

import numpy as np
import pyvista as pv

import vtkmeasuredbrdf.pyvista  # noqa: F401 (plotter.measured; PyVista 0.48 finds it by itself)

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--environment", default="room",
                    help="a built-in environment's name or an HDR image (default: %(default)s)")
parser.add_argument("--rotate", type=float, default=240.0, metavar="DEGREES",
                    help="turns the environment (default: %(default)s)")
parser.add_argument("--size", type=int, nargs=2, default=(1200, 600), metavar=("WIDTH", "HEIGHT"))
parser.add_argument("-o", "--output", default="pyvista_materials.png", help="default: %(default)s")
options = parser.parse_args()


def knot(p, q, radius):
    """A tube along a torus knot."""
    t = np.linspace(0.0, 2.0 * np.pi, 400) - np.pi / 6.0  # the tube's ends meet at the back
    r = 1.0 + 0.42 * np.cos(q * t)
    line = pv.Spline(np.stack((r * np.cos(p * t), r * np.sin(p * t), 0.42 * np.sin(q * t)), axis=1), 1200)
    return line.tube(radius=radius, n_sides=48)


def standing(mesh, place, size):
    """The mesh on the floor z = 0."""
    mesh = mesh.copy()
    mesh.points = (mesh.points - mesh.center) * (size / mesh.length)
    mesh.points += np.array((*place, -mesh.bounds[4]))
    return mesh


upright = knot(2, 3, 0.21)
upright.rotate_x(90, inplace=True)
round_ball = pv.Sphere(theta_resolution=120, phi_resolution=120)
objects = {
    "blue-car-paint": standing(upright, (0.0, 0.5), 3.1),
    "gold-paint": standing(pv.ParametricSuperEllipsoid(n1=0.3, n2=0.3), (-1.75, 0.1), 2.0),
    "pink-felt": standing(pv.ParametricSuperToroid(n1=1.0, n2=1.0), (1.85, 0.0), 2.1),
    "nickel": standing(round_ball, (-0.75, -1.15), 1.25),
    "violet-rubber": standing(round_ball, (0.7, -1.2), 1.0),
}
objects["gold-paint"].rotate_z(25, point=objects["gold-paint"].center, inplace=True)

plotter = pv.Plotter(off_screen=True, window_size=options.size)
for material, mesh in objects.items():
    plotter.measured.add_mesh(mesh, material, name=material)
table = pv.Cylinder(center=(0.0, 0.0, -0.06), direction=(0.0, 0.0, 1.0), radius=3.1, height=0.12, resolution=300)
plotter.measured.add_mesh(table, "delrin", name="table")
plotter.measured.set_environment(options.environment, rotate=options.rotate, background="blurred")
plotter.camera_position = [(0.6, -7.6, 2.7), (0.0, 0.0, 0.72), (0.0, 0.0, 1.0)]
plotter.camera.view_angle = 23.0
plotter.enable_ssao(radius=0.6, bias=0.01, kernel_size=128)
plotter.enable_anti_aliasing("ssaa")
plotter.screenshot(options.output)
for plan in plotter.measured.plans():
    print(f"{plan.actor}: {plan.method}, predicted error {100 * plan.error:.1f} %")
print(f"wrote {options.output}")
