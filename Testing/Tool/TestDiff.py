# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Drives `measured-brdf diff`: TestDiff.py PROGRAM [unittest arguments]."""

import os
import re
import struct
import subprocess
import sys
import unittest

import TestTool
from TestTool import ToolTest, make_png

WIDTH, HEIGHT = 64, 48
CTEST = ("CTEST_INTERACTIVE_DEBUG_MODE", "DASHBOARD_TEST_FROM_CTEST")  # how CTest is recognized


def stripes(x, y):
    return (230, 51, 26) if (x // 6 + y // 8) % 2 else (26, 102, 204)


def moved(x, y):
    return stripes(x + 1, y)


def flat(x, y):
    return (77, 128, 51)


def rounded(x, y):
    """Off by one in a tenth of the values."""
    return tuple(value + ((7 * x + 13 * y + 3 * c) % 10 == 0) for c, value in enumerate(stripes(x, y)))


class DiffTest(ToolTest):
    def write(self, name, content):
        super().write(name, content)
        return name

    def draw(self, name, formula, width=WIDTH, height=HEIGHT, alpha=None):
        pixel = lambda x, y: (*formula(x, y), *([] if alpha is None else [alpha(x, y)]))
        rows = [[pixel(x, y) for x in range(width)] for y in range(height)]
        return self.write(name, make_png(rows, 3 if alpha is None else 4))

    def draw_floats(self, name, values):
        """Writes a gray TIFF of one row of 32-bit floats."""
        entries = ((256, len(values)), (257, 1), (258, 32), (259, 1), (262, 1), (273, 8), (277, 1), (278, 1),
                   (279, 4 * len(values)), (339, 3))
        data = struct.pack(f"<{len(values)}f", *values)
        table = struct.pack("<H", len(entries))
        table += b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in entries) + struct.pack("<I", 0)
        return self.write(name, b"II*\0" + struct.pack("<I", 8 + len(data)) + data + table)

    def diff(self, *arguments, ctest=False):
        environment = {k: v for k, v in os.environ.items() if k not in CTEST}
        if ctest:
            environment["CTEST_INTERACTIVE_DEBUG_MODE"] = "0"
        command = [TestTool.PROGRAM, "diff", *map(str, arguments)]
        return subprocess.run(
            command, capture_output=True, text=True, timeout=120, cwd=self.folder, env=environment, check=False
        )

    def value(self, result, metric):
        return float(re.search(rf"\b{metric}=([-+.e0-9]+) ", result.stdout).group(1))


class DiffVerdict(DiffTest):
    def test_border_mask_and_alpha(self):
        self.draw("a.png", stripes)
        self.draw("edge.png", lambda x, y: stripes(x, y) if 0 < x < WIDTH - 1 else (255, 255, 255))
        exact = ["--metric", "max_difference"]
        self.check(self.diff("edge.png", "a.png", *exact), 1)
        self.check(self.diff("edge.png", "a.png", *exact, "--border", 1), 0)
        self.draw("mask.png", lambda x, y: (255,) * 3 if 0 < x < WIDTH - 1 else (0,) * 3)
        self.check(self.diff("edge.png", "a.png", *exact, "--mask", "mask.png"), 0)
        self.draw("clear.png", stripes, alpha=lambda x, y: 0)
        self.check(self.diff("clear.png", "a.png"), 1)
        self.check(self.diff("clear.png", "a.png", "--ignore-alpha"), 0)

    def test_floats_are_compared_by_hdr_flip(self):
        self.draw_floats("a.tif", [0.1, 1.0, 100.0, 1.0] * 8)
        self.draw_floats("b.tif", [0.1, 1.0, 200.0, 1.0] * 8)
        self.check(self.diff("a.tif", "a.tif"), 0, "hdr_flip=0 ")
        self.check(self.diff("b.tif", "a.tif"), 1, "hdr_flip=")
        relative = self.diff("b.tif", "a.tif", "--metric", "relative_l1", "--threshold", 2)
        self.assertAlmostEqual(self.value(relative, "relative_l1"), 100.0 / 102.1, 7)

    def test_equal_and_different(self):
        self.draw("a.png", stripes)
        self.draw("same.png", stripes)
        self.draw("moved.png", moved)
        same = self.diff("same.png", "a.png")
        self.check(same, 0, "passed: flip=0 (at most ", "baseline a.png")
        far = self.diff("moved.png", "a.png", "-o", "heat.png")
        self.check(far, 1, "moved.png differs from a.png", "heat.png")
        self.assertRegex(far.stdout, r"^failed: flip=0\.\d+ \(at most [.0-9]+\), baseline a.png\n$")
        self.assertTrue(os.path.exists(self.path("heat.png")))
        self.assertNotIn("Dart", far.stdout + same.stdout)
        loose = self.diff("moved.png", "a.png", "--metric", "flip", "--threshold", 0.5)
        self.check(loose, 0, "(at most 0.5)")
        self.assertEqual(self.value(loose, "flip"), self.value(far, "flip"))
        self.draw("rounded.png", rounded)
        self.check(self.diff("rounded.png", "a.png"), 0)

    def test_several_metrics_must_all_pass(self):
        self.draw("a.png", stripes)
        self.draw("b.png", rounded)
        both = ["--metric", "flip", "--metric", "max_difference"]
        self.check(self.diff("b.png", "a.png", *both), 1, "max_difference=0.00392156863 (at most 0)")
        self.check(self.diff("b.png", "a.png", *both, "--threshold", 0.5, "--threshold", 0.004), 0, "flip=")
        similar = ["b.png", "a.png", "--metric", "ssim", "--threshold"]
        self.check(self.diff(*similar, 0.9), 0, "(at least 0.9)")
        self.check(self.diff(*similar, 0.9999999), 1, "(at least 0.9999999)")

    def test_the_nearest_baseline_counts(self):
        self.draw("out.png", stripes)
        self.draw("valid.png", moved)
        self.check(self.diff("out.png", "valid.png"), 1)
        self.draw("valid_1.png", flat)
        self.draw("valid_2.png", stripes)
        self.draw("valid_4.png", stripes)  # the row ends before it
        self.check(self.diff("out.png", "valid.png", "--alternatives"), 0, "baseline valid_2.png")
        self.check(self.diff("out.png", "valid.png", "valid_2.png"), 0, "baseline valid_2.png")
        os.remove(self.path("valid_2.png"))
        self.check(self.diff("out.png", "valid.png", "--alternatives"), 1, "differs from valid.png")


class DiffForCTest(DiffTest):
    def test_measurements(self):
        self.draw("a.png", stripes)
        self.draw("out.png", moved)
        self.assertEqual(self.diff("a.png", "a.png").stdout.count("Dart"), 0)
        passed = self.diff("a.png", "a.png", ctest=True)
        self.check(passed, 0, '<DartMeasurement name="flip" type="numeric/double">0</DartMeasurement>\n')
        self.check(passed, 0, '<DartMeasurement name="BaselineImage" type="text/string">a.png</DartMeasurement>\n')
        self.assertNotIn("DartMeasurementFile", passed.stdout)
        self.assertFalse(os.path.exists(self.path("a.diff.png")))
        failed = self.diff("out.png", "a.png", ctest=True)
        self.assertEqual(failed.returncode, 1)
        files = dict(re.findall(r'<DartMeasurementFile name="(\w+)" type="image/png">(.*)</Dart', failed.stdout))
        names = {"TestImage": "out.png", "DifferenceImage": "out.diff.png", "ValidImage": "a.png"}
        self.assertEqual(sorted(files), sorted(names))
        for name, path in files.items():
            self.assertTrue(os.path.isabs(path) and os.path.isfile(path), path)
            self.assertEqual(os.path.basename(path), names[name])
        self.assertEqual(self.diff("a.png", "a.png", "--dart").stdout, passed.stdout)

    def test_a_missing_baseline_leaves_the_picture(self):
        self.draw("out.png", stripes)
        result = self.diff("out.png", "none.png", ctest=True)
        self.check(result, 2, "none.png")
        self.assertIn('<DartMeasurementFile name="TestImage" type="image/png">', result.stdout)


class DiffBadInput(DiffTest):
    def test_files(self):
        self.draw("a.png", stripes)
        self.draw("wide.png", stripes, width=80)
        self.check(self.diff("wide.png", "a.png"), 2, "wide.png", "a.png", "80 x 48", "64 x 48")
        self.check(self.diff("a.png", "a.png", "--mask", "wide.png"), 2, "mask", "80 x 48")
        self.check(self.diff("none.png", "a.png"), 2, "none.png")
        self.check(self.diff("a.png", "."), 2)
        self.write("junk.png", b"junk" * 9)
        self.check(self.diff("a.png", "junk.png"), 2, "junk.png")
        self.draw_floats("nan.tif", [1.0, float("nan"), 1.0])
        self.check(self.diff("nan.tif", "nan.tif"), 2, "nan.tif", "pixel (1, 0)", "nan", "finite")
        self.check(self.diff("a.png", "a.png", "--border", 24), 2, "no pixel")
        self.check(self.diff("a.png", "wide.png", "-o", "no/heat.png"), 2)
        self.check(self.diff("a.png", "a.png", "-o", "no/heat.png"), 2, "no/heat.png")

    def test_options(self):
        self.draw("a.png", stripes)
        pair = ["a.png", "a.png"]
        self.check(self.diff("a.png"), 2, "BASELINE")
        self.check(self.diff(*pair, "--metric", "psnr"), 2, "--metric", "psnr")
        for threshold in ("-1", "nan", "inf", "much"):
            self.check(self.diff(*pair, "--threshold", threshold), 2, "--threshold")
        several = ["--metric", "flip", "--metric", "ssim", "--threshold", 0.1]
        self.check(self.diff(*pair, *several), 2, "--threshold", "one for each")
        self.check(self.diff(*pair, "--border", -1), 2, "--border")
        self.check(self.diff(*pair, "-o", "heat.jpg"), 2, "heat.jpg", ".png")
        self.check(self.diff(*pair, "a.png", "--alternatives"), 2, "--alternatives")


if __name__ == "__main__":
    TestTool.PROGRAM = os.path.abspath(sys.argv[1])
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
