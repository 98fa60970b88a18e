# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of data and properties: primitives, normals, scalars, textures, clipping, transforms."""

from vtkmodules.vtkCommonCore import (
    VTK_UNSIGNED_CHAR,
    vtkDoubleArray,
    vtkFloatArray,
    vtkLookupTable,
    vtkPoints,
    vtkStringArray,
    vtkUnsignedCharArray,
)
from vtkmodules.vtkCommonDataModel import (
    VTK_POLY_LINE,
    VTK_QUAD,
    VTK_TRIANGLE,
    VTK_TRIANGLE_STRIP,
    VTK_VERTEX,
    vtkImageData,
    vtkPlane,
    vtkPolyData,
)
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import (
    vtkElevationFilter,
    vtkPointDataToCellData,
    vtkPolyDataNormals,
    vtkPolyDataTangents,
    vtkStripper,
    vtkTriangleFilter,
)
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPlaneSource
from vtkmodules.vtkFiltersTexture import vtkTextureMapToSphere
from vtkmodules.vtkRenderingCore import (
    vtkAssembly,
    vtkColorTransferFunction,
    vtkDataSetMapper,
    vtkFollower,
    vtkMapper,
    vtkProperty,
    vtkTexture,
)
from vtkmodules.vtkRenderingLOD import vtkLODActor

from .scene import (
    ALBEDO,
    BACKGROUND,
    FURNACE,
    Unavailable,
    View,
    connect,
    encode,
    mix,
    scene,
    sphere,
)

def chain(filter, source):
    """filter behind source; one line would let Python delete the source too soon."""
    filter.SetInputConnection(source.GetOutputPort())
    return filter


STOCK = "stock"  # the furnace's picture is the stock mapper's without lights


def modulated(color):
    """The furnace's color under a scalar or texture that multiplies, given as display values."""
    return encode(a * c**2.2 for a, c in zip(ALBEDO, color))


def plane(resolution=1, size=1.2):
    source = vtkPlaneSource()
    source.SetResolution(resolution, resolution)
    source.SetOrigin(-0.5 * size, -0.5 * size, 0.0)
    source.SetPoint1(0.5 * size, -0.5 * size, 0.0)
    source.SetPoint2(-0.5 * size, 0.5 * size, 0.0)
    return source


def elevated(source=None):
    filter = chain(vtkElevationFilter(), source or sphere())
    filter.SetLowPoint(0.0, -0.7, 0.0)
    filter.SetHighPoint(0.0, 0.7, 0.0)
    filter.Update()
    return filter


def data_of(source):
    source.Update()
    data = vtkPolyData()
    data.ShallowCopy(source.GetOutput())
    return data


def add_colors(attributes, count, name="colors", components=3, alpha=255):
    """Two colors in turns, so that the furnace has two answers."""
    array = vtkUnsignedCharArray()
    array.SetName(name)
    array.SetNumberOfComponents(components)
    for k in range(count):
        for value in ((255, 128, 64), (128, 255, 255))[k % 2]:
            array.InsertNextValue(value)
        if components == 4:
            array.InsertNextValue(alpha)
    attributes.AddArray(array)
    return array


COLORS = ((1.0, 128 / 255, 64 / 255), (128 / 255, 1.0, 1.0))


def smooth(view):
    """Colors run across the surface: no palette, but nothing black."""
    view.expect, view.others = (), 1.0
    return view


# ---- representations and primitives


@scene
def surface(factory):
    view = View(factory)
    view.add(Color=(0.3, 0.6, 0.9), Specular=0.5, SpecularPower=20.0)
    return view


@scene
def wireframe(factory):
    view = View(factory)
    view.add(Representation=1, LineWidth=2.0)
    view.expect = STOCK
    return view


@scene
def points(factory):
    view = View(factory)
    view.add(Representation=0, PointSize=5.0)
    view.expect = STOCK
    return view


@scene
def points_as_spheres(factory):
    view = View(factory)
    view.add(Representation=0, PointSize=9.0, RenderPointsAsSpheres=True)
    view.expect = STOCK
    return view


@scene
def lines_as_tubes(factory):
    view = View(factory)
    view.add(Representation=1, LineWidth=5.0, RenderLinesAsTubes=True)
    view.expect = STOCK
    return view


@scene
def edges(factory):
    view = View(factory)
    view.add(sphere(8), EdgeVisibility=True, EdgeColor=(1.0, 0.0, 1.0), LineWidth=3.0)
    view.expect, view.others = (FURNACE, (1.0, 0.0, 1.0)), 0.3
    return view


@scene
def edges_of_quads(factory):
    view = View(factory)
    view.add(plane(3), EdgeVisibility=True, EdgeColor=(1.0, 0.0, 1.0), LineWidth=2.0)
    view.expect, view.others = (FURNACE, (1.0, 0.0, 1.0)), 0.2
    return view


@scene
def edges_as_tubes(factory):
    view = View(factory)
    view.add(sphere(8), EdgeVisibility=True, EdgeColor=(1.0, 0.0, 1.0), LineWidth=6.0, RenderLinesAsTubes=True)
    view.expect, view.others, view.dark = (FURNACE,), 0.5, True
    view.at_most = {(255, 0, 255): 0.05}  # tubes are shaded
    return view


@scene
def edges_half_opaque(factory):
    view = View(factory)
    actor = view.add(sphere(8), EdgeVisibility=True, EdgeColor=(1.0, 0.0, 1.0), LineWidth=4.0)
    if not hasattr(actor.GetProperty(), "SetEdgeOpacity"):
        raise Unavailable("vtkProperty::EdgeOpacity came with VTK 9.3")
    actor.GetProperty().SetEdgeOpacity(0.5)
    view.expect, view.others = (FURNACE, mix(FURNACE, (1.0, 0.0, 1.0), 0.5)), 0.3
    return view


@scene
def edges_translucent(factory):
    view = View(factory)
    view.add(plane(3), EdgeVisibility=True, EdgeColor=(1.0, 0.0, 1.0), LineWidth=3.0, Opacity=0.5)
    view.expect, view.others = (mix(BACKGROUND, FURNACE, 0.5),), 0.4
    return view


@scene
def vertices(factory):
    """Drawn with edges only, by VTK 9.1 to 9.6; they are the superclass's."""
    view = View(factory)
    view.add(sphere(8), VertexVisibility=True, VertexColor=(0.0, 1.0, 0.0), PointSize=4.0, EdgeVisibility=True)
    view.others, view.dark = 0.5, True
    return view


@scene
def vertices_as_spheres(factory):
    view = View(factory)
    view.add(sphere(8), VertexVisibility=True, VertexColor=(0.0, 1.0, 0.0), PointSize=8.0, EdgeVisibility=True,
             RenderPointsAsSpheres=True)  # fmt: skip
    view.others, view.dark = 0.5, True
    return view


@scene
def only_vertices(factory):
    view = View(factory)
    data = vtkPolyData()
    data.SetPoints(data_of(sphere()).GetPoints())
    data.AllocateEstimate(60, 1)
    for k in range(60):
        data.InsertNextCell(VTK_VERTEX, 1, [k])
    view.add(data, PointSize=4.0)
    view.expect = STOCK
    return view


@scene
def only_lines(factory):
    view = View(factory)
    source = vtkLineSource()
    source.SetPoint1(-0.6, -0.5, 0.0)
    source.SetPoint2(0.6, 0.5, 0.0)
    source.SetResolution(5)
    view.add(source, LineWidth=4.0)
    view.expect = STOCK
    return view


@scene
def strips(factory):
    view = View(factory)
    view.add(chain(vtkStripper(), sphere()))
    return view


def every_cell():
    """A vertex, a line, a triangle, a quad and a strip in one polydata, without normals."""
    points = vtkPoints()
    for k in range(6):
        for j in range(3):
            points.InsertNextPoint(-0.75 + 0.3 * k, -0.6 + 0.6 * j, 0.1 * (k % 2))
    data = vtkPolyData()
    data.SetPoints(points)
    data.AllocateEstimate(10, 6)
    data.InsertNextCell(VTK_VERTEX, 1, [0])
    data.InsertNextCell(VTK_POLY_LINE, 3, [0, 1, 2])
    data.InsertNextCell(VTK_TRIANGLE, 3, [3, 6, 4])
    data.InsertNextCell(VTK_QUAD, 4, [4, 7, 8, 5])
    data.InsertNextCell(VTK_TRIANGLE_STRIP, 6, [9, 12, 10, 13, 11, 14])
    return data


@scene
def mixed_cells(factory):
    view = View(factory)
    view.add(every_cell(), PointSize=6.0, LineWidth=3.0)
    view.others = 0.1  # the lines and the vertex are the superclass's
    view.dark = True
    return view


@scene
def mixed_cells_with_cell_scalars(factory):
    view = View(factory)
    data = every_cell()
    data.GetCellData().SetScalars(add_colors(data.GetCellData(), data.GetNumberOfCells()))
    view.add(data, PointSize=6.0, LineWidth=3.0)
    view.expect, view.others = tuple(modulated(c) for c in COLORS), 0.1
    view.dark = True
    return view


@scene
def nothing(factory):
    view = View(factory)
    view.add(vtkPolyData())
    view.expect = ()
    return view


@scene
def points_without_cells(factory):
    view = View(factory)
    data = vtkPolyData()
    data.SetPoints(data_of(sphere()).GetPoints())
    view.add(data)
    view.expect = ()
    return view


@scene
def degenerate_triangles(factory):
    view = View(factory)
    data = data_of(plane())
    data.GetPointData().SetNormals(None)
    data.InsertNextCell(VTK_TRIANGLE, 3, [0, 0, 1])
    data.InsertNextCell(VTK_TRIANGLE, 3, [2, 2, 2])
    view.add(data)
    return view


@scene
def invisible(factory):
    view = View(factory)
    view.add().VisibilityOff()
    view.expect = ()
    return view


@scene
def static_mapper(factory):
    view = View(factory)
    view.add().GetMapper().Update()
    view.mappers[0].StaticOn()
    return view


@scene
def data_of_other_kinds(factory):
    """vtkDataSetMapper's own mapper stays stock: it must not mind ours beside it."""
    view = View(factory)
    image = vtkImageData()
    image.SetDimensions(3, 3, 1)
    image.SetSpacing(0.2, 0.2, 1.0)
    image.SetOrigin(-0.8, -0.5, 0.8)
    mapper = vtkDataSetMapper()
    mapper.SetInputData(image)
    view.add(mapper=mapper)
    view.add()
    view.others, view.dark = 0.3, True
    return view


# ---- interpolation and normals


def interpolated(mode, **properties):
    def make(factory):
        view = View(factory)
        view.add(sphere(8), Interpolation=mode, Specular=0.6, SpecularPower=30.0, Color=(0.7, 0.4, 0.3), **properties)
        return view

    return make


for name, mode in (("flat", 0), ("gouraud", 1), ("phong", 2), ("pbr", 3)):
    make = interpolated(mode)
    make.__name__ = "interpolation_" + name
    scene(make)


@scene
def interpolation_changes(factory):
    view = View(factory)
    actor = view.add(sphere(8))
    for mode in (0, 1, 2, 3, 0):
        actor.GetProperty().SetInterpolation(mode)
        view.window.Render()
    return view


@scene
def no_normals(factory):
    view = View(factory)
    data = data_of(sphere())
    data.GetPointData().SetNormals(None)
    view.add(data)
    return view


@scene
def cell_normals(factory):
    view = View(factory)
    normals = chain(vtkPolyDataNormals(), sphere())
    normals.ComputePointNormalsOff()
    normals.ComputeCellNormalsOn()
    data = data_of(normals)
    data.GetPointData().SetNormals(None)
    view.add(data)
    return view


@scene
def double_normals(factory):
    view = View(factory)
    data = data_of(sphere())
    normals = vtkDoubleArray()
    normals.DeepCopy(data.GetPointData().GetNormals())
    data.GetPointData().SetNormals(normals)
    view.add(data)
    return view


@scene
def double_points(factory):
    view = View(factory)
    source = sphere()
    source.SetOutputPointsPrecision(1)
    view.add(source)
    return view


def with_tangents():
    texture = chain(vtkTextureMapToSphere(), sphere())
    texture.PreventSeamOff()
    return chain(vtkPolyDataTangents(), texture)


@scene
def tangents(factory):
    view = View(factory)
    view.add(with_tangents())
    return view


@scene
def pbr_anisotropy(factory):
    view = View(factory)
    actor = view.add(with_tangents(), Interpolation=3, Metallic=0.8, Roughness=0.4)
    if not hasattr(actor.GetProperty(), "SetAnisotropy"):
        raise Unavailable("vtkProperty::Anisotropy came with VTK 9.1")
    actor.GetProperty().SetAnisotropy(0.7)
    actor.GetProperty().SetAnisotropyRotation(0.1)
    return view


@scene
def pbr_clear_coat(factory):
    view = View(factory)
    view.add(Interpolation=3, CoatStrength=0.8, CoatRoughness=0.2, CoatColor=(0.9, 0.5, 0.5), BaseIOR=1.6)
    return view


@scene
def pbr_edge_tint(factory):
    view = View(factory)
    view.add(Interpolation=3, Metallic=1.0, EdgeTint=(0.2, 0.9, 0.4))
    return view


# ---- scalars


def two_color_plane(attributes="point"):
    data = data_of(plane(2))
    part = data.GetPointData() if attributes == "point" else data.GetCellData()
    count = data.GetNumberOfPoints() if attributes == "point" else data.GetNumberOfCells()
    part.SetScalars(add_colors(part, count))
    return data


@scene
def scalars_of_points(factory):
    view = View(factory)
    view.add(two_color_plane())
    return smooth(view)


@scene
def scalars_of_cells(factory):
    view = View(factory)
    view.add(two_color_plane("cell"))
    view.expect = tuple(modulated(c) for c in COLORS)
    return view


@scene
def scalars_of_cells_and_edges(factory):
    view = View(factory)
    view.add(two_color_plane("cell"), EdgeVisibility=True, EdgeColor=(1.0, 0.0, 1.0), LineWidth=3.0)
    view.expect, view.others = tuple(modulated(c) for c in COLORS), 0.2
    return view


@scene
def scalars_of_cells_wireframe(factory):
    view = View(factory)
    view.add(two_color_plane("cell"), Representation=1)
    view.expect = STOCK
    return view


@scene
def scalars_of_cells_strips(factory):
    view = View(factory)
    triangles = vtkTriangleFilter()
    triangles.SetInputData(two_color_plane("cell"))
    stripper = chain(vtkStripper(), triangles)
    stripper.PassThroughCellIdsOn()
    view.add(stripper)
    return smooth(view)


@scene
def scalars_off(factory):
    view = View(factory)
    view.add(two_color_plane()).GetMapper().ScalarVisibilityOff()
    return view


@scene
def scalars_by_table(factory):
    view = View(factory)
    mapper = view.add(elevated()).GetMapper()
    table = vtkLookupTable()
    table.SetNumberOfColors(8)
    table.SetHueRange(0.6, 0.1)
    table.Build()
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(0.1, 0.9)
    return smooth(view)


@scene
def scalars_interpolated_before_mapping(factory):
    view = View(factory)
    mapper = view.add(elevated()).GetMapper()
    mapper.InterpolateScalarsBeforeMappingOn()
    mapper.SetScalarRange(0.2, 0.8)
    return smooth(view)


@scene
def scalars_out_of_range(factory):
    view = View(factory)
    mapper = view.add(elevated()).GetMapper()
    table = vtkLookupTable()
    table.UseBelowRangeColorOn()
    table.SetBelowRangeColor(1.0, 0.2, 0.2, 1.0)
    table.UseAboveRangeColorOn()
    table.SetAboveRangeColor(0.2, 1.0, 0.2, 1.0)
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(0.4, 0.6)
    mapper.InterpolateScalarsBeforeMappingOn()
    return smooth(view)


@scene
def scalars_by_transfer_function(factory):
    view = View(factory)
    colors = vtkColorTransferFunction()
    colors.AddRGBPoint(0.0, 0.2, 0.3, 0.9)
    colors.AddRGBPoint(1.0, 0.9, 0.3, 0.2)
    view.add(elevated()).GetMapper().SetLookupTable(colors)
    return smooth(view)


@scene
def scalars_log_scale(factory):
    view = View(factory)
    mapper = view.add(elevated()).GetMapper()
    table = vtkLookupTable()
    table.SetScaleToLog10()
    table.SetTableRange(0.05, 1.0)
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    return smooth(view)


@scene
def scalars_with_nan(factory):
    view = View(factory)
    data = data_of(elevated())
    array = vtkFloatArray()
    array.DeepCopy(data.GetPointData().GetScalars())
    for k in range(0, array.GetNumberOfTuples(), 3):
        array.SetValue(k, float("nan"))
    array.SetName("with nan")
    data.GetPointData().SetScalars(array)
    mapper = view.add(data).GetMapper()
    table = vtkLookupTable()
    table.SetNanColor(1.0, 1.0, 0.0, 1.0)
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(0.0, 1.0)
    return smooth(view)


@scene
def scalars_with_nan_before_mapping(factory):
    view = scalars_with_nan(factory)
    view.mappers[0].InterpolateScalarsBeforeMappingOn()
    return view


@scene
def scalars_by_category(factory):
    view = View(factory)
    data = data_of(plane(2))
    names = vtkStringArray()
    names.SetName("names")
    for k in range(data.GetNumberOfCells()):
        names.InsertNextValue("ab"[k % 2])
    data.GetCellData().AddArray(names)
    mapper = view.add(data).GetMapper()
    table = vtkLookupTable()
    table.IndexedLookupOn()
    table.SetNumberOfTableValues(2)
    table.SetAnnotation("a", "first")
    table.SetAnnotation("b", "second")
    for k, color in enumerate(COLORS):
        table.SetTableValue(k, *color, 1.0)
    mapper.SetLookupTable(table)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("names")
    view.expect = tuple(modulated(c) for c in COLORS)
    return view


@scene
def scalars_by_name_of_points(factory):
    view = View(factory)
    data = data_of(elevated())
    mapper = view.add(data).GetMapper()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("Elevation")
    return smooth(view)


@scene
def scalars_by_name_of_cells(factory):
    view = View(factory)
    data = data_of(plane(2))
    add_colors(data.GetCellData(), data.GetNumberOfCells(), "by name")
    mapper = view.add(data).GetMapper()
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("by name")
    view.expect = tuple(modulated(c) for c in COLORS)
    return view


@scene
def scalars_of_fields(factory):
    view = View(factory)
    data = data_of(plane(2))
    field = vtkFloatArray()
    field.SetName("field")
    for k in range(data.GetNumberOfPoints()):
        field.InsertNextValue(k / 8.0)
    data.GetFieldData().AddArray(field)
    mapper = view.add(data).GetMapper()
    mapper.SetScalarModeToUseFieldData()
    mapper.SelectColorArray("field")
    mapper.SetScalarRange(0.0, 1.0)
    return smooth(view)


@scene
def scalars_of_a_field_tuple(factory):
    view = View(factory)
    data = data_of(plane(2))
    add_colors(data.GetFieldData(), 3, "field")
    mapper = view.add(data).GetMapper()
    mapper.SetScalarModeToUseFieldData()
    mapper.SelectColorArray("field")
    mapper.SetFieldDataTupleId(1)
    view.expect = (modulated(COLORS[1]),)
    return view


@scene
def scalars_of_a_missing_array(factory):
    view = View(factory)
    mapper = view.add().GetMapper()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("no such array")
    return view


@scene
def scalars_direct_floats(factory):
    view = View(factory)
    data = data_of(plane(2))
    colors = vtkFloatArray()
    colors.SetName("floats")
    colors.SetNumberOfComponents(3)
    for k in range(data.GetNumberOfCells()):
        colors.InsertNextTuple3(*COLORS[k % 2])
    data.GetCellData().SetScalars(colors)
    view.add(data).GetMapper().SetColorModeToDirectScalars()
    view.expect = tuple(modulated(c) for c in COLORS)
    return view


@scene
def scalars_mapped_bytes(factory):
    """Bytes through the table after all."""
    view = View(factory)
    mapper = view.add(two_color_plane()).GetMapper()
    mapper.SetColorModeToMapScalars()
    mapper.SetScalarRange(0.0, 255.0)
    return smooth(view)


@scene
def scalars_of_a_component(factory):
    view = View(factory)
    data = data_of(sphere())
    data.GetPointData().AddArray(data.GetPoints().GetData())
    data.GetPoints().GetData().SetName("place")
    mapper = view.add(data).GetMapper()
    mapper.SetScalarModeToUsePointFieldData()
    table = vtkLookupTable()
    table.SetVectorModeToComponent()
    table.SetVectorComponent(1)
    table.SetHueRange(0.0, 0.6)
    table.SetTableRange(-0.7, 0.7)
    mapper.SelectColorArray("place")
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    return smooth(view)


@scene
def scalars_translucent(factory):
    view = View(factory)
    data = data_of(plane(2))
    data.GetCellData().SetScalars(add_colors(data.GetCellData(), data.GetNumberOfCells(), components=4, alpha=128))
    view.add(data)
    view.expect = tuple(mix(BACKGROUND, modulated(c), 128 / 255) for c in COLORS)
    view.others = 0.01  # the seams, drawn once or twice
    return view


@scene
def scalars_with_alpha_and_opacity(factory):
    view = View(factory)
    data = data_of(plane(2))
    data.GetCellData().SetScalars(add_colors(data.GetCellData(), data.GetNumberOfCells(), components=4))
    view.add(data, Opacity=0.5)
    view.expect = tuple(mix(BACKGROUND, modulated(c), 0.5) for c in COLORS)
    view.others = 0.01
    return view


@scene
def scalars_change(factory):
    """Arrays, modes and visibility from frame to frame."""
    view = View(factory)
    data = two_color_plane("cell")
    mapper = view.add(data).GetMapper()
    view.window.Render()
    mapper.ScalarVisibilityOff()
    view.window.Render()
    data.GetPointData().SetScalars(add_colors(data.GetPointData(), data.GetNumberOfPoints(), "others"))
    mapper.ScalarVisibilityOn()
    view.window.Render()
    mapper.SetScalarModeToUseCellData()
    view.expect = tuple(modulated(c) for c in COLORS)
    return view


@scene
def scalars_without_diffuse(factory):
    """vtkProperty's Diffuse is no part of a scalar's color."""
    view = View(factory)
    view.add(two_color_plane("cell"), Diffuse=0.5, Ambient=0.3)
    view.expect = tuple(modulated(c) for c in COLORS)
    return view


# ---- textures


def stripes(alpha=None, colors=COLORS, size=8):
    image = vtkImageData()
    image.SetDimensions(size, size, 1)
    components = 3 if alpha is None else 4
    image.AllocateScalars(VTK_UNSIGNED_CHAR, components)
    for y in range(size):
        for x in range(size):
            color = colors[(2 * x) // size % 2]
            for c in range(3):
                image.SetScalarComponentFromDouble(x, y, 0, c, round(255 * color[c]))
            if alpha is not None:
                image.SetScalarComponentFromDouble(x, y, 0, 3, alpha)
    texture = vtkTexture()
    texture.SetInputData(image)
    return texture


def textured(factory, texture, source=None, **properties):
    view = View(factory)
    view.add(source or plane(), **properties).SetTexture(texture)
    view.expect = tuple(modulated(c) for c in COLORS)
    view.others = 0.02
    return view


@scene
def texture(factory):
    return textured(factory, stripes())


@scene
def texture_interpolated(factory):
    image = stripes()
    image.InterpolateOn()
    image.MipmapOn()
    view = textured(factory, image)
    view.others = 0.2
    return view


@scene
def texture_srgb(factory):
    """The texture's colors are sRGB, and the right answer is linear: sRGB's own curve."""
    image = stripes()
    image.UseSRGBColorSpaceOn()
    view = textured(factory, image)

    def srgb(v):
        return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4

    view.expect = tuple(encode(a * srgb(v) for a, v in zip(ALBEDO, c)) for c in COLORS)
    return view


@scene
def texture_repeated(factory):
    source = plane()
    data = data_of(source)
    coordinates = vtkFloatArray()
    coordinates.SetNumberOfComponents(2)
    for u, v in ((0.0, 0.0), (2.5, 0.0), (0.0, 2.0), (2.5, 2.0)):
        coordinates.InsertNextTuple2(u, v)
    data.GetPointData().SetTCoords(coordinates)
    return textured(factory, stripes(), data)


@scene
def texture_clamped(factory):
    image = stripes()
    image.RepeatOff()
    image.EdgeClampOn()
    return textured(factory, image)


@scene
def texture_translucent(factory):
    view = textured(factory, stripes(alpha=128))
    view.expect = tuple(mix(BACKGROUND, modulated(c), 128 / 255) for c in COLORS)
    return view


@scene
def texture_with_scalars(factory):
    view = textured(factory, stripes(colors=(COLORS[0], COLORS[0])))
    data = two_color_plane("cell")
    view.mappers[0].SetInputDataObject(data)
    view.expect = tuple(modulated(tuple(x * y for x, y in zip(COLORS[0], c))) for c in COLORS)
    return view


@scene
def texture_transformed(factory):
    image = stripes()
    turn = vtkTransform()
    turn.Translate(0.25, 0.0, 0.0)
    turn.Scale(2.0, 1.0, 1.0)
    image.SetTransform(turn)
    return textured(factory, image)


@scene
def texture_blended(factory):
    """Two textures on two units."""
    view = View(factory)
    data = data_of(plane())
    for k in range(2):
        coordinates = vtkFloatArray()
        coordinates.DeepCopy(data.GetPointData().GetTCoords())
        coordinates.SetName("unit%d" % k)
        data.GetPointData().AddArray(coordinates)
    data.GetPointData().SetTCoords(None)
    actor = view.add(data)
    for k in range(2):
        image = stripes(colors=(COLORS[k], COLORS[0]))
        image.SetBlendingMode((vtkTexture.VTK_TEXTURE_BLENDING_MODE_REPLACE, vtkTexture.VTK_TEXTURE_BLENDING_MODE_ADD)[k])
        actor.GetProperty().SetTexture("image%d" % k, image)
        actor.GetMapper().MapDataArrayToMultiTextureAttribute("image%d" % k, "unit%d" % k, 0)
    return smooth(view)


@scene
def texture_missing_coordinates(factory):
    view = View(factory)
    view.add(sphere()).SetTexture(stripes())
    return view


@scene
def texture_comes_and_goes(factory):
    view = textured(factory, stripes())
    view.window.Render()
    view.actors[0].SetTexture(None)
    view.window.Render()
    view.actors[0].SetTexture(stripes())
    return view


@scene
def normal_map(factory):
    """Normals of the middle of the range: nothing is bent."""
    view = View(factory)
    flat = stripes(colors=((128 / 255, 128 / 255, 1.0),) * 2)
    actor = view.add(with_tangents(), Interpolation=3)
    actor.GetProperty().SetNormalTexture(flat)
    return view


@scene
def pbr_textures(factory):
    """VTK's own textures of its own material: a measured one has no use for them, and says so."""
    view = View(factory)
    actor = view.add(with_tangents(), Interpolation=3)
    color = stripes()
    color.UseSRGBColorSpaceOn()
    actor.GetProperty().SetBaseColorTexture(color)
    actor.GetProperty().SetORMTexture(stripes(colors=((1.0, 0.5, 0.2), (0.8, 0.3, 0.9))))
    emissive = stripes(colors=((0.2, 0.0, 0.0), (0.0, 0.0, 0.3)))
    emissive.UseSRGBColorSpaceOn()
    actor.GetProperty().SetEmissiveTexture(emissive)
    view.may_warn = ("texture",)
    return smooth(view)


@scene
def pbr_coat_normal_texture(factory):
    view = View(factory)
    actor = view.add(with_tangents(), Interpolation=3, CoatStrength=0.7)
    actor.GetProperty().SetCoatNormalTexture(stripes(colors=((0.5, 0.5, 1.0),) * 2))
    view.may_warn = ("texture",)
    return view


@scene
def pbr_anisotropy_texture(factory):
    view = View(factory)
    actor = view.add(with_tangents(), Interpolation=3, Anisotropy=0.5)
    actor.GetProperty().SetAnisotropyTexture(stripes())
    view.may_warn = ("texture",)
    return view


@scene
def seamless_coordinates(factory):
    view = textured(factory, stripes())
    view.mappers[0].SetSeamlessU(True)
    view.mappers[0].SetSeamlessV(True)
    view.expect = (modulated(COLORS[0]),)
    return view


# ---- clipping, culling, coincident topology


@scene
def clipping_plane(factory):
    view = View(factory)
    clip = vtkPlane()
    clip.SetNormal(1.0, 0.3, 0.2)
    view.add().GetMapper().AddClippingPlane(clip)
    return view


@scene
def clipping_planes(factory):
    view = View(factory)
    mapper = view.add().GetMapper()
    for axis in range(3):
        for sign in (-1.0, 1.0):
            clip = vtkPlane()
            normal = [0.0, 0.0, 0.0]
            normal[axis] = sign
            clip.SetNormal(*normal)
            clip.SetOrigin(*(-0.5 * n for n in normal))
            mapper.AddClippingPlane(clip)
    return view


@scene
def clipping_of_a_moved_actor(factory):
    view = clipping_plane(factory)
    view.actors[0].SetPosition(0.2, -0.1, 0.3)
    view.actors[0].SetScale(1.0, 1.3, 0.8)
    return view


@scene
def clipping_wireframe_and_edges(factory):
    view = clipping_plane(factory)
    view.actors[0].GetProperty().EdgeVisibilityOn()
    view.others, view.dark = 0.3, True
    return view


@scene
def culling(factory):
    view = View(factory)
    view.add(BackfaceCulling=True)
    front = view.add(FrontfaceCulling=True)
    front.SetPosition(0.2, 0.0, 0.0)
    return view


def coincident(factory, resolve):
    view = View(factory)
    view.add(plane(4))
    lines = view.add(plane(4), Representation=1, Color=(1.0, 0.0, 1.0), Lighting=False)
    points = view.add(plane(4), Representation=0, Color=(0.0, 1.0, 0.0), PointSize=5.0, Lighting=False)
    view.keep = [lines, points]
    mode = vtkMapper.GetResolveCoincidentTopology()
    resolve(view)
    view.at_end = lambda: vtkMapper.SetResolveCoincidentTopology(mode)
    view.expect = (FURNACE, (1.0, 0.0, 1.0), (0.0, 1.0, 0.0))
    view.others = 0.02
    return view


@scene
def coincident_by_polygon_offset(factory):
    return coincident(factory, lambda view: vtkMapper.SetResolveCoincidentTopologyToPolygonOffset())


@scene
def coincident_by_shifted_depth(factory):
    view = coincident(factory, lambda view: vtkMapper.SetResolveCoincidentTopologyToShiftZBuffer())
    view.others = 1.0
    return view


@scene
def coincident_off_with_own_offsets(factory):
    def resolve(view):
        vtkMapper.SetResolveCoincidentTopologyToOff()
        view.mappers[0].SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0)
        view.mappers[1].SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, -2.0)
        view.mappers[2].SetRelativeCoincidentTopologyPointOffsetParameter(-4.0)

    return coincident(factory, resolve)


# ---- transforms and places


@scene
def scaled_unevenly(factory):
    view = View(factory)
    actor = view.add(Specular=0.5)
    actor.SetScale(1.3, 0.6, 0.9)
    actor.RotateZ(30.0)
    return view


@scene
def mirrored(factory):
    view = View(factory)
    actor = view.add(every_cell())
    actor.SetScale(-1.0, 1.0, 1.0)
    view.others, view.dark = 0.1, True
    return view


@scene
def sheared_by_user_matrix(factory):
    view = View(factory)
    matrix = vtkMatrix4x4()
    matrix.SetElement(0, 1, 0.4)
    matrix.SetElement(2, 2, -1.0)
    view.add().SetUserMatrix(matrix)
    return view


@scene
def tangents_scaled_unevenly(factory):
    view = View(factory)
    actor = view.add(with_tangents())
    actor.SetScale(1.3, 0.5, 1.0)
    return view


@scene
def far_from_the_origin(factory):
    """Coordinates of a million: the vertex buffers are shifted."""
    view = View(factory)
    place = (1.0e6, -2.0e6, 3.0e6)
    source = sphere(center=place)
    source.SetOutputPointsPrecision(1)
    view.add(source)
    camera = view.renderer.GetActiveCamera()
    camera.SetFocalPoint(*place)
    camera.SetPosition(place[0] + 0.4, place[1] + 0.3, place[2] + 3.0)
    view.renderer.ResetCameraClippingRange()
    return view


def shift_scale(method):
    def make(factory):
        view = far_from_the_origin(factory)
        view.mappers[0].SetVBOShiftScaleMethod(method)
        return view

    return make


for name, method in (("always", 2), ("by_hand_off", 0), ("near_focal_plane", 5)):
    make = shift_scale(method)
    make.__name__ = "shift_scale_" + name
    if name != "by_hand_off":
        scene(make)


@scene
def assembly(factory):
    view = View(factory)
    whole = vtkAssembly()
    for k in range(3):
        part = view.add(sphere(radius=0.3))
        view.renderer.RemoveActor(part)
        part.SetPosition(0.5 * k - 0.5, 0.0, 0.0)
        part.SetScale(1.0, 1.0 + 0.3 * k, 1.0)
        whole.AddPart(part)
    whole.RotateZ(25.0)
    whole.SetScale(1.1, 0.9, 1.0)
    view.keep.append(whole)
    view.renderer.AddActor(whole)
    return view


@scene
def follower(factory):
    view = View(factory)
    actor = vtkFollower()
    mapper = factory.mapper()
    connect(mapper, plane())
    actor.SetMapper(mapper)
    actor.SetCamera(view.renderer.GetActiveCamera())
    view.mappers.append(mapper)
    view.renderer.AddActor(actor)
    return view


@scene
def lod_actor(factory):
    view = View(factory)
    actor = vtkLODActor()
    mapper = factory.mapper()
    connect(mapper, sphere())
    actor.SetMapper(mapper)
    view.mappers.append(mapper)
    view.renderer.AddActor(actor)
    view.window.SetDesiredUpdateRate(0.001)
    view.may_warn = ("levels of detail",)
    return view


@scene
def lod_actor_with_our_levels(factory):
    """A coarser mapper of ours as a level, drawn at once: no time is left for the fine one."""
    view = View(factory)
    actor = vtkLODActor()
    fine, coarse = factory.mapper(), factory.mapper()
    connect(fine, sphere(40))
    connect(coarse, sphere(6))
    actor.SetMapper(fine)
    actor.AddLODMapper(coarse)
    view.mappers += [fine, coarse]
    view.renderer.AddActor(actor)
    view.window.SetDesiredUpdateRate(0.001)
    view.window.Render()
    return view


@scene
def one_mapper_of_two_actors(factory):
    view = View(factory)
    first = view.add(sphere(radius=0.4))
    first.SetPosition(-0.5, 0.0, 0.0)
    second = view.add(mapper=first.GetMapper(), Representation=1)
    second.SetPosition(0.5, 0.0, 0.0)
    view.others, view.dark = 0.2, True
    return view


@scene
def backface_property(factory):
    """An open half of a sphere from inside: the material on both sides, nothing vanishes."""
    view = View(factory)
    source = sphere()
    source.SetStartTheta(0.0)
    source.SetEndTheta(180.0)
    actor = view.add(source)
    actor.RotateX(-60.0)
    back = vtkProperty()
    back.SetColor(0.2, 0.9, 0.3)
    actor.SetBackfaceProperty(back)
    return view


@scene
def backface_property_translucent(factory):
    view = View(factory)
    actor = view.add(plane())
    actor.RotateY(180.0)
    back = vtkProperty()
    back.SetOpacity(0.5)
    actor.SetBackfaceProperty(back)
    actor.ForceTranslucentOn()
    view.expect = (mix(BACKGROUND, FURNACE, 0.5),)
    return view


@scene
def copied_mapper(factory):
    """ShallowCopy takes over what both have."""
    view = View(factory)
    mapper = view.add(two_color_plane("cell")).GetMapper()
    copy = factory.mapper()
    copy.ShallowCopy(mapper)
    view.actors[0].SetMapper(copy)
    view.mappers.append(copy)
    view.expect = tuple(modulated(c) for c in COLORS)
    return view
