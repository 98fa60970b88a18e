# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a plotter does differently once it has measured materials: screenshots and exports for browsers."""

from __future__ import annotations

import contextlib
import functools
import importlib.util
import weakref
from typing import Any, Callable, Iterator

from ._mappers import MeasuredCompositeMapper, MeasuredMapper


def get_measured_actors(plotter: Any) -> list[tuple[str, Any]]:
    """Names and actors of all renderers that have one of our mappers."""
    return [(name, actor) for renderer in plotter.renderers for name, actor in renderer.actors.items()
            if isinstance(getattr(actor, "mapper", None), (MeasuredMapper, MeasuredCompositeMapper))]


def add_hooks(plotter: Any) -> None:
    """A screenshot draws first: PyVista's own shows the last picture that was drawn. Exports for vtk.js
    know the mappers, and have colors as vtk.js shows them. Plans are known after the plotter
    was closed, as show() does it."""
    _wrap(plotter, "screenshot", lambda owner: owner.render())  # nothing happens before the first picture
    _wrap(plotter, "export_html", around=browser_colors)
    _wrap(plotter, "export_vtksz", around=browser_colors)
    _wrap(plotter, "show", lambda owner: register_serializers())
    _wrap(plotter, "close", lambda owner: owner.measured.remember_plans())


def _wrap(plotter: Any, name: str, before: Callable[[Any], Any] | None = None, around: Any = None) -> None:
    """Replaces a method of this plotter alone."""
    get_owner = weakref.ref(plotter)
    original = getattr(type(plotter), name, None)
    if original is None:
        return

    @functools.wraps(original)
    def method(*args: Any, **kwargs: Any) -> Any:
        owner = get_owner()
        if before:
            before(owner)
        with around(owner) if around else contextlib.nullcontext():
            return original(owner, *args, **kwargs)

    plotter.__dict__[name] = method


_in_browser_colors: weakref.WeakSet[Any] = weakref.WeakSet()


@contextlib.contextmanager
def browser_colors(plotter: Any) -> Iterator[None]:
    """Inside of a with statement, the properties of measured actors have the colors that vtk.js wants.

    vtk.js shades by Phong's model and shows the result as it is: it wants the encoded color of the material.
    `plotter.export_html` and `plotter.export_vtksz` do this themselves; other ways to vtk.js do not.
    """
    register_serializers()
    if plotter in _in_browser_colors:  # export_html calls export_vtksz
        yield
        return
    _in_browser_colors.add(plotter)
    saved = []
    for _, actor in get_measured_actors(plotter):
        prop = actor.GetProperty()
        if prop.GetInterpolationAsString() == "Physically based rendering":
            for name in ("DiffuseColor", "SpecularColor", "AmbientColor"):
                color = getattr(prop, "Get" + name)()
                saved.append((getattr(prop, "Set" + name), color))
                getattr(prop, "Set" + name)(*(value ** (1.0 / 2.2) for value in color))
    try:
        yield
    finally:
        _in_browser_colors.discard(plotter)
        for set_color, color in saved:
            set_color(*color)


@functools.lru_cache(maxsize=None)
def register_serializers() -> bool:
    """Lets trame-vtk, where it is installed, send our mappers' data and colors to vtk.js."""
    if importlib.util.find_spec("trame_vtk") is None:
        return False
    try:
        from trame_vtk.modules.vtk.serializers.mappers import generic_mapper_serializer
        from trame_vtk.modules.vtk.serializers.registry import register_instance_serializer, register_js_class
    except ImportError:  # another version of it
        return False
    for name in ("vtkMeasuredBRDFMapper", "vtkCompositeMeasuredBRDFMapper"):
        register_instance_serializer(name, generic_mapper_serializer)
        register_js_class(name, "vtkMapper")
    return True
