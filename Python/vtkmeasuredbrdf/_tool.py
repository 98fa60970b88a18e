# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The command measured-brdf of an installation by pip: it runs the program that lies beside this module."""

import os
import sys


def main() -> None:
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "measured-brdf")
    os.execv(program, [program, *sys.argv[1:]])
