# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What `plotter.measured` offers."""

from __future__ import annotations

import os
import warnings
import weakref
from dataclasses import dataclass
from typing import Any

import pyvista as pv
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkRenderingCore import vtkTexture

from .. import vtkPBRPropertyFitter
from ..environments import Environment, get_image
from ..maps import MaterialMap
from ..materials import Material
from ._backgrounds import BACKGROUNDS, blur, get_axes, get_default_lights, new_skybox, new_texture
from ._hooks import add_hooks, get_measured_actors
from ._mappers import MeasuredCompositeMapper, MeasuredMapper
from ._surfaces import FEATURE_ANGLE, extend_pipeline, extract_surface, is_algorithm, resolve_materials

# What the material replaces.
_REPLACED = ("color", "ambient", "diffuse", "specular", "specular_power", "pbr", "metallic", "roughness")
_LIGHTS = ("auto", "keep", "remove")
_BACKGROUND_NAME = "measured-background"


@dataclass(frozen=True)
class Plan:
    """How an actor was drawn last.

    Attributes
    ----------
    actor
        The actor's name in the plotter.
    material
        The material's name; "" where a map chooses materials, or blocks of a MultiBlock have their own.
    method
        The method that integrates the environment's light, "table" for instance. "" before the first picture,
        without an environment, for a map of materials and for a MultiBlock.
    error
        The predicted relative L1 error over a sphere; None where there is no method.
    tolerance
        The error to stay below.
    text
        The plan in words; of a map or a MultiBlock a line for each material.
    """

    actor: str
    material: str
    method: str
    error: float | None
    tolerance: float
    text: str


class Measured:
    """Measured materials in a plotter: `plotter.measured`."""

    def __init__(self, plotter: Any) -> None:
        self._plotter: Any = weakref.proxy(plotter)
        self._environments: weakref.WeakKeyDictionary[Any, Environment] = weakref.WeakKeyDictionary()
        self._removed_lights: weakref.WeakKeyDictionary[Any, list[Any]] = weakref.WeakKeyDictionary()
        self._plans: list[Plan] = []
        add_hooks(plotter)

    def add_mesh(
        self,
        mesh: Any,
        material: Any,
        *,
        tolerance: float = 0.02,
        scalars: Any = None,
        smooth_shading: bool | None = None,
        split_sharp_edges: bool | None = None,
        fit_property: bool = True,
        render: bool = True,
        **kwargs: Any,
    ) -> pv.Actor:
        """Adds a mesh made of a measured material.

        Parameters
        ----------
        mesh
            What `pv.Plotter.add_mesh` takes: a dataset, a MultiBlock, or an algorithm, which stays connected.
        material
            A `Material`, or what makes one: an embedded material's name, a file, a `vtkBRDF`. The same text gives
            the same material. Of a MultiBlock also a sequence, one for each block, or a mapping from names or
            indices of blocks (as in `mesh[index]`) to materials, with the key None for the rest. None: drawn as
            PyVista draws it. A `MaterialMap`: data choose the material of each place.
        tolerance
            The relative error to stay below, from 0.001 to 1.
        scalars
            A name or an array, as PyVista takes it: its colors multiply the material's. None: none, even if the mesh
            has active scalars.
        smooth_shading, split_sharp_edges, feature_angle
            As PyVista's, but the default is smooth. Where the mesh has no point normals, they are computed, and
            edges sharper than feature_angle (30 degrees) stay sharp.
        fit_property
            Whether to set the actor's property to a close match in physically based shading, for what draws the
            property and not the material: exporters, and viewers in the browser. Once for a material: tenths of a second.
        **kwargs
            Further keywords of `pv.Plotter.add_mesh`. Those that the material replaces (color, pbr, metallic,
            roughness, ambient, diffuse, specular, specular_power) have no effect; a warning says so.

        Returns
        -------
        pv.Actor
            Its mapper is a `MeasuredMapper` or `MeasuredCompositeMapper`, with `material` and `tolerance`.
        """
        if kwargs.get("style") == "points_gaussian":
            raise ValueError("style: found 'points_gaussian', which draws no surface")
        if not 1e-3 <= tolerance <= 1.0:
            raise ValueError(f"tolerance: found {tolerance}, expected 0.001 to 1")
        self._warn_of_replaced(kwargs)
        mesh = mesh if is_algorithm(mesh) or pv.is_pyvista_dataset(mesh) else pv.wrap(mesh)
        blocks = None
        material_map = material if isinstance(material, MaterialMap) else None
        material = material_map.others if material_map else material
        if isinstance(mesh, pv.MultiBlock):
            material, blocks = resolve_materials(mesh, material)
            blocks = {index: find_material(given) for index, given in blocks.items()}
        material = find_material(material)
        smooth = True if smooth_shading is None else smooth_shading
        mesh, scalars, shading = self._prepare(mesh, scalars, smooth, split_sharp_edges, kwargs)
        if scalars is None and not kwargs.get("rgb") and kwargs.get("color") is None:
            kwargs["color"] = "white"  # else PyVista colors by active scalars
        actor = self._plotter.add_mesh(mesh, scalars=scalars, render=False, **shading, **kwargs)
        old = actor.mapper
        if blocks is None:
            new: Any = MeasuredMapper.from_mapper(old, material)
        else:
            new = MeasuredCompositeMapper.from_mapper(old, material, blocks)
        new.material_map = material_map
        new.tolerance = tolerance
        actor.mapper = new
        self._replace_mapper(old, new)
        if smooth:
            actor.prop.interpolation = "Phong"
        shown = _get_first(material_map, material)
        if fit_property and shown is not None and kwargs.get("style") in (None, "surface"):
            _fit(shown, actor.prop)
        if render:
            self._plotter.render()
        return actor

    @staticmethod
    def _warn_of_replaced(kwargs: dict[str, Any]) -> None:
        if kwargs.get("style") in (None, "surface"):
            replaced = [name for name in _REPLACED if kwargs.pop(name, None) is not None]
            if replaced:
                warnings.warn(", ".join(replaced) + ": no effect, the measured material replaces it", stacklevel=3)

    @staticmethod
    def _prepare(mesh: Any, scalars: Any, smooth: bool, split: bool | None, kwargs: dict[str, Any]) -> Any:
        """The mesh and its scalars as PyVista takes them, and its keywords for shading."""
        if is_algorithm(mesh):
            angle = kwargs.pop("feature_angle", FEATURE_ANGLE)
            return extend_pipeline(mesh, smooth, angle), scalars, {"smooth_shading": False}
        if isinstance(mesh, pv.MultiBlock):
            return mesh, scalars, {"smooth_shading": smooth}
        if not isinstance(mesh, pv.PolyData) and not isinstance(mesh, pv.PointSet):
            mesh, scalars = extract_surface(mesh, scalars, kwargs.get("preference", "point"))
        if split is None:
            split = smooth and mesh.point_data.active_normals is None
        return mesh, scalars, {"smooth_shading": smooth, "split_sharp_edges": split}

    def _replace_mapper(self, old: Any, new: Any) -> None:
        """Where PyVista remembers an actor's mapper."""
        self._plotter.mapper = new
        bars = getattr(getattr(self._plotter, "scalar_bars", None), "_scalar_bar_mappers", {})
        for mappers in bars.values():
            mappers[:] = [new if mapper is old else mapper for mapper in mappers]

    def set_material(self, actor: Any, material: Any, *, render: bool = True) -> None:
        """Gives an actor of `add_mesh` another material, and fits its property to it.

        actor: the actor or its name in the plotter.
        """
        actor = self._plotter.renderer.actors[actor] if isinstance(actor, str) else actor
        if not isinstance(actor.mapper, (MeasuredMapper, MeasuredCompositeMapper)):
            raise ValueError(f"actor: found one with a {type(actor.mapper).__name__}, expected one of add_mesh")
        material_map = material if isinstance(material, MaterialMap) else None
        material = material_map.others if material_map else find_material(material)
        actor.mapper.material = material
        actor.mapper.material_map = material_map
        shown = _get_first(material_map, material)
        if shown is not None:
            _fit(shown, actor.prop)
        if render:
            self._plotter.render()

    def set_environment(
        self,
        environment: Any,
        *,
        rotate: float = 0.0,
        up: Any = (0.0, 0.0, 1.0),
        background: str | None = None,
        lights: str = "auto",
        render: bool = True,
    ) -> None:
        """Lights the active renderer by an environment, in place of an earlier one.

        It becomes the renderer's environment texture, without VTK's own image-based lighting, which would take
        seconds to prepare.

        Parameters
        ----------
        environment
            An `Environment`, or what makes one: an embedded environment's name, an image file, an array, an image
            (`pv.ImageData`), a lat-long texture (`pv.Texture`, `vtkTexture`).
        rotate
            Angle in degrees by which the environment is turned about `up`, counterclockwise seen from above.
            To turn it further costs nothing: call this again with the same object, name or file. Of an array make an
            `Environment` first: an array may have changed, and is read again.
        up
            The direction in the world that is up. PyVista's views have z up; (0, 1, 0) is VTK's habit.
        background
            "map": the environment is seen behind the scene. "blurred": a blurred version of it. None: neither.
        lights
            "auto": PyVista's default light kit is removed, since its light would add to the environment's; lights
            that you have chosen stay. "keep": all lights stay. "remove": all are removed.
        """
        if background is not None and background not in BACKGROUNDS:
            raise ValueError(f"background: found {background!r}, expected 'map', 'blurred' or None")
        if lights not in _LIGHTS:
            raise ValueError(f"lights: found {lights!r}, expected 'auto', 'keep' or 'remove'")
        renderer = self._plotter.renderer
        found = find_environment(environment)
        right, vertical = get_axes(found, up, rotate)
        self._environments[renderer] = found  # the same name finds it again, and its texture, while it is in use
        texture = _get_texture(found, "map")
        renderer.UseImageBasedLightingOff()
        renderer.SetEnvironmentTexture(texture)
        renderer.SetEnvironmentRight(*right)
        renderer.SetEnvironmentUp(*vertical)
        self._remove_lights(renderer, lights)
        renderer.remove_actor(_BACKGROUND_NAME, render=False)
        if background is not None:
            skybox = new_skybox(_get_texture(found, background), right, vertical)
            renderer.add_actor(skybox, name=_BACKGROUND_NAME, reset_camera=False, pickable=False, render=False)
        if render:
            self._plotter.render()

    def _remove_lights(self, renderer: Any, lights: str) -> None:
        removed = [] if lights == "keep" else get_default_lights(renderer)
        if lights == "remove":
            removed = list(renderer.lights)
        if removed:
            self._removed_lights.setdefault(renderer, []).extend(removed)
            renderer.remove_all_lights()
        if lights != "keep":
            renderer.AutomaticLightCreationOff()  # VTK lights a scene that has no light

    def remove_environment(self, *, render: bool = True) -> None:
        """Removes the active renderer's environment and its background; lights that it removed come back."""
        renderer = self._plotter.renderer
        self._environments.pop(renderer, None)
        renderer.UseImageBasedLightingOff()
        renderer.SetEnvironmentTexture(None)
        renderer.SetEnvironmentRight(1.0, 0.0, 0.0)
        renderer.SetEnvironmentUp(0.0, 1.0, 0.0)
        renderer.remove_actor(_BACKGROUND_NAME, render=False)
        for light in self._removed_lights.pop(renderer, []):
            renderer.AddLight(light)
        if render:
            self._plotter.render()

    def plans(self) -> list[Plan]:
        """How the actors with measured materials were drawn last, in all renderers; also after the plotter was
        closed."""
        if self._plotter.render_window is not None:
            self.remember_plans()
        return list(self._plans)

    def remember_plans(self) -> None:
        """For `plans` after the plotter was closed, which calls this."""
        if self._plotter.render_window is not None:
            self._plans = [_describe(name, actor.mapper) for name, actor in get_measured_actors(self._plotter)]


def _get_first(material_map: MaterialMap | None, material: Material | None) -> Material | None:
    """The material that stands for all of a map where only one can be shown."""
    materials = [one for one in material_map.materials if one is not None] if material_map else []
    return materials[0] if materials else material


def _describe(name: str, mapper: Any) -> Plan:
    single = isinstance(mapper, MeasuredMapper) and mapper.material_map is None
    planner: Any = mapper.GetCurrentPlanner() if single else None
    choice = planner.GetChoice() if planner else -1
    material = mapper.material.name if mapper.material and mapper.material_map is None else ""
    method = planner.GetMethodName(choice) if choice >= 0 else ""
    error = planner.GetPredictedError(choice) if choice >= 0 else None
    return Plan(name, material, method, error, mapper.tolerance, mapper.plan)


_found: weakref.WeakValueDictionary[Any, Any] = weakref.WeakValueDictionary()


def _find(source: Any, kind: type) -> Any:
    """The same object for the same name, and for the same file or VTK object while that does not change."""
    if isinstance(source, kind):
        return source
    key: tuple[Any, ...]
    if isinstance(source, vtkObject):
        # No two changes in the program have the same time.
        key = (kind, source.GetMTime(), get_image(source).GetMTime() if isinstance(source, vtkTexture) else 0)
    elif isinstance(source, (str, os.PathLike)):
        text = os.fspath(source)
        key = (kind, text)
        path = text if os.path.exists(text) else text.rpartition("#")[0]
        if os.path.exists(path):
            status = os.stat(path)
            key = (kind, os.path.abspath(text), status.st_mtime_ns, status.st_size)
    else:
        return kind(source)
    found = _found.get(key)
    if found is None:
        found = _found[key] = kind(source)
    return found


def find_material(source: Any) -> Material | None:
    """The material; None for None."""
    return None if source is None else _find(source, Material)


def find_environment(source: Any) -> Environment:
    """The environment, of which a change of its rotation is not seen by others."""
    return _find(source, Environment)


_fitters: weakref.WeakKeyDictionary[Material, tuple[int, Any]] = weakref.WeakKeyDictionary()


def _fit(material: Material, prop: Any) -> None:
    """Sets the property to a close match in physically based shading."""
    time = material.brdf.GetMTime()
    if material not in _fitters or _fitters[material][0] != time:
        fitter = vtkPBRPropertyFitter()
        fitter.SetBRDF(material.brdf)
        fitter.Update()
        _fitters[material] = (material.brdf.GetMTime(), fitter)
    _fitters[material][1].Apply(prop)


_textures: weakref.WeakKeyDictionary[Environment, dict[str, tuple[int, Any]]] = weakref.WeakKeyDictionary()


def _get_texture(environment: Environment, kind: str) -> Any:
    """The environment's texture ("map") or its blurred one, made once."""
    made = _textures.setdefault(environment, {})
    time = environment.environment.GetPixelsMTime()
    if kind not in made or made[kind][0] != time:
        # vtkSkybox shows the second level of a mipmap, which is too coarse for what is small already.
        texture = new_texture(blur(environment), False) if kind == "blurred" else new_texture(environment)
        made[kind] = (time, texture)
    return made[kind][1]
