# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Textures of environments for renderers, the pictures behind the scene, and PyVista's default lights, which would add."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.vtkImagingCore import vtkImageShrink3D
from vtkmodules.vtkRenderingCore import vtkLightKit, vtkRenderer, vtkSkybox, vtkTexture

from ..environments import Environment

BACKGROUNDS = ("map", "blurred")
_BLUR = 5.0  # degrees, the standard deviation
_BLURRED_SIZE = 256, 128  # texels at most; the graphics card interpolates between them
_ROUNDING = 0.005  # PyVista rounds the colors of lights to 8 bits


def new_texture(environment: Environment, mipmap: bool = True) -> Any:
    """The environment's pixels as VTK's renderers take them. The texture holds the image."""
    texture = vtkTexture()
    texture.SetInputData(environment.environment.NewImageData())
    texture.SetColorModeToDirectScalars()
    texture.InterpolateOn()
    texture.SetMipmap(mipmap)
    return texture


def get_axes(environment: Environment, up: ArrayLike, rotate: float) -> tuple[NDArray[Any], NDArray[Any]]:
    """The environment's axes x (the center of its picture) and y (up) in the world.

    up: the direction in the world that is up; rotate: an angle in degrees about it, on top of the environment's
    own rotation.
    """
    vertical = np.asarray(up, dtype=float)
    length = np.linalg.norm(vertical) if vertical.shape == (3,) else 0.0
    if not (math.isfinite(length) and length > 0.0):
        raise ValueError(f"up: found {up!r}, expected a direction")
    if not math.isfinite(rotate):
        raise ValueError(f"rotate: found {rotate}, expected a finite angle in degrees")
    vertical = vertical / length
    right = np.array((1.0, 0.0, 0.0) if abs(vertical[0]) < 0.9 else (0.0, 1.0, 0.0))
    right -= vertical * (right @ vertical)
    right /= np.linalg.norm(right)
    side = np.cross(vertical, right)
    angle = math.radians(rotate)
    right, side = math.cos(angle) * right + math.sin(angle) * side, math.cos(angle) * side - math.sin(angle) * right
    world = np.array((right, vertical, -side))  # rows: x, y, z of the environment before its own rotation
    axes = environment.matrix @ world
    return axes[0], axes[1]


def new_skybox(texture: Any, right: NDArray[Any], up: NDArray[Any]) -> Any:
    """A sphere around the scene with the texture on it, turned as the renderer turns its environment texture."""
    skybox = vtkSkybox()
    skybox.SetTexture(texture)
    skybox.SetProjectionToSphere()
    skybox.GammaCorrectOn()  # radiance^(1/2.2), as materials are drawn
    skybox.SetFloorPlane(*up, 0.0)
    skybox.SetFloorRight(*np.cross(right, up))  # vtkSkybox begins its azimuth a quarter turn from the lighting's
    skybox.PickableOff()
    return skybox


def blur(environment: Environment) -> Environment:
    """A small version of the environment, blurred evenly over the sphere."""
    image = environment.environment.NewImageData()
    mean = vtkImageShrink3D()
    mean.SetInputData(image)
    mean.SetShrinkFactors(*(-(-count // most) for count, most in zip(image.GetDimensions(), _BLURRED_SIZE)), 1)
    mean.MeanOn()
    mean.Update()
    pixels = Environment(mean.GetOutput()).pixels
    height, width = pixels.shape[:2]
    theta = (np.arange(height) + 0.5) * math.pi / height
    cosines = np.cos(np.arange(width) * 2.0 * math.pi / width)
    # A von Mises-Fisher kernel times the texels' solid angles, for pairs of rows and differences of columns:
    # along the rows it is a convolution.
    sines = np.sin(theta)
    dot = np.multiply.outer(np.multiply.outer(sines, sines), cosines)
    dot += np.multiply.outer(np.cos(theta), np.cos(theta))[..., None]
    weights = np.exp((dot - 1.0) / math.radians(_BLUR) ** 2) * sines[None, :, None]
    weights /= weights.sum(axis=(1, 2), keepdims=True)
    blurred = np.einsum("abk,bkc->akc", np.fft.rfft(weights), np.fft.rfft(pixels, axis=1), optimize=True)
    return Environment(np.maximum(np.fft.irfft(blurred, width, axis=1), 0.0))


def _describe(light: Any) -> tuple[float, ...]:
    """What tells lights apart: kind, place, intensity, color."""
    place = (round(value, 4) for value in light.GetPosition())
    return (light.GetLightType(), *place, light.GetIntensity(), *light.GetDiffuseColor())


def _get_lights(renderer: Any) -> list[Any]:
    lights = renderer.GetLights()
    return [lights.GetItemAsObject(k) for k in range(lights.GetNumberOfItems())]


def get_default_lights(renderer: Any) -> list[Any]:
    """The lights of the default light kit, where the renderer has these and no other; else none."""
    kit = vtkLightKit()
    fresh = vtkRenderer()
    kit.AddLightsToRenderer(fresh)
    expected = sorted(map(_describe, _get_lights(fresh)))
    lights = _get_lights(renderer)
    found = sorted(map(_describe, lights))
    is_default = len(found) == len(expected) and np.allclose(found, expected, rtol=0.0, atol=_ROUNDING)
    return lights if is_default else []
