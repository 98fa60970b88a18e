#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the text files of this repository against .editorconfig.

Text is UTF-8 with LF line ends, without tabs, without spaces at the ends of lines, and ends with one line end. C++
lines have at most 100 columns; GLSL is ASCII. Sources and scripts begin with the SPDX lines.
"""

import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SKIPPED_FOLDERS = ("build", "output", "install", "__pycache__", ".git")
BINARY = (".png", ".exr")
COLUMNS = 100
CODE = (".h", ".cxx", ".txx")
LICENSED = (".h", ".cxx", ".txx", ".py")


def text_files():
    for folder, folders, names in os.walk(ROOT):
        top = folder == ROOT
        folders[:] = sorted(name for name in folders if name not in SKIPPED_FOLDERS
                            and not (top and name.startswith("build")))
        for name in sorted(names):
            path = os.path.join(folder, name)
            if not name.endswith(BINARY) and name != ".git" and not os.path.islink(path):
                yield path


def problems(path):
    with open(path, "rb") as file:
        content = file.read()
    if not content:
        return
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        yield 1, f"not UTF-8 at byte {error.start}"
        return
    if not text.endswith("\n") or text.endswith("\n\n"):
        yield text.count("\n"), "does not end with one line end"
    for number, line in enumerate(text.split("\n"), 1):
        if "\r" in line:
            yield number, "CR in a line"
        if "\t" in line:
            yield number, "tab"
        if line.endswith(" "):
            yield number, "space at the end of the line"
        if path.endswith(CODE) and len(line) > COLUMNS:
            yield number, f"{len(line)} columns"
        if path.endswith(".glsl") and not line.isascii():
            yield number, "not ASCII"
    if path.endswith(LICENSED) and "SPDX-License-Identifier: BSD-3-Clause" not in text[:300]:
        yield 1, "no SPDX lines"


def main():
    found = 0
    for path in text_files():
        for number, problem in problems(path):
            print(f"{os.path.relpath(path, ROOT)}:{number}: {problem}")
            found += 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
