# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the measured-brdf program: TestTool.py PROGRAM SHARED_DATA [unittest arguments]."""

import ast
import csv
import itertools
import json
import math
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree
import zlib

PROGRAM = ""
SHARED = ""


# Commands of the second program, measured-brdf-lab, which lies beside the first one.
LABORATORY = ("acquire", "photograph", "project", "representations", "stability", "thesis")


def run(*arguments, **options):
    program = PROGRAM + "-lab" if arguments and arguments[0] in LABORATORY else PROGRAM
    return subprocess.run(
        [program, *map(str, arguments)], capture_output=True, text=True, timeout=300, **options
    )


def read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def read_rows(path):
    with open(path, encoding="ascii") as file:
        lines = [line for line in file if not line.startswith("#")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def rgb(row):
    return [row["r"], row["g"], row["b"]]


def read_png_size(path):
    with open(path, "rb") as file:
        head = file.read(24)
    return struct.unpack(">II", head[16:24])


def read_png(path):
    """Rows of values, top first, of an RGB PNG of 8 or 16 bits."""
    with open(path, "rb") as file:
        data = file.read()
    width, height, depth, color = struct.unpack(">2I2B", data[16:26])
    assert color == 2
    packed, at = b"", 8
    while at < len(data):
        length = struct.unpack(">I", data[at : at + 4])[0]
        if data[at + 4 : at + 8] == b"IDAT":
            packed += data[at + 8 : at + 8 + length]
        at += 12 + length
    pixel = 3 * depth // 8
    raw, step = zlib.decompress(packed), pixel * width
    rows, above = [], bytearray(step)
    for y in range(height):
        kind, row = raw[y * (step + 1)], bytearray(raw[y * (step + 1) + 1 : (y + 1) * (step + 1)])
        for x in range(step):
            a = row[x - pixel] if x >= pixel else 0
            b, c = above[x], above[x - pixel] if x >= pixel else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[x] = (row[x] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        rows.append(row if depth == 8 else struct.unpack(f">{3 * width}H", row))
        above = row
    return rows


def make_png(rows, channels=3):
    """An 8-bit PNG of rows of pixels."""
    width = len(rows[0])
    head = struct.pack(">2I5B", width, len(rows), 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    data = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    png = b"\x89PNG\r\n\x1a\n"
    for kind, content in ((b"IHDR", head), (b"IDAT", zlib.compress(data)), (b"IEND", b"")):
        png += struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    return png


class ToolTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return self.path(name)

    def write_constant_environment(self, width=64, height=32):
        """Radiance 1 everywhere, as Radiance RGBE without run lengths."""
        head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
        return self.write("one.hdr", head.encode() + bytes([128, 128, 128, 129]) * width * height)

    def write_fits(self):
        return self.write("flat.fit", "flat = Aggregate(Lambertian(albedo = [0.5, 0.25, 0.125]))\n")

    def check(self, result, status, *words):
        """The status, and each word in the messages (stderr, or stdout where all went well)."""
        said = result.stdout if status == 0 else result.stderr
        if "needs an X server" in result.stderr and "xvfb-run" not in words:
            self.skipTest("skipped: no X server, which this VTK needs")
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, said)
        if status:
            self.assertNotEqual(result.stderr, "")

    def check_close(self, values, expected, relative, absolute=0.0):
        for value, wanted in zip(values, expected):
            self.assertLessEqual(abs(value - wanted), max(relative * abs(wanted), absolute))

    def interrupt(self, command):
        """Status and messages of a command that gets Ctrl-C once it listens to it; None: too late."""
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
            while process.poll() is None:
                with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
                    caught = [line for line in file if line.startswith("SigCgt")]
                if caught and int(caught[0].split()[1], 16) & (1 << (signal.SIGINT - 1)):
                    break
                time.sleep(0.05)
            if process.poll() is not None:
                self.skipTest("skipped: finished too soon to be interrupted")
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=120)[1]
        return process.returncode, said

    def shared(self, *parts):
        path = os.path.join(SHARED, *parts)
        if not os.path.exists(path):
            self.skipTest(f"skipped: no real data at {path}")
        return path


class Help(ToolTest):
    def test_help(self):
        self.check(run("--help"), 0, "SUBCOMMAND", "gallery", "Exit status")
        commands = (
            "list fetch info evaluate integrate lights render plan compare diff chart gallery convert fit export svbrdf "
            "explore"
        ).split()
        for command in commands:
            result = run(command, "--help")
            self.check(result, 0, "measured-brdf")
            text = " ".join(result.stdout.split())
            self.assertIsNone(re.search(r"\b(\w[\w ]{2,40}): \1:", text), text)  # "A material: A material:"
        self.check(run("--version"), 0, "measured-brdf 0.")
        for command in LABORATORY:
            result = subprocess.run([PROGRAM, command, "-o", "x"], capture_output=True, text=True, timeout=60, check=False)
            self.check(result, 1, "measured-brdf-lab " + command)


class Options(ToolTest):
    def test_usage_errors(self):
        self.check(run(), 2, "SUBCOMMAND")
        self.check(run("paint"), 2)
        self.check(run("info"), 2, "FILE")
        self.check(run("info", "gold-paint", "--color"), 2, "--color")
        self.check(run("evaluate", "gold-paint"), 2, "--pairs")
        common = ["--environment", "sky", "-o", self.path("x.png")]
        self.check(run("render", "gold-paint", *common, "--size", "0x10"), 2, "--size", "0x10")
        self.check(run("render", "gold-paint", *common, "--size", "10x10x"), 2, "--size")
        for view in ("10,100", "10", "10,20,0.5", "10,20,nan", "10,20,30,40", "10,20,"):
            self.check(run("render", "gold-paint", *common, "--view", view), 2, "--view")
        self.check(run("render", "gold-paint", *common, "--lights", "0"), 2, "--lights")
        self.check(run("render", "gold-paint", *common, "--lights", "100"), 2, "64 or 128")
        self.check(run("render", "gold-paint", "--environment", "sky", "-o", "x.gif"), 2, ".png")
        self.check(run("convert", "gold-paint", self.path("x.png")), 2, ".binary")
        self.assertEqual(os.listdir(self.folder), [])


class Materials(ToolTest):
    def test_list(self):
        said = run("list").stdout
        for words in ("gold-paint", "blue-car-paint", "carpaint_blue.mbsdf", "room", "Poly Haven", "CC0 1.0", "hall"):
            self.assertIn(words, said)
        materials = json.loads(run("list", "--json").stdout)
        kinds = {material["name"]: material["kind"] for material in materials}
        self.assertEqual((kinds["violet-rubber"], kinds["red-fabric2"]), ("rubber", "fabric"))
        self.assertTrue(all(material["name"] and material["source"] for material in materials))

    def test_half_floats(self):
        whole, half = self.path("whole.exr"), self.path("half.exr")
        self.check(run("convert", "blue-car-paint", whole), 0, "relative l2 error         0\n")
        self.check(run("convert", "blue-car-paint", half, "--half"), 0, "error    0\n")  # it is in 16 bits
        self.assertLess(os.path.getsize(half), os.path.getsize(whole))
        bad = run("convert", "blue-car-paint", self.path("a.binary"), "--half")
        self.check(bad, 1, "64-bit", ".exr")

    def test_info(self):
        info = json.loads(run("info", self.write_fits(), "--json").stdout)
        self.assertEqual(info["name"], "flat")
        self.assertEqual(info["negative_values"], 0)
        self.assertLess(info["reciprocity_error"], 1e-12)
        self.check_close(info["range"]["maximum"], [a / math.pi for a in (0.5, 0.25, 0.125)], 1e-6)
        for row in info["albedo"] + info["reflectance_per_angle"]:
            self.check_close(row["rgb"], [0.5, 0.25, 0.125], 1e-3)
        self.assertIn("closed form", info["shader_inputs"]["description"])
        gold = run("info", "gold-paint")
        self.check(gold, 0, "albedo", "reciprocity", "embedded", "recommendation")
        self.assertRegex(gold.stdout, "fresnel model +dielectric\n")
        self.assertRegex(gold.stdout, "index of refraction +4.991\n")
        self.assertNotIn("transmittance", gold.stdout)

    def test_bad_materials(self):
        self.check(run("info", "no-such-paint"), 1, "no-such-paint", "list")
        self.check(run("info", self.path("none.bsdf")), 1, "none.bsdf")
        self.check(run("info", self.folder), 1, self.folder)
        self.check(run("info", self.write("empty.binary", "")), 1, "empty.binary")
        self.check(run("info", self.write("cut.bsdf", b"tensor_file\0\1")), 1, "cut.bsdf")
        self.check(run("info", self.write_fits() + "#other"), 1, "other")
        other = self.write("road.other", "LIDAR 905 nm\n0.1 0.2\n")
        self.check(run("info", other), 1, "road.other", "formats that are read", ".binary", ".bsdf", ".xompt", ".astm")

    def test_transmission(self):
        block = ("<WavelengthData><Wavelength>Visible</Wavelength><WavelengthDataBlock><WavelengthDataDirection>{}"
                 "</WavelengthDataDirection><ScatteringData>{{{}}}</ScatteringData></WavelengthDataBlock></WavelengthData>")
        # Isotropic: an anisotropic one takes `info` five times as long; ExplorerParts::transmissionOfGrooves has one.
        start = ("<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>TensorTree3"
                 "</IncidentDataStructure></DataDefinition>")
        end = "</Layer></Optical></WindowElement>"
        reflection, front = block.format("Reflection Back", 0.1), block.format("Transmission Front", 0.05)
        sheet = self.write("sheet.xml", start + reflection + front + end)
        self.check(run("info", sheet), 0, "0.1571", "transmittance 0.47",
                   "Pictures show reflection only")
        transmission = json.loads(run("info", sheet, "--json").stdout)["transmission"]
        self.assertEqual([row["degrees"] for row in transmission["per_angle"]], [*range(0, 81, 10), 85])
        converted = run("convert", sheet, self.path("sheet.exr"))
        self.check(converted, 0, "relative l2 error         0\n")
        self.assertIn("sheet.xml: its transmission is left out", converted.stderr)
        bright = self.write("bright.xml", start + reflection + front + block.format("Transmission Back", 0.25) + end)
        self.assertRegex(run("info", bright).stdout, "  reciprocity error +4\n")  # |0.05 - 0.25| / 0.05
        gains = run("info", self.write("gains.xml", start + reflection + block.format("Transmission Front", 0.25) + end))
        self.check(gains, 0, "transmittance 1.1")
        self.assertRegex(gains.stdout, "  gains energy +yes\n")
        only = self.write("only.xml", start + front + end)
        self.check(run("info", only), 1, "only.xml", "transmission only")

    def test_a_typo_gets_the_nearest_names(self):
        self.check(run("info", "gold_paint"), 1, "unknown material 'gold_paint'", "'gold-paint'")

    def test_nothing_of_a_file_reaches_the_terminal_as_it_is(self):
        evil = "\x1b[2J\x9b31m\x07"
        name = self.write(evil + ".fit", f"a = {evil}\n")
        named = self.write(evil + ".mbsdf", b"")
        with open(named, "wb") as file:
            file.write(f'NVIDIA ARC MBSDF V1\nnote="{evil}"\nMBSDF_DATA=\n'.encode())
            file.write(struct.pack("<3I", 0, 2, 2) + struct.pack("<8f", *[0.5] * 8))
        for command in (
            ["info", name],
            ["info", name + "2"],
            ["info", evil],
            ["info", named],
            ["info", named, "--json"],
            [evil],
            ["info", name, "--" + evil],
            ["render", "gold-paint", "--environment", name, "-o", self.path("x.png")],
        ):
            result = run(*command)
            for said in (result.stdout, result.stderr):
                for character in "\x1b\x9b\x07":
                    self.assertNotIn(character, said, command)
            if command[1:2] == [named]:
                self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_file_never_hides_an_embedded_name(self):
        self.write("gold-paint", "nonsense")
        result = run("info", "gold-paint", cwd=self.folder)
        self.check(result, 0, "embedded")
        self.check(run("info", "./gold-paint", cwd=self.folder), 1, "gold-paint")


class Evaluate(ToolTest):
    PAIR = "0,0,1,0.6,0,0.8"

    def evaluate(self, text, *more, material=None):
        pairs = self.write("pairs.csv", text)
        return run("evaluate", material or self.write_fits(), "--pairs", pairs, *more)

    def test_lambert(self):
        text = '# a remark\r\n\r\nname,oz,"ix", iy,iz,ox,oy\r\n"first, of two",0.8,0,0,1,0.6,0\r\n# end\r\n'
        result = self.evaluate(text)
        self.check(result, 0)
        head, row, rest = result.stdout.split("\n")
        self.assertEqual((head, rest), ("ix,iy,iz,ox,oy,oz,r,g,b", ""))
        values = [float(cell) for cell in row.split(",")]
        self.assertEqual(values[:6], [0, 0, 1, 0.6, 0, 0.8])
        self.check_close(values[6:], [a / math.pi for a in (0.5, 0.25, 0.125)], 1e-8)

    def test_bad_tables(self):
        head = "ix,iy,iz,ox,oy,oz\n"
        self.check(self.evaluate(""), 1, "pairs.csv", "empty")
        self.check(self.evaluate("ix,iy,iz,ox,oy\n"), 1, "pairs.csv", "'oz'")
        self.check(self.evaluate("ix,ix,iy,iz,ox,oy,oz\n"), 1, "'ix'", "twice")
        self.check(self.evaluate(head + self.PAIR + "\n0,0,one,0,0,1\n"), 1, "line 3", "'iz'")
        self.check(self.evaluate(head + "0,0,1e,0,0,1\n"), 1, "line 2", "1e")
        self.check(self.evaluate(head + "0,0,1,0,0\n"), 1, "line 2", "5 cells")
        self.check(self.evaluate(head + "a,b,0,0,1,0,0,1\n"), 1, "line 2", "8 cells")
        self.check(self.evaluate(head + "0,0,1,0,,1\n"), 1, "line 2", "'oy'")
        self.check(self.evaluate(head + "0,0,nan,0,0,1\n"), 1, "line 2", "not a finite number")
        self.check(self.evaluate(head + "0,0,1,0,inf,1\n"), 1, "line 2", "not a finite number")
        self.check(self.evaluate(head + "0,0,1,0,0,0\n"), 1, "line 2", "(ox,oy,oz)")
        self.check(self.evaluate(head + "\0\0\0\n"), 1, "line 2")
        self.check(run("evaluate", "gold-paint", "--pairs", self.folder), 1, "directory")
        self.check(run("evaluate", "gold-paint", "--pairs", self.path("no.csv")), 1, "no.csv")

    def test_output_stays_whole(self):
        old = self.write("out.csv", "precious")
        self.check(self.evaluate("ix\n", "-o", old), 1)
        with open(old, encoding="ascii") as file:
            self.assertEqual(file.read(), "precious")
        table = "ix,iy,iz,ox,oy,oz\n" + self.PAIR + "\n"
        self.check(self.evaluate(table, "-o", self.path("no/out.csv")), 1, "no/out.csv")
        self.check(self.evaluate(table, "-o", self.folder), 1, "directory")
        if os.path.exists("/dev/full"):
            self.check(self.evaluate(table, "-o", "/dev/full"), 1, "/dev/full")
            with open("/dev/full", "w", encoding="ascii") as full:
                pairs = self.path("pairs.csv")
                command = [PROGRAM, "evaluate", "gold-paint", "--pairs", pairs]
                self.assertEqual(subprocess.run(command, stdout=full, check=False).returncode, 1)
        self.assertEqual(sorted(os.listdir(self.folder)), ["flat.fit", "out.csv", "pairs.csv"])


class Integrate(ToolTest):
    PAIRS = "nx,ny,nz,vx,vy,vz\n0,1,0,0.6,0.8,0\n0.6,0,0.8,0.6,0,0.8\n"

    def integrate(self, material, environment, *more):
        pairs = self.write("nv.csv", self.PAIRS)
        output = self.path("out.csv")
        result = run("integrate", material, "--environment", environment, "--pairs", pairs, "-o", output, *more)
        self.check(result, 0)
        return [rgb(row) for row in read_rows(output)], result.stderr

    def test_methods_approach_the_sum(self):
        exact, _ = self.integrate("blue-fabric", "hall")
        made = {}
        for options, error in (("filtered", 0.1), ("table --sizes 17,8,8", 0.05), ("auto", 0.03), ("thesis", 0.1)):
            values, said = self.integrate("blue-fabric", "hall", "--method", *options.split())
            for value, wanted in zip(values, exact):
                self.check_close(value, wanted, error)
            self.assertNotEqual(values, exact)
            made[options] = values
        self.assertIn("blue-fabric: basis", said)
        coarse, _ = self.integrate("blue-fabric", "hall", "--method", "thesis", "--order", 2)
        self.assertNotEqual(coarse, made["thesis"])

    def test_constant_light_gives_the_albedo(self):
        environment = self.write_constant_environment()
        for values in self.integrate(self.write_fits(), environment)[0]:
            self.check_close(values, [0.5, 0.25, 0.125], 2e-3)

    def test_bad_input(self):
        pairs = self.write("nv.csv", self.PAIRS)
        result = run("integrate", "gold-paint", "--environment", "no.exr", "--pairs", pairs)
        self.check(result, 1, "no.exr")
        junk = self.write("junk.exr", b"junk" * 10)
        result = run("integrate", "gold-paint", "--environment", junk, "--pairs", pairs)
        self.check(result, 1, "junk.exr")
        common = ["integrate", "gold-paint", "--environment", "sky", "--pairs", pairs]
        self.check(run(*common, "--method", "magic"), 2, "--method")
        self.check(run(*common, "--method", "light-set", "--lights", 100), 2, "power")
        for method, sizes in (("table", "8"), ("table", "65,16,16,1"), ("table", "65;16"),
                              ("filtered", "0"), ("filtered", "9,nan"), ("reference", "3")):
            self.check(run(*common, "--method", method, "--sizes", sizes), 2, "--sizes")
        self.check(run(*common, "--order", "2"), 2, "--order", "thesis")
        for tolerance in ("nan", "1e-4", "2"):
            self.check(run(*common, "--method", "auto", "--tolerance", tolerance), 2, "--tolerance")

    def test_interrupt(self):
        # Enough pairs for many seconds of work.
        line = "0,1,0,0.6,0.8,0\n"
        pairs = self.write("nv.csv", "nx,ny,nz,vx,vy,vz\n" + line * 20000)
        output = self.path("out.csv")
        command = [PROGRAM, "integrate", "gold-paint", "--environment", "sky"]
        command += ["--pairs", pairs, "-o", output]
        status, said = self.interrupt(command)
        self.assertEqual(status, 1, said)
        self.assertIn("interrupted", said)
        self.assertEqual(os.listdir(self.folder), ["nv.csv"])


class Lights(ToolTest):
    def lights(self, environment, *more):
        output = self.path("lights.csv")
        self.check(run("lights", environment, *more, "-o", output), 0)
        return read_rows(output)

    def test_seed(self):
        options = ["sky", "--count", 30, "--light-set", "importance", "--seed"]
        self.assertEqual(self.lights(*options, 7), self.lights(*options, 7))
        self.assertNotEqual(self.lights(*options, 7), self.lights(*options, 8))

    def test_projections(self):
        square = self.write_constant_environment(32, 32)
        result = run("lights", square, "--projection", "vertical-cross", "-o", self.path("x.csv"))
        self.check(result, 1, "one.hdr", "32 x 32", "expected")
        self.check(run("lights", square, "--projection", "fisheye", "-o", self.path("x.csv")), 2,
                   "--projection")
        result = run("lights", self.path("face_%s.exr"), "-o", self.path("x.csv"))
        self.check(result, 1, "face_%s.exr")
        self.assertFalse(os.path.exists(self.path("x.csv")))

    def test_preview(self):
        preview = self.path("lights.png")
        self.lights("sky", "--count", 16, "--preview", preview)
        self.assertEqual(read_png_size(preview), (1024, 512))
        self.check(run("lights", "sky", "-o", self.path("l.csv"), "--preview", "p.gif"), 2, ".png")
        self.assertFalse(os.path.exists(self.path("l.csv")))


class Convert(ToolTest):
    PAIRS = "ix,iy,iz,ox,oy,oz\n0.3,0.2,0.9,-0.5,0.1,0.8\n0,0,1,0,0,1\n-0.6,0.3,0.5,0.1,0.7,0.6\n"

    def evaluate(self, material):
        pairs = self.write("pairs.csv", self.PAIRS)
        result = run("evaluate", material, "--pairs", pairs)
        self.check(result, 0)
        return result.stdout

    def errors(self, result):
        self.check(result, 0)
        return [float(value) for value in re.findall(r"error +([-+.e0-9]+)\n", result.stdout)]

    def test_exr_is_exact(self):
        copy = self.path("copy.exr")
        self.assertEqual(self.errors(run("convert", "gold-paint", copy)), [0, 0])
        self.assertEqual(self.evaluate(copy), self.evaluate("gold-paint"))

    def test_merl(self):
        table, again = self.path("a.binary"), self.path("b.binary")
        error = self.errors(run("convert", "blue-fabric", table))[0]
        self.assertLess(error, 0.1)
        self.assertGreater(error, 0.0)
        self.assertEqual(os.path.getsize(table), 12 + 8 * 3 * 90 * 90 * 180)
        self.assertEqual(self.errors(run("convert", table, again)), [0, 0])
        with open(table, "rb") as a, open(again, "rb") as b:
            self.assertEqual(a.read(), b.read())
        self.assertEqual(self.evaluate(table), self.evaluate(again))

    def test_asymmetry_is_named(self):
        material = self.shared("materials", "rgl", "satin_purple_rgb.bsdf")
        result = run("convert", material, self.path("satin.binary"))
        self.check(result, 0, "asymmetry")
        # The mean of f(i,o) and f(o,i) is at best half the reciprocity error away.
        info = json.loads(run("info", material, "--json").stdout)
        self.assertLess(self.errors(result)[0], 0.7 * info["reciprocity_rms_error"])

    def test_bad_output(self):
        self.check(run("convert", "gold-paint", self.path("no/x.exr")), 1, "no/x.exr")


class Fit(ToolTest):

    def test_json(self):
        output = self.path("fit.exr")
        options = ["--model", "ashikhmin-shirley", "--loss", "squared", "--json", "-o", output]
        # The input is in the model's family but for its dielectric Fresnel term.
        fit = json.loads(run("fit", "gold-paint", *options).stdout)
        self.assertEqual((fit["model"], fit["loss"]), ("ashikhmin-shirley", "squared"))
        self.assertLess(fit["relative_l2_error"], 0.2)
        self.assertGreater(fit["seconds"], 0.0)
        self.assertTrue(fit["converged"])
        self.check_close(fit["albedo_of_fit"], fit["albedo_of_input"], 0.02)
        again = json.loads(run("fit", "gold-paint", *options).stdout)
        self.assertEqual(again["residual"], fit["residual"])
        lobes = json.loads(run("fit", "gold-paint", *options, "--lobes", "2").stdout)
        self.assertLess(lobes["residual"], fit["residual"])
        self.assertEqual(len(lobes["parameters"]), 3)


class FitAuto(ToolTest):
    def test_models(self):
        output = self.path("auto.exr")
        basis = json.loads(run("fit", "pink-felt", "--model", "auto", "--json", "-o", output).stdout)
        self.assertEqual(basis["model"], "basis")
        self.assertLess(basis["relative_l2_error"], 0.25)  # grazing angles
        self.assertEqual(basis["representation"], "basis")
        self.assertIn("order 6", basis["representation_form"])
        self.assertIn("residual", basis["reason"])
        huge = self.write("huge.fit", "huge = Aggregate(Lambertian(albedo = [1e60, 1e60, 1e60]))\n")
        self.check(run("fit", huge, "--model", "auto", "-o", output), 1, "huge.fit", "NaN or infinite")
        # The input is Ashikhmin-Shirley, so that model wins.
        result = run("fit", "gold-metallic-paint3", "--model", "auto", "--json", "-o", output)
        fit = json.loads(result.stdout)
        self.assertEqual(fit["model"], "ashikhmin-shirley")
        self.assertEqual(fit["representation"], "fit")
        self.assertIn("negative mass", fit["reason"])
        self.assertLess(fit["relative_l2_error"], 0.05)
        self.assertIn("D-BRDF", result.stderr)
        bad = run("fit", "pink-felt", "--model", "auto", "--lobes", "2", "-o", output)
        self.check(bad, 2, "--lobes", "auto")


class FitErrors(ToolTest):
    def test_errors(self):
        output = self.write("fit.exr", "what was there")
        for options, word in (
            (["--model", "phong"], "--model"),
            (["--model", "d-brdf", "--lobes", "2"], "--lobes"),
            (["--model", "blinn-phong", "--lobes", "4"], "--lobes"),
            (["--model", "blinn-phong", "--lobes", "0"], "--lobes"),
            (["--model", "blinn-phong", "--anisotropic"], "--anisotropic"),
            (["--model", "blinn-phong", "--loss", "l2"], "--loss"),
            (["--model", "blinn-phong", "--starts", "0"], "--starts"),
            (["--model", "blinn-phong", "--samples", "255"], "--samples"),
            (["--model", "blinn-phong", "--samples", "4194304"], "--samples"),
        ):
            self.check(run("fit", "gold-paint", *options, "-o", output), 2, word)
        self.check(run("fit", "gold-paint", "--model", "d-brdf", "-o", self.path("x.png")), 2, ".exr")
        black = self.write("black.fit", "black = Aggregate(Lambertian(albedo = [0, 0, 0]))\n")
        self.check(run("fit", black, "--model", "d-brdf", "-o", output), 1, "black.fit", "nothing")
        self.check(run("fit", "no-such", "--model", "d-brdf", "-o", output), 1, "no-such")
        self.check(run("fit", "gold-paint", "--model", "blinn-phong", "-o", self.path("no/x.exr")), 1,
                   "no/x.exr")
        with open(output) as file:
            self.assertEqual(file.read(), "what was there")


class Render(ToolTest):
    def render(self, material, output, *more):
        return run("render", material, "-o", self.path(output), *more)

    def test_without_a_display(self):
        environment = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        common = ["--environment", "sky", "--size", "32x32", "-o", self.path("x.png")]
        result = run("render", "gold-paint", *common, env=environment)
        if result.returncode != 0:  # VTK since 9.4 renders without an X server
            self.check(result, 1, "xvfb-run")
            self.assertEqual(os.listdir(self.folder), [])

    def test_furnace(self):
        # In constant light a Lambert ball shows its albedo at every pixel, and nothing of its edge.
        light = ["--environment", self.write_constant_environment(), "--size", "64x48"]
        result = self.render(self.write_fits(), "flat.png", *light, "--background", "none")
        self.check(result, 0)
        rows = read_png(self.path("flat.png"))
        self.assertEqual((len(rows), len(rows[0]) // 3), (48, 64))
        middle = [value / 255.0 for value in rows[24][3 * 32 : 3 * 32 + 3]]
        for value, albedo in zip(middle, (0.5, 0.25, 0.125)):
            self.assertAlmostEqual(value**2.2, albedo, delta=0.02)
        self.assertEqual(list(rows[0][:3]), [0, 0, 0])
        result = self.render(self.write_fits(), "flat2.png", *light, "--exposure", "-1")
        self.check(result, 0)
        rows = read_png(self.path("flat2.png"))
        self.assertAlmostEqual((rows[24][3 * 32] / 255.0) ** 2.2, 0.25, delta=0.02)
        self.assertAlmostEqual((rows[0][0] / 255.0) ** 2.2, 0.5, delta=0.02)  # the environment

    def test_report(self):
        report = self.path("report.json")
        common = ["--environment", "sky", "--size", "48x48", "--lights", "32"]
        self.check(self.render("gold-paint", "x.exr", *common, "--report", report), 0)
        values = read_json(report)
        self.assertGreater(values["frame_ms"], 0)
        self.assertGreater(values["setup_ms"], 0)
        self.assertGreater(values["texture_bytes"], 0)
        self.assertEqual((values["method"], values["lights"]), ("light-set", 32))
        self.assertTrue(1 <= values["lights_in_use"] <= 32)
        self.assertTrue(values["renderer"] and values["renderer"] != "unknown")
        self.assertTrue(values["vtk"].startswith("9."))
        common = common[:4]
        self.check(self.render("blue-fabric", "x.exr", *common, "--report", report), 0)
        values = read_json(report)
        self.assertEqual((values["method"], values["lights"]), ("auto", 0))
        self.assertIn("table", values["plan"])
        self.assertLessEqual(values["predicted_error"], 0.02)
        with open(self.path("x.exr"), "rb") as file:
            self.assertEqual(file.read(4), b"\x76\x2f\x31\x01")

    def test_meshes(self):
        triangle = "v -1 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n"
        common = ["--environment", "sky", "--size", "32x32", "--view", "-20,-10"]
        mesh = self.write("triangle.obj", triangle)
        self.check(self.render("gold-paint", "x.png", *common, "--mesh", mesh), 0)
        bad = self.write("bad.ply", "ply, but not really")
        for name in (bad, self.path("none.stl"), self.write("points.obj", "v 0 0 0\n")):
            result = self.render("gold-paint", "y.png", *common, "--mesh", name)
            self.check(result, 1, os.path.basename(name))
        mesh = self.write("mesh.docx", "")
        self.check(self.render("gold-paint", "y.png", *common, "--mesh", mesh), 1, "mesh.docx")
        self.assertFalse(os.path.exists(self.path("y.png")))

    def test_gallery(self):
        output = self.path("gallery.png")
        materials = ["blue-fabric", "gold-paint", self.write_fits()]
        common = ["--tile", "96", "-o", output]
        self.check(run("gallery", *materials, *common), 0)
        self.assertEqual(read_png_size(output)[0], 3 * (96 + 4) + 4)
        colors = {bytes(row[x : x + 3]) for row in read_png(output) for x in range(0, len(row), 3)}
        self.assertGreater(len(colors), 1000)
        self.check(run("gallery", "no-such-paint", *common), 1, "no-such-paint")


class Units(ToolTest):
    """A map in another unit: exact powers of two, so that no digit changes."""

    def write_sky(self, power, width=64, height=32):
        """A sky of radiance 2^power above, darker ground, and a lamp of 64 times as much."""
        head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
        sky = bytearray(bytes([128, 128, 160, 129 + power]) * (width * height // 2))
        lamp = 4 * (6 * width + 40)
        sky[lamp : lamp + 8] = bytes([128, 128, 128, 135 + power]) * 2
        ground = bytes([128, 100, 80, 127 + power]) * (width * height // 2)
        return self.write(f"sky{power}.hdr", head.encode() + sky + ground)

    def test_errors_of_both_shadings(self):
        reports = []
        for power in (0, -20):
            sky, report = self.write_sky(power), self.path("report.json")
            result = run(
                "compare", "blue-fabric", "--environment", sky, "--size", "48x48", "--reference-pixels", "64",
                "--method", "table", "--sizes", "33,8,8", "--report", report)
            self.check(result, 0)
            with open(report, encoding="utf-8") as file:
                reports.append(json.load(file))
        for key in ("relative_l1", "flip", "hdr_flip", "pbr_relative_l1", "pbr_flip", "texture_bytes"):
            self.check_close([report[key] for report in reports], 2 * [reports[0][key]], 1e-3)


class Compare(ToolTest):
    COMMON = ["--environment", "hall", "--size", "64x64", "--reference-pixels", "64"]

    def compare(self, *options):
        report, picture = self.path("report.json"), self.path("side.png")
        common = [*self.COMMON, "--report", report, "-o", picture]
        result = run("compare", "blue-fabric", *common, *options)
        self.check(result, 0, "relative L1", "95 % of the pixels within", "VTK's PBR")
        return read_json(report)

    def test_report(self):
        table = self.compare("--tolerance", "0.05")
        keys = (
            "method lights relative_l1 relative_rmse median_relative p99_relative percentile_95 rel_mse smape "
            "flip hdr_flip ssim delta_e_2000 frame_ms pbr_frame_ms pbr_relative_l1 "
            "setup_ms pbr_setup_ms texture_bytes predicted_error reference_pixels"
        ).split()
        self.assertLessEqual(set(keys), set(table))
        self.assertEqual((table["method"], table["tolerance"]), ("auto", 0.05))
        self.assertIn("table", table["plan"])
        self.assertLessEqual(table["predicted_error"], 0.05)
        self.assertLessEqual(table["relative_l1"], 0.05)
        self.assertLess(table["relative_l1"], 0.3 * table["pbr_relative_l1"])
        self.assertLess(table["pbr_relative_l1"], 0.5)
        self.assertTrue(0 < table["flip"] < table["pbr_flip"] < 0.5)
        self.assertTrue(30 <= table["reference_pixels"] <= 64 < table["covered_pixels"])
        for key in ("frame_ms", "pbr_frame_ms", "setup_ms", "setup_cpu_ms", "pbr_setup_cpu_ms", "texture_bytes"):
            self.assertGreater(table[key], 0)
        self.assertGreater(read_png_size(self.path("side.png"))[0], 4 * 64)


class FailureMap(Compare):
    def test_report(self):
        picture = self.path("failures.png")
        thesis = self.compare("--method", "thesis", "--lights", 4, "--failure-map", picture)
        self.assertEqual((thesis["method"], thesis["lights"]), ("thesis", 4))
        self.assertIsNone(thesis["predicted_error"])
        # Far worse than the 5 % of auto's table.
        self.assertTrue(0.07 < thesis["relative_l1"] < 0.5)
        self.assertGreater(thesis["relative_rmse"], 0.07)
        width, height = read_png_size(picture)
        self.assertTrue(width > 1000 and height > 500)
        self.assertTrue(0.001 < thesis["brdf_relative_l1"] < 0.5)
        self.assertTrue(0 < thesis["brdf_log_cosine"] < 0.1)
        self.assertEqual([set(angles) for angles in thesis["worst_angles"]], 5 * [{"theta_i", "theta_o", "phi", "error"}])
        pixels = sum(view["pixels"] for view in thesis["radiance_by_theta_o"])
        self.assertEqual(pixels, thesis["reference_pixels"])

    def test_fit(self):
        # 0.1 of the albedos' sum of 0.875 is missing, at all angles.
        fit = self.write("fit.fit", "low = Aggregate(Lambertian(albedo = [0.4, 0.25, 0.125]))\n")
        file = self.write_fits()
        report = self.path("report.json")
        options = ["--fit", fit, "--failure-map", self.path("f.png"), "--report", report]
        result = run("compare", file, "--environment", "hall", "--size", "60x60", "--method", "table", *options)
        self.check(result, 0, "relative L1")
        found = read_json(report)
        self.assertEqual((found["material"], found["fit"]), ("flat", "low"))
        self.check_close([found["brdf_relative_l1"]], [0.1 / 0.875], 1e-6)
        self.check_close([found["worst_angles"][0]["error"]], [0.1 / 0.875], 1e-6)
        # Of the radiance about the same share: the light is nearly white.
        self.check_close([found["relative_l1"]], [0.1 / 0.875], 0.2)
        # Of all pixels, as nobody asked for fewer.
        self.assertEqual(found["reference_pixels"], found["covered_pixels"])
        self.assertGreater(found["covered_pixels"], 2000)
        self.assertEqual(sum(view["pixels"] for view in found["radiance_by_theta_o"]), found["covered_pixels"])


class CompareStrip(Compare):
    COMMON = ["--environment", "sky", "--size", "48x40", "--reference-pixels", "64"]

    def test_report(self):
        strip = self.path("strip.png")
        seen = ["--mesh", "ball-on-foot", "--view", "200,10,60"]
        report = self.compare("--tolerance", "0.05", "--strip", strip, *seen)
        self.assertEqual(report["reference_pixels"], report["covered_pixels"])
        self.assertGreater(report["covered_pixels"], 64)
        width, height = read_png_size(strip)
        self.assertEqual(width, 3 * 48 + 4 * 4)  # three panels
        self.assertGreater(height, 40)

    def test_bad_input(self):
        common = ["compare", "blue-fabric", *self.COMMON]
        self.check(run(*common, "--strip", self.path("strip.jpg")), 2, "strip.jpg", ".png")


class ChartTest(ToolTest):
    COMMON = {
        "--methods": "table,thesis",
        "--tolerances": "0.05",
        "--size": "64x64",
        "--reference-pixels": 64,
        "--rounds": 3,
    }

    def command(self, *options):
        usual = [str(word) for item in self.COMMON.items() if item[0] not in options for word in item]
        return ["chart", "pink-felt", *usual, "-o", self.path("charts"), *options]

    def chart(self, *options):
        result = run(*self.command(*options))
        return result

    def read_results(self):
        return read_json(self.path("charts/results.json"))


class Chart(ChartTest):
    def test_chart(self):
        result = self.chart("--environments", "sky", "--for-view", "--tolerances", "0.05,0.001")
        self.check(result, 0, "1 pair in", "summary.png", "covered pixels, on a grid")
        results = self.read_results()
        self.assertEqual((results["format"], results["version"]), ("measured-brdf chart", 3))
        for key in ("processor", "threads", "vtk", "renderer", "renderer_version"):
            self.assertTrue(results["machine"][key], key)
        (pair,) = results["pairs"]
        self.assertEqual((pair["material"], pair["environment"]), ("pink-felt", "built-in sky"))
        points = pair["points"]
        names = [point["method"] for point in points]
        self.assertEqual(names, ["table"] * 3 + ["thesis"] * 2 + ["pbr"] + ["planner"] * 6)
        plans = {point["size"]: point for point in points[6:]}
        still, moving = "0.001", "0.001 while interacting"  # samples, and a table
        self.assertEqual(list(plans), ["0.05", still, moving] + [
            "0.05 in view", "0.001 in view", "0.001 in view while interacting"])
        self.assertLess(plans[moving]["frame_ms"], plans[still]["frame_ms"])
        self.assertLess(plans[moving]["texture_fetches"], plans[still]["texture_fetches"])
        self.assertLess(plans[still]["predicted_error"], plans[moving]["predicted_error"])
        for point in points:
            low, high = point["frame_ms_quartiles"]
            self.assertTrue(0 < low <= point["frame_ms"] <= high)
            self.assertIn(point["frames"], (1, 2, 3))  # fewer than asked for on a busy machine
            self.assertGreater(point["setup_ms"], 0)
            self.assertGreater(point["texture_bytes"], 0)
            self.assertGreaterEqual(point["texture_fetches"], 3)
        error = [point["errors"]["relative_l1"] for point in points]
        self.assertTrue(error[2] < error[0] < 0.02 < error[names.index("pbr")] < 0.2)
        for point in points[6:]:
            self.assertLess(point["errors"]["relative_l1"], point["predicted_error"])
        times = [point["frame_ms"] for point in points]
        self.assertEqual([figure["in_view"] for figure in pair["planner"]], [False] * 3 + [True] * 3)
        self.assertEqual([figure["interacting"] for figure in pair["planner"]], [False, False, True] * 2)
        with open(self.path("charts/results.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["method"] for row in rows], names)
        self.check_close([float(row["relative_l1"]) for row in rows], error, 1e-8)
        self.check_close([float(row["frame_ms"]) for row in rows], times, 1e-8)
        self.assertEqual([k for k, row in enumerate(rows) if row["on_front"] == "1"], sorted(pair["front"]))
        for name in ("summary", "setup", "memory", "pink-felt.built-in-sky"):
            self.assertEqual(read_png_size(self.path(f"charts/{name}.png")), (1600, 1000))
        self.check_page(points)

    def check_page(self, points):
        """What the project's results page makes of it; what people wrote there stays."""
        root = os.path.join(os.path.dirname(__file__), "..", "..")
        page = self.path("results.md")
        shutil.copyfile(os.path.join(root, "docs", "results.md"), page)
        with open(page, encoding="utf-8") as file:
            text = file.read()
        with open(page, "w", encoding="utf-8") as file:
            file.write(text.replace("<!-- end of", "Felt: a table.\n\n<!-- end of"))
        command = [sys.executable, os.path.join(root, "cmake", "make-results.py")]
        subprocess.run([*command, self.path("charts"), self.folder], check=True)
        with open(page, encoding="utf-8") as file:
            text = file.read()
        self.assertIn("Felt: a table.\n\n<!-- end of", text)
        self.assertIn("| of materials and maps that were not used | with | 1 of 1 | 0: 0, 0 |", text)
        self.assertIn("| of materials and maps that were not used | without | 0 of 1 | 1: 1, 1 |", text)
        for point in points[:6]:
            error = f"{100 * point['errors']['relative_l1']:.2g}"
            self.assertIn(f"| {point['method']} | {point['size']} | {error} |", text)
        self.assertTrue(os.path.exists(self.path("results-summary.png")))


class ChartResume(ChartTest):
    COMMON = {**ChartTest.COMMON, "--methods": "table", "--size": "16x16"}

    def test_interrupted(self):
        self.check(self.chart("--environments", "nowhere.exr"), 1, "nowhere.exr")
        one, two = self.write_constant_environment(), self.path("two.hdr")
        shutil.copyfile(one, two)
        command = [PROGRAM, *self.command("--environments", f"{one},{two}")]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
            while process.poll() is None and not os.path.exists(self.path("charts/results.json")):
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=120)[1]
        if "needs an X server" in said:
            self.skipTest("skipped: no X server, which this VTK needs")
        self.assertEqual(process.returncode, 1, said)
        self.assertIn("interrupted: 1 of 2 pairs", said)
        first = self.read_results()["pairs"]
        self.assertEqual(len(first), 1)
        self.check(self.chart("--environments", f"{one},{two}"), 0, "2 pairs in")
        second = self.read_results()["pairs"]
        self.assertEqual([pair["environment"] for pair in second], ["one", "two"])
        self.assertEqual(second[0], first[0])
        # An environment that is not the one of that name any more.
        self.write_constant_environment(32, 16)
        self.check(self.chart("--environments", one), 1, "under one has changed since")


class ChartErrors(ChartTest):
    def test_bad_input(self):
        self.check(self.chart("--methods", "table,magic"), 2, "--methods", "magic", "soft-lights")
        self.check(self.chart("--methods", "table,,basis"), 2, "--methods")
        for tolerances in ("0", "0.02,x", "nan"):
            self.check(self.chart("--tolerances", tolerances), 2, "--tolerances")
        self.check(self.chart("--environments", ""), 2, "--environments")
        self.check(self.chart("--slowest", "-1"), 2, "--slowest")
        self.check(self.chart("--rounds", "2"), 2, "--rounds")
        self.check(self.chart("--size", "0x9"), 2, "--size")
        self.check(self.chart(""), 2, "FILE", "empty")
        self.check(self.chart("pink-felt"), 2, "pink-felt")
        self.check(self.chart("no-such-thing"), 1, "no-such-thing")
        self.check(run("chart", "pink-felt"), 2, "--output")
        blocked = self.write("blocked", "a file")
        self.check(run("chart", "pink-felt", "-o", blocked), 1, "blocked")
        self.check(run("chart", "pink-felt", "-o", blocked + "/x"), 1, "blocked/x")

    def test_results_of_something_else(self):
        os.mkdir(self.path("charts"))
        machine = {"processor": "abacus"}
        ours = {"format": "measured-brdf chart", "version": 3}
        for content, words in (
            ("no JSON", ["not written by"]),
            ("{}", ["not written by"]),
            (json.dumps({**ours, "version": 1}), ["version", "3"]),
            (json.dumps({**ours, "settings": {"size": "10x10"}, "machine": machine}), ["setting", "methods"]),
        ):
            with self.subTest(content):
                path = self.write("charts/results.json", content)
                result = self.chart("--environments", "sky")
                self.check(result, 1, "charts/results.json", "another folder", *words)
                with open(path, encoding="utf-8") as file:
                    self.assertEqual(file.read(), content)


class Plan(ToolTest):
    def test_plan(self):
        common = ["plan", "blue-fabric", "--environment", "hall", "--choice-only"]
        plan = json.loads(run(*common, "--tolerance", "0.01", "--json").stdout)
        chosen = plan["candidates"][plan["choice"]]
        self.assertEqual((chosen["method"], plan["meets_tolerance"]), ("table", True))
        self.assertLessEqual(chosen["predicted_error"], 0.01)
        for key in ("cost", "texture_bytes", "setup_ms"):
            self.assertGreater(chosen[key], 0)
        coarse = json.loads(run(*common, "--tolerance", "0.2", "--json").stdout)
        coarse = coarse["candidates"][coarse["choice"]]
        self.assertLessEqual(coarse["texture_bytes"], chosen["texture_bytes"])
        self.assertEqual(chosen["cost"], 1)
        self.check(run(*common), 0, "  >", "predicted error", "within 2 %", " cost ")
        self.check(run(*common, "--tolerance", "0.001", "--maximum-cost", "1"), 0, "costs more than MaximumCost")

    def test_for_view(self):
        common = ["plan", "gold-paint", "--environment", "hall", "--choice-only"]

        def plan(*options):
            plan = json.loads(run(*common, "--json", *options).stdout)
            return plan["candidates"][plan["choice"]]
        sphere = plan()
        seen = plan("--for-view", "--view", "0,0", "--size", "200x200")
        self.assertNotEqual(seen["predicted_error"], sphere["predicted_error"])
        self.assertIn("--view has no effect without --for-view", run(*common, "--view", "0,0").stderr)
        report = self.path("r.json")
        result = run("compare", "gold-paint", "--environment", "hall", "--size", "64x64", "--for-view",
                     "--report", report, "-o", self.path("c.png"))
        self.check(result, 0)
        figures = read_json(report)
        self.assertTrue(figures["meets_tolerance"])
        self.assertLess(figures["relative_l1"], 0.02)

    def test_nothing_is_kept(self):
        home = self.path("home")
        os.mkdir(home)
        environment = {**os.environ, "HOME": home, "XDG_CACHE_HOME": home, "MESA_SHADER_CACHE_DISABLE": "true"}
        self.check(run("render", "blue-fabric", "--environment", "sky", "--size", "16x16", "-o", self.path("x.exr"),
                       env=environment), 0)
        self.assertEqual(os.listdir(home), [])


class Export(ToolTest):
    """Under small lights, so that it is fast; the errors of real lights are in docs/exports.md. A file's form is tested
    with a material whose fit is quick: what the fits find is tested by numbers (TestToolExport, test_gltf)."""

    def export(self, target, name, *options, material="gold-paint"):
        common = ["--fit-under", "neutral", "--environment", "sky", "--size", "12", "--closest"]
        return run("export", material, "--to", target, "-o", self.path(name), *common, *options)

    def write_constant(self, name):
        """A material whose f is 0.1 everywhere: its fits are quick."""
        data = struct.pack("<3I", 0, 2, 2) + struct.pack("<8f", *[0.1] * 8)
        return self.write(name, b"NVIDIA ARC MBSDF V1\nMBSDF_DATA=\n" + data)

    def test_gltf(self):
        sheet, report = self.path("sheet.png"), self.path("report.json")
        result = self.export("gltf", "matte.gltf", "--sheet", sheet, "--report", report, "--json",
                             material=self.write_constant("matte.mbsdf"))
        self.check(result, 0)
        figures = read_json(report)
        self.assertEqual(json.loads(result.stdout), figures)
        (model,) = figures["models"]
        self.assertEqual([error["seen_by_the_fit"] for error in model["errors"]], [True, False])
        for error in model["errors"]:
            self.assertTrue(0.0 <= error["relative_l1"] < 0.15, error)
            self.assertTrue(0.0 <= error["flip"] < 0.2, error)
        base = read_json(self.path("matte.gltf"))["materials"][0]["pbrMetallicRoughness"]
        self.assertEqual(base["baseColorFactor"][:3], model["values"]["baseColorFactor"])
        width, height = read_png_size(sheet)
        self.assertGreater(width, 3 * 192)
        self.assertGreater(height, 2 * 192)

    def test_materialx(self):
        matte = self.write_constant("matte.mbsdf")
        self.check(self.export("mtlx", "both.mtlx", material=matte), 0, "standard_surface", "open_pbr_surface")
        document = xml.etree.ElementTree.parse(self.path("both.mtlx")).getroot()
        self.assertEqual((document.tag, document.get("colorspace")), ("materialx", "lin_rec709"))
        self.assertEqual(document.get("version"), "1.39")
        self.assertEqual(len(document.findall("surfacematerial")), 2)

    def test_other_targets(self):
        # Its name means something in each of the files.
        named = self.write_constant('a"]}<b>\'.mbsdf')
        self.check(self.export("usda", "x.usda", material=named), 0, "UsdPreviewSurface")
        with open(self.path("x.usda"), encoding="utf-8") as file:
            text = file.read()
        self.assertTrue(text.startswith("#usda 1.0\n"))
        for words in ('def Material "a____b__"', "UsdPreviewSurface", "color3f inputs:diffuseColor = ("):
            self.assertIn(words, text)
        self.assertEqual(text.count("{"), text.count("}"))
        self.check(self.export("vtk-json", "x.json", material=named), 0, "VTK's PBR")
        values = read_json(self.path("x.json"))["property"]
        self.assertEqual((values["Interpolation"], len(values["Color"])), (3, 3))
        self.check(self.export("paraview-state", "x.py", material=named), 0)
        with open(self.path("x.py"), encoding="utf-8") as file:
            script = file.read()
        compile(script, "x.py", "exec")
        found = ast.literal_eval(script.split("VALUES = ")[1].split("}\n")[0] + "}")
        self.assertEqual((found["Interpolation"], found["Roughness"]), ("PBR", values["Roughness"]))

    def test_bad_input(self):
        self.check(run("export", "gold-paint", "-o", self.path("x.glb")), 2, "--to")
        self.check(run("export", "gold-paint", "--to", "gltf"), 2, "--output")
        self.check(run("export", "gold-paint", "--to", "blend", "-o", "x.blend"), 2, "--to", "blend")
        self.check(self.export("gltf", "x.usda"), 2, "x.usda", ".gltf or .glb")
        self.check(self.export("usda", "x.glb"), 2, "x.glb", ".usda")
        self.check(self.export("gltf", "x.glb", "--model", "open_pbr"), 2, "--model")
        self.check(self.export("gltf", "x.glb", "--size", "4"), 2, "--size")
        self.check(self.export("gltf", "x.glb", "--view", "30"), 2, "--view")
        self.check(self.export("gltf", "x.glb", "--sheet", "x.jpg"), 2, "x.jpg", ".png")
        self.check(self.export("gltf", "x.glb", material="no-such"), 1, "no-such")
        self.check(self.export("gltf", "no/x.glb"), 1, "no/x.glb")
        common = ["export", "gold-paint", "--to", "gltf", "-o", self.path("x.glb")]
        self.check(run(*common, "--environment", "no.hdr"), 1, "no.hdr")
        self.check(run(*common, "--fit-under", "sky,no.hdr"), 1, "no.hdr")
        self.check(run(*common, "--fit-under", "sky", "--environment", "sky"), 2, "--environment", "sky")
        self.assertEqual(os.listdir(self.folder), [])

    def test_interrupt(self):
        command = [PROGRAM, "export", "gold-paint", "--to", "gltf", "-o", self.path("x.glb")]
        status, said = self.interrupt(command)
        self.assertEqual(status, 1, said)
        self.assertIn("interrupted", said)
        self.assertEqual(os.listdir(self.folder), [])


class Occlusion(ToolTest):
    """What a mesh hides: predicted, traced, compared."""

    def write_bowl(self):
        """Two half spheres, open towards z, the inner one with normals inwards."""
        path = self.path("bowl.ply")
        points, faces = [], []
        for i, j in itertools.product(range(32), range(24)):
            u, t = i * math.pi / 16, 0.5 * math.pi * (0.05 + 0.95 * (j if j < 12 else 23 - j) / 11)
            radius, side = (1.0, 1.0) if j < 12 else (0.9, -1.0)
            direction = (math.sin(t) * math.cos(u), math.sin(t) * math.sin(u), -math.cos(t))
            points.append([*(radius * d for d in direction), *(side * d for d in direction)])
            if j > 0:
                faces.append([4, *(24 * ((i + k) % 32) + j - m for k, m in ((0, 0), (0, 1), (1, 1), (1, 0)))])
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n")
            file.writelines(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
            file.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
            file.writelines(" ".join(map(str, row)) + "\n" for row in points + faces)
        return path

    def test_mesh(self):
        mesh = json.loads(run("info", "ball-on-foot", "--json").stdout)
        self.assertEqual(mesh["triangles"] + mesh["skipped_triangles"], 2 * 360 * 240 - 360)  # quads but at the top
        rows = {(row["environment"], row["material"]): row for row in mesh["unoccluded"]}
        self.assertGreaterEqual(len(rows), 4)
        for row in rows.values():
            self.assertGreater(row["error"], 0.005)
            self.assertLess(row["error"], 0.5)
            self.assertLess(row["uncertainty"], 0.5 * row["error"] + 0.01)
        self.check(run("info", self.write_bowl()), 0, "unoccluded", "sky", "diffuse", "gloss")
        self.check(run("info", self.path("none.ply")), 1, "none.ply")

    def test_compare(self):
        report, strip = self.path("r.json"), self.path("strip.png")
        options = ["--environment", "sky", "--mesh", self.write_bowl(), "--size", "48x48", "--report", report]
        result = run("compare", "blue-fabric", *options, "--occlusion", "--samples", "64", "--strip", strip)
        self.check(result, 0, "unoccluded light: ", "the reference has occlusion")
        found = read_json(report)
        self.assertTrue(found["occlusion"])
        self.assertLess(found["traced_noise"], 0.1)
        self.assertTrue(os.path.exists(strip))

    def test_render_as_the_mapper(self):
        """What a mesh hides is drawn as the mapper draws it; for the laboratory it can be left out."""
        report = self.path("r.json")
        common = ["blue-fabric", "--environment", "hall", "--mesh", self.write_bowl(), "--size", "64x64",
                  "--view", "20,20", "--background", "none"]

        def render(name, *options):
            result = run("render", *common, "-o", self.path(name), "--report", report, *options)
            self.check(result, 0)
            return read_json(report).get("plan", "")

        def difference(name, other):
            result = run("diff", self.path(name), self.path(other), "--metric", "relative_l1", "--threshold", "9")
            self.check(result, 0)
            return float(result.stdout.split("relative_l1=")[1].split()[0])

        self.assertRegex(render("default.exr"), "unoccluded light: .*, modeled")
        self.assertRegex(render("view.exr", "--for-view"), "unoccluded light: .*, modeled")
        render("on.exr", "--occlusion", "on")
        self.assertNotIn("unoccluded", render("off.exr", "--occlusion", "off"))
        render("traced.exr", "--method", "traced", "--samples", "128")
        self.assertEqual(difference("default.exr", "on.exr"), 0.0)
        left_out = difference("off.exr", "traced.exr")
        self.assertGreater(left_out, 0.5)
        self.assertLess(difference("default.exr", "traced.exr"), 0.6 * left_out)
        many = ["render", "pink-felt", "--environment", "sky", "--mesh", "ball-on-foot", "--size", "16x16", "-o"]
        result = run(*many, self.path("x.exr"))
        self.check(result, 0)
        self.assertRegex(result.stderr, "not modeled: [0-9]+ points are more than 20000; --occlusion on models it")
        self.check(run(*many, self.path("x.png"), "--occlusion", "maybe"), 2, "--occlusion", "auto")

    def test_render(self):
        report = self.path("r.json")
        common = ["--environment", "sky", "--mesh", self.write_bowl(), "--size", "24x24", "--report", report]

        def render(*options):
            result = run("render", "blue-fabric", *common, "-o", self.path("x.exr"), *options)
            self.check(result, 0)
            with open(report, encoding="utf-8") as file:
                self.assertEqual(json.load(file)["method"], options[1])
            return result.stderr

        traced = render("--method", "traced", "--samples", "32", "--bounces", "1")
        self.assertIn("other samples would differ by", traced)
        plain = render("--method", "reference", "--samples", "32")
        self.assertIn("--samples has no effect without --method traced", plain)
        self.assertIn("--bounces has no effect", render("--method", "table", "--bounces", "1"))
        modeled = render("--method", "table", "--bounces", "1", "--occlusion", "on")
        self.assertNotIn("has no effect", modeled)
        lights = render("--method", "light-set", "--occlusion", "on")
        self.assertIn("--occlusion has no effect on a sum over lights", lights)
        self.check(run("render", "blue-fabric", "--environment", "sky", "--bounces", "-1", "-o", "x.png"), 2, "--bounces")


class PlanErrors(ToolTest):
    COMPARE = ["compare", "blue-fabric", *Compare.COMMON]

    def test_bad_input(self):
        common = self.COMPARE
        self.check(run(*common, "--method", "magic"), 2, "--method")
        self.check(run(*common, "--method", "reference"), 2, "--method")
        for option in ("--tolerance", "--maximum-cost"):
            for value in ("0", "-1", "nan"):
                self.check(run(*common, option, value), 2, option, value)
                self.check(run("plan", "blue-fabric", "--environment", "sky", option, value), 2, option, value)
        self.check(run(*common, "--reference-pixels", "0"), 2, "--reference-pixels")
        self.check(run(*common, "-o", "x.exr"), 2, ".png")
        self.check(run(*common, "-o", self.path("no/x.png")), 1, "no/x.png")
        self.check(run(*common, "--report", self.path("no/r.json")), 1, "no/r.json")
        self.check(run(*common, "--failure-map", "x.pdf"), 2, "x.pdf", ".png")
        self.check(run(*common, "--failure-map", self.path("no/f.png")), 1, "no/f.png")
        self.check(run(*common, "--fit", "no.fit"), 1, "no.fit")
        self.check(run("plan", "no-such", "--environment", "sky"), 1, "no-such")
        self.check(run("plan", "blue-fabric", "--environment", "no.hdr"), 1, "no.hdr")
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    PROGRAM, SHARED = map(os.path.abspath, sys.argv[1:3])
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
