# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Drives measured-brdf-lab, which lies beside measured-brdf: TestLaboratory.py MEASURED_BRDF [unittest arguments]."""

import csv
import json
import os
import sys
import unittest

import TestTool
from TestTool import ToolTest, read_png, run


class Help(ToolTest):
    def test_help(self):
        for command in TestTool.LABORATORY:
            self.check(run(command, "--help"), 0, "measured-brdf-lab")


class ThesisTables(ToolTest):
    def test_table(self):
        output = self.path("table.csv")
        # One that fails is left out and named; a name that needs quotes, environments of one name.
        black = self.write("black.fit", "black = Aggregate(Lambertian(albedo = [0, 0, 0]))\n")
        exr = self.path('a,"b".exr')
        self.check(run("convert", "blue-fabric", exr), 0)
        common = ["--environment", "sky", "--environment", "sky", "--orders", "2,6", "-o", output]
        result = run("representations", black, self.path("none.exr"), exr, *common)
        self.check(result, 1, "left out: " + black, "nothing to fit", "none.exr", "2 of 3")
        with open(output, encoding="ascii") as file:
            rows = {row["representation"]: row for row in csv.DictReader(file)}
        self.assertEqual(len(rows), 11)
        self.assertEqual(list(rows["zonal 6"])[6:8], ["image_built-in sky", "image_built-in sky 2"])
        error = lambda name: float(rows[name]["relative_l2_hemisphere"])
        self.assertLess(error("spherical harmonics 6"), error("spherical harmonics 2"))
        self.assertLess(error("Ashikhmin-Shirley 1"), 0.1)
        self.assertEqual(int(rows["zonal 6"]["functions"]), 49)
        self.assertGreater(int(rows["zonal 6"]["texture_bytes"]), 0)
        self.assertEqual([name for name in rows if rows[name]["recommended"] == "1"], ["spherical harmonics 6"])
        result = run("representations", "no-such", "-o", self.path("no/table.csv"))
        self.check(result, 1, "no/table.csv")
        self.assertNotIn("no-such", result.stderr)

    def test_options(self):
        for options, word in (
            (["--zone", "57,9"], "--zone"),
            (["--zone", "9"], "--zone"),
            (["--zone", "9,91"], "--zone"),
            (["--orders", "0"], "--orders"),
            (["--orders", "4,100"], "--orders"),
        ):
            self.check(run("representations", "blue-fabric", *options), 2, word)


class ThesisFigures(ToolTest):
    def test_figures(self):
        folder = self.path("thesis")
        # Much taller than 2:1: its light map has to fit in the sheet all the same.
        head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 8\n"
        tall = bytes(v for k in range(512) for v in (64 + k % 190, 255 - k // 3, k // 2, 128))
        tall = self.write("tall.hdr", head + tall)
        result = run("thesis", "pink-felt", "--projection", "lat-long", "--environment", tall,
                     "--tile", "32", "--order", "2", "-o", folder)
        self.check(result, 0)
        self.assertEqual(sorted(os.listdir(folder)), ["lights.png", "materials.png", "ringing.png"])
        for name in os.listdir(folder):
            rows = read_png(os.path.join(folder, name))
            colors = {bytes(row[x : x + 3]) for row in rows for x in range(0, len(row), 3)}
            self.assertGreater(len(colors), 300, name)
        taken = self.write("taken", "a file")
        self.check(run("thesis", "-o", taken), 1, "taken")
        self.check(run("thesis", "-o", folder, "--tile", "10"), 2, "--tile")


class Bases(ToolTest):
    def figure(self, result, label):
        """The number that follows a label on a line of its own."""
        lines = [line for line in result.stdout.splitlines() if line.startswith(label + ": ")]
        self.assertEqual(len(lines), 1, result.stdout)
        return float(lines[0][len(label) + 2 :].split()[0])

    def write_lobe(self, exponent):
        lobe = f"NganBlinnPhong(sharpness = {exponent}, albedo = [0.5, 0.3, 0.1])"
        return self.write("lobe.fit", f"lobe = Aggregate({lobe})\n")

    def test_acquire(self):
        stack = self.path("stack.exr")
        inside = "relative L2 error inside the zone"
        options = ["--basis", "legendre-fourier", "--order", "4", "-o", stack]
        clean = run("acquire", "blue-fabric", *options)
        self.check(clean, 0, "photographs: 49", "bytes")
        self.assertLess(self.figure(clean, inside), 2.0)
        info = json.loads(run("info", stack, "--json").stdout)
        self.assertEqual((info["model"], info["options"]["basis"]), ("Basis", "legendre-fourier"))
        self.assertEqual(info["arrays"]["coefficients"], {"shape": [25, 48, 1], "channels": 3})
        numbers = {"order": 4, "incidentBegin": 9, "incidentEnd": 57, "outgoingBegin": 9, "outgoingEnd": 57}
        self.assertEqual({name: info["numbers"][name][0] for name in numbers}, numbers)
        self.assertEqual((info["options"]["incidentCosine"], info["options"]["outgoingCosine"]), ("on", "off"))
        self.assertIn("simulated acquisition", info["source"])
        self.check(run("info", stack), 0, "legendre-fourier", "25 x 48 x 1 RGB triples")

        noisy = ["acquire", "blue-fabric", *options, "--noise", "0.05", "--bits", "8"]
        result = run(*noisy)
        self.assertGreater(self.figure(result, inside), 1.2 * self.figure(clean, inside))
        with open(stack, "rb") as file:
            first = file.read()
        run(*noisy)
        with open(stack, "rb") as file:
            self.assertEqual(file.read(), first)
        run(*noisy, "--seed", "2")
        with open(stack, "rb") as file:
            self.assertNotEqual(file.read(), first)

    def test_project(self):
        inside = "relative L2 error from 9 to 57 degrees"
        output = self.path("out.exr")
        errors = []
        for order in (2, 4, 8):
            options = ["--basis", "legendre-fourier", "--order", order, "-o", output]
            result = run("project", "blue-fabric", *options)
            self.check(result, 0, "negative mass", "over the hemisphere", "bytes")
            errors.append(self.figure(result, inside))
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertLess(errors[2], 0.5)
        options = ["--basis", "spherical-harmonics", "--order", 6, "--zone", "20,40", "-o", output]
        result = run("project", "blue-fabric", *options)
        self.assertLess(self.figure(result, "relative L2 error from 20 to 40 degrees"), 1.0)
        info = json.loads(run("info", output, "--json").stdout)
        self.assertEqual((info["numbers"]["outgoingBegin"], info["numbers"]["outgoingEnd"]), ([0], [90]))

    def test_extrapolate(self):
        stack, whole = self.path("stack.exr"), self.path("whole.exr")
        material = self.write_lobe(5)
        self.check(run("acquire", material, "-o", stack), 0)
        result = run("project", stack, "--extrapolate", "-o", whole)
        self.check(result, 0, "limit 0.1")
        self.assertLess(self.figure(result, "relative residual inside the zone"), 0.04)
        info = json.loads(run("info", whole, "--json").stdout)
        self.assertEqual((info["options"]["basis"], info["numbers"]["order"]), ("spherical-harmonics", [6]))
        options = ["--basis", "zonal", "--order", 6, "--extrapolate", "-o", whole]
        self.check(run("project", material, *options), 0, "over the hemisphere")

        os.remove(whole)
        sharp = self.write_lobe(50)
        result = run("project", sharp, *options)
        self.check(result, 1, "0.15", "limit 0.1", "measured-brdf fit", "--model d-brdf")
        self.assertFalse(os.path.exists(whole))
        more = [*options, "--maximum-residual", 0.2]
        self.check(run("project", sharp, *more), 1, "limit 0.2", "negative mass", "limit 0.05")
        self.check(run("project", sharp, *more, "--maximum-negative-mass", 0.5), 0, "limit 0.2")
        self.assertTrue(os.path.exists(whole))

    def test_interrupt(self):
        output = self.path("out.exr")
        command = [TestTool.PROGRAM + "-lab", "acquire", "gold-paint", "--order", "20", "-o", output]
        status, said = self.interrupt(command)
        self.assertEqual(status, 1, said)
        self.assertIn("interrupted", said)
        self.assertEqual(os.listdir(self.folder), [])


class BasesErrors(ToolTest):
    def test_usage_errors(self):
        output = self.path("x.exr")
        acquire = ["acquire", "gold-paint", "-o", output]
        project = ["project", "gold-paint", "--basis", "zonal", "--order", 4, "-o", output]
        for order in ("0", "100", "-1", "x"):
            self.check(run(*acquire, "--order", order), 2, "--order", order)
        self.check(run(*project[:2], *project[6:], "--basis", "zonal", "--order", 0), 2, "--order")
        for zone in ("57,9", "9,57,3", "9", "9,9.5", "-1,50", "0,91", "nan,nan"):
            self.check(run(*acquire, "--zone=" + zone), 2, "--zone", zone, "9,57")
        self.check(run(*project, "--zone=a,b"), 2, "--zone", "a,b", "9,57")
        for noise in ("-1", "nan", "inf"):
            self.check(run(*acquire, "--noise", noise), 2, "--noise", noise)
        for bits in ("99", "-1"):
            self.check(run(*acquire, "--bits", bits), 2, "--bits", bits)
        self.check(run(*acquire, "--basis", "spherical-harmonics"), 2, "--basis", "hemispherical")
        hemisphere = ["--basis", "hemispherical", "--zone", "9,57"]
        self.check(run(*acquire, *hemisphere), 2, "--zone", "hemispherical")
        self.check(run("acquire", "gold-paint", "-o", self.path("x.png")), 2, "x.png", ".exr")
        self.check(run("project", "gold-paint", "-o", output), 2, "--basis", "--order")
        self.check(run(*project, "--maximum-residual", "0.1"), 2, "--maximum-residual")
        whole = ["--basis", "hemispherical", "--order", 4, "--extrapolate", "-o", output]
        self.check(run("project", "gold-paint", *whole), 2, "--extrapolate", "hemispherical")
        self.check(run("acquire", "no-such-paint", "-o", output), 1, "no-such-paint")
        self.check(run("project", *whole[:4], "no-such", "-o", output), 1, "no-such")
        self.assertEqual(os.listdir(self.folder), [])
        self.check(run("acquire", "blue-fabric", "--order", 2, "-o", output), 0)
        again = ["project", output, "--extrapolate", "-o", output]
        self.check(run(*again, "--basis", "zonal"), 2, "--basis", "already")


class Stability(ToolTest):
    """What surrounds the cases; the cases themselves are tests of their own (CMakeLists.txt)."""

    def test_report(self):
        folder = self.path("out")
        command = ["stability", "--short", "--case", "fireflies", "--case", "zenith", "-o", folder]
        self.check(run(*command), 0, "zenith", "fireflies", "pass", "known limits, 0 fail")
        with open(os.path.join(folder, "stability.json"), encoding="utf-8") as file:
            report = json.load(file)
        for key in ("version", "vtk", "machine", "renderer", "seconds"):
            self.assertTrue(report[key])
        self.assertTrue(report["short"])
        self.assertEqual({case["name"] for case in report["cases"]}, {"zenith", "fireflies"})
        self.assertEqual({case["group"] for case in report["cases"]}, {"bases", "sampling"})
        for case in report["cases"]:
            passes = case["value"] <= case["threshold"]
            self.assertEqual(case["status"], "pass" if passes else "known limit", case)
            self.assertTrue(case["method"] and case["figure"] and (passes or case["note"]))
        # Legendre x Fourier is known to jump at the zenith; the harmonics do not.
        jumps = {c["method"]: c["value"] for c in report["cases"] if c["name"] == "zenith"}
        self.assertGreater(jumps["Leg.xFourier 6"], 0.1)
        self.assertLess(jumps["harmonics 6"], 0.01)

    def test_fails_beyond_its_threshold(self):
        # A mirror under a coarse map: more than any known limit.
        command = ["stability", "chrome", "--short", "--case", "grazing", "-o", self.folder]
        result = run(*command)
        self.check(result, 1, "beyond", "stability.json")
        self.assertIn(" fail ", result.stdout)

    def test_bad_input(self):
        folder = self.path("out")
        self.check(run("stability"), 2, "--output")
        for name in ("no-such", ""):
            self.check(run("stability", "--case", name, "-o", folder), 2, "dots", "temporal: motion")
        self.check(run("stability", "no-such", "-o", folder), 1, "no-such")
        self.check(run("stability", "--environment", "no.hdr", "-o", folder), 1, "no.hdr")
        self.check(run("stability", "-o", self.write("file", "")), 1, "file")
        self.check(run("stability", "-o", "/proc/no"), 1, "/proc/no")
        self.assertEqual(os.listdir(folder), [])


class FitOfBases(ToolTest):
    def test_models(self):
        output = self.path("auto.exr")
        # What is in a basis already stays in it, though the rule would have it fitted.
        stack = self.path("stack.exr")
        project = ["--basis", "zonal", "--order", 8, "-o", stack]
        self.check(run("project", "gold-metallic-paint3", *project), 0)
        kept = run("fit", stack, "--model", "auto", "-o", output)
        self.check(kept, 0, "zonal", "order 8", "in one already")
        self.assertRegex(kept.stdout, "relative l2 error +0\n")
        self.assertNotIn("order 6", kept.stdout)


if __name__ == "__main__":
    TestTool.PROGRAM = os.path.abspath(sys.argv[1])
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
