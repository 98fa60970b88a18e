#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The errors of exports in docs/exports.md: make-export-table.py [OPTIONS] PROGRAM MATERIAL...

Exports every material to every shading model, fitted under the built-in sky and hall and the neutral studio, and writes a table
of the errors under the built-in room between the marks in docs/exports.md. --results FILE keeps what was measured; a run that
was interrupted goes on there.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BEGIN, END = "<!-- begin of the export table -->\n", "<!-- end of the export table -->\n"
TARGETS = {"gltf": "x.glb", "mtlx": "x.mtlx", "usda": "x.usda", "vtk-json": "x.json"}
COLUMNS = ["glTF metallic-roughness", "standard_surface", "open_pbr_surface", "UsdPreviewSurface", "VTK's PBR"]
PARTS = {"specular": "s", "coat": "c", "sheen": "f", "anisotropy": "a"}


def measure(program, material, size):
    models = []
    with tempfile.TemporaryDirectory() as folder:
        for target, name in TARGETS.items():
            command = [program, "export", material, "--to", target, "-o", os.path.join(folder, name), "--closest", "--json"]
            made = subprocess.run([*command, "--size", str(size)], stdout=subprocess.PIPE, text=True, check=True)
            models += json.loads(made.stdout)["models"]
    return models


def format_cell(model):
    (error,) = [error for error in model["errors"] if not error["seen_by_the_fit"]]
    parts = "".join(PARTS[part] for part in model["parts"])
    return f"{100.0 * error['relative_l1']:.1f} %, {error['flip']:.3f}" + (f" ({parts})" if parts else "")


def make_table(results):
    lines = ["| material | glTF | standard_surface | open_pbr_surface | UsdPreviewSurface | VTK's PBR |", "|---|---|---|---|---|---|"]
    sums = [0.0] * len(COLUMNS)
    for name, models in results.items():
        by_title = {model["model"]: model for model in models}
        lines.append(f"| {name} | " + " | ".join(format_cell(by_title[title]) for title in COLUMNS) + " |")
        for k, title in enumerate(COLUMNS):
            (error,) = [error for error in by_title[title]["errors"] if not error["seen_by_the_fit"]]
            sums[k] += error["relative_l1"] / len(results)
    lines.append("| mean | " + " | ".join(f"{100.0 * value:.1f} %" for value in sums) + " |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", metavar="PROGRAM", help="measured-brdf")
    parser.add_argument("materials", metavar="MATERIAL", nargs="+", help="files and names of embedded materials")
    parser.add_argument("--results", required=True, help="JSON file that keeps what was measured")
    parser.add_argument("--size", type=int, default=16, help="pixels across the sphere (default 16)")
    arguments = parser.parse_args()
    results = {}
    if os.path.exists(arguments.results):
        with open(arguments.results, encoding="utf-8") as file:
            results = json.load(file)
    for material in arguments.materials:
        name = os.path.splitext(os.path.basename(material))[0].removesuffix("_rgb")
        if name not in results:
            results[name] = measure(arguments.program, material, arguments.size)
            with open(arguments.results, "w", encoding="utf-8") as file:
                json.dump(results, file, indent=1)
            print(name, *(format_cell(model) for model in results[name]), sep="  ", flush=True)
    page = os.path.join(ROOT, "docs", "exports.md")
    with open(page, encoding="utf-8") as file:
        text = file.read()
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    with open(page, "w", encoding="utf-8") as file:
        file.write(text[:begin] + "\n" + make_table(results) + "\n" + text[end:])


if __name__ == "__main__":
    sys.exit(main())
