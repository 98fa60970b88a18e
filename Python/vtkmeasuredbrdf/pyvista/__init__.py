# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Measured materials in PyVista.

    import pyvista as pv
    import vtkmeasuredbrdf.pyvista

    plotter = pv.Plotter()
    plotter.measured.add_mesh(pv.Sphere(), "gold-paint")
    plotter.measured.set_environment("room", background="blurred")
    plotter.show()

Importing this module gives every plotter the component `measured`, an object of the class `Measured`. With
PyVista 0.48 and later the import is not even needed.
"""

from __future__ import annotations

from typing import Any

import pyvista as pv

from ..environments import Environment
from ..maps import MaterialMap
from ..materials import Material
from ._component import Measured, Plan
from ._hooks import browser_colors
from ._mappers import MeasuredCompositeMapper, MeasuredMapper

__all__ = [
    "Environment",
    "Material",
    "MaterialMap",
    "Measured",
    "MeasuredCompositeMapper",
    "MeasuredMapper",
    "Plan",
    "browser_colors",
]

_NAME = "measured"


class _Component:
    """Makes the component when it is first asked for: PyVista's own way, for versions before 0.48."""

    def __get__(self, plotter: Any, _type: Any = None) -> Any:
        if plotter is None:
            return Measured
        component = plotter.__dict__[_NAME] = Measured(plotter)
        return component


if hasattr(pv, "register_plotter_component"):
    pv.register_plotter_component(_NAME)(Measured)
else:
    setattr(pv.BasePlotter, _NAME, _Component())
