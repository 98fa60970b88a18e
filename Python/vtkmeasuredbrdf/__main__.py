# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The command `measured-brdf` of the package: the C++ program of that name, with `fetch` and `view` in Python."""

import os
import subprocess
import sys
from pathlib import Path

HELP = """measured-brdf fetch [NAME...]   download published materials and environments
measured-brdf view [FILE...]    a page in the browser: material, environment, mesh, plan, lobe and slices
Further commands:
"""


def find_program():
    """The C++ program: in a wheel beside this file, else in the prefix's bin or in PATH. Scripts such as this
    package's own are passed over."""
    package = Path(__file__).resolve().parent
    if os.name == "nt":
        folders = [package]
    else:
        folders = [package, *(parent / "bin" for parent in package.parents), *map(Path, os.get_exec_path())]
    for folder in folders:
        path = folder / ("measured-brdf.exe" if os.name == "nt" else "measured-brdf")
        if os.access(path, os.X_OK) and path.is_file():
            with path.open("rb") as file:
                if file.read(2) != b"#!":
                    return str(path)
    return sys.exit("measured-brdf: the program is missing: it is neither in this package nor in PATH. The package was "
                    "built without it (MEASUREDBRDF_BUILD_TOOL)")


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["fetch"]:
        from ._fetch import main as fetch

        fetch(arguments[1:])
    elif arguments[:1] == ["view"]:
        try:
            from .view import main as view
        except ImportError as error:
            sys.exit(f"measured-brdf view: {error}")
        sys.argv = ["measured-brdf view", *arguments[1:]]  # trame reads its own options there
        view()
    else:
        if arguments in ([], ["-h"], ["--help"]):
            print(HELP, end="", flush=True)
        command = [find_program(), *arguments]
        if os.name == "nt":  # whose execv does not wait
            sys.exit(subprocess.call(command))
        os.execv(command[0], command)


if __name__ == "__main__":
    main()
