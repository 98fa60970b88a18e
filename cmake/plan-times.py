#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Plans for materials that are new under a map that is known: time, choice, prediction, and frames.

usage: plan-times.py DATA [--tolerance 0.02] [--only PART ...] [--known] [--new-map] [--frames] [--csv FILE]

DATA: materials/rgl, materials/mbsdf and environments. PYTHONPATH: the build's lib/python3/dist-packages. Times are
the processor's, of all threads, and, as "clock", those that pass. --known: each plan again under
a map that is known, too, for a material that is. --new-map: again for the known material, the map read anew. --frames: a 500 x 500 frame of a sphere of 64,000 triangles relative to VTK's PBR, drawn in turns
(needs a display).
"""

import argparse
import csv
import statistics
import time
from pathlib import Path

from vtkmeasuredbrdf import (
    vtkBRDFReader, vtkEmbeddedMaterials, vtkEnvironmentReader, vtkMeasuredBRDFMapper, vtkRadiancePlanner)

ENVIRONMENTS = ("studio.exr", "interior.exr", "city.exr", "sunset.exr", "forest.exr", "pmndrs_sunrise.hdr",
                "courtyard.exr", "rooitou_park_1k.hdr")
PUBLISHED = ("blue-fabric", "gold-metallic-paint3", "violet-rubber", "nickel", "pink-felt", "gold-paint")
TURNS = 5


def read(reader, path):
    reader.SetFileName(str(path))
    if not reader.Read():
        raise SystemExit(f"{path} can't be read")
    return reader


def plan(brdf, environment, tolerance):
    planner = vtkRadiancePlanner()
    planner.SetBRDF(brdf)
    planner.SetEnvironment(environment)
    planner.SetErrorTolerance(tolerance)
    start = time.process_time(), time.perf_counter()
    if not planner.Update():
        raise SystemExit("no plan")
    return round(time.process_time() - start[0], 3), round(time.perf_counter() - start[1], 3), planner


class Picture:
    """A sphere that fills a window."""

    def __init__(self, mapper):
        from vtkmodules.vtkFiltersSources import vtkSphereSource
        from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
        self.sphere = vtkSphereSource()
        self.sphere.SetThetaResolution(180)
        self.sphere.SetPhiResolution(180)
        mapper.SetInputConnection(self.sphere.GetOutputPort())
        self.actor = vtkActor()
        self.actor.SetMapper(mapper)
        self.renderer = vtkRenderer()
        self.renderer.AddActor(self.actor)
        self.renderer.SetAutomaticLightCreation(False)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(500, 500)
        self.window.AddRenderer(self.renderer)
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(0.5)
        camera.SetPosition(0.0, 0.0, 2.0)
        self.renderer.ResetCameraClippingRange()

    def draw(self):
        start = time.process_time()
        for _ in range(2):
            self.window.Render()
            self.window.WaitForCompletion()
        return time.process_time() - start


def make_pbr(environment):
    from vtkmodules.vtkRenderingCore import vtkPolyDataMapper, vtkTexture
    picture = Picture(vtkPolyDataMapper())
    picture.actor.GetProperty().SetInterpolationToPBR()
    picture.actor.GetProperty().SetMetallic(0.7)
    picture.actor.GetProperty().SetRoughness(0.3)
    texture = vtkTexture()
    texture.SetInputData(environment.NewImageData())
    texture.SetColorModeToDirectScalars()
    texture.MipmapOn()
    texture.InterpolateOn()
    picture.renderer.UseImageBasedLightingOn()
    picture.renderer.SetEnvironmentTexture(texture)
    return picture


def compare_frames(pbr, brdf, environment, planner):
    mapper = vtkMeasuredBRDFMapper()
    mapper.SetBRDF(brdf)
    mapper.SetEnvironment(environment)
    mapper.SetIntegrator(planner.NewIntegrator())
    pictures = (pbr, Picture(mapper))
    times = ([], [])
    for turn in range(TURNS + 1):
        for picture, known in zip(pictures, times):
            seconds = picture.draw()
            if turn > 0:
                known.append(seconds)
    return statistics.median(times[1]) / statistics.median(times[0])


def find_materials(data):
    files = sorted((data / "materials/rgl").glob("*.bsdf")) + sorted((data / "materials/mbsdf").glob("*.mbsdf"))
    finders = {path.stem: lambda path=path: read(vtkBRDFReader(), path).GetBRDF() for path in files}
    finders.update({name: lambda name=name: vtkEmbeddedMaterials.NewBRDF(name) for name in PUBLISHED})
    return finders


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=Path)
    parser.add_argument("--tolerance", type=float, default=0.02)
    parser.add_argument("--only", nargs="*", default=[], help="parts of MATERIAL/MAP")
    parser.add_argument("--known", action="store_true")
    parser.add_argument("--new-map", action="store_true")
    parser.add_argument("--frames", action="store_true")
    parser.add_argument("--csv", type=Path)
    options = parser.parse_args()
    rows = []
    for name in ENVIRONMENTS:
        finders = {material: find for material, find in find_materials(options.data).items()
                   if not options.only or any(part in f"{material}/{name}" for part in options.only)}
        if not finders:
            continue
        environment = read(vtkEnvironmentReader(), options.data / "environments" / name).GetEnvironment()
        plan(vtkEmbeddedMaterials.NewBRDF("pink-felt"), environment, options.tolerance)  # the map is known from here on
        pbr = make_pbr(environment) if options.frames else None
        for material, find in finders.items():
            brdf = find()
            brdf.Prepare()
            seconds, clock, planner = plan(brdf, environment, options.tolerance)
            choice = planner.GetChoice()
            row = {"material": material, "map": name, "seconds": seconds, "clock": clock,
                   "candidates": planner.GetNumberOfCandidates(), "meets": int(planner.GetMeetsTolerance()),
                   "error_percent": round(100.0 * planner.GetPredictedError(choice), 3),
                   "MB": round(planner.GetTextureBytes(choice) / 1e6, 2),
                   "choice": f"{planner.GetMethodName(choice)}, {planner.GetDescription(choice)}"}
            if options.known:
                row["known_seconds"], row["known_clock"], _ = plan(brdf, environment, options.tolerance)
            if options.new_map:
                anew = read(vtkEnvironmentReader(), options.data / "environments" / name).GetEnvironment()
                row["new_map_seconds"], row["new_map_clock"], _ = plan(brdf, anew, options.tolerance)
            if options.frames:
                row["frame"] = round(compare_frames(pbr, brdf, environment, planner), 3)
            rows.append(row)
            print(" | ".join(str(value) for value in row.values()), flush=True)
            if options.csv:
                with options.csv.open("w", newline="", encoding="utf-8") as file:
                    writer = csv.DictWriter(file, rows[0])
                    writer.writeheader()
                    writer.writerows(rows)
    for column in ("seconds", "clock", "known_seconds", "known_clock", "new_map_seconds", "new_map_clock", "frame"):
        values = sorted(row[column] for row in rows if column in row)
        if values:
            print(f"{column}: geometric mean {statistics.geometric_mean(values):.3g}, median "
                  f"{statistics.median(values):.3g}, largest {values[-1]:.3g}, of {len(values)}")


if __name__ == "__main__":
    main()
