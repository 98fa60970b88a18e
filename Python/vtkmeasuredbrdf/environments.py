# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Environments for NumPy programs: radiance from every direction.

    >>> from vtkmeasuredbrdf.environments import Environment
    >>> room = Environment("room")
    >>> room.pixels.shape
    (256, 512, 3)
"""

from __future__ import annotations

import math
import os
import warnings
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_FLOAT
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTexture

from . import vtkEmbeddedEnvironments, vtkEnvironment, vtkEnvironmentReader
from ._arrays import to_floats, to_numpy
from ._errors import TakenErrors, is_path, warn_of_notes
from ._fetch import find_fetched

Source = Union[str, "os.PathLike[str]", ArrayLike, vtkImageData, vtkTexture, vtkEnvironment, "Environment"]


class Environment:
    """Distant light: a lat-long image of linear RGB radiance (Rec. 709), and a rotation.

    Parameters
    ----------
    source
        * the name of an embedded environment (`Environment.names()`), or of a published one that `vtkmeasuredbrdf.fetch`
          has downloaded,
        * an image file: lat-long, angular map, mirror ball or cube map, in any format that `vtkEnvironmentReader` reads. What
          its header says holds. A warning tells what was chosen or lost,
        * an array of shape (height, width, 3), (height, width) or (height, width, 4): a lat-long image, top row
          first. The center of the picture shows +x, and columns to the right of it turn towards +z; y is up.
          Floats are linear radiance. Integers are display values, scaled by their type's maximum.
          Alpha is dropped.
        * a `vtkImageData` of such values, bottom row first, or a `vtkTexture` of one,
        * a `vtkEnvironment`, which is then shared, or another `Environment`.
    rotation
        Angle in degrees by which the environment is turned about +y, counterclockwise seen from above.
        None: as the source has it.
    srgb
        Whether the values of an array, an image or a texture are sRGB-encoded. None: integers are, floats are not,
        and a texture's are where it says so (`GetUseSRGBColorSpace`).
    layer
        The layer or part of an OpenEXR file. "": the one named Combined, else the channels R, G and B without a
        name, else the first.

    Raises
    ------
    FileNotFoundError
        The source names a file that does not exist.
    ValueError
        There is no such name, or the file or the array cannot be read as an image. The message says why.
    """

    __slots__ = ("__weakref__", "_embedded", "_environment", "_time")

    def __init__(
        self, source: Source, rotation: float | None = None, *, srgb: bool | None = None, layer: str = ""
    ) -> None:
        self._embedded = ""
        self._environment: Any
        if isinstance(source, Environment):
            self._embedded = source._embedded if source._is_unchanged() else ""
            self._environment = source._environment.NewSnapshot()
        elif isinstance(source, vtkEnvironment):
            self._environment = source
        elif isinstance(source, (str, os.PathLike)):
            self._read(os.fspath(source), layer)
        elif isinstance(source, (vtkImageData, vtkTexture)):
            encoded = True if isinstance(source, vtkTexture) and source.GetUseSRGBColorSpace() else None
            self._environment = _from_image(get_image(source), encoded if srgb is None else srgb)
        else:
            self._environment = _from_array(source, srgb)
        self._time = self._environment.GetPixelsMTime()
        if rotation is not None:
            self.rotation = rotation

    def _read(self, source: str, layer: str) -> None:
        if source in self.names():
            self._environment = vtkEmbeddedEnvironments.NewEnvironment(source)
            self._embedded = source
            return
        if not os.path.exists(source) and "%s" not in source and not is_path(source):
            source = find_fetched(source, "environment", self.names())
        reader = vtkEnvironmentReader()
        reader.SetFileName(source)
        reader.SetLayer(layer)
        with TakenErrors(reader):
            done = reader.Read()
        if not done:
            found = os.path.exists(source) or "%s" in source
            raise (ValueError if found else FileNotFoundError)(reader.GetErrorMessage())
        warn_of_notes(source, reader)
        self._environment = reader.GetEnvironment()
        if not self._environment.GetName():
            self._environment.SetName(os.path.splitext(os.path.basename(source))[0])

    @staticmethod
    def names() -> list[str]:
        """The names of the embedded environments."""
        return [vtkEmbeddedEnvironments.GetName(k) for k in range(vtkEmbeddedEnvironments.GetNumberOfEnvironments())]

    @property
    def environment(self) -> Any:
        """The `vtkEnvironment`, for mappers, planners and integrators."""
        return self._environment

    @property
    def name(self) -> str:
        """The embedded environment's name, the file's name, or "" of an array."""
        return self._embedded or self._environment.GetName()

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width in texels."""
        return self._environment.GetHeight(), self._environment.GetWidth()

    @property
    def pixels(self) -> NDArray[np.float32]:
        """A copy of the image: linear RGB radiance, shape (height, width, 3), float32, top row first."""
        scalars = self._environment.NewImageData().GetPointData().GetScalars()
        return to_numpy(scalars).reshape(*self.shape, 3)[::-1]

    @property
    def matrix(self) -> NDArray[np.float64]:
        """The rotation from world directions to the environment's own: shape (3, 3), orthonormal rows."""
        rows = [0.0] * 9
        self._environment.GetWorldToEnvironment(rows)
        return np.array(rows).reshape(3, 3)

    @property
    def rotation(self) -> float | None:
        """The angle in degrees by which the environment is turned about +y, counterclockwise seen from above.

        None for other rotations (`vtkEnvironment.SetWorldToEnvironment`).
        """
        matrix = self.matrix
        if abs(matrix[1, 1] - 1.0) > 1e-9:
            return None
        return math.degrees(math.atan2(matrix[2, 0], matrix[0, 0]))

    @rotation.setter
    def rotation(self, degrees: float) -> None:
        if not math.isfinite(degrees):
            raise ValueError(f"rotation: found {degrees}, expected a finite angle in degrees")
        self._environment.SetRotationY(degrees)

    def radiance(self, directions: ArrayLike) -> NDArray[np.float32]:
        """The radiance from directions in the world, bilinear between texels: linear RGB, float32, shape (..., 3).

        directions: shape (3,) or (..., 3), of any length but 0.
        """
        world = to_floats(directions, "directions", 3)
        lengths = np.linalg.norm(world, axis=-1, keepdims=True)
        if not (np.isfinite(lengths).all() and (lengths > 0.0).all()):
            raise ValueError("directions: found one that is zero or not finite")
        x, y, z = np.moveaxis((world / lengths) @ self.matrix.T, -1, 0)
        height, width = self.shape
        u = np.arctan2(z, x) / (2.0 * math.pi) + 0.5
        v = np.arcsin(np.clip(y, -1.0, 1.0)) / math.pi + 0.5
        across = u * width - 0.5
        up = np.clip(v * height - 0.5, 0.0, height - 1.0)
        left, below = np.floor(across).astype(np.intp), np.floor(up).astype(np.intp)
        to_right, to_above = (across - left)[..., None], (up - below)[..., None]

        def get(row: NDArray[np.intp], column: NDArray[np.intp]) -> NDArray[np.float64]:
            return self.pixels[height - 1 - np.minimum(row, height - 1), column % width].astype(np.float64)

        low = get(below, left) * (1.0 - to_right) + get(below, left + 1) * to_right
        high = get(below + 1, left) * (1.0 - to_right) + get(below + 1, left + 1) * to_right
        radiance: NDArray[np.float32] = (low * (1.0 - to_above) + high * to_above).astype(np.float32)
        return radiance

    def __copy__(self) -> Environment:
        """The same pixels, without a copy of them, and a rotation of its own."""
        return Environment(self)

    def __deepcopy__(self, _memo: Any) -> Environment:
        return Environment(self)

    def _is_unchanged(self) -> bool:
        """Whether the pixels are still those that were found."""
        return self._time == self._environment.GetPixelsMTime()

    def __reduce__(self) -> tuple[Any, ...]:
        unchanged = bool(self._embedded) and self._is_unchanged()
        pixels = None if unchanged else np.ascontiguousarray(self.pixels)
        name = self._embedded if unchanged else self._environment.GetName()
        return _restore, (name, pixels, self.matrix.ravel().tolist())

    def __repr__(self) -> str:
        height, width = self.shape
        return f"<Environment {self.name!r}, {width} x {height} texels>"


def _restore(name: str, pixels: NDArray[np.float32] | None, matrix: list[float]) -> Environment:
    """For pickle. No pixels: an embedded environment."""
    environment = Environment(name if pixels is None else pixels)
    if pixels is not None:
        environment.environment.SetName(name)
    environment.environment.SetWorldToEnvironment(matrix)
    return environment


def _from_array(source: ArrayLike, srgb: bool | None) -> Any:
    """A new vtkEnvironment."""
    array = np.asarray(source)
    if array.ndim == 2:
        array = array[..., np.newaxis]
    if array.ndim != 3 or array.shape[-1] not in (1, 3, 4) or 0 in array.shape:
        raise ValueError(f"source: found an array of shape {np.shape(source)}, expected (height, width, 3), "
                         "(height, width) or (height, width, 4)")
    if array.dtype.kind not in "fu":
        raise ValueError(f"source: found values of type {array.dtype}, expected floats or unsigned integers")
    if array.dtype.kind == "f":
        array = array.astype(np.float32, copy=False)
    elif array.dtype.itemsize > 2:
        raise ValueError(f"source: found values of type {array.dtype}, expected uint8, uint16 or floats")
    else:
        array = array.astype(array.dtype.newbyteorder("="), copy=False)
    pixels = np.ascontiguousarray(array[::-1])  # C++ begins with the bottom row
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, pixels.shape[-1])))
    return _from_image(image, srgb, 4)


def get_image(source: Any) -> Any:
    """The image itself, or a texture's, brought up to date."""
    if not isinstance(source, vtkTexture):
        return source
    if source.GetCubeMap():
        raise ValueError("source: found a texture of a cube map, expected one of a lat-long image. A renderer's "
                         "SetEnvironmentTexture takes cube maps")
    if source.GetNumberOfInputConnections(0) == 0:
        raise ValueError("source: found a texture without an image")
    source.GetInputAlgorithm(0, 0).Update()
    return source.GetInput()


def _from_image(image: Any, srgb: bool | None, level: int = 3) -> Any:
    """A new vtkEnvironment. level: of the stack, whose line a warning names."""
    scalars = image.GetPointData().GetScalars()
    environment = vtkEnvironment()
    with TakenErrors(environment) as errors:
        is_integer = scalars is not None and scalars.GetDataType() not in (VTK_FLOAT, VTK_DOUBLE)
        if not environment.SetImage(image, is_integer if srgb is None else srgb):
            raise ValueError(errors.text)
    bad = environment.GetNumberOfNegativeValues(), environment.GetNumberOfNonFiniteValues()
    if any(bad):
        warnings.warn(f"{bad[0]} values of the environment are negative and {bad[1]} are not finite; 0 is taken, "
                      "the largest value for +infinity",
                      stacklevel=level)
    return environment
