# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Drives `measured-brdf svbrdf` on photographs of `measured-brdf-lab photograph`: TestSvbrdf.py PROGRAM [unittest arguments]."""

import json
import os
import sys
import unittest

import TestTool
from TestTool import ToolTest, make_png, read_png, run

SIDE = 16


def share(x, y):
    """Of the second material, in 255ths."""
    return min(255, max(0, 24 * (x - 3) + 3 * y))


class SvbrdfTest(ToolTest):
    def photograph(self, *options):
        self.write("weights.png", make_png([[(255 - share(x, y), share(x, y), 0) for x in range(SIDE)] for y in range(SIDE)]))
        self.check(run("photograph", "red-fabric2", "nickel", "--weights", self.path("weights.png"), "-o",
                       self.path("photos"), *options), 0, "simulated", "photographs.json")

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return json.load(file)

    def read_bytes(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def check_weights(self, tolerance):
        rows = read_png(self.path("found/weights-1.png"))
        self.assertEqual(len(rows), SIDE)
        for y, row in enumerate(rows):
            for x in range(SIDE):
                self.assertAlmostEqual(row[3 * x + 1] / 65535.0, share(x, y) / 255.0, delta=tolerance)


class Library(SvbrdfTest):
    def test_round_trip(self):
        self.photograph("--count", 40)
        listed = self.read("photos/photographs.json")
        self.assertIn("SIMULATED", listed["comment"])
        self.assertEqual(len(listed["photographs"]), 40)
        result = run("svbrdf", self.path("photos/photographs.json"), "-o", self.path("found"), "--json")
        self.check(result, 0)
        said = json.loads(result.stdout)
        self.assertLess(said["worst_error"], 1e-4)
        self.assertEqual([material["material"] for material in said["materials"]], ["red-fabric2", "nickel"])
        self.assertEqual(said["size"], [SIDE, SIDE])
        self.check_weights(1e-3)
        again = [os.path.join("found", name) for name in ("map.json", "weights-1.png", "error.png")]
        before = [self.read_bytes(name) for name in again]
        self.check(run("svbrdf", self.path("photos/photographs.json"), "-o", self.path("found")), 0,
                   "mean error", "red-fabric2", "nickel", "saturated pixels          0\n")
        self.assertEqual([self.read_bytes(name) for name in again], before)

    def test_a_folder_of_bonns_names(self):
        self.photograph("--count", 60, "--exposure", 0.5, "--format", "png")
        os.remove(self.path("photos/photographs.json"))
        self.assertTrue(all(name.startswith("tl0") and "_pv" in name for name in os.listdir(self.path("photos"))))
        self.write("photos/readme.txt", "no photograph")
        result = run("svbrdf", self.path("photos"), "--irradiance", 0.5 * 3.14159265, "--library", "nickel,red-fabric2,delrin",
                     "-o", self.path("found"), "--json")
        self.check(result, 0)
        self.assertIn("1 file ignored", result.stderr)
        said = json.loads(result.stdout)
        self.assertEqual(sorted(material["material"] for material in said["materials"]), ["nickel", "red-fabric2"])
        self.assertLess(said["mean_error"], 0.1)  # 8 bits
        self.assertGreater(said["black_pixels"] + said["saturated_pixels"], 0)


class Tables(SvbrdfTest):
    def test_round_trip(self):
        self.photograph("--count", 80, "--directions", "half-vector", "--noise", 0.002)
        result = run("svbrdf", self.path("photos/photographs.json"), "--tables", "--materials", 2, "-o",
                     self.path("found"), "--json")
        self.check(result, 0)
        said = json.loads(result.stdout)
        self.assertLess(said["mean_error"], 0.05)
        self.assertTrue(said["converged"])
        self.assertEqual(self.read("found/map.json")["materials"][1]["material"], "material-2.exr")
        self.check(run("info", self.path("found/material-1.exr")), 0, "half/difference")

    def test_interrupted(self):
        self.photograph("--count", 200)
        command = [TestTool.PROGRAM, "svbrdf", self.path("photos/photographs.json"), "-o", self.path("found")]
        status, said = self.interrupt(command)
        self.assertEqual(status, 1)
        self.assertIn("interrupted", said)
        self.assertFalse(os.path.exists(self.path("found/map.json")))


class Errors(SvbrdfTest):
    def test_usage(self):
        out = ["-o", self.path("x")]
        self.write("weights.png", make_png([[(255, 0, 0)]]))
        weights = ["--weights", self.path("weights.png")]
        self.check(run("photograph", "nickel", *out), 2, "--weights is required")
        self.check(run("photograph", "nickel", *weights, "--exposure", "bright", *out), 2, "--exposure", "bright")
        self.check(run("photograph", "nickel", *weights, "--noise", "-1", *out), 2, "--noise")
        self.check(run("photograph", *["nickel"] * 5, *weights, *out), 1, "5 materials with 3 channels")
        self.check(run("svbrdf", "list.json", "--tables", "--library", "nickel", *out), 2, "--library")
        self.check(run("svbrdf", "list.json", "--tables", "--tolerance", "0.1", *out), 2, "--tolerance")
        self.check(run("svbrdf", "list.json", "--smoothness", "0.1", *out), 2, "--smoothness")
        self.check(run("svbrdf", "list.json", "--irradiance", "0", *out), 2, "--irradiance")
        self.check(run("svbrdf", "list.json", "--materials", "33", *out), 2, "--materials")
        self.assertFalse(os.path.exists(self.path("x")))

    def test_bad_input(self):
        out = ["-o", self.path("x")]
        self.check(run("svbrdf", self.path("absent.json"), *out), 1, "absent.json")
        self.check(run("svbrdf", self.folder, *out), 1, "names say directions")
        for name, theta, words in (("a.png", 100, ("photograph 0", "100")), ("list.json", 10, ())):
            self.write("list.json", json.dumps({"photographs": [
                {"file": name, "light": {"theta": theta}, "view": {"theta": 0}}]}))
            self.check(run("svbrdf", self.path("list.json"), *out), 1, "list.json", *words)


if __name__ == "__main__":
    TestTool.PROGRAM = os.path.abspath(sys.argv[1])
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
