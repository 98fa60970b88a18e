# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes with point normals, for pictures and for what surfaces hide from themselves."""

import math

import numpy as np
from common import make, make_polydata, with_normals
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricSuperEllipsoid, vtkParametricTorus
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkContourFilter, vtkTriangleFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersModeling import vtkAdaptiveSubdivisionFilter, vtkLinearExtrusionFilter
from vtkmodules.vtkFiltersSources import (
    vtkCubeSource,
    vtkCylinderSource,
    vtkParametricFunctionSource,
    vtkPlaneSource,
    vtkSphereSource,
)
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def get_output(source):
    source.Update()
    return source.GetOutput()


def make_ball(center, radius, around, down):
    return make(vtkSphereSource, Center=tuple(center), Radius=radius, ThetaResolution=around, PhiResolution=down)


def make_parametric(function, u, v):
    return make(vtkParametricFunctionSource, ParametricFunction=function, UResolution=u, VResolution=v)


def make_ring(ring, section, height):
    """A torus about y."""
    source = make_parametric(make(vtkParametricTorus, RingRadius=ring, CrossSectionRadius=section), 120, 40)
    turn = vtkTransform()
    turn.Translate(0.0, height, 0.0)
    turn.RotateX(-90.0)
    moved = make(vtkTransformPolyDataFilter, Transform=turn)
    moved.SetInputConnection(source.GetOutputPort())
    return moved


def make_isosurface(value, extent=None):
    source = vtkRTAnalyticSource()
    if extent:
        source = make(vtkRTAnalyticSource, WholeExtent=(-extent, extent) * 3, XFreq=40.0, YFreq=20.0, ZFreq=30.0)
    contour = make(vtkContourFilter, ComputeNormals=extent is None, ComputeScalars=extent is None)
    contour.SetValue(0, value)
    contour.SetInputConnection(source.GetOutputPort())
    return contour


def make_knob():
    """A sphere in a ring on a plate."""
    plate = make(vtkPlaneSource, Origin=(-2.2, -1.0, 2.2), Point1=(2.2, -1.0, 2.2), Point2=(-2.2, -1.0, -2.2),
                 Resolution=(60, 60))  # fmt: skip
    return [make_ball((0.0, 0.0, 0.0), 1.0, 96, 64), make_ring(1.25, 0.3, -0.7), plate]


def make_molecule():
    """Forty spheres that touch and cut one another."""
    random = np.random.MT19937()
    random._legacy_seeding(3)  # as std::mt19937

    def draw():
        return 2.0 * ((int(random.random_raw()) + int(random.random_raw()) * 2**32) / 2**64) - 1.0

    centers = [np.zeros(3)]
    while len(centers) < 40:
        start = centers[int(random.random_raw()) % len(centers)]
        d = np.array([draw(), draw(), draw()])
        length = np.linalg.norm(d)
        center = start + 1.3 * d / length
        if length > 0.1 and all(np.linalg.norm(other - center) > 1.1 for other in centers):
            centers.append(center)
    return [make_ball(center, 0.85 + 0.15 * draw(), 36, 24) for center in centers]


def make_dents(steps):
    """A sphere with dents, of 1.5 steps^2 points."""
    surface = get_output(make_ball((0.0, 0.0, 0.0), 1.0, 3 * steps // 2, steps))
    points = vtk_to_numpy(surface.GetPoints().GetData())
    x, y, z = points.T.astype(float)
    points *= (1.0 + 0.12 * np.sin(9.0 * x) * np.sin(8.0 * y + 1.0) * np.sin(7.0 * z + 2.0)
               + 0.08 * np.cos(17.0 * x + 3.0 * y) * np.cos(15.0 * z))[:, None]  # fmt: skip
    surface.GetPointData().SetNormals(None)
    return [surface]


def make_gear():
    """A toothed wheel with a hub: a machine part of large flat faces, refined."""
    steps = ((0.0, 0.8), (0.12, 0.8), (0.17, 1.05), (0.3, 1.05))
    rim = [(2.0 * math.pi * tooth / 16.0 + turn, radius, 0.0) for tooth in range(16) for turn, radius in steps]
    hub = [(2.0 * math.pi * k / 60.0, 0.35, 0.35) for k in range(60)]
    parts = vtkAppendPolyData()
    for outline in (rim, hub):
        points = [(radius * math.cos(turn), radius * math.sin(turn), z) for turn, radius, z in outline]
        parts.AddInputData(make_polydata(np.array(points), np.arange(len(points))[None]))
    solid = make(vtkLinearExtrusionFilter, Vector=(0.0, 0.0, 0.4))
    solid.SetExtrusionTypeToVectorExtrusion()
    solid.SetInputConnection(parts.GetOutputPort())
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(solid.GetOutputPort())
    fine = make(vtkAdaptiveSubdivisionFilter, MaximumEdgeLength=0.05)
    fine.SetInputConnection(triangles.GetOutputPort())
    return [fine]


def make_helix():
    """Sixty balls that touch and overlap."""
    return [make_ball((math.cos(0.7 * k), 0.07 * k, math.sin(0.7 * k)), 0.3 if k % 3 else 0.45, 24, 16) for k in range(60)]


def make_machine_part():
    """A base plate with ribs, bolts and a hub."""
    parts = [make(vtkCubeSource, Bounds=(-2.0, 2.0, -0.2, 0.0, -1.5, 1.5))]
    for k in range(7):
        x = 0.55 * k
        parts.append(make(vtkCubeSource, Bounds=(x - 1.8, x - 1.65, 0.0, 0.9, -1.3, 0.2)))
        parts.append(make(vtkCylinderSource, Resolution=24, Center=(x - 1.7, 0.15, 1.1), Height=0.4, Radius=0.15))
    return [*parts, make(vtkCylinderSource, Resolution=64, Center=(0.0, 0.5, 0.65), Height=1.2, Radius=0.3)]


def read(name):
    reader = vtkPLYReader() if name.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(name)
    return reader


def join(parts, **properties):
    """The parts as triangles with normals, of which edges above the feature angle are sharp."""
    together = vtkAppendPolyData()
    for part in parts:
        together.AddInputData(part if isinstance(part, vtkPolyData) else get_output(part))
    triangles = make(vtkTriangleFilter, PassLines=False, PassVerts=False)
    triangles.SetInputConnection(together.GetOutputPort())
    return with_normals(triangles, FeatureAngle=40.0, **properties)


# Of benchmarks of occlusion, by their names.
HIDING = {
    "bumps": lambda: join(make_dents(160)),
    "fine-bumps": lambda: join(make_dents(378)),
    "gear": lambda: join(make_gear(), AutoOrientNormals=True),  # which is closed
    "isosurface": lambda: join([make_isosurface(160.0, 20)]),
    "knob": lambda: join(make_knob()),
    "molecule": lambda: join(make_molecule()),
    "torus": lambda: join([make_ring(0.7, 0.35, 0.0)]),
}
TORUS = {"RingRadius": 0.7, "CrossSectionRadius": 0.35}
# Of pictures that plans are for.
SHAPES = {
    "sphere": lambda: make_ball((0.0, 0.0, 0.0), 0.5, 256, 128),
    "torus": lambda: make_parametric(make(vtkParametricTorus, **TORUS), 256, 128),
    "box": lambda: make_parametric(make(vtkParametricSuperEllipsoid, N1=0.3, N2=0.3), 256, 128),  # rounded
    "plate": vtkPlaneSource,
    "isosurface": lambda: make_isosurface(157.0),
}


def make_hiding(name):
    """A mesh of HIDING, or a .vtp file that has normals."""
    return HIDING[name]() if name in HIDING else get_output(read(name))


def make_shape(name):
    """A mesh of SHAPES, the knob, the bumps, or a .vtp file."""
    if name in ("knob", "bumps"):
        return HIDING[name]()
    return with_normals(SHAPES[name]() if name in SHAPES else read(name), Splitting=False)
