# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Materials and environments for NumPy: values, shapes, errors, copies, pickles."""

import copy
import math
import os
import pickle
import subprocess
import sys
import tempfile
import unittest
import warnings

import vtkmodules.vtkRenderingLOD  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401

BY_VTK = set(sys.modules)  # with NumPy, where VTK itself imports that (VTK 9.6)
import vtkmeasuredbrdf  # noqa: E402

if {"numpy", "pyvista", "vtkmeasuredbrdf.materials"} & (set(sys.modules) - BY_VTK):
    sys.exit("import vtkmeasuredbrdf imports NumPy or PyVista")
try:
    import numpy as np
except ImportError:
    print("Skipped: NumPy is not installed")
    sys.exit(77)

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

from vtkmeasuredbrdf import _arrays
from vtkmeasuredbrdf.materials import Environment, Material, integrate

RNG = np.random.default_rng(1)
PRINTED = vtkStringOutputWindow()


def directions(*shape):
    """Unit vectors above the horizon, away from grazing."""
    d = RNG.normal(size=(*shape, 3))
    d[..., 2] = np.abs(d[..., 2]) + 0.3
    return d / np.linalg.norm(d, axis=-1, keepdims=True)


def scalar_values(brdf, i, o):
    """The scalar form of evaluate, one call for each pair."""
    values = []
    for a, b in zip(np.reshape(i, (-1, 3)), np.reshape(o, (-1, 3))):
        f = [0.0] * 3
        brdf.Evaluate(a, b, f)
        values.append(f)
    return np.array(values)


def lambert(*albedo):
    brdf = vtkmeasuredbrdf.vtkLambertBRDF()
    brdf.SetAlbedo(albedo)
    return Material(brdf)


class TestMaterial(unittest.TestCase):
    def check(self, error, text, function, *arguments, **keywords):
        with self.assertRaises(error) as caught:
            function(*arguments, **keywords)
        self.assertIn(text, str(caught.exception))

    def test_values_are_the_scalar_ones(self):
        for name in ("gold-paint", "pink-felt"):
            gold = Material(name)
            i, o = directions(500), directions(500)
            i[7] = (0.0, 0.0, -1.0)
            o[8] = (0.0, 0.0, 0.0)
            np.testing.assert_array_equal(gold.evaluate(i, o), scalar_values(gold.brdf, i, o))
            expected = [gold.brdf.Pdf(a, b) for a, b in zip(i, o)]
            np.testing.assert_array_equal(gold.pdf(i, o), expected)
            np.testing.assert_array_equal(gold.evaluate(i, o)[7:9], 0.0)
            u = RNG.random((500, 2))
            drawn = gold.sample(o, u)
            for k in range(0, 500, 25):
                one = [0.0] * 3
                gold.brdf.Sample(o[k], u[k, 0], u[k, 1], one)
                np.testing.assert_array_equal(drawn[k], one)

    def test_shapes_broadcast(self):
        gold = Material("gold-paint")
        i, o = directions(4, 1), directions(5)
        f = gold.evaluate(i, o)
        self.assertEqual(f.shape, (4, 5, 3))
        self.assertEqual(gold.pdf(i, o).shape, (4, 5))
        np.testing.assert_array_equal(f[2, 3], gold.evaluate(i[2, 0], o[3]))
        self.assertEqual(gold.evaluate((0, 0, 1), (0, 0, 1)).shape, (3,))
        self.assertIsInstance(gold.pdf((0, 0, 1), (0, 0, 1)), float)
        self.assertEqual(gold.evaluate(np.empty((0, 3)), (0, 0, 1)).shape, (0, 3))
        self.assertEqual(gold.sample((0, 0, 1), RNG.random((6, 2))).shape, (6, 3))
        self.assertEqual(gold.albedo((0, 0, 1)).shape, (3,))
        self.assertEqual(gold.albedo([[(0, 0, 1), (1, 0, 1)]]).shape, (1, 2, 3))

    def test_types_and_layouts(self):
        gold = Material("gold-paint")
        i, o = directions(9), directions(9)
        expected = gold.evaluate(i, o)
        self.assertEqual(expected.dtype, np.float64)
        single = gold.evaluate(i.astype(np.float32), o.astype(np.float32))
        self.assertEqual(single.dtype, np.float32)
        np.testing.assert_allclose(single, expected, rtol=1e-4)
        self.assertEqual(gold.evaluate(i.astype(np.float32), o).dtype, np.float64)
        np.testing.assert_array_equal(gold.evaluate(i.tolist(), np.asfortranarray(o)), expected)
        np.testing.assert_array_equal(gold.evaluate(i[::-1], o[::-1])[::-1], expected)
        np.testing.assert_array_equal(gold.evaluate(i.astype(">f8"), o), expected)
        i.flags.writeable = False
        np.testing.assert_array_equal(gold.evaluate(i, o), expected)
        np.testing.assert_array_equal(gold.evaluate([1, 0, 2], [0, 0, 1]), gold.evaluate([1.0, 0, 2], [0, 0, 1.0]))

    def test_no_copies(self):
        for dtype in (np.float32, np.float64):
            values = np.ones((4, 3), dtype)
            self.assertIs(_arrays.to_floats(values, "i", 3), values)
            shared = _arrays.to_vtk(values)
            values[2, 1] = 7.0
            self.assertEqual(shared.GetComponent(2, 1), 7.0)
            back = _arrays.to_numpy(shared)
            self.assertTrue(np.shares_memory(back, values))

    def test_albedo_is_the_mean_of_samples(self):
        np.testing.assert_allclose(lambert(0.8, 0.5, 0.1).albedo(directions(3)), [(0.8, 0.5, 0.1)] * 3, rtol=1e-9)
        felt = Material("pink-felt")
        o = np.array((0.6, 0.0, 0.8))
        i = felt.sample(o, RNG.random((200000, 2)))
        above = i[:, 2] > 0.0
        weights = felt.evaluate(i, o)[above] * (i[above, 2] / felt.pdf(i, o)[above])[:, None]
        estimate = weights.sum(axis=0) / len(i)
        np.testing.assert_allclose(estimate, felt.albedo(o), rtol=0.02)  # some 5 standard errors

    def test_names(self):
        self.assertIn("gold-paint", Material.names())
        self.assertEqual(Material("gold-paint").name, "gold-paint")
        self.assertTrue(Material("gold-paint").source)
        self.assertIn("gold-paint", repr(Material("gold-paint")))
        self.assertEqual(lambert(0.5, 0.5, 0.5).name, "vtkLambertBRDF")

    def test_errors(self):
        gold = Material("gold-paint")
        self.check(ValueError, "'gold-paint'", Material, "gold_paint")
        self.check(FileNotFoundError, "missing.bsdf", Material, "missing.bsdf")
        self.check(FileNotFoundError, "missing", Material, os.path.join("no-such-folder", "missing"))
        self.check(ValueError, "found float", Material, 1.5)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "text.bsdf")
            with open(path, "w", encoding="ascii") as file:
                file.write("no material")
            self.check(ValueError, path, Material, path)
        up = (0, 0, 1)
        self.check(ValueError, "i: found shape (2,), expected (3,)", gold.evaluate, (0, 1), up)
        self.check(ValueError, "o: found shape ()", gold.evaluate, up, 1.0)
        self.check(ValueError, "i (4, 3), o (5, 3)", gold.pdf, np.ones((4, 3)), np.ones((5, 3)))
        self.check(ValueError, "u: found shape (3,)", gold.sample, up, up)
        self.check(ValueError, "u: found a number outside of [0, 1)", gold.sample, up, (0.5, 1.0))
        self.check(ValueError, "o: found values of type", gold.albedo, ["a", "b", "c"])
        self.check(ValueError, "o: ", gold.albedo, [(0, 0, 1), (0, 1)])
        self.check(ValueError, "no-such-folder", gold.save, os.path.join("no-such-folder", "a.exr"))


class TestPickles(unittest.TestCase):
    i, o = directions(50), directions(50)

    def expect_same(self, one, other):
        np.testing.assert_array_equal(one.evaluate(self.i, self.o), other.evaluate(self.i, self.o))
        np.testing.assert_array_equal(one.pdf(self.i, self.o), other.pdf(self.i, self.o))
        self.assertEqual(one.name, other.name)

    def test_embedded_ones_by_name(self):
        data = pickle.dumps(Material("gold-paint"))
        self.assertLess(len(data), 200)
        self.expect_same(pickle.loads(data), Material("gold-paint"))

    def test_others_by_their_data(self):
        self.expect_same(pickle.loads(pickle.dumps(lambert(0.8, 0.5, 0.1))), lambert(0.8, 0.5, 0.1))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mine.exr")
            lambert(0.3, 0.2, 0.1).save(path)
            read = Material(path)
            data = pickle.dumps(read)
        self.expect_same(pickle.loads(data), read)
        self.assertEqual(read.name, "mine")

    def test_changed_ones_by_their_data(self):
        felt = Material("pink-felt")
        felt.brdf.SetResamplingTolerance(0.3)
        again = pickle.loads(pickle.dumps(felt))
        self.assertEqual(again.brdf.GetResamplingTolerance(), 0.3)
        self.expect_same(felt, again)
        self.assertEqual(again.name, "pink-felt")

    def test_another_process(self):
        program = ("import pickle, sys; material, i, o = pickle.load(sys.stdin.buffer); "
                   "sys.stdout.buffer.write(pickle.dumps(material.evaluate(i, o)))")
        for material in (Material("gold-paint"), lambert(0.8, 0.5, 0.1)):
            data = pickle.dumps((material, self.i, self.o))
            values = subprocess.run([sys.executable, "-c", program], input=data, stdout=subprocess.PIPE, check=True)
            np.testing.assert_array_equal(pickle.loads(values.stdout), material.evaluate(self.i, self.o))

    def test_copies(self):
        original = lambert(0.8, 0.5, 0.1)
        shallow, deep = copy.copy(original), copy.deepcopy(original)
        self.assertIs(shallow.brdf, original.brdf)
        self.expect_same(original, deep)
        original.brdf.SetAlbedo(0.1, 0.1, 0.1)
        self.expect_same(original, shallow)
        np.testing.assert_array_equal(deep.evaluate(self.i, self.o), lambert(0.8, 0.5, 0.1).evaluate(self.i, self.o))


class TestEnvironment(unittest.TestCase):
    def test_pixels(self):
        pixels = RNG.random((6, 12, 3)).astype(np.float32)
        environment = Environment(pixels)
        np.testing.assert_array_equal(environment.pixels, pixels)
        np.testing.assert_array_equal(Environment(pixels.astype(np.float64)[::-1][::-1]).pixels, pixels)
        self.assertEqual(environment.shape, (6, 12))
        rgb = [0.0] * 3
        environment.environment.GetRadiance((0.0, 1.0, 0.0), rgb)  # up is the top row
        np.testing.assert_array_less(pixels[0].min(axis=0), rgb)
        np.testing.assert_array_less(rgb, pixels[0].max(axis=0))
        gray = Environment(pixels[..., 0])
        np.testing.assert_array_equal(gray.pixels[..., 2], pixels[..., 0])
        encoded = Environment(np.full((2, 4, 3), 188, np.uint8))
        np.testing.assert_allclose(encoded.pixels, 0.5, atol=0.005)  # sRGB's middle
        linear = Environment(np.full((2, 4, 3), 51, np.uint8), srgb=False)
        np.testing.assert_allclose(linear.pixels, 0.2, rtol=1e-6)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            Environment(np.array([[[-1.0, 0.0, np.nan]]]))
        self.assertIn("1 values of the environment are negative and 1", str(caught[0].message))

    def test_a_file_is_as_its_header_says(self):
        """As VTK's own reader has it, which makes the renderer's texture of it."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOImage import vtkHDRReader

        texels = bytes(k % 251 if k % 4 != 3 else 128 + k % 7 for k in range(4 * 6 * 3))
        with tempfile.TemporaryDirectory() as folder:
            for name, size in (("cloudy 80%sky.hdr", "-Y 3 +X 6"), ("up.hdr", "+Y 3 +X 6"), ("left.hdr", "-Y 3 -X 6")):
                path = os.path.join(folder, name)
                with open(path, "wb") as file:
                    file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=10\n\n%s\n" % size.encode() + texels)
                reader = vtkHDRReader()
                errors = []
                reader.AddObserver("ErrorEvent", lambda *_, errors=errors: errors.append(1))
                reader.SetFileName(path)
                reader.Update()
                if errors:
                    self.skipTest("this VTK's own reader does not read such a file")
                expected = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(3, 6, 3)[::-1]
                np.testing.assert_allclose(Environment(path).pixels, expected, rtol=1e-6, err_msg=size)

    def test_a_file_s_notes_are_warnings(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "square.hdr")
            with open(path, "wb") as file:
                file.write(b"#?RADIANCE\n\n-Y 2 +X 2\n" + bytes(range(1, 17)))
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("default")
                for _ in range(3):
                    Environment(path)
            self.assertEqual(len(caught), 1)
            self.assertIn("square.hdr: The size 2 x 2 is not 2:1", str(caught[0].message))
            self.assertEqual(caught[0].filename, __file__)
            with self.assertRaisesRegex(ValueError, "layer: found none, expected 'Combined'"):
                Environment(path, layer="Combined")

    def test_radiance_follows_the_rotation(self):
        environment = Environment("sky", rotation=30.0)
        self.assertAlmostEqual(environment.rotation, 30.0)
        towards = RNG.normal(size=(200, 3))
        found = environment.radiance(towards)
        for direction, radiance in zip(towards, found):
            own = environment.matrix @ direction / np.linalg.norm(direction)
            rgb = [0.0] * 3
            environment.environment.GetRadiance(own, rgb)
            np.testing.assert_allclose(radiance, rgb, rtol=1e-6)
        angle = math.radians(30.0)  # what was at +x is turned counterclockwise, seen from +y
        np.testing.assert_allclose(
            environment.radiance((math.cos(angle), 0.01, -math.sin(angle))),
            Environment("sky").radiance((1, 0.01, 0)),
            rtol=1e-6,
        )

    def test_copies_and_pickles(self):
        for environment in (Environment("sky", rotation=30.0), Environment(RNG.random((4, 8, 3)), rotation=-45.0)):
            for other in (copy.copy(environment), copy.deepcopy(environment), pickle.loads(pickle.dumps(environment))):
                np.testing.assert_array_equal(other.pixels, environment.pixels)
                np.testing.assert_array_equal(other.matrix, environment.matrix)
                self.assertEqual(other.name, environment.name)
                other.rotation = 10.0
            self.assertNotAlmostEqual(environment.rotation, 10.0)
        self.assertLess(len(pickle.dumps(Environment("sky"))), 400)
        changed = Environment("sky")
        changed.environment.SetToProceduralHall()
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(changed)).pixels, changed.pixels)

    def test_errors(self):
        for source, error, text in (
            ("skyy", ValueError, "'sky'"),
            ("missing.exr", FileNotFoundError, "missing.exr"),
            (np.zeros((2, 2, 2)), ValueError, "shape (2, 2, 2)"),
            (np.zeros((0, 4, 3)), ValueError, "shape (0, 4, 3)"),
            (np.zeros((2, 4, 3), np.int64), ValueError, "int64"),
            (np.zeros((2, 4, 3), np.uint32), ValueError, "uint32"),
        ):
            with self.assertRaises(error) as caught:
                Environment(source)
            self.assertIn(text, str(caught.exception))
        with self.assertRaises(ValueError):
            Environment("sky").rotation = math.nan
        with self.assertRaises(ValueError):
            Environment("sky").radiance((0, 0, 0))


class TestIntegrate(unittest.TestCase):
    def test_white_light_gives_the_albedo(self):
        white = Environment(np.ones((64, 128, 3)))
        radiance = integrate(lambert(0.8, 0.5, 0.1), white, directions(5), (0.0, 0.0, 1.0))
        self.assertEqual(radiance.shape, (5, 3))
        np.testing.assert_allclose(radiance, [(0.8, 0.5, 0.1)] * 5, rtol=1e-3)
        below = integrate(lambert(0.8, 0.5, 0.1), white, (0, 0, 1), (0, 0.1, -1))
        np.testing.assert_array_equal(below, 0.0)

    def test_is_the_sum_over_samples(self):
        felt, sky = Material("pink-felt"), Environment(RNG.random((16, 32, 3)))
        exact = integrate(felt, sky, (0, 0, 1), (0.6, 0.0, 0.8))
        i = felt.sample((0.6, 0.0, 0.8), RNG.random((400000, 2)))  # the local frame is the world's here
        i = i[i[:, 2] > 0.0]
        weights = felt.evaluate(i, (0.6, 0.0, 0.8)) * (i[:, 2] / felt.pdf(i, (0.6, 0.0, 0.8)))[:, None]
        estimate = (weights * sky.radiance(i)).sum(axis=0) / 400000
        np.testing.assert_allclose(estimate, exact, rtol=0.01)  # some 5 standard errors

    def test_methods(self):
        felt, sky = Material("pink-felt"), Environment("sky")
        normals, views = directions(3, 1), directions(4)
        exact = integrate(felt, sky, normals, views)
        self.assertEqual(exact.shape, (3, 4, 3))
        table = integrate("pink-felt", "sky", normals, views, method="table", sizes=[33, 16, 32])
        np.testing.assert_allclose(table, exact, rtol=0.1)
        self.assertFalse(np.array_equal(table, exact))
        planned = integrate(felt, sky, normals, views, tolerance=0.02)
        self.assertLess(np.abs(planned - exact).sum() / exact.sum(), 0.05)
        integrator = vtkmeasuredbrdf.vtkAdaptiveRadianceIntegrator()
        np.testing.assert_array_equal(integrate(felt, sky, normals, views, method=integrator), exact)
        self.assertIsNone(integrator.GetBRDF())
        np.testing.assert_allclose(integrate(felt, sky, normals, views, method="light-set", sizes=[1 << 20]), exact, rtol=3e-3)
        turned = integrate(felt, Environment("sky", rotation=90.0), normals, views, (1, 0, 0))
        self.assertFalse(np.allclose(turned, exact))

    def test_errors(self):
        for keywords, text in (
            ({"method": "no-such-method"}, "expected table"),
            ({"method": "table", "sizes": [10**6]}, "SetSizes"),
            ({"tolerance": 7.0}, "tolerance: found 7.0"),
            ({"tolerance": 0.1, "method": "table"}, "tolerance: found a method"),
        ):
            with self.assertRaises(ValueError) as caught:
                integrate("pink-felt", "sky", (0, 0, 1), (0, 0, 1), **keywords)
            self.assertIn(text, str(caught.exception))
        with self.assertRaises(ValueError) as caught:
            integrate("pink-felt", "sky", (0, 0, 0), (0, 0, 1))
        self.assertIn("zero or not finite", str(caught.exception))


if __name__ == "__main__":
    vtkOutputWindow.SetInstance(PRINTED)
    result = unittest.main(exit=False, verbosity=1).result
    if PRINTED.GetOutput():
        sys.exit("VTK printed what was raised:\n" + PRINTED.GetOutput())
    sys.exit(0 if result.wasSuccessful() else 1)
