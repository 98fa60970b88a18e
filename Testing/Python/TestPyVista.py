# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Measured materials in PyVista: pixels, surfaces, lights, subplots, copies, exports."""

import contextlib
import importlib.metadata
import importlib.util
import io
import json
import os
import pickle
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

try:
    import numpy as np
    import pyvista as pv
except ImportError as error:
    print(f"Skipped: PyVista is not installed ({error})")
    sys.exit(77)

import vtkmeasuredbrdf
from vtkmodules.vtkRenderingCore import vtkTexture

if tuple(map(int, pv.__version__.split(".")[:2])) < (0, 44):
    try:
        import vtkmeasuredbrdf.pyvista
    except ImportError as error:
        print(f"Skipped: {error}")
        sys.exit(77)
    sys.exit("an old PyVista is not refused")
import vtkmeasuredbrdf.pyvista as measured
from vtkmeasuredbrdf.maps import MaterialMap
from vtkmeasuredbrdf.materials import Environment, Material

pv.OFF_SCREEN = True
pv.global_theme.window_size = [200, 200]
WHITE = Environment(np.ones((64, 128, 3), np.float32))


def lambert(*albedo):
    brdf = vtkmeasuredbrdf.vtkLambertBRDF()
    brdf.SetAlbedo(albedo)
    return Material(brdf)


def vtk_texture(image):
    texture = vtkTexture()
    texture.SetInputData(image)
    return texture


def encode(radiance):
    """A pixel of that radiance."""
    return 255.0 * np.minimum(radiance, 1.0) ** (1.0 / 2.2)


def new_plotter(**keywords):
    return pv.Plotter(off_screen=True, **keywords)


def center(plotter):
    picture = plotter.screenshot(return_img=True)
    height, width = picture.shape[:2]
    return picture[height // 2, width // 2].astype(float)


def half_lit(axis, sign=1.0):
    """An environment whose radiance is 1 where an axis of its own frame has that sign, else 0.05."""
    height, width = 64, 128
    theta = (np.arange(height) + 0.5) * np.pi / height
    phi = (np.arange(width) + 0.5) * 2.0 * np.pi / width - np.pi
    xyz = np.stack(np.broadcast_arrays(
        np.sin(theta)[:, None] * np.cos(phi), np.cos(theta)[:, None], np.sin(theta)[:, None] * np.sin(phi)))
    return Environment(np.where(sign * xyz[axis] > 0.0, 1.0, 0.05)[..., None].repeat(3, axis=-1))


class PlotterTest(unittest.TestCase):
    def setUp(self):
        self.plotter = new_plotter()

    def tearDown(self):
        pv.close_all()

    def expect_pixel(self, plotter, radiance, tolerance=2.5):
        np.testing.assert_allclose(center(plotter), encode(np.array(radiance)), atol=tolerance)

    def expect_error(self, error, text, function, *arguments, **keywords):
        with self.assertRaises(error) as caught:
            function(*arguments, **keywords)
        self.assertIn(text, str(caught.exception))


class TestPixels(PlotterTest):
    def test_a_white_environment_shows_the_albedo(self):
        actor = self.plotter.measured.add_mesh(pv.Sphere(), lambert(0.8, 0.5, 0.1))
        self.plotter.measured.set_environment(WHITE)
        self.assertIsInstance(actor, pv.Actor)
        self.expect_pixel(self.plotter, (0.8, 0.5, 0.1))
        self.assertFalse(self.plotter.renderer.GetUseImageBasedLighting())

    def test_a_screenshot_shows_changes(self):
        actor = self.plotter.measured.add_mesh(pv.Sphere(), lambert(0.8, 0.5, 0.1))
        self.plotter.measured.set_environment(WHITE)
        self.expect_pixel(self.plotter, (0.8, 0.5, 0.1))
        actor.mapper.material.brdf.SetAlbedo(0.2, 0.2, 0.2)
        self.expect_pixel(self.plotter, (0.2, 0.2, 0.2))
        actor.mapper.material = lambert(0.1, 0.9, 0.1)
        self.expect_pixel(self.plotter, (0.1, 0.9, 0.1))
        self.plotter.measured.set_material(actor.name if hasattr(actor, "name") else actor, lambert(0.9, 0.1, 0.1))
        self.expect_pixel(self.plotter, (0.9, 0.1, 0.1))
        self.plotter.measured.set_environment(Environment(np.full((64, 128, 3), 0.5)))
        self.expect_pixel(self.plotter, (0.45, 0.05, 0.05))

    def test_the_light_kit_goes_and_chosen_lights_stay(self):
        self.plotter.measured.add_mesh(pv.Sphere(), lambert(0.2, 0.2, 0.2))
        lights = len(self.plotter.renderer.lights)
        self.assertGreater(lights, 1)
        self.plotter.measured.set_environment(WHITE)
        self.assertEqual(len(self.plotter.renderer.lights), 0)
        self.expect_pixel(self.plotter, (0.2, 0.2, 0.2))
        self.plotter.measured.remove_environment()
        self.assertIsNone(self.plotter.renderer.GetEnvironmentTexture())
        self.assertEqual(len(self.plotter.renderer.lights), lights)
        own = new_plotter(lighting="none")
        own.add_light(pv.Light(light_type="headlight", intensity=np.pi / 2))
        own.measured.add_mesh(pv.Sphere(), lambert(0.2, 0.2, 0.2))
        own.measured.set_environment(WHITE)
        self.expect_pixel(own, (0.3, 0.3, 0.3), 4.0)
        own.measured.set_environment(WHITE, lights="remove")
        self.expect_pixel(own, (0.2, 0.2, 0.2))

    def test_up_and_rotation(self):
        upper = half_lit(1)
        self.plotter.measured.add_mesh(pv.Sphere(), lambert(0.5, 0.5, 0.5))
        for up in ((0, 0, 1), (0, 1, 0)):
            self.plotter.measured.set_environment(upper, up=up)
            self.plotter.view_vector(up, viewup=(1, 0, 0))
            above = center(self.plotter)[0]
            self.plotter.view_vector([-c for c in up], viewup=(1, 0, 0))
            below = center(self.plotter)[0]
            self.assertGreater(above, below + 80.0)
            self.assertAlmostEqual(above, encode(0.5), delta=3.0)
        for rotate, view in ((0.0, (1, 0, 0)), (90.0, (0, 1, 0)), (180.0, (-1, 0, 0))):  # about z
            self.plotter.measured.set_environment(half_lit(0), rotate=rotate)
            self.plotter.view_vector(view)
            self.assertAlmostEqual(center(self.plotter)[0], encode(0.5), delta=3.0)
        turned = Environment(half_lit(0), rotation=90.0)  # its own rotation counts, too
        self.plotter.measured.set_environment(turned)
        self.plotter.view_vector((0, 1, 0))
        self.assertAlmostEqual(center(self.plotter)[0], encode(0.5), delta=3.0)

    def test_turning_keeps_the_texture(self):
        """What is made of an environment's pixels is made once, whatever names the environment."""
        pixels = np.linspace(0.1, 1.0, 64 * 128 * 3).reshape(-1, 3)
        image = pv.ImageData(dimensions=(128, 64, 1))
        image.point_data["light"] = pixels
        image.point_data.active_scalars_name = "light"
        environment = vtkmeasuredbrdf.vtkEnvironment()
        environment.SetToProceduralSky()
        self.plotter.measured.add_mesh(pv.Sphere(), "gold-paint")
        for source in ("room", image, vtk_texture(image), environment, WHITE):
            addresses, pictures = [], []
            for rotate in (0.0, 40.0, 80.0):
                self.plotter.measured.set_environment(source, rotate=rotate)
                addresses.append(self.plotter.renderer.GetEnvironmentTexture().GetAddressAsString(""))
                pictures.append(center(self.plotter))
            self.assertEqual(addresses, addresses[:1] * 3, source)
        image.point_data["light"] = pixels[::-1]
        image.point_data.active_scalars_name = "light"
        self.plotter.measured.set_environment(image)
        changed = self.plotter.renderer.GetEnvironmentTexture()
        self.plotter.measured.set_environment(image)
        self.assertIs(changed, self.plotter.renderer.GetEnvironmentTexture())

    def test_environments_of_images_and_textures(self):
        values = np.zeros((64, 128, 3), np.uint8)
        values[:32] = (188, 188, 188)  # sRGB of 0.503 above, nothing below
        image = pv.ImageData(dimensions=(128, 64, 1))
        image.point_data["colors"] = values[::-1].reshape(-1, 3)
        image.point_data.active_scalars_name = "colors"
        expected = Environment(values).pixels
        self.assertAlmostEqual(float(expected[0, 0, 0]), 0.503, delta=0.002)
        self.plotter.measured.add_mesh(pv.Sphere(), lambert(0.5, 0.5, 0.5))
        for source in (image, vtk_texture(image), pv.Texture(image), pv.Texture(values)):
            np.testing.assert_allclose(Environment(source).pixels, expected, atol=1e-6)
            self.plotter.measured.set_environment(source, up=(0, 0, 1))
            self.plotter.view_vector((0, 0, 1), viewup=(0, 1, 0))
            self.expect_pixel(self.plotter, np.full(3, 0.5 * 0.503))
        linear = pv.ImageData(dimensions=(128, 64, 1))
        linear.point_data["light"] = np.full((64 * 128, 3), 3.0)
        linear.point_data.active_scalars_name = "light"
        np.testing.assert_allclose(Environment(linear).pixels, 3.0)
        for source, text in ((pv.ImageData(dimensions=(4, 4, 4)), "point scalars"), (vtkTexture(), "without an image")):
            self.expect_error(ValueError, text, self.plotter.measured.set_environment, source)
        cube = vtkTexture()
        cube.CubeMapOn()
        self.expect_error(ValueError, "cube map", self.plotter.measured.set_environment, cube)

    def test_lines_and_points_have_their_color(self):
        for style in ("wireframe", "points"):
            plotter = new_plotter()
            plotter.measured.add_mesh(pv.Sphere(), "gold-paint", style=style, color="red", lighting=False,
                                      line_width=3, point_size=5)
            plotter.measured.set_environment("room")
            picture = plotter.screenshot(return_img=True).reshape(-1, 3).astype(int)
            red = (picture[:, 0] > 200) & (picture[:, 1] < 50) & (picture[:, 2] < 50)
            self.assertGreater(red.sum(), 500, style)

    def test_backgrounds(self):
        rng = np.random.default_rng(2)
        coarse = rng.random((8, 16, 3)).repeat(16, axis=0).repeat(16, axis=1)
        environment = Environment(coarse, rotation=20.0)
        self.plotter.measured.add_mesh(pv.Sphere(center=(-5, 0, 0)), "gold-paint")
        self.plotter.measured.set_environment(environment, rotate=25.0, background="map")
        self.plotter.camera_position = [(0, 0, 0), (1.0, 0.6, 0.3), (0, 0, 1)]
        # The world has z up, the environment y: its z axis is the world's -y.
        towards = np.array((1.0, 0.6, 0.3)) / np.linalg.norm((1.0, 0.6, 0.3))
        angle = np.radians(-25.0)
        x = np.cos(angle) * towards[0] - np.sin(angle) * towards[1]
        y = np.sin(angle) * towards[0] + np.cos(angle) * towards[1]
        expected = environment.radiance((x, towards[2], -y))
        np.testing.assert_allclose(center(self.plotter), encode(expected), atol=3.0)
        self.plotter.measured.set_environment(environment, rotate=25.0, background="blurred")
        blurred = self.plotter.screenshot(return_img=True).astype(float)
        self.assertLess(np.abs(np.diff(blurred, axis=0)).max(), 15.0)  # no edges
        self.assertGreater(blurred.min(), 20.0)
        self.plotter.measured.set_environment(environment)
        background = 255.0 * np.array(self.plotter.background_color.float_rgb)
        np.testing.assert_allclose(center(self.plotter), background, atol=2.0)
        self.expect_error(ValueError, "background: found 'sky'", self.plotter.measured.set_environment, WHITE,
                          background="sky")


class TestSurfaces(PlotterTest):
    def test_smooth_is_the_default(self):
        bare = pv.Sphere(theta_resolution=12, phi_resolution=12)
        bare.point_data.clear()
        actor = self.plotter.measured.add_mesh(bare, "gold-paint")
        self.assertNotEqual(actor.prop.GetInterpolation(), 0)
        self.assertIsNotNone(actor.mapper.dataset.point_data.active_normals)
        self.assertIsNone(bare.point_data.active_normals)  # the caller's mesh stays as it was
        corners = pv.Cube().clean()
        corners.point_data.clear()
        cube = self.plotter.measured.add_mesh(corners, "gold-paint")
        self.assertEqual(cube.mapper.dataset.n_points, 24)  # edges stay sharp
        flat = self.plotter.measured.add_mesh(bare, "gold-paint", smooth_shading=False, fit_property=False)
        self.assertEqual(flat.prop.GetInterpolation(), 0)

    def test_all_kinds_of_data(self):
        self.plotter.measured.set_environment(WHITE)
        grid = pv.ImageData(dimensions=(4, 4, 4), origin=(-1.5, -1.5, -1.5))
        cone = pv.ConeSource() if hasattr(pv, "ConeSource") else None
        source = new_source()
        for mesh in (grid, grid.cast_to_unstructured_grid(), grid.cast_to_structured_grid(), source,
                     source.GetOutputPort(), cone or pv.Cone(), pv.Cube().triangulate()):
            for smooth in (True, False):
                self.plotter.clear_actors()
                actor = self.plotter.measured.add_mesh(mesh, lambert(0.8, 0.5, 0.1), smooth_shading=smooth)
                self.plotter.reset_camera()
                self.expect_pixel(self.plotter, (0.8, 0.5, 0.1))
                self.assertIsInstance(actor.mapper, measured.MeasuredMapper)

    def test_pipelines_stay_connected(self):
        source = new_source()
        self.plotter.measured.set_environment(WHITE)
        self.plotter.measured.add_mesh(source, lambert(0.8, 0.5, 0.1))
        self.plotter.camera_position = [(0, 0, 5), (0, 0, 0), (0, 1, 0)]
        self.expect_pixel(self.plotter, (0.8, 0.5, 0.1))
        source.SetCenter(50.0, 0.0, 0.0)
        background = 255.0 * np.array(self.plotter.background_color.float_rgb)
        np.testing.assert_allclose(center(self.plotter), background, atol=2.0)

    def test_scalars_multiply_where_they_are_given(self):
        sphere = pv.Sphere()
        sphere.point_data["height"] = np.ones(sphere.n_points)
        sphere.set_active_scalars("height")
        self.plotter.measured.set_environment(WHITE)
        self.plotter.measured.add_mesh(sphere, lambert(0.8, 0.5, 0.1))
        self.expect_pixel(self.plotter, (0.8, 0.5, 0.1))
        self.assertEqual(len(self.plotter.scalar_bars), 0)
        self.plotter.clear_actors()
        actor = self.plotter.measured.add_mesh(sphere, lambert(0.8, 0.5, 0.1), scalars="height", clim=(0, 2),
                                               cmap=["black", "red"], n_colors=2)
        self.expect_pixel(self.plotter, (0.8, 0.0, 0.0))
        self.assertEqual(len(self.plotter.scalar_bars), 1)
        self.plotter.update_scalar_bar_range((0.0, 0.9), name="height")
        self.assertEqual(tuple(actor.mapper.scalar_range), (0.0, 0.9))
        self.plotter.remove_actor(actor)
        self.assertEqual(len(self.plotter.scalar_bars), 0)
        colors = np.tile(np.uint8((0, 255, 0)), (sphere.n_points, 1))
        self.plotter.measured.add_mesh(sphere, lambert(0.8, 0.5, 0.1), scalars=colors, rgb=True)
        self.expect_pixel(self.plotter, (0.0, 0.5, 0.0))
        grid = pv.ImageData(dimensions=(4, 4, 4))
        for smooth in (True, False):  # arrays of another length than the surface's
            for count in (grid.n_points, grid.n_cells):
                self.plotter.clear_actors()
                self.plotter.measured.add_mesh(grid, lambert(0.8, 0.5, 0.1), scalars=np.arange(count, dtype=float),
                                               smooth_shading=smooth, show_scalar_bar=False)
                self.assertGreater(center(self.plotter).max(), 0.0)

    def test_what_has_no_effect_is_said(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            self.plotter.measured.add_mesh(pv.Sphere(), "gold-paint", color="red", pbr=True)
        texts = [str(warning.message) for warning in caught]
        self.assertTrue(any("color, pbr: no effect" in text for text in texts), texts)

    def test_errors(self):
        add = self.plotter.measured.add_mesh
        self.expect_error(ValueError, "'gold-paint'", add, pv.Sphere(), "gold_paint")
        self.expect_error(FileNotFoundError, "missing.bsdf", add, pv.Sphere(), "missing.bsdf")
        self.expect_error(ValueError, "tolerance: found 7", add, pv.Sphere(), "gold-paint", tolerance=7)
        self.expect_error(ValueError, "points_gaussian", add, pv.Sphere(), "gold-paint", style="points_gaussian")
        self.assertEqual(len(self.plotter.renderer.actors), 0)
        actor = self.plotter.add_mesh(pv.Sphere())
        self.expect_error(ValueError, "DataSetMapper", self.plotter.measured.set_material, actor, "nickel")


def new_source():
    from vtkmodules.vtkFiltersSources import vtkSphereSource

    source = vtkSphereSource()
    source.SetThetaResolution(32)
    source.SetPhiResolution(32)
    return source


class TestBlocks(PlotterTest):
    COLORS = {"left": (0.8, 0.1, 0.1), "right": (0.1, 0.8, 0.1), "top": (0.1, 0.1, 0.8)}

    def new_blocks(self):
        blocks = pv.MultiBlock()
        for name, place in (("left", (-2, 0, 0)), ("right", (2, 0, 0))):
            blocks[name] = pv.Sphere(center=place)
        inner = pv.MultiBlock()
        inner["top"] = pv.Sphere(center=(0, 2, 0))
        blocks["inner"] = inner
        return blocks

    def expect_colors(self, expected):
        self.plotter.camera_position = [(0, 0, 12), (0, 0, 0), (0, 1, 0)]
        picture = self.plotter.screenshot(return_img=True).astype(float)
        per_unit = 200 / (2 * 12 * np.tan(np.radians(self.plotter.camera.view_angle / 2)))
        for name, (x, y) in (("left", (-2, 0)), ("right", (2, 0)), ("top", (0, 2))):
            pixel = picture[round(100 - y * per_unit), round(100 + x * per_unit)]
            np.testing.assert_allclose(pixel, encode(np.array(expected[name])), atol=2.5, err_msg=name)

    def test_materials_of_blocks(self):
        materials = {name: lambert(*color) for name, color in self.COLORS.items()}
        self.plotter.measured.set_environment(WHITE)
        by_index = {0: materials["left"], 1: materials["right"], 2: materials["top"]}
        by_rest = {"left": materials["left"], "right": materials["right"], None: materials["top"]}
        for given in (materials, by_index, by_rest, list(materials.values())):
            self.plotter.clear_actors()
            actor = self.plotter.measured.add_mesh(self.new_blocks(), given)
            self.assertIsInstance(actor.mapper, measured.MeasuredCompositeMapper)
            self.expect_colors(self.COLORS)
        same = self.plotter.measured.add_mesh(self.new_blocks(), materials["top"], name="same")
        actor.SetVisibility(False)
        self.expect_colors(dict.fromkeys(self.COLORS, self.COLORS["top"]))
        same.mapper.block_attr[1].opacity = 0.25
        copied = same.copy()
        self.assertEqual(copied.mapper.block_attr[1].opacity, 0.25)
        same.mapper.block_attr[1].opacity = None
        copied.mapper.block_attr[1].opacity = None
        self.plotter.clear_actors()
        copied.mapper.block_materials = {1: materials["left"]}
        self.plotter.add_actor(copied)
        self.expect_colors({**dict.fromkeys(self.COLORS, self.COLORS["top"]), "left": self.COLORS["left"]})

    def test_errors(self):
        add = self.plotter.measured.add_mesh
        self.expect_error(ValueError, "expected an index or one of 'left'", add, self.new_blocks(), {"x": "nickel"})
        self.expect_error(ValueError, "found block 3, expected 0 to 2", add, self.new_blocks(), {3: "nickel"})
        self.expect_error(ValueError, "found 1 materials, expected 3", add, self.new_blocks(), ["nickel"])


def find_all(scene, *types):
    """The parts of a scene for vtk.js, by type."""
    found = {}
    stack = [scene]
    while stack:
        part = stack.pop()
        if isinstance(part, dict):
            if part.get("type") in types:
                found.setdefault(part["type"], []).append(part)
            stack += part.values()
        elif isinstance(part, list):
            stack += part
    return found


class TestMaps(PlotterTest):
    """White light on a plane: its left half (x < 0) and its right half show what the map says."""

    def setUp(self):
        super().setUp()
        self.plane = pv.Plane(i_resolution=2, j_resolution=2)
        self.plane.cell_data["rock"] = [5, 9, 5, 9]
        self.rocks = MaterialMap.classes("rock", {5: lambert(0.2, 0.4, 0.6), 9: lambert(0.5, 0.1, 0.1)})

    def expect(self, mesh, material, left, right, *below):
        """Colors left and right of the middle, above it and, where given, below."""
        plotter = new_plotter()
        actor = plotter.measured.add_mesh(mesh, material)
        plotter.measured.set_environment(WHITE)
        plotter.view_xy()
        picture = plotter.screenshot(return_img=True).astype(float)
        middle = picture.shape[0] // 2
        for color, x, y in zip((left, right, *below), (-15, 15, 15), (-15, -15, 15)):
            np.testing.assert_allclose(picture[middle + y, middle + x], encode(np.array(color)), atol=3)
        return plotter, actor

    def test_classes(self):
        for mesh in (self.plane, pv.MultiBlock([self.plane])):
            plotter, actor = self.expect(mesh, self.rocks, (0.2, 0.4, 0.6), (0.5, 0.1, 0.1))
        plotter, actor = self.expect(self.plane, self.rocks, (0.2, 0.4, 0.6), (0.5, 0.1, 0.1))
        self.assertIs(actor.mapper.material_map, self.rocks)
        self.assertIs(actor.mapper.copy().material_map, self.rocks)
        self.assertEqual(len(plotter.measured.plans()), 1)
        plotter.measured.set_material(actor, lambert(0.7, 0.7, 0.7))
        self.assertIsNone(actor.mapper.material_map)
        self.expect_pixel(plotter, (0.7, 0.7, 0.7))

    def test_values_and_others(self):
        self.plane.cell_data["wet"] = [0.25, np.nan, 0.25, np.nan]
        wetness = MaterialMap.values("wet", {0.0: lambert(0.0, 0.4, 0.8), 1.0: lambert(0.8, 0.0, 0.0)},
                                     others=lambert(0.3, 0.3, 0.3))
        self.expect(self.plane, wetness, (0.2, 0.3, 0.6), (0.3, 0.3, 0.3))

    def test_weights(self):
        self.plane.point_data["a"] = np.full(9, 3.0)
        self.plane.point_data["b"] = np.full(9, 1.0)
        self.plane.point_data["both"] = np.tile((3.0, 1.0), (9, 1))
        materials = [lambert(0.8, 0.0, 0.4), lambert(0.0, 0.4, 0.4)]
        for arrays in ("both", ["a", "b"]):
            self.expect(self.plane, MaterialMap.weights(arrays, materials), *2 * [(0.6, 0.1, 0.4)])

    def test_images(self):
        image = np.zeros((2, 2, 2), np.uint8)
        image[:, 0, 0] = image[:, 1, 1] = 255  # left the first, right the second
        image[1] = 255  # below, both
        halves = MaterialMap.images(np.repeat(np.repeat(image, 50, 0), 50, 1),
                                    [lambert(0.8, 0.0, 0.0), lambert(0.0, 0.0, 0.8)])
        self.expect(pv.Plane(), halves, (0.8, 0.0, 0.0), (0.0, 0.0, 0.8), (0.4, 0.0, 0.4))

    def test_errors(self):
        for text, make, *arguments in (
            ("finite", MaterialMap.classes, "rock", {float("nan"): "nickel"}),
            ("only classes", MaterialMap.values, "wet", {0.0: None}),
            ("one for each of 2", MaterialMap.weights, ["a"], ["nickel", "gold-paint"]),
            ("expected (height, width, 2)", MaterialMap.images, np.zeros((4, 4)), ["nickel", "gold-paint"]),
            ("unsigned integers", MaterialMap.images, np.zeros((4, 4, 1), int), ["nickel"]),
            ("nicke1", MaterialMap.classes, "rock", {1: "nicke1"}),
        ):
            self.expect_error(ValueError, text, make, *arguments)


class TestOcclusion(PlotterTest):
    """White light in a bowl: its bottom sees the part of the sky that its mouth leaves."""

    def look_into(self, mesh, mode, bounce=False):
        plotter = new_plotter()
        actor = plotter.measured.add_mesh(mesh, lambert(0.5, 0.5, 0.5))
        actor.mapper.SetOcclusionMode(mode)
        actor.mapper.SetOcclusionBounce(bounce)
        plotter.measured.set_environment(WHITE)
        plotter.view_vector((0, 0, -1), viewup=(0, 1, 0))
        return (center(plotter) / 255.0) ** 2.2, actor

    def test_a_bowl(self):
        bowl = pv.Sphere(theta_resolution=60, phi_resolution=40, end_phi=90)
        off, _ = self.look_into(bowl, 0)
        on, _ = self.look_into(bowl, 2)
        # From the bottom of a half sphere its mouth is a circle of 45 degrees: half of the irradiance.
        np.testing.assert_allclose(off, 0.5, atol=0.01)
        np.testing.assert_allclose(on, 0.25, atol=0.015)
        auto, actor = self.look_into(bowl, 1)
        np.testing.assert_allclose(auto, on, atol=0.01)
        self.assertIn("modeled", actor.mapper.plan)
        visibility = vtkmeasuredbrdf.vtkSurfaceVisibilityFilter()
        visibility.SetInputData(bowl)
        visibility.BothSidesOn()
        visibility.BounceOn()
        traced, actor = self.look_into(visibility, 1)
        np.testing.assert_allclose(traced, on, atol=0.01)
        self.assertNotIn("unoccluded", actor.mapper.plan)
        bounced, actor = self.look_into(visibility, 1, bounce=True)
        self.assertTrue((bounced > on + 0.03).all() and (bounced < off).all(), bounced)
        self.assertIn("one bounce", actor.mapper.plan)


class TestPlotter(PlotterTest):
    def test_plans(self):
        self.plotter.measured.add_mesh(pv.Sphere(), "pink-felt", name="ball", tolerance=0.05)
        self.assertEqual(self.plotter.measured.plans()[0].error, None)
        self.plotter.measured.set_environment("sky")
        self.plotter.screenshot()
        (plan,) = self.plotter.measured.plans()
        self.assertEqual((plan.actor, plan.material, plan.tolerance), ("ball", "pink-felt", 0.05))
        self.assertLessEqual(plan.error, 0.05)
        self.assertTrue(plan.text.startswith(plan.method) and plan.method, plan)

    def test_subplots_and_shared_materials(self):
        plotter = new_plotter(shape=(1, 2))
        actors = []
        for column, radiance in enumerate((1.0, 0.5)):
            plotter.subplot(0, column)
            actors.append(plotter.measured.add_mesh(pv.Sphere(), "pink-felt"))
            plotter.measured.set_environment(Environment(np.full((64, 128, 3), radiance)))
        self.assertIs(actors[0].mapper.material, actors[1].mapper.material)
        picture = plotter.screenshot(return_img=True).astype(float)
        left, right = ((picture[100, x] / 255.0) ** 2.2 for x in (50, 150))
        np.testing.assert_allclose(right, 0.5 * left, rtol=0.05)
        self.assertEqual(len(plotter.measured.plans()), 2)

    def test_copies(self):
        actor = self.plotter.measured.add_mesh(pv.Sphere(), lambert(0.8, 0.5, 0.1), tolerance=0.1)
        self.plotter.measured.set_environment(WHITE)
        actor.mapper.maximum_cost = 4
        copied = actor.copy()
        self.assertIsNot(copied.mapper, actor.mapper)
        self.assertEqual((copied.mapper.tolerance, copied.mapper.material), (0.1, actor.mapper.material))
        self.assertEqual(copied.mapper.maximum_cost, 4)
        with self.assertRaisesRegex(ValueError, "maximum_cost: found 0, expected 1 to 1e6"):
            actor.mapper.maximum_cost = 0
        self.plotter.clear_actors()
        self.plotter.add_actor(copied)
        self.expect_pixel(self.plotter, (0.8, 0.5, 0.1))
        copied.mapper.material = lambert(0.1, 0.1, 0.1)
        self.assertIsNot(copied.mapper.material, actor.mapper.material)
        again = pickle.loads(pickle.dumps(actor.mapper.material))
        self.plotter.measured.add_mesh(pickle.loads(pickle.dumps(pv.Sphere(radius=0.6))), again)
        self.expect_pixel(self.plotter, (0.8, 0.5, 0.1))

    def test_clear_and_close(self):
        for _ in range(2):
            actor = self.plotter.measured.add_mesh(pv.Sphere(), lambert(0.8, 0.5, 0.1))
            self.plotter.measured.set_environment(WHITE, background="map")
            self.expect_pixel(self.plotter, (0.8, 0.5, 0.1))
            self.plotter.remove_actor(actor)
            self.expect_pixel(self.plotter, (1.0, 1.0, 1.0))  # the map
            self.plotter.clear()
            self.assertEqual(self.plotter.measured.plans(), [])
        self.plotter.close()

    def test_show(self):
        self.plotter.measured.add_mesh(pv.Sphere(), lambert(0.8, 0.5, 0.1))
        self.plotter.measured.set_environment(WHITE)
        picture = self.plotter.show(return_img=True)
        (plan,) = self.plotter.measured.plans()  # of a plotter that is closed
        self.assertTrue(plan.method)
        np.testing.assert_allclose(picture[100, 100], encode(np.array((0.8, 0.5, 0.1))), atol=2.5)

    def test_exports_have_the_nearest_property(self):
        actor = self.plotter.measured.add_mesh(pv.Sphere(), "gold-paint")
        color = actor.prop.GetDiffuseColor()
        self.assertGreater(color[0], 4.0 * color[2])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.gltf")
            self.plotter.export_gltf(path)
            with open(path, encoding="utf-8") as file:
                material = json.load(file)["materials"][0]["pbrMetallicRoughness"]
        np.testing.assert_allclose(material["baseColorFactor"][:3], color, rtol=1e-3)

    def test_html(self):
        try:
            from trame_vtk.modules.vtk import serializers
        except ImportError:
            self.skipTest("trame-vtk is not installed")
        actor = self.plotter.measured.add_mesh(pv.Sphere(), "gold-paint")
        self.plotter.measured.set_environment("sky")
        color = actor.prop.GetDiffuseColor()
        self.plotter.screenshot()
        serializers.initialize_serializers()
        window = self.plotter.render_window
        with measured.browser_colors(self.plotter):
            scene = serializers.serialize(
                None, window, serializers.reference_id(window), serializers.SynchronizationContext(), 0)
        found = find_all(scene, "vtkMapper", "vtkOpenGLProperty")
        self.assertEqual(sorted(found), ["vtkMapper", "vtkOpenGLProperty"])
        shown = found["vtkOpenGLProperty"][0]["properties"]["diffuseColor"]
        np.testing.assert_allclose(shown, encode(np.array(color)) / 255.0)
        self.assertEqual(actor.prop.GetDiffuseColor(), color)
        if importlib.util.find_spec("vtkmodules.vtkWebCore") is None:
            self.skipTest("this VTK has no vtkWebCore, which trame-vtk's files want")
        try:
            html = self.plotter.export_html(None).getvalue()
        except ImportError as error:  # PyVista 0.49 and later want trame-pyvista
            self.skipTest(str(error))
        self.assertGreater(len(html), 100000)

    def test_the_documentation(self):
        root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
        with open(os.path.join(root, "docs", "pyvista.md"), encoding="utf-8") as file:
            samples = re.findall(r"^```python\n(.*?)^```", file.read(), re.DOTALL | re.MULTILINE)
        self.assertEqual(len(samples), 5)
        names = {}
        for sample in samples:
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(sample, "docs/pyvista.md", "exec"), names)  # noqa: S102 (ours)
        self.assertEqual(names["f"].shape, names["i"].shape)

    def test_entry_point(self):
        points = importlib.metadata.entry_points()
        group = "pyvista.plotter_components"
        found = points.select(group=group) if hasattr(points, "select") else points.get(group, ())
        self.assertIn(("measured", "vtkmeasuredbrdf.pyvista"), {(point.name, point.value) for point in found})
        self.assertEqual(importlib.metadata.version("vtkmeasuredbrdf"), vtkmeasuredbrdf.__version__)
        if hasattr(pv, "register_plotter_component"):
            program = "import pyvista; print(pyvista.Plotter(off_screen=True).measured.plans())"
            result = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, check=True)
            self.assertEqual(result.stdout.strip(), b"[]")


if __name__ == "__main__":
    print(f"PyVista {pv.__version__}, VTK {'.'.join(map(str, pv.vtk_version_info))}")
    unittest.main(verbosity=1)
