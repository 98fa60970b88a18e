# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""PyVista's default lights, which would add to an environment."""

from __future__ import annotations

from typing import Any

import numpy as np
from vtkmodules.vtkRenderingCore import vtkLightKit, vtkRenderer


# PyVista rounds the colors of lights to 8 bits.
_ROUNDING = 0.005


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
