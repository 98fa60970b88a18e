# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""vtkmeasuredbrdf.fetch, from a server on this machine: sums, limits, names, and materials that are found by name."""

import functools
import hashlib
import http.server
import importlib.util
import os
import sys
import tempfile
import threading
import unittest
from pathlib import Path
from unittest import mock

for module in ("pooch", "numpy"):
    if importlib.util.find_spec(module) is None:
        print(f"Skipped: {module} is not installed")
        sys.exit(77)

import pooch

import vtkmeasuredbrdf
from vtkmeasuredbrdf import _fetch
from vtkmeasuredbrdf.environments import Environment
from vtkmeasuredbrdf.materials import Material


class Handler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Fetch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        patch = mock.patch.object(pooch, "os_cache", lambda name: self.folder / name)
        patch.start()
        self.addCleanup(patch.stop)
        server = http.server.ThreadingHTTPServer(
            ("127.0.0.1", 0), functools.partial(Handler, directory=str(self.folder)))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        self.data = self.folder / "served.exr"
        Material("gold-paint").save(self.data)
        bytes_ = self.data.read_bytes()
        own = {"url": f"http://127.0.0.1:{server.server_port}/served.exr", "file": "gold.exr", "begins_with": "v/1\1",
               "size": len(bytes_), "sha256": hashlib.sha256(bytes_).hexdigest()}
        patch = mock.patch.dict(_fetch.get_catalog()["satin_purple"], own)
        patch.start()
        self.addCleanup(patch.stop)
        self.entry = _fetch.get_catalog()["satin_purple"]
        self.path = self.folder / "vtkMeasuredBRDF" / "vtkMeasuredBRDF-files" / "gold.exr"

    def fail(self, error, text, *arguments, **keywords):
        with self.assertRaisesRegex(error, text):
            vtkmeasuredbrdf.fetch(*arguments, **keywords)

    def test_material(self):
        with self.assertRaisesRegex(ValueError, r"vtkmeasuredbrdf.fetch\('satin_purple'\)"):
            Material("satin_purple")
        with self.assertLogs(pooch.get_logger(), "INFO") as logs:
            self.assertEqual(vtkmeasuredbrdf.fetch("satin_purple"), str(self.path))
        self.assertIn("CC0", "".join(logs.output))
        self.assertEqual(self.path.read_bytes(), self.data.read_bytes())
        self.assertEqual(Material("satin_purple").evaluate((0, 0, 1), (0, 0, 1)).tolist(),
                         Material("gold-paint").evaluate((0, 0, 1), (0, 0, 1)).tolist())
        self.data.unlink()
        self.assertEqual(vtkmeasuredbrdf.fetch("gold.exr"), str(self.path))  # once

    def test_names(self):
        self.fail(ValueError, "'satin_purple'", "satin_purpel")
        with self.assertRaisesRegex(ValueError, "'satin_purple'"):
            Material("satin_purpel")
        with self.assertRaisesRegex(ValueError, "'venice_sunset_1k'"):
            Environment("venice_sunset_k")
        self.assertEqual(len(_fetch.get_catalog()), 118)

    def test_refused(self):
        self.fail(ValueError, "hash", "satin_purple", sha256=64 * "0")
        self.entry["begins_with"] = "tensor_file"
        self.fail(OSError, "does not begin with 'tensor_file'", "satin_purple")
        self.entry["size"] -= 1
        self.fail(OSError, "sends more than", "satin_purple")
        self.entry["size"] += 2
        self.fail(OSError, "bytes came, expected", "satin_purple")
        self.entry["url"] += ".gone"
        self.fail(OSError, "404", "satin_purple")
        self.assertFalse(list(self.path.parent.iterdir()))

    def test_unknown_sum(self):
        self.entry["sha256"] = ""
        self.fail(ValueError, "nobody knows", "satin_purple")
        vtkmeasuredbrdf.fetch("satin_purple", trust_first=True)
        self.assertEqual(vtkmeasuredbrdf.fetch("satin_purple"), str(self.path))
        self.path.write_bytes(b"changed")
        vtkmeasuredbrdf.fetch("satin_purple")  # anew
        self.assertEqual(self.path.read_bytes(), self.data.read_bytes())

    def test_without_pooch(self):
        with mock.patch.dict(sys.modules, pooch=None):
            self.fail(ImportError, "pip install pooch", "satin_purple")


class Network(unittest.TestCase):
    def test_published(self):
        with tempfile.TemporaryDirectory() as folder, \
                mock.patch.object(pooch, "os_cache", lambda name: os.path.join(folder, name)):
            try:
                path = vtkmeasuredbrdf.fetch("satin_purple")
            except OSError as error:
                self.skipTest(f"no network: {error}")
            self.assertGreater(Material(path).albedo((0, 0, 1)).max(), 0.0)


if __name__ == "__main__":
    unittest.main()
