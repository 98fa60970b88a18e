# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Measured materials for NumPy programs.

    >>> from vtkmeasuredbrdf.materials import Environment, Material, integrate
    >>> gold = Material("gold-paint")
    >>> gold.evaluate((0.6, 0.0, 0.8), [(-0.6, 0.0, 0.8), (0.0, 0.0, 1.0)]).shape
    (2, 3)

Directions are in the surface's local frame: z is the normal, x the tangent; i points to the light and o to the
viewer. They may have any length but 0. Shapes broadcast as NumPy's. Results are float32 where all arguments are,
else float64. All functions use every core (`vtkSMPTools`).
"""

from __future__ import annotations

import os
import tempfile
from typing import Any, Callable, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.vtkCommonCore import vtkDoubleArray

from . import (
    vtkBRDF,
    vtkBRDFModels,
    vtkBRDFReader,
    vtkBRDFWriter,
    vtkEmbeddedMaterials,
    vtkRadianceIntegrator,
    vtkRadianceMethods,
    vtkRadiancePlanner,
)
from ._arrays import broadcast, expand, get_result_type, to_floats, to_numpy, to_vtk
from ._errors import TakenErrors, is_path
from ._fetch import find_fetched
from .environments import Environment

__all__ = ["Environment", "Material", "integrate"]

Source = Union[str, "os.PathLike[str]", vtkBRDF, "Material"]


class Material:
    """A material as its BRDF f(i,o), the bidirectional reflectance distribution function.

    Parameters
    ----------
    source
        * the name of an embedded material (`Material.names()`), or of a published one that `vtkmeasuredbrdf.fetch` has
          downloaded,
        * a file: MERL `.binary`, RGL `.bsdf`, NVIDIA `.mbsdf`, BSDF `.xml`, UTIA `.bin`,
          OpenMATERIAL 3D `.xompt`, ASTM `.astm`, published fits (`file#name` picks one), or this
          project's `.exr`,
        * a `vtkBRDF` or another `Material`, which is then shared.

    Raises
    ------
    FileNotFoundError
        The source names a file that does not exist.
    ValueError
        There is no such name, or the file cannot be read. The message says why.
    """

    __slots__ = ("__weakref__", "_brdf", "_embedded", "_name")

    def __init__(self, source: Source) -> None:
        self._embedded = ""
        self._name = ""
        self._brdf: Any
        if isinstance(source, Material):
            self._brdf, self._embedded, self._name = source._brdf, source._embedded, source._name
        elif isinstance(source, vtkBRDF):
            self._brdf = source
        elif isinstance(source, (str, os.PathLike)):
            self._read(os.fspath(source))
        else:
            raise ValueError(f"source: found {type(source).__name__}, expected a name, a file or a vtkBRDF")

    def _read(self, source: str) -> None:
        if source in self.names():
            self._brdf = vtkEmbeddedMaterials.NewBRDF(source)
            self._embedded = self._name = source
            return
        exists = os.path.exists(source) or os.path.exists(source.rpartition("#")[0])
        if not exists and not is_path(source):
            source, exists = find_fetched(source, "material", self.names()), True
        reader = vtkBRDFReader()
        reader.SetFileName(source)
        with TakenErrors(reader):
            done = reader.Read()
        if not done:
            raise (ValueError if exists else FileNotFoundError)(reader.GetErrorMessage())
        self._brdf = reader.GetBRDF()
        self._name = os.path.splitext(os.path.basename(source))[0]

    @staticmethod
    def names() -> list[str]:
        """The names of the embedded materials."""
        return [vtkEmbeddedMaterials.GetName(k) for k in range(vtkEmbeddedMaterials.GetNumberOfMaterials())]

    @property
    def brdf(self) -> Any:
        """The `vtkBRDF`, for mappers, planners and integrators."""
        return self._brdf

    @property
    def name(self) -> str:
        """The material's own name, else that of its file or of its class."""
        return self._embedded or self._brdf.GetName() or self._name or self._brdf.GetClassName()

    @property
    def source(self) -> str:
        """Where the data are from: a paper, a database, a file. May be empty."""
        return self._brdf.GetSource()

    def evaluate(self, i: ArrayLike, o: ArrayLike) -> NDArray[Any]:
        """The BRDF f(i,o) in 1/sr, linear RGB (Rec. 709), without the cosine.

        i, o: directions to the light and to the viewer, shape (3,) or (..., 3). Returns shape (..., 3): 0 where a
        direction is at or below the horizon (z <= 0) or is no direction.
        """
        return self._call(self._brdf.EvaluateArray, {"i": to_floats(i, "i", 3), "o": to_floats(o, "o", 3)}, 3)

    def sample(self, o: ArrayLike, u: ArrayLike) -> NDArray[Any]:
        """Directions to the light, drawn where the material reflects.

        The mean of evaluate(i, o) * i[..., 2:] / pdf(i, o)[..., None] over the draws, those below the horizon
        counted as 0, is the directional albedo.

        o: directions to the viewer, shape (3,) or (..., 3). u: uniform random numbers in [0, 1), shape (2,) or
        (..., 2). Returns unit vectors, shape (..., 3): (0, 0, 0) where the draw fell below the horizon.
        """
        numbers = to_floats(u, "u", 2)
        if not ((numbers >= 0.0) & (numbers < 1.0)).all():
            raise ValueError("u: found a number outside of [0, 1)")
        return self._call(self._brdf.SampleArray, {"o": to_floats(o, "o", 3), "u": numbers}, 3)

    def pdf(self, i: ArrayLike, o: ArrayLike) -> NDArray[Any]:
        """The probability density of `sample` in 1/sr, over the solid angle of i.

        i, o: directions to the light and to the viewer, shape (3,) or (..., 3). Returns shape (...).
        """
        return self._call(self._brdf.PdfArray, {"i": to_floats(i, "i", 3), "o": to_floats(o, "o", 3)}, 1)

    def albedo(self, o: ArrayLike) -> NDArray[Any]:
        """The directional albedo: the integral of f(i,o) cos(theta_i) over i.

        o: directions to the viewer, shape (3,) or (..., 3). Returns linear RGB, shape (..., 3), within 1e-3 of the
        integral (vtkBRDF::GetDirectionalAlbedo says where not).
        """
        return self._call(self._brdf.GetDirectionalAlbedoArray, {"o": to_floats(o, "o", 3)}, 3)

    def _call(self, function: Callable[..., bool], arguments: dict[str, NDArray[Any]], components: int) -> NDArray[Any]:
        """A C++ method on arrays; one component gives no last axis."""
        shape, tuples = broadcast(arguments)
        count = int(np.prod(shape, dtype=np.intp))
        result: NDArray[Any] = np.empty((count, components), get_result_type(tuples))
        filled = to_vtk(result)
        with TakenErrors(self._brdf) as errors:
            if not function(*map(to_vtk, tuples), filled):
                raise ValueError(errors.text)
        return result.reshape(shape if components == 1 else (*shape, components))[()]

    def save(self, path: str | os.PathLike[str], *, half_floats: bool = False) -> None:
        """Writes the material to a file, `.exr` or (tables only) MERL's `.binary`.

        half_floats: tables of `.exr` as 16-bit floats, a relative error of 2^-11. Raises ValueError with the
        reason where that is not possible.
        """
        writer = vtkBRDFWriter()
        writer.SetFileName(os.fspath(path))
        writer.SetBRDF(self._brdf)
        writer.SetHalfFloats(half_floats)
        with TakenErrors(writer):
            if not writer.Write():
                raise ValueError(writer.GetErrorMessage())

    def to_bytes(self) -> bytes:
        """The material as bytes, for `from_bytes`: those of an `.exr` file. They give identical values."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "material.exr")
            self.save(path)
            with open(path, "rb") as file:
                return file.read()

    @classmethod
    def from_bytes(cls, data: bytes) -> Material:
        """A material from the bytes of a file of any known format."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "material")
            with open(path, "wb") as file:
                file.write(data)
            material = cls(path)
        material._name = ""
        return material

    def __copy__(self) -> Material:
        """The same BRDF under another name."""
        return Material(self)

    def __deepcopy__(self, _memo: Any) -> Material:
        """A material that shares nothing that can be changed."""
        snapshot = self._brdf.NewSnapshot()
        copied = Material(snapshot) if snapshot else Material.from_bytes(self.to_bytes())
        copied._embedded, copied._name = self._embedded, self._name
        return copied

    def __reduce__(self) -> tuple[Any, ...]:
        if self._embedded:
            key = vtkBRDFModels.GetContentKey(vtkEmbeddedMaterials.NewBRDF(self._embedded))
            if key and key == vtkBRDFModels.GetContentKey(self._brdf):
                return Material, (self._embedded,)
        return _restore, (self.to_bytes(), self._embedded or self._name)

    def __repr__(self) -> str:
        return f"<Material {self.name!r}, {self._brdf.GetClassName()}>"


def _restore(data: bytes, name: str) -> Material:
    """For pickle."""
    material = Material.from_bytes(data)
    material._name = name
    return material


def integrate(
    material: Source,
    environment: Any,
    normals: ArrayLike,
    views: ArrayLike,
    tangents: ArrayLike | None = None,
    *,
    method: str | vtkRadianceIntegrator = "reference",
    sizes: Sequence[int] = (),
    tolerance: float | None = None,
) -> NDArray[Any]:
    """The radiance that a material under an environment sends to viewers.

    Parameters
    ----------
    material
        A `Material`, or what makes one.
    environment
        An `Environment`, or what makes one.
    normals, views
        Shape (3,) or (..., 3): the surface's normal and the direction from the surface to the viewer, in the world,
        of any length but 0. Both are needed for every point; shapes broadcast.
    tangents
        Shape (3,) or (..., 3): the local frame's x axis, for anisotropic materials. None: any.
    method
        A name (`vtkRadianceMethods`): "reference" (default, each pair within 0.3 %), "table", "hybrid",
        "light-set", "filtered"; or a `vtkRadianceIntegrator`, of which a copy is used.
    sizes
        The method's sizes (`vtkRadianceIntegrator.GetSizesText`), the most important one first.
    tolerance
        Relative L1 error over a sphere, 0.001 to 1: a planner tries methods from cheap to costly until one stays below it.
        Then `method` and `sizes` must not be given.

    Returns
    -------
    ndarray
        Shape (..., 3): radiance in the environment's unit, linear RGB, float64; 0 for views below the horizon.

    Raises
    ------
    ValueError
        Shapes do not broadcast, a direction is zero or not finite, or there is no such method or size.
    """
    material = material if isinstance(material, Material) else Material(material)
    light = environment if isinstance(environment, Environment) else Environment(environment)
    arguments = {"normals": to_floats(normals, "normals", 3), "views": to_floats(views, "views", 3)}
    if tangents is not None:
        arguments["tangents"] = to_floats(tangents, "tangents", 3)
    shape, tuples = broadcast(arguments)
    count = int(np.prod(shape, dtype=np.intp))
    tuples = [expand(array, count) for array in tuples]
    if tolerance is not None:
        if method != "reference" or len(sizes):
            raise ValueError("tolerance: found a method or sizes beside it, expected neither")
        integrator = _plan(material, light, tolerance)
    else:
        integrator = _new_integrator(method, sizes)
    integrator.SetBRDF(material.brdf)
    integrator.SetEnvironment(light.environment)
    arrays = [to_vtk(array) for array in tuples]
    radiance = vtkDoubleArray()
    with TakenErrors(integrator) as errors:
        if not integrator.Integrate(*arrays[:2], radiance, *arrays[2:]):
            raise ValueError(errors.text)
    return to_numpy(radiance).reshape(*shape, 3)


def _new_integrator(method: str | vtkRadianceIntegrator, sizes: Sequence[int]) -> Any:
    if isinstance(method, vtkRadianceIntegrator):
        integrator = method.NewCopy()
    else:
        integrator = vtkRadianceMethods.NewIntegrator(method)
        if integrator is None:
            raise ValueError(f"method: found {method!r}, expected {vtkRadianceMethods.GetNames()}")
    with TakenErrors(integrator) as errors:
        if not integrator.SetSizes([int(size) for size in sizes]):
            raise ValueError(errors.text)
    return integrator


def _plan(material: Material, environment: Environment, tolerance: float) -> Any:
    if not 1e-3 <= tolerance <= 1.0:
        raise ValueError(f"tolerance: found {tolerance}, expected 0.001 to 1")
    planner = vtkRadiancePlanner()
    planner.SetErrorTolerance(tolerance)
    planner.SetBRDF(material.brdf)
    planner.SetEnvironment(environment.environment)
    with TakenErrors(planner) as errors:
        if not planner.Update():
            raise ValueError(errors.text)
    return planner.NewIntegrator()
