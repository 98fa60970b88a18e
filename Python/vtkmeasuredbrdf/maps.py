# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of several materials.

    >>> from vtkmeasuredbrdf.maps import MaterialMap
    >>> rocks = MaterialMap.classes("rock", {1: "white-marble", 2: "hematite", 7: None}, others="blue-rubber")
    >>> wetness = MaterialMap.values("moisture", {0.0: "blue-fabric", 0.8: "nickel"})

`vtkmeasuredbrdf.pyvista` takes a map where it takes a material; `vtkMeasuredBRDFMapper.SetMaterialMap` takes its
attribute `map`.
"""

from __future__ import annotations

import json
import os
from typing import Any, Mapping, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

from . import vtkMaterialMap, vtkPictureReader
from ._errors import TakenErrors, warn_of_notes
from .materials import Material, Source

__all__ = ["MaterialMap"]

_MOST_COMPONENTS = 4  # of a texture


class MaterialMap:
    """Data that choose and mix the materials of a surface: a `vtkMaterialMap` (`map`).

    Make one with `classes`, `values`, `weights`, `images` or `read`. A material is a `Material` or what makes one. others is
    the material of places that the data say nothing of (an unknown class, NaN, weights that are all 0); None: they
    are drawn as without materials.
    """

    __slots__ = ("__weakref__", "_map", "_materials", "_others")

    def __init__(self, mode: int, others: Source | None) -> None:
        self._map = vtkMaterialMap()
        self._map.SetMode(mode)
        self._materials: list[Material | None] = []
        self._others = _to_material(others)

    @classmethod
    def classes(cls, array: str, materials: Mapping[float, Source | None], *,
                others: Source | None = None) -> MaterialMap:
        """A material for each value of a point or cell array; None: drawn as without materials."""
        made = cls(vtkMaterialMap.CLASSES, others)
        made._map.SetArrayName(array)
        made._add_values(materials)
        return made

    @classmethod
    def values(cls, array: str, materials: Mapping[float, Source], *, others: Source | None = None) -> MaterialMap:
        """Materials at places on the scale of a point or cell array, blended linearly in between."""
        made = cls(vtkMaterialMap.VALUES, others)
        made._map.SetArrayName(array)
        made._add_values(materials)
        return made

    @classmethod
    def weights(cls, arrays: Union[str, Sequence[str]], materials: Sequence[Source], *,
                others: Source | None = None) -> MaterialMap:
        """A weight for each material at each point: components of one array, or an array for each."""
        made = cls(vtkMaterialMap.WEIGHTS, others)
        if isinstance(arrays, str):
            made._map.SetArrayName(arrays)
        elif len(arrays) != len(materials):
            raise ValueError(f"arrays: found {len(arrays)}, expected one for each of {len(materials)} materials")
        for material in materials:
            made._add(material)
        for k, name in enumerate([] if isinstance(arrays, str) else arrays):
            made._map.SetWeightArrayName(k, name)
        return made

    @classmethod
    def images(cls, images: ArrayLike, materials: Sequence[Source], *, repeat: bool = True,
               others: Source | None = None) -> MaterialMap:
        """Weights over the texture coordinates: an array of shape (height, width, materials), the upper row first.

        Unsigned integers are divided by their type's largest value. repeat: whether they do so beyond [0, 1].
        """
        pixels = np.asarray(images)
        if pixels.ndim != 3 or pixels.shape[2] != len(materials) or 0 in pixels.shape:
            raise ValueError(f"images: found shape {pixels.shape}, expected (height, width, {len(materials)})")
        if pixels.dtype.kind not in "uf":
            raise ValueError(f"images: found {pixels.dtype}, expected floats or unsigned integers")
        pixels = pixels.astype(np.float32) if pixels.dtype == np.float16 else pixels
        made = cls(vtkMaterialMap.TEXTURES, others)
        for material in materials:
            made._add(material)
        for first in range(0, pixels.shape[2], _MOST_COMPONENTS):
            part = pixels[::-1, :, first:first + _MOST_COMPONENTS]  # VTK's first row is the lowest
            image = vtkImageData()
            image.SetDimensions(part.shape[1], part.shape[0], 1)
            flat = np.ascontiguousarray(part).reshape(-1, part.shape[2])
            image.GetPointData().SetScalars(numpy_to_vtk(flat, deep=True))
            made._map.AddWeightImage(image)
        made._map.SetRepeatWeightImages(repeat)
        return made

    @classmethod
    def read(cls, path: Union[str, os.PathLike[str]], *, others: Source | None = None) -> MaterialMap:
        """The map that `measured-brdf svbrdf` found: its map.json, with the images and materials beside it."""
        folder = os.path.dirname(os.fspath(path))
        with open(path, encoding="utf-8") as file:
            description = json.load(file)
        try:
            sources = [material["material"] for material in description["materials"]]
            names = [str(name) for name in description["weights"]]
        except (KeyError, TypeError) as error:
            raise ValueError(f"{os.fspath(path)}: no material map: {error!r}") from error
        # What has none of these characters is a built-in material, the others are files.
        materials = [os.path.join(folder, source) if set("/.#") & set(source) else source for source in sources]
        weights = np.concatenate([_read_weights(os.path.join(folder, name)) for name in names], axis=2)
        return cls.images(weights[:, :, :len(materials)], materials, others=others)

    def _add_values(self, materials: Mapping[float, Source | None]) -> None:
        for value, material in materials.items():
            self._add(material, float(value))

    def _add(self, source: Source | None, *value: float) -> None:
        material = _to_material(source)
        if material is None and self._map.GetMode() != vtkMaterialMap.CLASSES:
            raise ValueError("materials: found None, which only classes may have")
        with TakenErrors(self._map) as errors:
            index = self._map.AddMaterial(material.brdf if material else None, *value,
                                          material.name if material else "")
        if index < 0:
            raise ValueError(errors.text)
        self._materials[index:index + 1] = [material]

    @property
    def map(self) -> Any:
        """The `vtkMaterialMap`."""
        return self._map

    @property
    def materials(self) -> list[Material | None]:
        """The materials, in the map's order."""
        return list(self._materials)

    @property
    def others(self) -> Material | None:
        """The material of places that the data say nothing of."""
        return self._others

    def __repr__(self) -> str:
        names = [material.name if material else None for material in self._materials]
        return f"MaterialMap({names})"


def _read_weights(path: str) -> Any:
    reader = vtkPictureReader()
    reader.SetFileName(path)
    with TakenErrors(reader) as errors:
        if not reader.Read():
            raise ValueError(errors.text)
    warn_of_notes(path, reader)
    picture = reader.GetPicture()
    width, height, _ = picture.GetDimensions()
    return vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]


def _to_material(source: Source | None) -> Material | None:
    return source if source is None or isinstance(source, Material) else Material(source)
