# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Drives `measured-brdf svbrdf` on simulated photographs: TestSvbrdf.py PROGRAM [unittest arguments]."""

import json
import math
import os
import random
import struct
import sys
import unittest

import TestTool
from TestTool import ToolTest, make_png, read_png, run

SIDE = 16
MATERIALS = ("red-fabric2", "nickel")


def share(x, y):
    """Of the second material, in 255ths."""
    return min(255, max(0, 24 * (x - 3) + 3 * y))


def encode(linear):
    """sRGB's curve."""
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1.0 / 2.4) - 0.055


class SvbrdfTest(ToolTest):
    def draw_pairs(self, count, bonn):
        """Light and view: angles of Bonn's rings, or any about a half vector near the normal; degrees, and unit vectors."""
        pairs = []
        while len(pairs) < count:
            angles = [(random.choice((0, 15, 30, 45, 60, 75)), random.choice(range(0, 360, 15))) for _ in range(2)]
            light, view = ([math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t)]
                           for t, p in ((math.radians(theta), math.radians(phi)) for theta, phi in angles))
            if not bonn:
                theta, turn = 0.5 * math.pi * random.random() ** 2, 2.0 * math.pi * random.random()
                half = [math.sin(theta) * math.cos(turn), math.sin(theta) * math.sin(turn), math.cos(theta)]
                cosine = sum(a * b for a, b in zip(half, light))
                view = [2.0 * cosine * h - i for h, i in zip(half, light)]
            if min(light[2], view[2]) > 0.17 and (*angles, light, view) not in pairs:
                pairs.append((*angles, light, view))
        return pairs

    def photograph(self, count, bonn=True, exposure=None, noise=0.0):
        """Folder photos: PFM files and their list; with an exposure PNG files of Bonn's names. Returns the folder."""
        random.seed(1)
        pairs = self.draw_pairs(count, bonn)
        lines = [",".join(map(str, light + view)) for _, _, light, view in pairs]
        self.write("pairs.csv", "ix,iy,iz,ox,oy,oz\n" + "\n".join(lines) + "\n")
        materials = []
        for name in MATERIALS:
            result = run("evaluate", name, "--pairs", self.path("pairs.csv"))
            self.check(result, 0)
            materials.append([[float(word) for word in line.split(",")[6:]] for line in result.stdout.split()[1:]])
        os.mkdir(self.path("photos"))
        listed = []
        for k, (i, o, light, view) in enumerate(pairs):
            a, b = materials[0][k], materials[1][k]
            exposed = exposure or 0.9 / (math.pi * light[2] * max(a + b))
            rows = []
            for y in range(SIDE):
                shares = [share(x, y) / 255.0 for x in range(SIDE)]
                rows.append([[math.pi * exposed * light[2] * ((1.0 - s) * a[c] + s * b[c]) + random.gauss(0.0, noise)
                              for c in range(3)] for s in shares])
            if exposure:
                codes = [[[round(255.0 * encode(min(value, 1.0))) for value in pixel] for pixel in row] for row in rows]
                self.write(f"photos/tl{i[0]:03}_pl{i[1]:03}_tv{o[0]:03}_pv{o[1]:03}.png", make_png(codes))
            else:
                values = [value for row in reversed(rows) for pixel in row for value in pixel]
                self.write(f"photos/{k}.pfm", f"PF\n{SIDE} {SIDE}\n-1.0\n".encode() + struct.pack(f"<{len(values)}f", *values))
                listed.append({"file": f"{k}.pfm", "light": light, "view": view, "exposure": exposed})
        self.write("photos/photographs.json", json.dumps({"photographs": listed}))

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
        self.photograph(40)
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
                   "relative error of a texel", "red-fabric2", "nickel", "0 saturated")
        self.assertEqual([self.read_bytes(name) for name in again], before)

    def test_a_folder_of_bonns_names(self):
        self.photograph(60, exposure=0.5)
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
        self.photograph(80, bonn=False, noise=0.002)
        result = run("svbrdf", self.path("photos/photographs.json"), "--tables", "--materials", 2, "-o",
                     self.path("found"), "--json")
        self.check(result, 0)
        said = json.loads(result.stdout)
        self.assertLess(said["mean_error"], 0.05)
        self.assertTrue(said["converged"])
        self.assertEqual(self.read("found/map.json")["materials"][1]["material"], "material-2.exr")
        self.check(run("info", self.path("found/material-1.exr")), 0, "half/difference")

    def test_interrupted(self):
        self.photograph(200)
        command = [TestTool.PROGRAM, "svbrdf", self.path("photos/photographs.json"), "-o", self.path("found")]
        status, said = self.interrupt(command)
        self.assertEqual(status, 1)
        self.assertIn("interrupted", said)
        self.assertFalse(os.path.exists(self.path("found/map.json")))


class Errors(SvbrdfTest):
    def test_usage(self):
        out = ["-o", self.path("x")]
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
