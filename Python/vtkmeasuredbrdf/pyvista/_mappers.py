# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Mappers that are PyVista's and draw measured materials."""

from __future__ import annotations

from typing import Any, Mapping

import pyvista as pv
from vtkmodules.vtkCommonCore import vtkObject

from .. import vtkCompositeMeasuredBRDFMapper, vtkMeasuredBRDFMapper
from ..maps import MaterialMap
from ..materials import Material

OLDEST = 0, 44  # of PyVista
if tuple(map(int, pv.__version__.split(".")[:2])) < OLDEST:
    raise ImportError(f"vtkmeasuredbrdf.pyvista: found PyVista {pv.__version__}, expected 0.44 or later")

# What pv.DataSetMapper adds to VTK's mapper: `dataset`, `lookup_table`, `scalar_range`, `copy()` and others.
_DataSetMethods: Any = pv.DataSetMapper.__bases__[0]
# What a new mapper has of its own.
_OWN = ("_material", "_material_map", "_block_materials", "_attr", "_dataset")


class _Measured:
    """What both mappers have in common."""

    # PyVista refuses new attributes of objects; these are the class's.
    _material: Material | None = None
    _material_map: MaterialMap | None = None

    @property
    def material(self) -> Material | None:
        """The material; None: drawn as PyVista draws it."""
        return self._material

    @material.setter
    def material(self: Any, material: Any) -> None:
        self._material = None if material is None else to_material(material)
        self.SetBRDF(self._material.brdf if self._material else None)

    @property
    def material_map(self) -> MaterialMap | None:
        """Data that choose the materials; `material` is of the places that they say nothing of."""
        return self._material_map

    @material_map.setter
    def material_map(self: Any, material_map: MaterialMap | None) -> None:
        self._material_map = material_map
        self.SetMaterialMap(material_map.map if material_map else None)
        if material_map:
            self.material = material_map.others

    @property
    def tolerance(self: Any) -> float:
        """The relative error to stay below, from 0.001 to 1."""
        return self.GetErrorTolerance()

    @tolerance.setter
    def tolerance(self: Any, tolerance: float) -> None:
        if not 1e-3 <= tolerance <= 1.0:
            raise ValueError(f"tolerance: found {tolerance}, expected 0.001 to 1")
        self.SetErrorTolerance(tolerance)

    @property
    def maximum_cost(self: Any) -> float:
        """What a pixel of a planned method may cost, times a table's, from 1 to 1e6."""
        return self.GetMaximumCost()

    @maximum_cost.setter
    def maximum_cost(self: Any, cost: float) -> None:
        if not 1.0 <= cost <= 1e6:
            raise ValueError(f"maximum_cost: found {cost}, expected 1 to 1e6")
        self.SetMaximumCost(cost)

    @property
    def plan(self: Any) -> str:
        """How the last picture was drawn: method, predicted error, sizes and reason; "" before the first one."""
        return self.GetPlan()


def to_material(material: Any) -> Material:
    """The material, or what its name or file stands for."""
    return material if isinstance(material, Material) else Material(material)


def _take_over(new: Any, old: Any) -> None:
    """All properties of a mapper, and what PyVista keeps beside them."""
    new.__dict__.update({name: value for name, value in vars(old).items() if name not in _OWN})
    shown = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()  # VTK 9.1 calls deprecated methods of its own here, and says so
    try:
        new.ShallowCopy(old)
    finally:
        vtkObject.SetGlobalWarningDisplay(shown)


class MeasuredMapper(_Measured, _DataSetMethods, vtkMeasuredBRDFMapper):  # type: ignore[misc, valid-type]
    """Draws a surface of a measured material: `vtkMeasuredBRDFMapper` with the interface of `pv.DataSetMapper`."""

    @classmethod
    def from_mapper(cls, mapper: Any, material: Any) -> MeasuredMapper:
        """In place of another mapper of polygons, with its input, scalars and colors."""
        new = cls()
        _take_over(new, mapper)
        if mapper.GetNumberOfInputConnections(0):
            new.SetInputConnection(0, mapper.GetInputConnection(0, 0))
        new.material = material
        new.material_map = getattr(mapper, "material_map", None)
        return new

    def copy(self) -> MeasuredMapper:
        """A mapper with the same properties, input and material."""
        return type(self).from_mapper(self, self._material)


class MeasuredCompositeMapper(_Measured, pv.CompositePolyDataMapper, vtkCompositeMeasuredBRDFMapper):  # type: ignore[misc]
    """Draws the blocks of a MultiBlock, each of its material.

    It is a `vtkCompositeMeasuredBRDFMapper` with the interface of `pv.CompositePolyDataMapper`.
    """

    _block_materials: Mapping[int, Material | None] = {}

    @classmethod
    def from_mapper(cls, mapper: Any, material: Any, block_materials: Mapping[int, Any]) -> MeasuredCompositeMapper:
        """In place of another mapper of the same MultiBlock.

        block_materials: by flat index, as `mapper.block_attr` counts; the root is 0.
        """
        new = cls(mapper.dataset)
        _take_over(new, mapper)
        new.SetCompositeDataDisplayAttributes(new.block_attr)
        for index in range(len(mapper.block_attr)):
            if mapper.block_attr.get_block(index) is None:
                continue
            for name in ("color", "opacity", "visible", "pickable"):
                value = getattr(mapper.block_attr[index], name)
                if value is not None:
                    setattr(new.block_attr[index], name, value)
        new.material = material
        new.material_map = getattr(mapper, "material_map", None)
        new.block_materials = block_materials
        return new

    @property
    def block_materials(self) -> dict[int, Material | None]:
        """The materials of single blocks, and of all that lies below them, by flat index. None: drawn as PyVista
        draws it."""
        return dict(self._block_materials)

    @block_materials.setter
    def block_materials(self, materials: Mapping[int, Any]) -> None:
        self.RemoveBlockBRDFs()
        self._block_materials = {
            index: None if material is None else to_material(material) for index, material in materials.items()
        }
        for index, material in self._block_materials.items():
            self.SetBlockBRDF(index, material.brdf if material else None)

    def copy(self) -> MeasuredCompositeMapper:
        """A mapper with the same properties, input and materials."""
        return type(self).from_mapper(self, self._material, self._block_materials)


for _class, _name in ((MeasuredMapper, "vtkMeasuredBRDFMapper"),
                      (MeasuredCompositeMapper, "vtkCompositeMeasuredBRDFMapper")):
    if _class.__vtkname__ != _name:  # objects of another C++ class than their methods' would crash
        raise ImportError(f"vtkmeasuredbrdf.pyvista does not know the mappers of PyVista {pv.__version__}")
