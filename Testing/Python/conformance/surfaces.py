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
    vtkPolyDataNormals,
    vtkPolyDataTangents,
    vtkStripper,
)
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPlaneSource
from vtkmodules.vtkFiltersTexture import vtkTextureMapToSphere
from vtkmodules.vtkRenderingCore import (
    vtkAssembly,
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
    MAGENTA,
    SMOOTH,
    Unavailable,
    add_scene,
    connect,
    encode,
    made,
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
    half = 0.5 * size
    corners = {"Origin": (-half, -half, 0.0), "Point1": (half, -half, 0.0), "Point2": (-half, half, 0.0)}
    return made(vtkPlaneSource, Resolution=(resolution, resolution), **corners)


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
    array = made(vtkUnsignedCharArray, Name=name, NumberOfComponents=components)
    for k in range(count):
        for value in ((255, 128, 64), (128, 255, 255))[k % 2]:
            array.InsertNextValue(value)
        if components == 4:
            array.InsertNextValue(alpha)
    attributes.AddArray(array)
    return array


COLORS = ((1.0, 128 / 255, 64 / 255), (128 / 255, 1.0, 1.0))
BOTH = tuple(modulated(c) for c in COLORS)


# ---- representations and primitives


add_scene("surface", lambda view: view.add(Color=(0.3, 0.6, 0.9), Specular=0.5, SpecularPower=20.0))
add_scene("wireframe", lambda view: view.add(Representation=1, LineWidth=2.0), expect=STOCK)
add_scene("points", lambda view: view.add(Representation=0, PointSize=5.0), expect=STOCK)
add_scene(
    "edges",
    lambda view: view.add(sphere(8), EdgeVisibility=True, EdgeColor=MAGENTA, LineWidth=3.0),
    expect=(FURNACE, MAGENTA),
    others=0.3,
)


# tubes are shaded
@scene(expect=(FURNACE,), others=0.5, dark=True, at_most={(255, 0, 255): 0.05})
def edges_as_tubes(view):
    view.add(sphere(8), EdgeVisibility=True, EdgeColor=MAGENTA, LineWidth=6.0, RenderLinesAsTubes=True)


@scene(expect=(FURNACE, mix(FURNACE, MAGENTA, 0.5)), others=0.3)
def edges_half_opaque(view):
    actor = view.add(sphere(8), EdgeVisibility=True, EdgeColor=MAGENTA, LineWidth=4.0)
    if not hasattr(actor.GetProperty(), "SetEdgeOpacity"):
        raise Unavailable("vtkProperty::EdgeOpacity came with VTK 9.3")
    actor.GetProperty().SetEdgeOpacity(0.5)


# Drawn with edges only, by VTK 9.1 to 9.6; they are the superclass's.
add_scene(
    "vertices",
    lambda view: view.add(sphere(8), VertexVisibility=True, VertexColor=(0.0, 1.0, 0.0), PointSize=4.0, EdgeVisibility=True),
    others=0.5,
    dark=True,
)


@scene(expect=STOCK)
def only_vertices(view):
    data = made(vtkPolyData, Points=data_of(sphere()).GetPoints())
    data.AllocateEstimate(60, 1)
    for k in range(60):
        data.InsertNextCell(VTK_VERTEX, 1, [k])
    view.add(data, PointSize=4.0)


@scene(expect=STOCK)
def only_lines(view):
    source = made(vtkLineSource, Point1=(-0.6, -0.5, 0.0), Point2=(0.6, 0.5, 0.0), Resolution=5)
    view.add(source, LineWidth=4.0)


add_scene("strips", lambda view: view.add(chain(vtkStripper(), sphere())))


def every_cell():
    """A vertex, a line, a triangle, a quad and a strip in one polydata, without normals."""
    points = vtkPoints()
    for k in range(6):
        for j in range(3):
            points.InsertNextPoint(-0.75 + 0.3 * k, -0.6 + 0.6 * j, 0.1 * (k % 2))
    data = made(vtkPolyData, Points=points)
    data.AllocateEstimate(10, 6)
    data.InsertNextCell(VTK_VERTEX, 1, [0])
    data.InsertNextCell(VTK_POLY_LINE, 3, [0, 1, 2])
    data.InsertNextCell(VTK_TRIANGLE, 3, [3, 6, 4])
    data.InsertNextCell(VTK_QUAD, 4, [4, 7, 8, 5])
    data.InsertNextCell(VTK_TRIANGLE_STRIP, 6, [9, 12, 10, 13, 11, 14])
    return data


# the lines and the vertex are the superclass's
add_scene("mixed_cells", lambda view: view.add(every_cell(), PointSize=6.0, LineWidth=3.0), others=0.1, dark=True)


@scene(expect=BOTH, others=0.1, dark=True)
def mixed_cells_with_cell_scalars(view):
    data = every_cell()
    data.GetCellData().SetScalars(add_colors(data.GetCellData(), data.GetNumberOfCells()))
    view.add(data, PointSize=6.0, LineWidth=3.0)


add_scene("nothing", lambda view: view.add(vtkPolyData()), expect=())


@scene
def degenerate_triangles(view):
    data = data_of(plane())
    data.GetPointData().SetNormals(None)
    data.InsertNextCell(VTK_TRIANGLE, 3, [0, 0, 1])
    data.InsertNextCell(VTK_TRIANGLE, 3, [2, 2, 2])
    view.add(data)


@scene(others=0.3, dark=True)
def data_of_other_kinds(view):
    """vtkDataSetMapper's own mapper stays stock: it must not mind ours beside it."""
    image = made(vtkImageData, Dimensions=(3, 3, 1), Spacing=(0.2, 0.2, 1.0), Origin=(-0.8, -0.5, 0.8))
    mapper = made(vtkDataSetMapper, InputData=image)
    view.add(mapper=mapper)
    view.add()


# ---- interpolation and normals


def interpolated(mode):
    return lambda view: view.add(sphere(8), Interpolation=mode, Specular=0.6, SpecularPower=30.0, Color=(0.7, 0.4, 0.3))


for mode, name in enumerate(("flat", "gouraud", "phong", "pbr")):
    add_scene("interpolation_" + name, interpolated(mode))


@scene
def interpolation_changes(view):
    actor = view.add(sphere(8))
    for mode in (0, 1, 2, 3, 0):
        actor.GetProperty().SetInterpolation(mode)
        view.window.Render()


@scene
def no_normals(view):
    data = data_of(sphere())
    data.GetPointData().SetNormals(None)
    view.add(data)


@scene
def cell_normals(view):
    normals = chain(vtkPolyDataNormals(), sphere())
    normals.ComputePointNormalsOff()
    normals.ComputeCellNormalsOn()
    data = data_of(normals)
    data.GetPointData().SetNormals(None)
    view.add(data)


@scene
def double_normals(view):
    data = data_of(sphere())
    normals = vtkDoubleArray()
    normals.DeepCopy(data.GetPointData().GetNormals())
    data.GetPointData().SetNormals(normals)
    view.add(data)


def with_tangents():
    texture = chain(vtkTextureMapToSphere(), sphere())
    texture.PreventSeamOff()
    return chain(vtkPolyDataTangents(), texture)


add_scene("tangents", lambda view: view.add(with_tangents()))


@scene
def pbr_anisotropy(view):
    actor = view.add(with_tangents(), Interpolation=3, Metallic=0.8, Roughness=0.4)
    if not hasattr(actor.GetProperty(), "SetAnisotropy"):
        raise Unavailable("vtkProperty::Anisotropy came with VTK 9.1")
    actor.GetProperty().SetAnisotropy(0.7)
    actor.GetProperty().SetAnisotropyRotation(0.1)


add_scene(
    "pbr_clear_coat",
    lambda view: view.add(Interpolation=3, CoatStrength=0.8, CoatRoughness=0.2, CoatColor=(0.9, 0.5, 0.5), BaseIOR=1.6),
)


# ---- scalars


def two_color_plane(attributes="point"):
    data = data_of(plane(2))
    part = data.GetPointData() if attributes == "point" else data.GetCellData()
    count = data.GetNumberOfPoints() if attributes == "point" else data.GetNumberOfCells()
    part.SetScalars(add_colors(part, count))
    return data


add_scene("scalars_of_points", lambda view: view.add(two_color_plane()), **SMOOTH)
add_scene("scalars_of_cells", lambda view: view.add(two_color_plane("cell")), expect=BOTH)


@scene(expect=BOTH, others=0.2)
def scalars_of_cells_and_edges(view):
    view.add(two_color_plane("cell"), EdgeVisibility=True, EdgeColor=MAGENTA, LineWidth=3.0)


add_scene("scalars_off", lambda view: view.add(two_color_plane()).GetMapper().ScalarVisibilityOff())


@scene(**SMOOTH)
def scalars_by_table(view):
    mapper = view.add(elevated()).GetMapper()
    table = made(vtkLookupTable, NumberOfColors=8, HueRange=(0.6, 0.1))
    table.Build()
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(0.1, 0.9)


@scene(**SMOOTH)
def scalars_interpolated_before_mapping(view):
    mapper = view.add(elevated()).GetMapper()
    mapper.InterpolateScalarsBeforeMappingOn()
    mapper.SetScalarRange(0.2, 0.8)


@scene(**SMOOTH)
def scalars_out_of_range(view):
    mapper = view.add(elevated()).GetMapper()
    table = made(
        vtkLookupTable,
        UseBelowRangeColor=True,
        BelowRangeColor=(1.0, 0.2, 0.2, 1.0),
        UseAboveRangeColor=True,
        AboveRangeColor=(0.2, 1.0, 0.2, 1.0),
    )
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(0.4, 0.6)
    mapper.InterpolateScalarsBeforeMappingOn()


@scene(**SMOOTH)
def scalars_with_nan(view):
    data = data_of(elevated())
    array = vtkFloatArray()
    array.DeepCopy(data.GetPointData().GetScalars())
    for k in range(0, array.GetNumberOfTuples(), 3):
        array.SetValue(k, float("nan"))
    array.SetName("with nan")
    data.GetPointData().SetScalars(array)
    mapper = view.add(data).GetMapper()
    table = made(vtkLookupTable, NanColor=(1.0, 1.0, 0.0, 1.0))
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(0.0, 1.0)


@scene
def scalars_with_nan_before_mapping(view):
    scalars_with_nan(view)
    view.mappers[0].InterpolateScalarsBeforeMappingOn()


@scene(expect=BOTH)
def scalars_by_category(view):
    data = data_of(plane(2))
    names = vtkStringArray()
    names.SetName("names")
    for k in range(data.GetNumberOfCells()):
        names.InsertNextValue("ab"[k % 2])
    data.GetCellData().AddArray(names)
    mapper = view.add(data).GetMapper()
    table = made(vtkLookupTable, IndexedLookup=True, NumberOfTableValues=2, Annotation=("a", "first"))
    table.SetAnnotation("b", "second")
    for k, color in enumerate(COLORS):
        table.SetTableValue(k, *color, 1.0)
    mapper.SetLookupTable(table)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("names")


@scene(expect=BOTH)
def scalars_by_name_of_cells(view):
    data = data_of(plane(2))
    add_colors(data.GetCellData(), data.GetNumberOfCells(), "by name")
    mapper = view.add(data).GetMapper()
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("by name")


@scene(expect=(modulated(COLORS[1]),))
def scalars_of_a_field_tuple(view):
    data = data_of(plane(2))
    add_colors(data.GetFieldData(), 3, "field")
    mapper = view.add(data).GetMapper()
    mapper.SetScalarModeToUseFieldData()
    mapper.SelectColorArray("field")
    mapper.SetFieldDataTupleId(1)


@scene
def scalars_of_a_missing_array(view):
    mapper = view.add().GetMapper()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("no such array")


# the seams, drawn once or twice
@scene(expect=tuple(mix(BACKGROUND, modulated(c), 128 / 255) for c in COLORS), others=0.01)
def scalars_translucent(view):
    data = data_of(plane(2))
    data.GetCellData().SetScalars(add_colors(data.GetCellData(), data.GetNumberOfCells(), components=4, alpha=128))
    view.add(data)


@scene(expect=BOTH)
def scalars_change(view):
    """Arrays, modes and visibility from frame to frame."""
    data = two_color_plane("cell")
    mapper = view.add(data).GetMapper()
    view.window.Render()
    mapper.ScalarVisibilityOff()
    view.window.Render()
    data.GetPointData().SetScalars(add_colors(data.GetPointData(), data.GetNumberOfPoints(), "others"))
    mapper.ScalarVisibilityOn()
    view.window.Render()
    mapper.SetScalarModeToUseCellData()


# vtkProperty's Diffuse is no part of a scalar's color.
add_scene("scalars_without_diffuse", lambda view: view.add(two_color_plane("cell"), Diffuse=0.5, Ambient=0.3), expect=BOTH)


# ---- textures


def stripes(alpha=None, colors=COLORS, size=8):
    image = made(vtkImageData, Dimensions=(size, size, 1))
    components = 3 if alpha is None else 4
    image.AllocateScalars(VTK_UNSIGNED_CHAR, components)
    for y in range(size):
        for x in range(size):
            color = colors[(2 * x) // size % 2]
            for c in range(3):
                image.SetScalarComponentFromDouble(x, y, 0, c, round(255 * color[c]))
            if alpha is not None:
                image.SetScalarComponentFromDouble(x, y, 0, 3, alpha)
    texture = made(vtkTexture, InputData=image)
    return texture


def textured(view, texture, source=None, **properties):
    view.add(source or plane(), **properties).SetTexture(texture)
    view.expect, view.others = BOTH, 0.02


add_scene("texture", lambda view: textured(view, stripes()))


@scene(others=0.2)
def texture_interpolated(view):
    image = stripes()
    image.InterpolateOn()
    image.MipmapOn()
    textured(view, image)


@scene
def texture_srgb(view):
    """The texture's colors are sRGB, and the right answer is linear: sRGB's own curve."""
    image = stripes()
    image.UseSRGBColorSpaceOn()
    textured(view, image)

    def srgb(v):
        return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4

    view.expect = tuple(encode(a * srgb(v) for a, v in zip(ALBEDO, c)) for c in COLORS)


add_scene(
    "texture_translucent",
    lambda view: textured(view, stripes(alpha=128)),
    expect=tuple(mix(BACKGROUND, modulated(c), 128 / 255) for c in COLORS),
)


@scene(expect=tuple(modulated(tuple(x * y for x, y in zip(COLORS[0], c))) for c in COLORS))
def texture_with_scalars(view):
    textured(view, stripes(colors=(COLORS[0], COLORS[0])))
    data = two_color_plane("cell")
    view.mappers[0].SetInputDataObject(data)


@scene
def texture_transformed(view):
    image = stripes()
    turn = vtkTransform()
    turn.Translate(0.25, 0.0, 0.0)
    turn.Scale(2.0, 1.0, 1.0)
    image.SetTransform(turn)
    textured(view, image)


@scene(**SMOOTH)
def texture_blended(view):
    """Two textures on two units."""
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


add_scene("texture_missing_coordinates", lambda view: view.add(sphere()).SetTexture(stripes()))


@scene
def texture_comes_and_goes(view):
    textured(view, stripes())
    view.window.Render()
    view.actors[0].SetTexture(None)
    view.window.Render()
    view.actors[0].SetTexture(stripes())


@scene
def normal_map(view):
    """Normals of the middle of the range: nothing is bent."""
    flat = stripes(colors=((128 / 255, 128 / 255, 1.0),) * 2)
    actor = view.add(with_tangents(), Interpolation=3)
    actor.GetProperty().SetNormalTexture(flat)


@scene(**SMOOTH, may_warn=("texture",))
def pbr_textures(view):
    """VTK's own textures of its own material: a measured one has no use for them, and says so."""
    actor = view.add(with_tangents(), Interpolation=3)
    color = stripes()
    color.UseSRGBColorSpaceOn()
    actor.GetProperty().SetBaseColorTexture(color)
    actor.GetProperty().SetORMTexture(stripes(colors=((1.0, 0.5, 0.2), (0.8, 0.3, 0.9))))
    emissive = stripes(colors=((0.2, 0.0, 0.0), (0.0, 0.0, 0.3)))
    emissive.UseSRGBColorSpaceOn()
    actor.GetProperty().SetEmissiveTexture(emissive)


@scene(may_warn=("texture",))
def pbr_coat_normal_texture(view):
    actor = view.add(with_tangents(), Interpolation=3, CoatStrength=0.7)
    actor.GetProperty().SetCoatNormalTexture(stripes(colors=((0.5, 0.5, 1.0),) * 2))


@scene(expect=(modulated(COLORS[0]),))
def seamless_coordinates(view):
    textured(view, stripes())
    view.mappers[0].SetSeamlessU(True)
    view.mappers[0].SetSeamlessV(True)


# ---- clipping, culling, coincident topology


@scene
def clipping_plane(view):
    clip = made(vtkPlane, Normal=(1.0, 0.3, 0.2))
    view.add().GetMapper().AddClippingPlane(clip)


@scene
def clipping_planes(view):
    mapper = view.add().GetMapper()
    for axis in range(3):
        for sign in (-1.0, 1.0):
            clip = vtkPlane()
            normal = [0.0, 0.0, 0.0]
            normal[axis] = sign
            clip.SetNormal(*normal)
            clip.SetOrigin(*(-0.5 * n for n in normal))
            mapper.AddClippingPlane(clip)


@scene
def clipping_of_a_moved_actor(view):
    clipping_plane(view)
    view.actors[0].SetPosition(0.2, -0.1, 0.3)
    view.actors[0].SetScale(1.0, 1.3, 0.8)


@scene
def culling(view):
    view.add(BackfaceCulling=True)
    front = view.add(FrontfaceCulling=True)
    front.SetPosition(0.2, 0.0, 0.0)


def coincident(view, resolve):
    view.add(plane(4))
    lines = view.add(plane(4), Representation=1, Color=MAGENTA, Lighting=False)
    points = view.add(plane(4), Representation=0, Color=(0.0, 1.0, 0.0), PointSize=5.0, Lighting=False)
    view.keep = [lines, points]
    mode = vtkMapper.GetResolveCoincidentTopology()
    resolve(view)
    view.at_end = lambda: vtkMapper.SetResolveCoincidentTopology(mode)
    view.expect, view.others = (FURNACE, MAGENTA, (0.0, 1.0, 0.0)), 0.02


add_scene(
    "coincident_by_polygon_offset",
    lambda view: coincident(view, lambda view: vtkMapper.SetResolveCoincidentTopologyToPolygonOffset()),
)


@scene
def coincident_off_with_own_offsets(view):
    def resolve(view):
        vtkMapper.SetResolveCoincidentTopologyToOff()
        view.mappers[0].SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0)
        view.mappers[1].SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, -2.0)
        view.mappers[2].SetRelativeCoincidentTopologyPointOffsetParameter(-4.0)

    coincident(view, resolve)


# ---- transforms and places


@scene
def scaled_unevenly(view):
    actor = view.add(Specular=0.5)
    actor.SetScale(1.3, 0.6, 0.9)
    actor.RotateZ(30.0)


@scene(others=0.1, dark=True)
def mirrored(view):
    actor = view.add(every_cell())
    actor.SetScale(-1.0, 1.0, 1.0)


@scene
def sheared_by_user_matrix(view):
    matrix = made(vtkMatrix4x4, Element=(0, 1, 0.4))
    matrix.SetElement(2, 2, -1.0)
    view.add().SetUserMatrix(matrix)


@scene
def tangents_scaled_unevenly(view):
    actor = view.add(with_tangents())
    actor.SetScale(1.3, 0.5, 1.0)


@scene
def far_from_the_origin(view):
    """Coordinates of a million: the vertex buffers are shifted."""
    place = (1.0e6, -2.0e6, 3.0e6)
    source = sphere(center=place)
    source.SetOutputPointsPrecision(1)
    view.add(source)
    camera = view.renderer.GetActiveCamera()
    camera.SetFocalPoint(*place)
    camera.SetPosition(place[0] + 0.4, place[1] + 0.3, place[2] + 3.0)
    view.renderer.ResetCameraClippingRange()


@scene
def shift_scale_always(view):
    far_from_the_origin(view)
    view.mappers[0].SetVBOShiftScaleMethod(2)


@scene
def assembly(view):
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


@scene
def follower(view):
    actor = vtkFollower()
    mapper = view.factory.mapper()
    connect(mapper, plane())
    actor.SetMapper(mapper)
    actor.SetCamera(view.renderer.GetActiveCamera())
    view.mappers.append(mapper)
    view.renderer.AddActor(actor)


@scene(may_warn=("levels of detail",))
def lod_actor(view):
    actor = vtkLODActor()
    mapper = view.factory.mapper()
    connect(mapper, sphere())
    actor.SetMapper(mapper)
    view.mappers.append(mapper)
    view.renderer.AddActor(actor)
    view.window.SetDesiredUpdateRate(0.001)


@scene
def lod_actor_with_our_levels(view):
    """A coarser mapper of ours as a level, drawn at once: no time is left for the fine one."""
    actor = vtkLODActor()
    fine, coarse = view.factory.mapper(), view.factory.mapper()
    connect(fine, sphere(40))
    connect(coarse, sphere(6))
    actor.SetMapper(fine)
    actor.AddLODMapper(coarse)
    view.mappers += [fine, coarse]
    view.renderer.AddActor(actor)
    view.window.SetDesiredUpdateRate(0.001)
    view.window.Render()


@scene(others=0.2, dark=True)
def one_mapper_of_two_actors(view):
    first = view.add(sphere(radius=0.4))
    first.SetPosition(-0.5, 0.0, 0.0)
    second = view.add(mapper=first.GetMapper(), Representation=1)
    second.SetPosition(0.5, 0.0, 0.0)


@scene
def backface_property(view):
    """An open half of a sphere from inside: the material on both sides, nothing vanishes."""
    source = sphere()
    source.SetStartTheta(0.0)
    source.SetEndTheta(180.0)
    actor = view.add(source)
    actor.RotateX(-60.0)
    back = made(vtkProperty, Color=(0.2, 0.9, 0.3))
    actor.SetBackfaceProperty(back)


@scene(expect=(mix(BACKGROUND, FURNACE, 0.5),))
def backface_property_translucent(view):
    actor = view.add(plane())
    actor.RotateY(180.0)
    back = made(vtkProperty, Opacity=0.5)
    actor.SetBackfaceProperty(back)
    actor.ForceTranslucentOn()
