# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files that the tool writes are whole or what they were; files of JSON that it reads are nested as deep as they may be.

usage: TestFiles.py MEASURED_BRDF CLOSE_FAILS [unittest options]

CLOSE_FAILS: a library that makes closing a file under way an error, as quotas and network file systems do; "" for none.
"""
import os
import resource
import stat
import subprocess
import sys
import tempfile
import threading
import unittest

PROGRAM, CLOSE_FAILS = sys.argv[1:3]
OLD = b"what was there"


class Outputs(unittest.TestCase):
    # What each of them writes; OUT stands for the file.
    COMMANDS = {
        "convert.exr": ["convert", "blue-fabric", "OUT"],
        "lights.csv": ["lights", "hall", "-o", "OUT"],
        "picture.png": ["render", "blue-fabric", "--environment", "sky", "-o", "OUT", "--size", "48x48", "--method", "light-set"],
        "picture.exr": ["render", "blue-fabric", "--environment", "sky", "-o", "OUT", "--size", "48x48", "--method", "light-set"],
    }

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="measuredbrdf-files-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_tool(self, command, out, **options):
        arguments = [out if word == "OUT" else word for word in command]
        result = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, **options)
        if "needs an X server" in result.stderr:
            for left in os.listdir(self.folder):
                os.remove(os.path.join(self.folder, left))
            self.skipTest("skipped: " + result.stderr)
        return result

    def make_old(self, name):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(OLD)
        return path

    def check_kept(self, result, path, *words):
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        for word in (path, "cannot be written", *words):
            self.assertIn(word, result.stderr)
        with open(path, "rb") as file:
            self.assertEqual(file.read(), OLD)
        self.assertEqual(os.listdir(self.folder), [os.path.basename(path)])

    def test_full_disk(self):
        """A limit of file sizes acts as a full disk does."""
        for name, command in self.COMMANDS.items():
            with self.subTest(name):
                path = self.make_old(name)
                result = self.run_tool(
                    command, path, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
                self.check_kept(result, path, "File too large")
                os.remove(path)

    def test_error_of_closing(self):
        if not CLOSE_FAILS:
            self.skipTest("skipped: no library that makes closing fail")
        for name, command in self.COMMANDS.items():
            with self.subTest(name):
                path = self.make_old(name)
                result = self.run_tool(command, path, env={**os.environ, "LD_PRELOAD": CLOSE_FAILS})
                self.check_kept(result, path, "quota")
                os.remove(path)

    def test_links_and_long_names(self):
        for name, command in self.COMMANDS.items():
            with self.subTest(name):
                target = self.make_old("n" * 240 + os.path.splitext(name)[1])
                link = os.path.join(self.folder, "link" + os.path.splitext(name)[1])
                os.symlink(os.path.basename(target), link)
                result = self.run_tool(command, link)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(os.path.islink(link))
                self.assertGreater(os.path.getsize(target), len(OLD))
                self.assertEqual(len(os.listdir(self.folder)), 2)
                os.remove(link)
                os.remove(target)

    def test_pipe(self):
        path = os.path.join(self.folder, "pipe.exr")
        os.mkfifo(path)
        read = []

        def take():
            with open(path, "rb") as file:
                read.append(file.read())

        thread = threading.Thread(target=take, daemon=True)
        thread.start()
        result = self.run_tool(self.COMMANDS["convert.exr"], path)
        self.assertEqual(result.returncode, 0, result.stderr)
        thread.join(60)
        self.assertEqual(read[0][:4], b"\x76\x2f\x31\x01")
        self.assertTrue(stat.S_ISFIFO(os.stat(path).st_mode))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
