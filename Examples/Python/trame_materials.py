#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""A small web page: choose a material, an environment, a tolerance and a mesh; see the picture, the plan and its error.

The server draws, and sends pictures to the browser. Needs trame and trame-vuetify (pip), and PyVista.
"""

import base64
import io
import os

import pyvista as pv
from PIL import Image
from trame.app import get_server
from trame.ui.vuetify3 import SinglePageWithDrawerLayout
from trame.widgets import html, vuetify3 as v3

import vtkmeasuredbrdf.pyvista as measured

MESHES = {
    "sphere": lambda: pv.Sphere(theta_resolution=120, phi_resolution=120),
    "super torus": lambda: pv.ParametricSuperToroid(n1=1.0, n2=1.0),
    "rounded cube": lambda: pv.ParametricSuperEllipsoid(n1=0.3, n2=0.3),
    "cube": pv.Cube,
}
TOLERANCES = [0.01, 0.02, 0.05, 0.1, 0.2]
ACTOR = "object"

server = get_server(client_type="vue3")
state = server.state
state.trame__title = "Measured materials"
state.update({
    "material": "blue-car-paint", "environment": "room", "tolerance": 0.02, "mesh": "rounded cube",
    "turn": 0, "azimuth": 30, "elevation": 20, "picture": "", "plan": "", "error": "", "problem": "",
})
plotter = pv.Plotter(off_screen=True, window_size=(800, 560))
shown = {}  # what the plotter holds now


def update_scene():
    """Brings the plotter to what the page asks for; only what changed is done."""
    if shown.get("mesh") != state.mesh:
        plotter.measured.add_mesh(MESHES[state.mesh](), state.material, name=ACTOR, render=False)
        plotter.reset_camera()
    actor = plotter.renderer.actors[ACTOR]
    if shown.get("material") != state.material:
        plotter.measured.set_material(actor, state.material, render=False)
    actor.mapper.tolerance = float(state.tolerance)
    if shown.get("environment") != (state.environment, state.turn):
        plotter.measured.set_environment(
            state.environment, rotate=float(state.turn), background="blurred", render=False)
    shown.update(mesh=state.mesh, material=state.material, environment=(state.environment, state.turn))
    plotter.camera_position = "xz"
    plotter.camera.azimuth = float(state.azimuth)
    plotter.camera.elevation = float(state.elevation)
    plotter.camera.zoom(1.1)


@state.change("material", "environment", "tolerance", "mesh", "turn", "azimuth", "elevation")
def draw(**_):
    """Draws a picture and sends it."""
    try:
        update_scene()
    except (OSError, ValueError) as error:  # a file that is missing or no material
        state.problem = str(error)
        return
    file = io.BytesIO()
    Image.fromarray(plotter.screenshot(return_img=True)).save(file, "JPEG", quality=92)
    state.picture = "data:image/jpeg;base64," + base64.b64encode(file.getvalue()).decode()
    (plan,) = plotter.measured.plans()
    state.plan = plan.text
    state.error = "" if plan.error is None else f"{plan.method}, predicted error {100 * plan.error:.1f} %"
    state.problem = ""


with SinglePageWithDrawerLayout(server) as layout:
    layout.title.set_text("Measured materials")
    with layout.drawer, v3.VContainer():
        v3.VCombobox(label="Material, or a file", v_model=("material",), items=("materials", measured.Material.names()))
        v3.VCombobox(label="Environment, or a file", v_model=("environment",),
                     items=("environments", measured.Environment.names()))
        v3.VSelect(label="Tolerance", v_model=("tolerance",), items=("tolerances", TOLERANCES))
        v3.VSelect(label="Mesh", v_model=("mesh",), items=("meshes", list(MESHES)))
        for name, label, low, high in (("turn", "Turn the environment", 0, 360), ("azimuth", "Azimuth", 0, 360),
                                       ("elevation", "Elevation", -80, 80)):
            v3.VSlider(label=label, v_model=(name,), min=low, max=high, step=5, hide_details=True)
    with layout.content, v3.VContainer(fluid=True):
        v3.VAlert("{{ problem }}", type="error", v_if=("problem",))
        html.H3("{{ error }}", id="error")
        html.P("{{ plan }}", id="plan", style="margin-bottom: 1em")
        html.Img(src=("picture",), id="picture", style="max-width: 100%")

if __name__ == "__main__":
    os.environ.setdefault("TRAME_DISABLE_V3_WARNING", "1")
    server.start()
