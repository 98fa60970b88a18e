# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""`python -m vtkmeasuredbrdf`: it finds the C++ program and never itself, and says where there is none."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from vtkmeasuredbrdf import __main__ as command


def run(*arguments):
    return subprocess.run([sys.executable, "-m", "vtkmeasuredbrdf", *arguments], capture_output=True, text=True)


class Command(unittest.TestCase):
    def test_program(self):
        try:
            command.find_program()
        except SystemExit:
            self.skipTest("the program was not built")
        done = run("list")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("gold-paint", done.stdout)
        self.assertEqual(run("list", "--wrong").returncode, 2)
        self.assertIn("measured-brdf view", run("--help").stdout.splitlines()[1])

    def test_fetch_list(self):
        done = run("fetch", "--list", "satin")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("satin_purple", done.stdout)
        self.assertNotIn("cardboard", done.stdout)

    def test_finding(self):
        """Scripts are passed over: the package's own has the program's name."""
        with tempfile.TemporaryDirectory() as folder:
            script, program = Path(folder, "script", "measured-brdf"), Path(folder, "program", "measured-brdf")
            script.parent.mkdir()
            program.parent.mkdir()
            script.write_text("#!/bin/sh\n", encoding="ascii")
            script.chmod(0o755)
            shutil.copy(os.path.realpath(sys.executable), program)
            path = os.pathsep.join((str(script.parent), str(program.parent)))
            with mock.patch.object(command, "__file__", os.path.join(folder, "package", "__main__.py")):
                with mock.patch.dict(os.environ, PATH=path):
                    self.assertEqual(command.find_program(), str(program))
                with mock.patch.dict(os.environ, PATH=str(script.parent)), self.assertRaises(SystemExit) as caught:
                    command.find_program()
        self.assertIn("the program is missing", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
