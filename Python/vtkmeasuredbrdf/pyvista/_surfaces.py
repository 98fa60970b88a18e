# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""From what Plotter.add_mesh takes to surfaces with normals, and to the materials of blocks."""

from __future__ import annotations

import inspect
from typing import Any, Mapping, Sequence

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkAlgorithmOutput
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

FEATURE_ANGLE = 30.0  # degrees; edges that are sharper stay sharp


def is_algorithm(mesh: Any) -> bool:
    return isinstance(mesh, (vtkAlgorithm, vtkAlgorithmOutput))


def extend_pipeline(mesh: Any, smooth: bool, feature_angle: float) -> Any:
    """A pipeline's surface as polygons, with normals where they are missing and wanted."""
    output = mesh if isinstance(mesh, vtkAlgorithmOutput) else mesh.GetOutputPort()
    producer = output.GetProducer()
    producer.Update()
    data = producer.GetOutputDataObject(output.GetIndex())
    last = producer if isinstance(mesh, vtkAlgorithm) else output
    if not data.IsA("vtkPolyData"):
        surface = vtkGeometryFilter()
        surface.SetInputConnection(output)
        output, last = surface.GetOutputPort(), surface
    if smooth and not (data.IsA("vtkPolyData") and data.GetPointData().GetNormals()):
        normals = vtkPolyDataNormals()
        normals.SetInputConnection(output)
        normals.SetFeatureAngle(feature_angle)
        last = normals
    return last


def extract_surface(mesh: Any, scalars: Any, preference: str) -> tuple[Any, Any]:
    """Polygons of a dataset that has none, and its scalars where they are given as an array."""
    keywords: dict[str, Any] = {"pass_pointid": True, "pass_cellid": True}
    if "algorithm" in inspect.signature(mesh.extract_surface).parameters:  # PyVista 0.47 and later ask for it
        keywords["algorithm"] = "dataset_surface"
    surface = mesh.extract_surface(**keywords)
    if scalars is None or isinstance(scalars, str):
        return surface, scalars
    scalars = np.asarray(scalars)
    of_points = len(scalars) == mesh.n_points
    if of_points and len(scalars) == mesh.n_cells:
        of_points = preference == "point"
    if of_points:
        return surface, scalars[surface.point_data["vtkOriginalPointIds"]]
    if len(scalars) == mesh.n_cells:
        return surface, scalars[surface.cell_data["vtkOriginalCellIds"]]
    return surface, scalars  # PyVista reports it


def find_blocks(dataset: Any, first: int = 1) -> tuple[list[tuple[int, str, int]], int]:
    """The blocks of a MultiBlock as (flat index, name, depth), and the next flat index."""
    found = []
    for k in range(len(dataset)):
        block = dataset[k]
        found.append((first, dataset.get_block_name(k), 0))
        first += 1
        if isinstance(block, pv.MultiBlock):
            below, first = find_blocks(block, first)
            found += [(index, name, depth + 1) for index, name, depth in below]
    return found, first


def resolve_materials(dataset: Any, material: Any) -> tuple[Any, dict[int, Any]]:
    """The material of all blocks, and those of single blocks by flat index.

    material: one for all; a sequence, one for each block of the MultiBlock; or a mapping from names or indices of
    blocks, as in `dataset[index]`, to materials, with None for the rest.
    """
    if isinstance(material, Mapping):
        return _resolve_mapping(dataset, dict(material))
    if isinstance(material, Sequence) and not isinstance(material, (str, bytes)):
        if len(material) != len(dataset):
            raise ValueError(f"material: found {len(material)} materials, expected {len(dataset)}, one for each block")
        return None, dict(zip(_get_children(dataset), material))
    return material, {}


def _get_children(dataset: Any) -> list[int]:
    """The flat indices of dataset[0], dataset[1], ..."""
    return [index for index, _, depth in find_blocks(dataset)[0] if depth == 0]


def _resolve_mapping(dataset: Any, materials: dict[Any, Any]) -> tuple[Any, dict[int, Any]]:
    rest = materials.pop(None, None)
    blocks, _ = find_blocks(dataset)
    children = _get_children(dataset)
    resolved: dict[int, Any] = {}
    for key, material in materials.items():
        if isinstance(key, (int, np.integer)) and not isinstance(key, bool):
            if not -len(children) <= key < len(children):
                raise ValueError(f"material: found block {key}, expected 0 to {len(children) - 1}")
            resolved[children[key]] = material
            continue
        named = [index for index, name, _ in blocks if name == key]
        if not named:
            names = ", ".join(repr(name) for _, name, _ in blocks)
            raise ValueError(f"material: found block {key!r}, expected an index or one of {names}")
        resolved.update(dict.fromkeys(named, material))
    return rest, resolved
