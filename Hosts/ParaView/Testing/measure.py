# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frames and memory of a distributed surface, this representation beside "Surface" with VTK's PBR:

    mpiexec -n RANKS pvbatch --symmetric measure.py [MILLIONS]

MILLIONS of triangles (default 10) in 1000 x 1000 pixels. Every rank runs the script. The first one prints a row of
Markdown for each representation: ranks, representation, the median still frame of 9 in ms, the first frame in s, and the
largest memory of a rank in MB after it, with what the representation added.
"""
import math
import os
import statistics
import sys
import time

from paraview import simple
from paraview.modules.vtkRemotingCore import vtkProcessModule
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

from common import load_plugin, look, make_view

FRAMES = 9


def get_memory():
    """Resident memory of this process in MB."""
    with open("/proc/self/status", encoding="utf-8") as file:
        for line in file:
            if line.startswith("VmRSS:"):
                return float(line.split()[1]) / 1024
    return math.nan


def get_largest(value):
    from vtkmodules.vtkCommonCore import vtkDoubleArray

    mine, largest = vtkDoubleArray(), vtkDoubleArray()
    mine.InsertNextValue(value)
    largest.SetNumberOfValues(1)
    vtkMultiProcessController.GetGlobalController().AllReduce(mine, largest, vtkCommunicator.MAX_OP)
    return largest.GetValue(0)


def measure(view, sphere, representation, environment):
    before = get_largest(get_memory())
    display = simple.Show(sphere, view)
    display.Representation = representation
    if representation == "Surface":
        display.Interpolation = "PBR"
        display.Metallic = 1.0
        display.Roughness = 0.3
        view.BackgroundTexture = environment
        view.BackgroundColorMode = "Skybox"
        view.UseEnvironmentLighting = 1
    begin = time.perf_counter()
    simple.Render(view)
    first = time.perf_counter() - begin
    times = []
    for frame in range(FRAMES):
        view.CameraPosition = [2.4 * math.sin(0.02 * frame), 0.0, 2.4 * math.cos(0.02 * frame)]
        begin = time.perf_counter()
        simple.Render(view)
        times.append(time.perf_counter() - begin)
    after = get_largest(get_memory())
    return 1e3 * statistics.median(times), first, after, after - before


def main(millions):
    load_plugin()
    module = vtkProcessModule.GetProcessModule()
    side = round(math.sqrt(1e6 * millions / 2))
    for representation in ("Surface", "Measured Material"):
        view = make_view()
        view.ViewSize = [1000, 1000]
        view.RemoteRenderThreshold = 0
        look(view)
        sphere = simple.Sphere(ThetaResolution=side, PhiResolution=side)
        environment = simple.CreateTexture(os.environ["MEASUREDBRDF_PARAVIEW_HDR"])
        frame, first, memory, added = measure(view, sphere, representation, environment)
        if module.GetPartitionId() == 0:
            count = module.GetNumberOfLocalPartitions()
            print(f"| {count} | {representation} | {frame:.0f} | {first:.1f} | {memory:.0f} | {added:.0f} |", flush=True)
        simple.Delete(view)
        simple.Delete(sphere)


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 10.0)
