# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""vtkmeasuredbrdf.testing, with vtkImageData, files and (where NumPy is) arrays."""

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest

import vtkmeasuredbrdf

# What the wrapped module imports of VTK differs with VTK's version.
own = {name for name in sys.modules if name.startswith("vtkmeasuredbrdf.")}
assert own == {"vtkmeasuredbrdf." + name for name in ("vtkMeasuredBRDF", "_errors", "_fetch")}, f"the package imports more than it needs: {own}"

from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGWriter  # noqa: E402

from vtkmeasuredbrdf.testing import assert_images_close, compare_images  # noqa: E402

try:
    import numpy
except ImportError:
    numpy = None

VTK_UNSIGNED_CHAR, VTK_FLOAT, VTK_INT = 3, 10, 6


def make(value, width=20, height=12, kind=VTK_UNSIGNED_CHAR):
    """value(x, y) or one for all, row 0 at the bottom."""
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.AllocateScalars(kind, 3)
    for y in range(height):
        for x in range(width):
            for c in range(3):
                image.SetScalarComponentFromDouble(x, y, 0, c, value(x, y) if callable(value) else value)
    return image


class Testing(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        for name in ("CTEST_INTERACTIVE_DEBUG_MODE", "DASHBOARD_TEST_FROM_CTEST"):
            before = os.environ.pop(name, None)
            if before is not None:
                self.addCleanup(os.environ.__setitem__, name, before)

    def save(self, name, image):
        writer = vtkPNGWriter()
        writer.SetFileName(name)
        writer.SetInputData(image)
        writer.Write()
        return name

    def test_close_and_far(self):
        baseline = self.save("valid.png", make(lambda x, y: 12 * x))
        image = make(lambda x, y: 12 * x)
        found = assert_images_close(image, baseline)
        self.assertEqual((found.metric, found.value, found.passed), ("flip", 0.0, True))
        self.assertEqual(sorted(os.listdir()), ["valid.png"])
        far = make(lambda x, y: 240 - 12 * x)
        os.link(self.save("old.png", image), "valid.test.png")  # is replaced, not written into
        with self.assertRaisesRegex(AssertionError, r"valid.test.png differs from valid.png: flip=0\.\d+ \(at most 0"):
            assert_images_close(far, baseline)
        self.assertEqual(sorted(os.listdir()), ["old.png", "valid.diff.png", "valid.png", "valid.test.png"])
        self.assertEqual(compare_images("valid.test.png", far, "max_difference").value, 0.0)
        self.assertEqual(compare_images("old.png", image, "max_difference").value, 0.0)
        os.mkdir("out")
        self.save("drawn.png", far)
        with self.assertRaisesRegex(AssertionError, "drawn.png differs from valid.png: max_difference="):
            assert_images_close(pathlib.Path("drawn.png"), baseline, "max_difference", output="out")
        self.assertEqual(os.listdir("out"), ["valid.diff.png"])

    def test_same_figures_as_the_class(self):
        first, second = make(100), make(lambda x, y: 100 + (x == 3))
        found = compare_images(second, first, "max_difference", 0.01)
        self.assertAlmostEqual(found.value, 1 / 255)
        self.assertTrue(found.passed)
        self.assertEqual(found.heat_map.GetDimensions(), (20, 12, 1))
        similar = compare_images(second, first, "ssim", 1.0)
        self.assertFalse(similar.passed)
        self.assertIn("at least 1)", str(similar))
        floats = [make(value, kind=VTK_FLOAT) for value in (1.0, 1.1)]
        self.assertEqual(compare_images(*floats).metric, "hdr_flip")
        self.assertAlmostEqual(compare_images(*floats, metric="relative_l1").value, 0.1 / 1.1, 6)

    def test_the_nearest_baseline_counts(self):
        for name, value in (("v.png", 10), ("v_1.png", 200), ("v_2.png", 100)):
            self.save(name, make(value))
        image = make(100)
        self.assertFalse(compare_images(image, "v.png").passed)
        self.assertEqual(compare_images(image, "v.png", alternatives=True).baseline, "v_2.png")
        self.assertEqual(compare_images(image, ["v.png", "v_1.png"]).baseline, "v_1.png")
        self.assertEqual(compare_images(make(10), ["v.png", "v_1.png"], "ssim").baseline, "v.png")

    def test_border_and_mask(self):
        edge = make(lambda x, y: 255 if x == 0 else 50)
        self.assertGreater(compare_images(edge, make(50)).value, 0.0)
        self.assertEqual(compare_images(edge, make(50), border=1).value, 0.0)
        mask = make(lambda x, y: 0 if x == 0 else 255)
        self.assertEqual(compare_images(edge, make(50), mask=mask).value, 0.0)

    def test_bad_input(self):
        good = make(50)
        with self.assertRaisesRegex(ValueError, "30 x 12.*20 x 12"):
            compare_images(make(50, 30), good)
        with self.assertRaisesRegex(ValueError, "baseline: .*none.png"):
            assert_images_close(good, "none.png")
        self.assertEqual(os.listdir(), ["none.test.png"])  # the candidate for the baseline
        for bad in (None, 3, object()):
            with self.assertRaisesRegex(TypeError, "image: found"):
                compare_images(bad, good)
        with self.assertRaisesRegex(ValueError, "'psnr'.*flip"):
            compare_images(good, good, "psnr")
        for threshold in (-1.0, float("nan")):
            with self.assertRaisesRegex(ValueError, "threshold"):
                compare_images(good, good, threshold=threshold)
        with self.assertRaisesRegex(ValueError, "border"):
            compare_images(good, good, border=-1)
        with self.assertRaisesRegex(ValueError, "list is empty"):
            compare_images(good, [])
        with self.assertRaisesRegex(ValueError, "alternatives"):
            compare_images(good, good, alternatives=True)
        with self.assertRaisesRegex(ValueError, "unsigned char"):
            compare_images(make(50, kind=VTK_INT), good)

    def test_what_ctest_takes(self):
        baseline = self.save("valid.png", make(50))
        os.environ["CTEST_INTERACTIVE_DEBUG_MODE"] = "0"
        said = io.StringIO()
        try:
            with contextlib.redirect_stdout(said):
                assert_images_close(make(50), baseline)
                with self.assertRaises(AssertionError):
                    assert_images_close(make(150), baseline)
        finally:
            del os.environ["CTEST_INTERACTIVE_DEBUG_MODE"]
        self.assertIn('<DartMeasurement name="flip" type="numeric/double">0</DartMeasurement>\n', said.getvalue())
        for name in ("TestImage", "DifferenceImage", "ValidImage"):
            self.assertEqual(said.getvalue().count(f'<DartMeasurementFile name="{name}" type="image/png">/'), 1)

    @unittest.skipUnless(numpy, "skipped: no NumPy")
    def test_arrays(self):
        rows = numpy.zeros((12, 20, 3), numpy.uint8)
        rows[0] = 255  # the top row
        image = make(lambda x, y: 255 if y == 11 else 0)
        self.assertEqual(compare_images(rows, image, "max_difference").value, 0.0)
        self.assertEqual(compare_images(rows[:, :, 0], image, "max_difference").value, 0.0)
        self.assertEqual(compare_images(rows.astype(numpy.uint16) * 257, image, "max_difference").value, 0.0)
        light = numpy.full((12, 20, 3), 2.0)
        self.assertEqual(compare_images(light, light.astype(numpy.float32)).metric, "hdr_flip")
        with self.assertRaisesRegex(TypeError, "int64"):
            compare_images(rows.astype(numpy.int64), image)
        with self.assertRaisesRegex(ValueError, r"\(12, 20, 5\)"):
            compare_images(numpy.zeros((12, 20, 5), numpy.uint8), image)
        light[3, 4, 1] = numpy.nan
        with self.assertRaisesRegex(ValueError, r"\(4, 8\) from the bottom left, channel 1: found nan"):
            compare_images(light, light)


if __name__ == "__main__":
    unittest.main()
