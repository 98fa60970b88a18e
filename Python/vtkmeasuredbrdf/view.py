# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A page to explore materials: `measured-brdf view [FILE...]` in a browser, `app()` in a cell of a notebook.

The server draws and sends pictures. Needs PyVista, trame and trame-vuetify.
"""

from __future__ import annotations

import asyncio
import base64
import io
import itertools
from typing import Any, Sequence

try:
    import pyvista as pv
    from trame.app import TrameApp, get_server
    from trame.ui.vuetify3 import SinglePageWithDrawerLayout
    from trame.widgets import vuetify3 as v3
except ImportError as error:
    raise ImportError(f"vtkmeasuredbrdf.view needs more packages ({error}): "
                      "pip install pyvista trame trame-vuetify") from None
import numpy as np
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy

from . import pyvista as measured, vtkBRDFLobeSource, vtkBRDFSliceSource
from .pyvista._component import find_material


def _make_vase() -> Any:
    profile = [(0.01, 0.0, 0.0), (0.45, 0.0, 0.0), (0.75, 0.0, 0.6), (0.5, 0.0, 1.25), (0.25, 0.0, 1.6), (0.4, 0.0, 1.9)]
    return pv.Spline(np.array(profile), 120).extrude_rotate(resolution=180, capping=False)


MESHES = {
    "sphere": lambda: pv.Sphere(theta_resolution=120, phi_resolution=120),
    "vase": _make_vase,
    "rounded cube": lambda: pv.ParametricSuperEllipsoid(n1=0.3, n2=0.3),
}
TOLERANCES = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2]
_SCENE = ("material", "environment", "mesh", "tolerance", "rotation", "azimuth", "elevation", "zoom")
_COLORS = ("#d64036", "#2e8c3e", "#3462cc")
_DECADES = 4  # of the charts' logarithmic axes
_PICTURE = """<img id="picture" :src="picture" draggable="false" style="width: 100%; cursor: grab; touch-action: none"
  @pointermove="if ($event.buttons) { azimuth = azimuth - 0.5 * $event.movementX;
    elevation = Math.max(-85, Math.min(85, elevation + 0.5 * $event.movementY)) }"
  @wheel.prevent="zoom = Math.max(0.3, Math.min(8, zoom * Math.exp(-0.001 * $event.deltaY)))">
<h3 id="error">{{ error }}</h3><p id="plan">{{ plan }}</p>"""
_numbers = itertools.count()


class App(TrameApp):
    """The page. A notebook shows it where it is the last line of a cell; `server.start()` opens a browser.

    What is chosen is `state.material`, `state.environment`, `state.mesh`, `state.tolerance`, `state.rotation` and
    `state.angle`, from Python, too.
    """

    def __init__(self, server: Any, materials: Sequence[str], environment: str, mesh: str, tolerance: float) -> None:
        super().__init__(server)
        self._choices = {
            "materials": list(dict.fromkeys([*materials, "blue-car-paint", *measured.Material.names()])),
            "environments": list(dict.fromkeys([environment, *measured.Environment.names()])),
            "meshes": list(dict.fromkeys([mesh, *MESHES])),
        }
        self.state.update({
            "trame__title": "Measured materials", "material": self._choices["materials"][0], "environment": environment,
            "mesh": mesh, "tolerance": tolerance, "rotation": 0, "azimuth": 30, "elevation": 20, "zoom": 1.1, "angle": 45,
            "picture": "", "plan": "", "error": "", "lobe": "", "charts": "", "problems": [],
        })
        self._plotter = pv.Plotter(off_screen=True, window_size=(880, 660))
        self._lobe = pv.Plotter(off_screen=True, window_size=(480, 360))
        self._shown: dict[str, Any] = {}
        self._changes = 0
        self._put_mesh("vase")  # something to show where the mesh asked for is bad
        self._shown["mesh"] = "vase"
        self.mapper.tolerance = tolerance
        self.state.change(*_SCENE, "angle")(self._on_change)
        self._build()

    async def _on_change(self, **_: Any) -> None:
        """Draws what is wanted then, and again once it is planned."""
        self._changes += 1
        change = self._changes
        known = {name for names in self._choices.values() for name in names}
        typed = not {self.state.material, self.state.environment, self.state.mesh} <= known
        await asyncio.sleep(0.5 if typed else 0.01)  # more letters, or more moves of the mouse
        if change == self._changes:
            self._draw()
        while change == self._changes and self.mapper.GetPlanPending():
            await asyncio.sleep(0.05)
            if self.mapper.GetPlanReady():
                self._draw()

    def _draw(self) -> None:
        with self.state:
            self.draw()

    @property
    def mapper(self) -> Any:
        """The object's, whose material None is drawn as PyVista draws it."""
        return self._plotter.renderer.actors["object"].mapper

    def draw(self) -> None:
        """Brings the pictures to what the state asks for. What cannot be read is said, and what was before it stays."""
        problems = []
        for name, put in (("mesh", self._put_mesh), ("material", self._put_material),
                          ("environment", self._put_environment)):
            value = (self.state.environment, self.state.rotation) if name == "environment" else self.state[name]
            try:
                if self._shown.get(name) != value:
                    put(value)
                    self._shown[name] = value
            except (OSError, ValueError) as error:
                problems.append(str(error))
        self.state.problems = problems
        self.mapper.tolerance = float(self.state.tolerance)
        self._plotter.view_xz(render=False)
        self._plotter.camera.azimuth = self.state.azimuth
        self._plotter.camera.elevation = self.state.elevation
        self._plotter.camera.zoom(self.state.zoom)
        self.state.picture = _encode(self._plotter)
        (plan,) = self._plotter.measured.plans()
        self.state.plan = plan.text
        self.state.error = "" if plan.error is None else f"{plan.method}, predicted error {100 * plan.error:.1f} %"
        lobe = self.mapper.material, float(self.state.angle)
        if lobe[0] and self._shown.get("lobe") != lobe:
            self._put_lobe(*lobe)
            self.state.charts = _draw_charts(*lobe)
            self._shown["lobe"] = lobe

    def _put_mesh(self, name: str) -> None:
        mesh = MESHES[name]() if name in MESHES else pv.read(str(name))
        if isinstance(mesh, pv.MultiBlock):
            mesh = mesh.combine()
        if mesh.n_points == 0:
            raise ValueError(f"{name}: found no points, expected a mesh")
        material = self.mapper.material if self._shown else None
        actor = self._plotter.measured.add_mesh(mesh, material, name="object", fit_property=False, render=False)
        actor.mapper.SetPlanningModeToBackgroundFromStart()
        self._plotter.reset_camera(render=False)

    def _put_material(self, name: str) -> None:
        self.mapper.material = find_material(name)

    def _put_environment(self, value: tuple[str, float]) -> None:
        self._plotter.measured.set_environment(value[0], rotate=float(value[1]), background="blurred", render=False)

    def _put_lobe(self, material: measured.Material, angle: float) -> None:
        source = vtkBRDFLobeSource()
        source.SetBRDF(material.brdf)
        source.SetThetaI(angle)
        source.SetScalingToLogarithmic()
        source.NormalizeOn()
        source.Update()
        lobe = pv.wrap(source.GetOutput()).compute_normals(split_vertices=False)
        x, z = np.sin(np.radians(angle)), np.cos(np.radians(angle))
        add = self._lobe.add_mesh
        add(lobe, name="lobe", color="#8f96a3", smooth_shading=True, specular=0.15, ambient=0.15, render=False,
            reset_camera=False, scalars=None)
        add(pv.Line((0, 0, 0), (-1.3 * x, 0, 1.3 * z)), name="light", color="#e0a800", line_width=3, render=False)
        add(pv.Line((0, 0, 0), (1.3 * x, 0, 1.3 * z)), name="mirror", color="#909090", line_width=1, render=False)
        add(pv.Polygon(radius=1.0, n_sides=96, fill=False), name="horizon", color="#909090", render=False)
        self._lobe.camera_position = [(1.2, -3.6, 1.6), (0, 0, 0.45), (0, 0, 1)]
        self._lobe.render()
        self.state.lobe = _encode(self._lobe)

    def _build(self) -> None:
        with SinglePageWithDrawerLayout(self.server) as self.ui:
            self.ui.title.set_text("Measured materials")
            self.ui.footer.hide()
            with self.ui.drawer as drawer, v3.VContainer():
                drawer.width = 300
                for name, choices in (("material", "materials"), ("environment", "environments"), ("mesh", "meshes")):
                    v3.VCombobox(label=f"{name.capitalize()}, or a file", v_model=(name,),
                                 items=(choices, self._choices[choices]))
                v3.VSelect(label="Tolerance", v_model=("tolerance",),
                           items=("tolerances", sorted({*TOLERANCES, self.state.tolerance})))
                for name, label, high in (("rotation", "Turn the environment", 360), ("angle", "Light of the lobe", 89)):
                    v3.VLabel(f"{label}: {{{{ {name} }}}}°")
                    v3.VSlider(v_model=(name,), min=0, max=high, step=1, hide_details=True)
            with self.ui.content, v3.VContainer(fluid=True):
                v3.VAlert("{{ problem }}", type="error", v_for="problem in problems", key="problem", classes="mb-2")
                with v3.VRow():
                    v3.VCol(_PICTURE, cols=12, md=8)
                    v3.VCol('<img id="lobe" :src="lobe" style="width: 100%"><div id="charts" v-html="charts"></div>',
                            cols=12, md=4)


def _encode(plotter: Any) -> str:
    """The plotter's picture for a page."""
    file = io.BytesIO()
    Image.fromarray(plotter.screenshot(return_img=True)).save(file, "JPEG", quality=92)
    return "data:image/jpeg;base64," + base64.b64encode(file.getvalue()).decode()


def _draw_charts(material: measured.Material, angle: float) -> str:
    """Two charts of f on one logarithmic scale as SVG: the plane of incidence, and a slice over theta_h."""
    theta = np.radians(angle)
    mirror = angle + 4.0 * np.linspace(-1.0, 1.0, 129) ** 3
    degrees = np.sort(np.concatenate([np.linspace(-89.5, 89.5, 359), mirror[mirror < 89.5]]))
    o = np.stack([np.sin(np.radians(degrees)), 0.0 * degrees, np.cos(np.radians(degrees))], axis=-1)
    plane = material.evaluate((-np.sin(theta), 0.0, np.cos(theta)), o)
    source = vtkBRDFSliceSource()
    source.SetBRDF(material.brdf)
    source.SetThetaDRange(angle, angle)
    source.UseThetaHSquaredOn()
    source.Update()
    table = {name: vtk_to_numpy(source.GetOutput().GetColumnByName(name))
             for name in ("theta_h", "red", "green", "blue", "vtkValidPointMask")}
    valid = table["vtkValidPointMask"] != 0
    theta_h = table["theta_h"][valid]
    slices = np.stack([table[name][valid] for name in ("red", "green", "blue")], axis=-1)
    top = np.ceil(np.log10(max(plane.max(initial=0.0), slices.max(initial=0.0), 1e-6)))

    def scale(f: Any) -> Any:
        return np.clip((np.log10(np.maximum(f, 1e-30)) - top) / _DECADES + 1.0, 0.0, 1.0)

    polar, flat = [], []
    half = np.radians(np.linspace(-90.0, 90.0, 91))
    for decade in range(_DECADES + 1):
        r = decade / _DECADES
        text = f"{10.0 ** (top - _DECADES + decade):g}"
        polar.append(("#ccc", 200 + 180 * r * np.sin(half), 195 - 180 * r * np.cos(half), text if decade else ""))
        flat.append(("#ccc", np.array((5.0, 395.0)), np.full(2, 195 - 180 * r), text))
    polar.append(("#e0a800", np.array((200, 200 - 190 * np.sin(theta))), np.array((195, 195 - 190 * np.cos(theta))), ""))
    for color, in_plane, in_slice in zip(_COLORS, scale(plane).T, scale(slices).T):
        polar.append((color, 200 + 180 * in_plane * np.sin(np.radians(degrees)),
                      195 - 180 * in_plane * np.cos(np.radians(degrees)), ""))
        flat.append((color, 5 + 390 / 90 * theta_h, 195 - 180 * in_slice, ""))
    return (_draw_svg("f in 1/sr in the plane of incidence", polar)
            + _draw_svg(f"f over theta_h from 0 to 90°, where theta_d is {angle:g}°", flat))


def _draw_svg(title: str, lines: Sequence[tuple[str, Any, Any, str]]) -> str:
    """Lines as color, x, y and a text at the start."""
    parts = []
    for color, x, y, text in lines:
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
        parts.append(f'<polyline fill="none" stroke="{color}" stroke-width="1.5" points="{points}"/>')
        parts.append(f'<text x="{x[0] + 2:.0f}" y="{y[0] - 3:.0f}" font-size="11">{text}</text>')
    return f'<p>{title}</p><svg viewBox="0 0 400 205" style="width: 100%">{"".join(parts)}</svg>'


def app(*materials: str, environment: str = "room", mesh: str = "vase", tolerance: float = 0.02) -> App:
    """The page, for a cell of a notebook.

    materials: files, which are listed before the embedded materials; the first one is shown. environment: a name or a
    file. mesh: "sphere", "vase", "rounded cube" or a file that PyVista reads.
    """
    return App(f"vtkmeasuredbrdf-{next(_numbers)}", materials, environment, mesh, tolerance)


def main() -> None:
    """`measured-brdf view`."""
    server = get_server("vtkmeasuredbrdf")
    parser = server.cli  # which has trame's own options
    parser.prog, parser.description = "measured-brdf view", "Explore materials in a browser."
    parser.add_argument("materials", metavar="FILE", nargs="*", help="materials; the embedded ones are listed, too")
    parser.add_argument("--environment", default="room", help="a name or a file (%(default)s)")
    parser.add_argument("--mesh", default="vase", help=f"{', '.join(MESHES)} or a file (%(default)s)")
    parser.add_argument("--tolerance", type=float, default=0.02, help="relative error to stay below (%(default)s)")
    options = parser.parse_args()
    try:
        App(server, options.materials, options.environment, options.mesh, options.tolerance)
    except ValueError as error:
        parser.error(str(error))
    server.start()


if __name__ == "__main__":
    main()
