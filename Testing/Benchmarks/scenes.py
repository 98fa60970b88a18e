# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Many actors and many blocks: the tables of docs/scenes.md.

Frames of measured materials beside the stock mappers with PBR under image-based light, of one scene, taken in turns; first
frames with many materials; what a further material and a further environment keep in memory.
"""

import argparse
import ctypes
import math
import statistics

import numpy as np
import vtkmeasuredbrdf as measured
import vtkmodules.vtkRenderingOpenGL2 as opengl
from common import Environment, Picture, make, make_mapper, make_sphere, make_sums, tell_header, tell_row
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkRenderingCore import vtkActor, vtkCompositePolyDataMapper, vtkPolyDataMapper

if (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) < (9, 3):
    vtkCompositePolyDataMapper = opengl.vtkCompositePolyDataMapper2  # noqa: F811


class MallocInfo(ctypes.Structure):
    """glibc's struct mallinfo2."""

    _fields_ = [(name, ctypes.c_size_t) for name in
                "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost".split()]  # fmt: skip


LIBC = ctypes.CDLL(None)
LIBC.mallinfo2.restype = MallocInfo


def get_heap_megabytes():
    return 1e-6 * LIBC.mallinfo2().uordblks


def make_one(index, side):
    return make_sphere(0.45, 16, (index % side, index // side, 0.0))


def make_materials(count):
    """From matte to satin."""
    return make_sums(count, lambda k: 5.0 + 15.0 * k / count)


class Scene(Picture):
    """A camera that sees side x side units, and light from a built-in hall."""

    def __init__(self, side, pbr=False):
        super().__init__(vtkPolyDataMapper(), radius=0.5 * side)
        self.renderer.RemoveActor(self.actor)  # there are many
        self.pbr = pbr
        if pbr:
            hall = measured.vtkEnvironment()
            hall.SetToProceduralHall()
            self.shade_by_pbr(hall, 0.0, 0.4)
        middle = 0.5 * (side - 1)
        self.renderer.GetActiveCamera().SetFocalPoint(middle, middle, 0.0)
        self.renderer.GetActiveCamera().SetPosition(middle, middle, 10.0)

    def add(self, mapper, data):
        mapper.SetInputDataObject(data)
        actor = make(vtkActor, Mapper=mapper)
        if self.pbr:
            actor.SetProperty(self.actor.GetProperty())
        self.renderer.AddActor(actor)


def time_frames(scenes, rounds):
    """Medians of the frames after the first one, in turns."""
    times = [[scene.draw() for scene in scenes] for _ in range(rounds + 1)]
    return [statistics.median(column) for column in zip(*times[1:])]


def tell_actors(count, rounds):
    side = math.ceil(math.sqrt(count))
    (material,) = make_materials(1)
    scenes = [Scene(side, pbr=kind == 0) for kind in range(3)]
    lights = make(measured.vtkLightSetRadianceIntegrator, NumberOfLights=16)
    for k in range(count):
        one = make_one(k, side)
        scenes[0].add(vtkPolyDataMapper(), one)
        scenes[1].add(make_mapper(material), one)
        scenes[2].add(make_mapper(material, integrator=lights), one)
    pbr, auto, sixteen = time_frames(scenes, rounds)
    tell_row(f"{count} actor{'s' * (count > 1)}", f"{pbr:.1f}", f"{auto:.1f}", f"**{auto / pbr:.2f}**", f"{sixteen:.1f}",
             f"{sixteen / pbr:.2f}")  # fmt: skip


def tell_blocks(count, rounds):
    side = math.ceil(math.sqrt(count))
    materials = make_materials(10)
    blocks = vtkMultiBlockDataSet()
    for k in range(count):
        blocks.SetBlock(k, make_one(k, side))
    scenes = [Scene(side, pbr=kind == 0) for kind in range(3)]
    scenes[0].add(vtkCompositePolyDataMapper(), blocks)
    one, ten = (make(measured.vtkCompositeMeasuredBRDFMapper, BRDF=materials[0]) for _ in range(2))
    for k in range(count):
        ten.SetBlockBRDF(k + 1, materials[k % 10])
    scenes[1].add(one, blocks)
    scenes[2].add(ten, blocks)
    pbr, first, second = time_frames(scenes, rounds)
    tell_row(f"{count} blocks, 1 material / 10 materials", f"{pbr:.1f}", f"{first:.1f} / {second:.1f}",
             f"**{first / pbr:.2f} / {second / pbr:.2f}**", "", "")  # fmt: skip


def tell_materials(count):
    """Every one with a plan of its own."""
    side = math.ceil(math.sqrt(count))
    scene = Scene(side)
    materials = make_materials(count)
    for k, material in enumerate(materials):
        scene.add(make_mapper(material), make_one(k, side))
    first = scene.draw()
    materials[0].GetTerm(1).SetExponent(12.3)
    tell_row(f"{count} material{'s' * (count > 1)}", f"{1e-3 * first:.2f}", f"{scene.draw():.0f}")


def tell_memory(width):
    pixels = np.zeros((width // 2, width, 3), np.float32)
    pixels += (0.5 + 0.4 * np.sin(0.001 * np.arange(width)))[:, None]
    pixels[width // 6, width // 3] = 5e4  # a sun
    environment = Environment(pixels).environment
    scene = Scene(3)
    heap = [get_heap_megabytes()]
    for k, material in enumerate(make_materials(6)):
        mapper = make_mapper(material, environment)
        scene.add(mapper, make_one(k, 3))
        scene.draw()
        heap.append(get_heap_megabytes())
    tell_row(f"{width} x {width // 2} ({1e-6 * pixels.nbytes:.0f} MB)", f"{heap[1] - heap[0]:.1f}",
             f"{(heap[6] - heap[2]) / 4.0:.2f}", f"{1e-6 * mapper.GetTextureBytes():.2f}")  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15, help="frames of each kind in turns")
    rounds = parser.parse_args().rounds
    print(f"VTK {vtkVersion.GetVTKVersion()}, frame times in ms, medians of {rounds} frames taken in turns\n")
    tell_header("scene", "stock PBR, image-based light", "AUTO", "ratio", "16 lights", "ratio")
    for count in (1, 100, 1000, 2000):
        tell_actors(count, rounds)
    tell_blocks(10000, rounds)
    print()
    tell_header("different materials", "first frame (s)", "frame after one change (ms)")
    for count in (1, 10, 100):
        tell_materials(count)
    print()
    tell_header("environment with a sun (its pixels)", "heap after the first material (MB)",
                "for each further material (MB)", "its textures (MB)")  # fmt: skip
    for width in (1024, 4096):
        tell_memory(width)


if __name__ == "__main__":
    main()
