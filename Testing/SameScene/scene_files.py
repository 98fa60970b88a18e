# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The files of the scene that every host draws: three balls that hide the sky from each other, a mirror-like coat on a bright
base, and a map in large units whose header gives the exposure and the order of its pixels."""

import math
import os

from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

MESH, MATERIAL, ENVIRONMENT, PLAIN_ENVIRONMENT = "balls.vtp", "coat.fit", "window.hdr", "plain.hdr"
RADIUS = 0.3
# Where `measured-brdf render --view 30,20` looks from: the bounding sphere fills 0.9 of the picture.
AZIMUTH, ELEVATION, ANGLE, FILL = 30.0, 20.0, 30.0, 0.9
SIZE = 300
WIDTH, HEIGHT = 128, 64


def get_camera_position():
    azimuth, elevation = math.radians(AZIMUTH), math.radians(ELEVATION)
    share = FILL * math.tan(math.radians(0.5 * ANGLE))
    distance = 3.0 * RADIUS * math.sqrt(1.0 + 1.0 / share**2)
    return (
        distance * math.cos(elevation) * math.sin(azimuth),
        distance * math.sin(elevation),
        distance * math.cos(elevation) * math.cos(azimuth),
    )


def write_mesh(path):
    balls = vtkAppendPolyData()
    for x in (-2.0 * RADIUS, 0.0, 2.0 * RADIUS):
        sphere = vtkSphereSource()
        sphere.SetCenter(x, 0.0, 0.0)
        sphere.SetRadius(RADIUS)
        sphere.SetThetaResolution(32)
        sphere.SetPhiResolution(32)
        balls.AddInputConnection(sphere.GetOutputPort())
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(balls.GetOutputPort())
    writer.SetFileName(path)
    assert writer.Write() == 1, path


def get_radiance(x, y):
    """A gray room with a bluish ceiling and a bright window, which the balls mirror; x from 0 to WIDTH, y from 0 at the top to HEIGHT."""
    if 86 <= x < 100 and 12 <= y < 24:
        return (9.0, 8.0, 6.5)
    return (0.15, 0.2, 0.3) if y < 20 else (0.3, 0.28, 0.25) if y < 44 else (0.05, 0.04, 0.03)


def encode(rgb):
    """A pixel of shared exponent: Ward, Real pixels, Graphics Gems II, 1991."""
    mantissa, exponent = math.frexp(max(rgb))
    scale = mantissa * 256.0 / max(rgb)
    return bytes([*(int(value * scale) for value in rgb), exponent + 128])


def write_environment(path, factor, turned):
    # Turned: each line of the file is a column of the picture, from the left; its pixels go down.
    order = f"+X {WIDTH} -Y {HEIGHT}" if turned else f"-Y {HEIGHT} +X {WIDTH}"
    places = [(x, y) for x in range(WIDTH) for y in range(HEIGHT)]
    if not turned:
        places.sort(key=lambda place: (place[1], place[0]))
    exposure = f"EXPOSURE={factor}\n" if factor != 1 else ""
    with open(path, "wb") as file:
        file.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n{exposure}\n{order}\n".encode())
        file.write(b"".join(encode([factor * value for value in get_radiance(*place)]) for place in places))


def write_scene(folder):
    os.makedirs(folder, exist_ok=True)
    write_mesh(os.path.join(folder, MESH))
    with open(os.path.join(folder, MATERIAL), "w") as file:
        file.write(
            "coat = Aggregate(Lambertian(albedo = [0.6, 0.3, 0.12]), "
            "LowAshikhminShirley(albedo = [0.3, 0.3, 0.3], sharpness = 20000.0, fresnelReflectance = 1.5))\n"
        )
    # A power of two: both files hold the same mantissas.
    write_environment(os.path.join(folder, ENVIRONMENT), 2**17, turned=True)
    write_environment(os.path.join(folder, PLAIN_ENVIRONMENT), 1, turned=False)
