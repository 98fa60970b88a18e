# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of several materials beside one material: frame times and textures, the table of docs/maps.md.

A sphere of 64,000 triangles that fills most of 500 x 500 pixels, frames taken in turns. Times are the processor's, of all threads:
a software renderer's, whatever else the machine does.
"""

import argparse
import math
import time

import numpy as np
import vtkmeasuredbrdf as measured
from common import Environment, Picture, make, make_mapper, make_sphere, make_sums, tell_header, tell_row, to_array
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData


def make_mapped_sphere(resolution=180):
    sphere = make_sphere(resolution=resolution)
    points = vtk_to_numpy(sphere.GetPoints().GetData())
    sphere.GetPointData().SetTCoords(to_array(points[:, :2] + 0.5, "coordinates"))
    return sphere, points


def make_materials_in_sun():
    """Gloss or a diffuse part alone have other shaders than both."""
    materials = make_sums(64, lambda k: 8.0 + 0.1 * k)
    for k, material in enumerate(materials):
        if k % 3:
            term = material.GetTerm(k % 3 - 1)
            material.RemoveAllTerms()
            material.AddTerm(term)
    return materials


class Kinds:
    """What is drawn: (name, materials that meet in a pixel, mapper)."""

    def __init__(self, wanted):
        self.wanted, self.list = wanted, []
        self.sky = measured.vtkEnvironment()
        self.sky.SetToProceduralSky()
        self.materials = make_sums(1024, lambda k: 8.0 + 0.1 * (k % 256))

    def add(self, name, meeting, surface, material=None, mode=None, materials=0, of=None, image=None):
        """One material, or a map of so many, by the mode."""
        mapper = make_mapper(material, self.sky)
        mapper.SetInputData(surface)
        if mode is not None:
            material_map = make(measured.vtkMaterialMap, Mode=mode, ArrayName="data")
            for k in range(materials):
                material_map.AddMaterial((of or self.materials)[k])
            if image is not None:
                material_map.AddWeightImage(image)
            mapper.SetMaterialMap(material_map)
        if not self.list or self.wanted in name:
            self.list.append((name, meeting, mapper))
        return mapper

    def add_classes(self, classes, of_cells, of=None, suffix=""):
        """Wedges about the z axis; of many classes, a few triangles in a row each."""
        sphere, points = make_mapped_sphere()
        at = points
        if of_cells:
            triangles = points[vtk_to_numpy(sphere.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
            at = np.stack([triangles[..., 0].max(axis=1), triangles[..., 1].min(axis=1)], axis=1)
        turn = np.arange(len(at)) / len(at) if classes > 64 else np.arctan2(at[:, 1], at[:, 0]) / 6.2831854 + 0.5
        numbers = np.minimum((turn * classes).astype(np.int32), classes - 1)
        (sphere.GetCellData() if of_cells else sphere.GetPointData()).AddArray(to_array(numbers))
        name = f"{classes} classes of {'cells' if of_cells else 'points'}{suffix}"
        return self.add(name, 1, sphere, mode=measured.vtkMaterialMap.CLASSES, materials=classes, of=of)

    def add_all(self):
        one = self.materials[0]
        self.add("one material", 1, make_mapped_sphere()[0], one)
        for classes in (2, 8, 24, 256, 1024):
            self.add_classes(classes, True)
        for classes in (8, 64):
            self.add_classes(classes, False)
        colored = self.add_classes(64, False, suffix=", colors of cells")  # white: nothing changes
        cells = colored.GetInput().GetCellData()
        cells.AddArray(to_array(np.full((colored.GetInput().GetNumberOfCells(), 3), 255, np.uint8), "white"))
        colored.SetScalarModeToUseCellFieldData()
        colored.SelectColorArray("white")
        others = make_sums(64, lambda k: 4.0 ** (1.0 + k % 6))
        self.add_classes(64, False, others, ", tables of 17 to 129 rows")
        # Two suns are lights beside tables, which evaluate materials of three shaders.
        pixels = np.full((128, 256, 3), 0.3, np.float32)
        pixels[27, 40] = pixels[42, 150] = 4000.0
        suns = Environment(pixels).environment
        in_sun = make_materials_in_sun()
        lit = [
            self.add("one material, suns as lights", 1, make_mapped_sphere()[0], in_sun[0]),
            self.add_classes(64, False, in_sun, ", three shaders, suns as lights"),
        ]
        for mapper in lit:
            mapper.SetEnvironment(suns)
            mapper.SetIntegrator(make(measured.vtkHybridRadianceIntegrator, NumberOfRows=17))
        self.add("one material, as many triangles as 64 classes of points", 1, make_mapped_sphere(235)[0], one)
        sphere, points = make_mapped_sphere()
        sphere.GetPointData().AddArray(to_array((points[:, 0] + 0.5) * 7.0))
        self.add("8 materials on a scale", 2, sphere, mode=measured.vtkMaterialMap.VALUES, materials=8)
        for count in (2, 3, 4):
            sphere, points = make_mapped_sphere()
            sphere.GetPointData().AddArray(to_array(np.ones((len(points), count), np.float32)))
            self.add(f"{count} weights of points", count, sphere, mode=measured.vtkMaterialMap.WEIGHTS, materials=count)
        for count in (2, 4):
            image = make(vtkImageData, Dimensions=(256, 256, 1))
            image.GetPointData().SetScalars(to_array(np.full((256 * 256, count), 100, np.uint8), "weights"))
            self.add(f"{count} weights in an image", count, make_mapped_sphere()[0], mode=measured.vtkMaterialMap.TEXTURES,
                     materials=count, image=image)  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=25, help="frames of each kind in turns")
    parser.add_argument("--name", default="", help="only those of whose name it is a part, and the first")
    parser.add_argument("--pixels", type=int, default=500, help="the window's width and height")
    options = parser.parse_args()
    kinds = Kinds(options.name)
    kinds.add_all()
    picture = Picture(kinds.list[0][2], size=(options.pixels, options.pixels))
    camera = picture.renderer.GetActiveCamera()
    camera.ParallelProjectionOff()
    firsts, least = [], [math.inf] * len(kinds.list)
    for _, _, mapper in kinds.list:
        picture.actor.SetMapper(mapper)
        picture.renderer.ResetCamera()
        camera.Zoom(1.5)
        firsts.append(picture.draw(time.process_time))
        camera.Zoom(1.0 / 1.5)
    camera.Zoom(1.5)
    for _ in range(options.rounds):
        for k, (_, _, mapper) in enumerate(kinds.list):
            picture.actor.SetMapper(mapper)
            picture.draw()  # what the last kind left in caches
            least[k] = min(least[k], picture.draw(time.process_time))
    tell_header("surface", "materials in a pixel", "frame, ms", "times one material", "of that times their number",
                "textures, KB", "first frame, s")  # fmt: skip
    for (name, meeting, mapper), frame, first in zip(kinds.list, least, firsts):
        ratio = frame / least[0]
        tell_row(name, meeting, f"{frame:.1f}", f"{ratio:.2f}", f"{ratio / meeting:.2f}",
                 f"{mapper.GetTextureBytes() / 1024.0:.0f}", f"{1e-3 * first:.1f}")  # fmt: skip


if __name__ == "__main__":
    main()
