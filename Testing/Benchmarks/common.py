# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the benchmarks have in common: materials, light, pairs, surfaces and windows. Times are of worth on an idle machine.

Run a benchmark with the build's Python package, and on a display or a virtual one where it draws:

    PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a /usr/bin/python3 Testing/Benchmarks/frames.py

Measured materials and environments are looked up in ../shared/data beside the checkout; what is not there is left out.
"""

import itertools
import math
import os
import statistics
import time
import warnings

import numpy as np
import vtkmeasuredbrdf as measured
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmeasuredbrdf.environments import Environment
from vtkmeasuredbrdf.materials import Material, integrate
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow, vtkTexture

warnings.simplefilter("ignore")  # of negative radiance in known maps
DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../shared/data")


def make(cls, **properties):
    """An object of VTK with properties: make(vtkTexture, Interpolate=True)."""
    made = cls()
    for name, value in properties.items():
        setter = getattr(made, "Set" + name)
        setter(*value) if isinstance(value, tuple) else setter(value)
    return made


# ---- materials and light


def find(cls, folder, name):
    """A material or an environment of a name, of a file, or of a file in the data folder; None where there is none."""
    inside = os.path.join(DATA, folder, name)
    try:
        return cls(inside if os.path.exists(inside) else name)
    except (FileNotFoundError, ValueError):
        return None


def find_material(name):
    return find(Material, "materials", name)


def find_environment(name):
    return find(Environment, "environments", name)


def get_stem(path):
    return os.path.basename(path).partition(".")[0]


def make_brushed(along, across, samples=128):
    """Brushed metal: the distribution of Trowbridge and Reitz 1975 (GGX) of widths along the tangent and across it."""
    part = (np.arange(samples) + 0.5) / samples
    theta, phi = 0.5 * math.pi * part**2, 2.0 * math.pi * part[:, None]
    d = (np.sin(theta) * np.cos(phi) / along) ** 2 + (np.sin(theta) * np.sin(phi) / across) ** 2 + np.cos(theta) ** 2
    brdf = measured.vtkDistributionBRDF()
    values = np.repeat((1.0 / (math.pi * along * across * d * d)).ravel(), 3)
    assert brdf.SetDistribution(samples, samples, values.tolist())
    brdf.SetSchlickFresnel((0.95, 0.7, 0.4))
    return brdf


def make_sums(count, exponent):
    """Materials that differ: a matte base and gloss of exponent(k)."""
    sums = []
    for k in range(count):
        material = measured.vtkSumBRDF()
        material.AddTerm(make(measured.vtkLambertBRDF, Albedo=(0.1 + 0.8 * k / count, 0.3, 0.2)))
        material.AddTerm(make(measured.vtkBlinnPhongBRDF, Specular=(0.1, 0.1, 0.1), Exponent=exponent(k)))
        sums.append(material)
    return sums


# ---- pairs of normals and views, and errors


def make_everywhere_pairs(count):
    """Views over all directions, and for each a point of the disc that a sphere shows: normals and views.

    In four dimensions evenly: the generalized golden ratio's sequence (Roberts 2018), the root of x^5 = x + 1.
    """
    ratio = 1.1673039782614187
    x = (0.5 + np.arange(1, count + 1)[:, None] / ratio ** np.arange(1, 5)) % 1.0
    y = 1.0 - 2.0 * x[:, 0]
    s, around = np.sqrt(1.0 - y * y), 2.0 * math.pi * x[:, 1]
    views = np.stack([s * np.cos(around), y, s * np.sin(around)], axis=1)
    u = np.stack([-np.sin(around), np.zeros(count), np.cos(around)], axis=1)
    radius, phi = np.sqrt(x[:, 2:3]), 2.0 * math.pi * x[:, 3:4]
    normals = radius * (np.cos(phi) * u + np.sin(phi) * np.cross(views, u)) + np.sqrt(1.0 - radius**2) * views
    return normals, views


def get_error(radiance, reference):
    """Relative L1, and its standard error: a few pixels can decide."""
    differences = np.abs(radiance - reference).sum(axis=-1)
    references = reference.sum(axis=-1)
    total = max(references.sum(), 1e-30)
    error = differences.sum() / total
    return error, math.sqrt(((differences - error * references) ** 2).sum()) / total


def tell_prepare(title, material, environment, integrator, sizes, pairs):
    """A row: the time to prepare an integrator, its error over pairs (normals, views, reference), its textures."""
    assert integrator.SetSizes(list(sizes)), sizes
    integrator.SetBRDF(material)
    integrator.SetEnvironment(environment)
    begin = time.perf_counter()
    integrator.Prepare()
    seconds = time.perf_counter() - begin
    normals, views, reference = pairs
    error, _ = get_error(integrate(material, environment, normals, views, method=integrator, sizes=sizes), reference)
    tell_row(title, " x ".join(map(str, sizes)), f"{1e3 * seconds:.0f}", f"{100 * error:.2f}",
             f"{1e-6 * integrator.EstimateTextureBytes():.2f}")  # fmt: skip


def tell_row(*cells):
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def tell_header(*names):
    tell_row(*names)
    print("|" + "---|" * len(names))


# ---- surfaces


def with_normals(source, **properties):
    """The output of a source or data with point normals."""
    normals = make(vtkPolyDataNormals, **properties)
    normals.SetInputData(source) if isinstance(source, vtkPolyData) else normals.SetInputConnection(source.GetOutputPort())
    normals.Update()
    return normals.GetOutput()


def make_sphere(radius=0.5, resolution=180, center=(0.0, 0.0, 0.0)):
    """By default of 64,000 triangles."""
    sphere = make(vtkSphereSource, Radius=radius, ThetaResolution=resolution, PhiResolution=resolution, Center=center)
    sphere.Update()
    return sphere.GetOutput()


def make_bumps(depth, across, along, radius=0.5):
    """A sphere of half a million triangles with bumps: their depth, and turns (radians per length) across and along z."""
    sphere = make(vtkSphereSource, Radius=radius, ThetaResolution=500, PhiResolution=502)
    sphere.Update()
    points = vtk_to_numpy(sphere.GetOutput().GetPoints().GetData())
    bump = np.sin(across * points[:, 0]) * np.sin(across * points[:, 1]) + np.sin(along * points[:, 2])
    points *= (1.0 - depth * bump)[:, None]
    return with_normals(sphere.GetOutput(), Splitting=False)


def make_layers(count, width=2.0):
    """Rectangles 2 high and 2 width wide, each nearer than the one before, so that all are shaded.

    They have the normals of a sphere's front, so that neighbors fetch what neighbors do. A pixel's cost comes from many layers
    less one, since a frame on a graphics card takes most of its time on the processor.
    """
    source = make(vtkPlaneSource, Resolution=(16, 16), Origin=(-width, -1.0, 0.0), Point1=(width, -1.0, 0.0),
                  Point2=(-width, 1.0, 0.0))  # fmt: skip
    source.Update()
    layer = source.GetOutput()
    points = vtk_to_numpy(layer.GetPoints().GetData())
    quads = vtk_to_numpy(layer.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    x, y = points[:, 0] / width, points[:, 1]
    normals = np.stack([0.7 * x, 0.7 * y, np.sqrt(1.0 - 0.49 * (x * x + y * y))], axis=1)
    return make_polydata(
        np.concatenate([points + (0.0, 0.0, k / count) for k in range(count)]),
        np.concatenate([quads + k * len(points) for k in range(count)]),
        np.tile(normals, (count, 1)),
    )


def make_polydata(points, polygons, normals=None):
    """Polygons of as many corners as the array has columns."""
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray

    surface, places, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, np.float32), deep=True))
    corners = polygons.shape[1]
    cells.SetData(corners, numpy_to_vtk(np.ascontiguousarray(polygons, np.int64).ravel(), deep=True))
    surface.SetPoints(places)
    surface.SetPolys(cells)
    if normals is not None:
        surface.GetPointData().SetNormals(numpy_to_vtk(np.ascontiguousarray(normals, np.float32), deep=True))
    return surface


def to_array(values, name="data"):
    """A copy in VTK."""
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array


# ---- windows


class Picture:
    """A window of its own for each picture, so that no state of one slows another; it shows `radius` up and down."""

    def __init__(self, mapper, surface=None, size=(500, 500), radius=0.5, pbr=None):
        self.mapper, self.actor, self.renderer = mapper, vtkActor(), vtkRenderer()
        if surface is not None:
            mapper.SetInputData(surface)
        self.actor.SetMapper(mapper)
        self.renderer.AddActor(self.actor)
        self.renderer.SetAutomaticLightCreation(False)
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(radius)
        camera.SetPosition(0.0, 0.0, 4.0 * radius + 1.0)
        self.window = make(vtkRenderWindow, OffScreenRendering=1, MultiSamples=0, Size=size)
        self.window.AddRenderer(self.renderer)
        if pbr:
            self.shade_by_pbr(pbr)
        self.renderer.ResetCameraClippingRange()

    def shade_by_pbr(self, environment, metallic=0.7, roughness=0.3):
        """VTK's PBR and image-based light."""
        surface = self.actor.GetProperty()
        surface.SetInterpolationToPBR()
        surface.SetMetallic(metallic)
        surface.SetRoughness(roughness)
        texture = make(vtkTexture, InputData=environment.NewImageData(), Mipmap=True, Interpolate=True)
        texture.SetColorModeToDirectScalars()
        self.renderer.UseImageBasedLightingOn()
        self.renderer.SetEnvironmentTexture(texture)

    def draw(self, now=time.perf_counter):
        """Milliseconds until the frame is drawn, by the clock or by another one, e.g. time.process_time."""
        begin = now()
        self.window.Render()
        self.window.WaitForCompletion()
        return 1e3 * (now() - begin)


def time_in_turns(pictures, rounds, now=time.perf_counter, slowest=math.inf):
    """Each picture's median frame, of frames that are drawn in turns; NaN where one takes longer than `slowest` ms."""
    times = [[] for _ in pictures]
    for turn, (picture, found) in itertools.product(range(-2, rounds), list(zip(pictures, times))):
        if math.nan in found:
            continue
        picture.draw()  # another window came before: this one does not count
        frame = picture.draw(now)
        if turn > -2 and frame > slowest:  # after the shaders are made
            found[:] = [math.nan]
        elif turn >= 0:
            found.append(frame)
    return [statistics.median(found) for found in times]


def make_mapper(material, environment=None, integrator=None, **properties):
    """A measured mapper; without an environment that of the default."""
    mapper = make(measured.vtkMeasuredBRDFMapper, BRDF=material, **properties)
    if environment is not None:
        mapper.SetEnvironment(environment)
    if integrator is not None:
        mapper.SetIntegrator(integrator)
    return mapper
