# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""NumPy arrays as arguments and results of C++ methods on VTK arrays, without copies where possible."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkFloatArray


def to_floats(value: ArrayLike, name: str, components: int) -> NDArray[Any]:
    """The value as an array of float32 or float64, shape (..., components). No copy of such an array."""
    try:
        array = np.asarray(value)
    except ValueError as error:  # ragged lists
        raise ValueError(f"{name}: {error}") from None
    if array.dtype.kind not in "fiub":
        raise ValueError(f"{name}: found values of type {array.dtype}, expected numbers")
    if array.ndim == 0 or array.shape[-1] != components:
        raise ValueError(f"{name}: found shape {array.shape}, expected ({components},) or (..., {components})")
    if array.dtype != np.float32 and array.dtype != np.float64:
        array = array.astype(np.float64)
    return array


def broadcast(arrays: dict[str, NDArray[Any]]) -> tuple[tuple[int, ...], list[NDArray[Any]]]:
    """NumPy's broadcasting over all axes but the last one.

    Returns the common shape without the last axis, and each array as contiguous tuples, shape (n, components).
    An array of one tuple stays one: C++ takes it for all.
    """
    try:
        shape = np.broadcast_shapes(*(array.shape[:-1] for array in arrays.values()))
    except ValueError:
        found = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ValueError(f"found shapes that do not broadcast: {found}") from None
    tuples = []
    for array in arrays.values():
        components = array.shape[-1]
        if array.shape[:-1] != shape and array.size != components:
            array = np.broadcast_to(array, (*shape, components))
        tuples.append(np.ascontiguousarray(array).reshape(-1, components))
    return shape, tuples


def expand(tuples: NDArray[Any], count: int) -> NDArray[Any]:
    """One tuple as `count` of them, for C++ methods that want as many tuples in every array."""
    return tuples if len(tuples) == count else np.ascontiguousarray(np.broadcast_to(tuples, (count, tuples.shape[-1])))


def get_result_type(arrays: list[NDArray[Any]]) -> type:
    """float32 where all arguments are, else float64."""
    return np.float32 if all(array.dtype == np.float32 for array in arrays) else np.float64


def to_vtk(tuples: NDArray[Any]) -> Any:
    """A VTK array on the same memory. The ndarray has to live as long as VTK uses it."""
    array = vtkFloatArray() if tuples.dtype == np.float32 else vtkDoubleArray()
    array.SetNumberOfComponents(tuples.shape[-1])
    if tuples.size:
        array.SetVoidArray(tuples, tuples.size, 1)
    return array


def to_numpy(array: Any) -> NDArray[Any]:
    """A VTK array of floats or doubles as an ndarray on the same memory, shape (n, components)."""
    dtype = np.float32 if isinstance(array, vtkFloatArray) else np.float64
    components = array.GetNumberOfComponents()
    if array.GetNumberOfTuples() == 0:
        return np.empty((0, components), dtype)
    return np.frombuffer(array, dtype).reshape(-1, components)
