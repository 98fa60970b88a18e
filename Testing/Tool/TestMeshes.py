# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files that are damaged, or come with bad normals or none: TestMeshes.py PROGRAM SHARED_DATA [unittest arguments]."""

import base64
import json
import math
import os
import signal
import struct
import subprocess
import sys
import time
import unittest

import TestTool
from TestTool import ToolTest, read_png, run

FLOATS = "property float x\nproperty float y\nproperty float z\n"


def make_ball(rows=24, columns=48):
    """Triangles of unit points."""

    def point(row, column):
        theta, phi = math.pi * row / rows, 2.0 * math.pi * (column % columns) / columns
        if row in (0, rows):
            return (0.0, 0.0, 1.0 if row == 0 else -1.0)
        return (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))

    triangles = []
    for row in range(rows):
        for column in range(columns):
            a, b = point(row, column), point(row + 1, column)
            c, d = point(row + 1, column + 1), point(row, column + 1)
            triangles += [(a, b, c)] * (b != c) + [(a, c, d)] * (a != d)
    return triangles


class MeshDamage(ToolTest):
    def make_gltf(self, **changes):
        content = struct.pack("<9f3H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)
        document = {
            "asset": {"version": "2.0"},
            "buffers": [{"uri": "data:application/octet-stream;base64," + base64.b64encode(content).decode(), "byteLength": 42}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
            ],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "nodes": [{"mesh": 0}],
            "scenes": [{"nodes": [0]}],
            "scene": 0,
        }
        document.update(changes)
        return json.dumps(document)

    def test_damage_is_an_error(self):
        self.check(run("info", self.write("whole.gltf", self.make_gltf())), 0, "triangles                 1")
        head = "ply\nformat ascii 1.0\nelement vertex 3\n" + FLOATS
        face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        binary = head.replace("ascii", "binary_little_endian") + face
        points = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
        far = [{"bufferView": 0, "componentType": 5126, "count": 2000000, "type": "VEC3"}]
        vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        cases = {
            "cut.ply": "ply\nformat ascii 1.0\nelement vertex 3\n",
            "many.ply": head.replace("3", "999999999") + face,
            "flat.ply": head.replace(FLOATS, "property float x\n") + face + "0 0 0\n1 0 0\n0 1 0\n",
            "corner.ply": head + face + "0 0 0\n1 0 0\n0 1 0\n3 0 1 99\n",
            "nan.ply": head + face + "nan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            "far.obj": vertices + "f 1 2 9\n",
            "normal.obj": vertices + "f 1//1 2//1 3//1\n",
            "empty.obj": "",
            "face.ply": head + face + "0 0 0\n1 0 0\n0 1 0\n3 0\n",
            "points.ply": binary.encode() + points[:-8],
            "missing.ply": head.replace("3", "30") + face + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            "cycle.gltf": self.make_gltf(nodes=[{"children": [1]}, {"children": [0]}]),
            "far.gltf": self.make_gltf(accessors=far, meshes=[{"primitives": [{"attributes": {"POSITION": 0}}]}]),
            "view.gltf": self.make_gltf(bufferViews=[{"buffer": 7, "byteLength": 36}]),
            "accessor.gltf": self.make_gltf(meshes=[{"primitives": [{"attributes": {"POSITION": 9}}]}]),
            "mesh.gltf": self.make_gltf(nodes=[{"mesh": 5}]),
            "cut.stl": b"\0" * 80 + struct.pack("<I", 1000) + b"\0" * 60,
            "cut.vtp": b'<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1"><Poin',
            "far.vtk": "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 77\n",
        }
        for name, content in cases.items():
            with self.subTest(name):
                result = run("info", self.write(name, content))
                self.check(result, 1, name)
                self.assertEqual(result.stderr.count("error:"), 1, result.stderr)

    @unittest.skipUnless(os.path.exists("/proc/self/status"), "skipped: no /proc")
    def test_ctrl_c_ends_a_long_reading(self):
        count = 60000
        text = "v 0 0 0\nv 0 0 1\n"
        for k in range(count):
            angle = 2.0 * math.pi * k / count
            text += f"v {math.cos(angle):.6f} {math.sin(angle):.6f} 0.5\n"
        text += "".join(f"f 1 2 {k + 3}\n" for k in range(count))
        command = [TestTool.PROGRAM, "plan", "gold-paint", "--environment", "room", "--mesh", self.write("fan.obj", text)]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
            children = []
            while process.poll() is None and not children:
                time.sleep(0.01)
                with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
                    children = file.read().split()
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 1, said)
        self.assertIn("interrupted", said)
        self.assertFalse(os.path.exists("/proc/" + children[0]))


class MeshNormals(ToolTest):
    def draw(self, mesh):
        path = mesh + ".png"
        result = run("render", "gold-paint", "--environment", "room", "--mesh", mesh, "--size", "96x96", "-o", path)
        if "needs an X server" in result.stderr:
            self.skipTest("skipped: no X server, which this VTK needs")
        self.check(result, 0)
        return [value for row in read_png(path) for value in row], result.stderr

    def check_same(self, found, expected, largest):
        self.assertLessEqual(max(abs(a - b) for a, b in zip(found, expected)), largest)

    def test_a_point_for_each_corner_is_smooth(self):
        triangles = make_ball()
        stl = "solid ball\n"
        obj, textured = "", "vt 0 0\nvt 1 0\nvt 0 1\n"
        for triangle in triangles:
            corners = [" ".join(f"{value:.9g}" for value in corner) for corner in triangle]
            stl += "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {corner}\n" for corner in corners)
            stl += "endloop\nendfacet\n"
            obj += "".join(f"v {corner}\n" for corner in corners) + "f -3 -2 -1\n"
            textured += "".join(f"v {corner}\n" for corner in corners) + "f -3/1 -2/2 -1/3\n"
        smooth, _ = self.draw(self.write("ball.stl", stl + "endsolid\n"))
        for name, text in (("ball.obj", obj), ("textured.obj", textured)):
            found, said = self.draw(self.write(name, text))
            self.assertEqual(said, "")
            self.check_same(found, smooth, 1)

    def write_ball(self, name, change):
        """A ball of a point for each corner with normals, of which change(k, normal) gives others."""
        points = [corner for triangle in make_ball() for corner in triangle]
        normals = [change(k, point) for k, point in enumerate(points)]
        count = len(points) // 3
        data = b"# vtk DataFile Version 3.0\n\nBINARY\nDATASET POLYDATA\n"
        data += f"POINTS {len(points)} float\n".encode() + b"".join(struct.pack(">3f", *point) for point in points)
        data += f"\nPOLYGONS {count} {4 * count}\n".encode()
        data += b"".join(struct.pack(">4i", 3, 3 * k, 3 * k + 1, 3 * k + 2) for k in range(count))
        data += f"\nPOINT_DATA {len(points)}\nNORMALS n float\n".encode()
        data += b"".join(struct.pack(">3f", *normal) for normal in normals)
        return self.write(name, data), len(points)

    def test_normals_that_are_none_are_computed(self):
        whole, said = self.draw(self.write_ball("whole.vtk", lambda _, normal: normal)[0])
        self.assertEqual(said, "")
        bad = ((math.nan, 0.0, 1.0), (0.0, 0.0, 0.0), (math.inf, 0.0, 0.0), (math.nan,) * 3)
        path, count = self.write_ball("bad.vtk", lambda k, normal: bad[k % 4] if k % 7 == 0 else normal)
        found, said = self.draw(path)
        self.check_same(found, whole, 3)
        self.assertEqual(said.count("normals"), 1, said)
        self.assertIn(f"{(count + 6) // 7} of {count} normals", said)


if __name__ == "__main__":
    TestTool.PROGRAM, TestTool.SHARED = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
