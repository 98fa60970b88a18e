# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of composite data: block attributes, nesting, empty and null blocks, selection, a material per block."""

import vtkmeasuredbrdf as measured
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import (
    vtkMultiBlockDataSet,
    vtkPartitionedDataSet,
    vtkPartitionedDataSetCollection,
    vtkPlane,
    vtkPolyData,
)
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes, vtkProperty

from .passes import CELLS, light, select
from .scene import BACKGROUND, FURNACE, MAGENTA, SMOOTH, add_scene, encode, made, mix, scene, sphere
from .surfaces import BOTH, COLORS, add_colors, data_of, elevated, modulated, plane, stripes


def block(x, y=0.0, source=None):
    data = data_of(source or plane(2, 0.5))
    points = data.GetPoints()
    moved = vtkPolyData()
    moved.DeepCopy(data)
    for k in range(points.GetNumberOfPoints()):
        p = points.GetPoint(k)
        moved.GetPoints().SetPoint(k, p[0] + x, p[1] + y, p[2])
    return moved


def blocks(*data):
    whole = vtkMultiBlockDataSet()
    for k, part in enumerate(data):
        whole.SetBlock(k, part)
    return whole


def three():
    """Flat indices 1, 2, 3."""
    return blocks(block(-0.6), block(0.0), block(0.6))


def composite(view, data, attributes=True, **properties):
    mapper = view.factory.composite()
    mapper.SetInputDataObject(data)
    if attributes:
        mapper.SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes())
    view.add(mapper=mapper, **properties)
    return view


OWN = (0.2, 0.6, 0.9)


def own_material():
    brdf = measured.vtkLambertBRDF()
    brdf.SetAlbedo(*OWN)
    return brdf


def own_material_of(view, block):
    view.expect = (FURNACE, encode(OWN))
    if view.factory.has_material:
        view.mappers[0].SetBlockBRDF(block, own_material())


def of_two_materials(view):
    composite(view, three())
    own_material_of(view, 2)


add_scene("composite_plain", lambda view: composite(view, three(), attributes=False))


@scene
def composite_partitions(view):
    whole = vtkPartitionedDataSetCollection()
    for k in range(3):
        part = vtkPartitionedDataSet()
        part.SetPartition(0, block(0.6 * k - 0.6, -0.3))
        part.SetPartition(1, block(0.6 * k - 0.6, 0.3))
        whole.SetPartitionedDataSet(k, part)
    composite(view, whole)


add_scene("composite_nested", lambda view: composite(view, blocks(blocks(block(-0.6), block(0.0)), blocks(blocks(block(0.6))))))
add_scene(
    "composite_empty_and_null",
    lambda view: composite(view, blocks(None, vtkPolyData(), block(0.0), None, vtkMultiBlockDataSet())),
)
add_scene("composite_all_empty", lambda view: composite(view, blocks(None, vtkPolyData())), expect=())


@scene
def composite_block_visibility(view):
    composite(view, three())
    view.mappers[0].SetBlockVisibility(2, False)


@scene(expect=BOTH + (FURNACE,))
def composite_block_colors(view):
    composite(view, three())
    for k, color in enumerate(COLORS):
        view.mappers[0].SetBlockColor(k + 1, *color)


@scene(expect=(FURNACE, mix(BACKGROUND, FURNACE, 0.5)))
def composite_block_opacity(view):
    composite(view, three())
    view.mappers[0].SetBlockOpacity(1, 0.5)


@scene(expect=(modulated(COLORS[0]), FURNACE))
def composite_attributes_of_a_branch(view):
    composite(view, blocks(blocks(block(-0.6), block(0.0)), block(0.6)))
    view.mappers[0].SetBlockColor(1, *COLORS[0])  # both blocks below


@scene(expect=(FURNACE,))
def composite_attributes_change(view):
    composite_block_colors(view)
    view.window.Render()
    view.mappers[0].RemoveBlockColors()
    view.mappers[0].SetBlockVisibility(1, False)
    view.window.Render()
    view.mappers[0].RemoveBlockVisibilities()


add_scene("composite_scalars_of_points", lambda view: composite(view, blocks(data_of(elevated()), block(0.9))), **SMOOTH)


@scene(expect=BOTH)
def composite_scalars_of_cells(view):
    data = three()
    for k in range(3):
        part = data.GetBlock(k)
        part.GetCellData().SetScalars(add_colors(part.GetCellData(), part.GetNumberOfCells()))
    composite(view, data)


@scene(**SMOOTH)
def composite_scalars_of_some_blocks(view):
    data = three()
    part = data.GetBlock(1)
    array = made(vtkFloatArray, Name="some")
    for k in range(part.GetNumberOfPoints()):
        array.InsertNextValue(k / 8.0)
    part.GetPointData().AddArray(array)
    composite(view, data)
    mapper = view.mappers[0]
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("some")
    mapper.SetScalarRange(0.0, 1.0)
    mapper.SetColorMissingArraysWithNanColor(True)


add_scene(
    "composite_edges",
    lambda view: composite(view, three(), EdgeVisibility=True, EdgeColor=MAGENTA, LineWidth=3.0),
    expect=(FURNACE, MAGENTA),
    others=0.2,
)
add_scene(
    "composite_vertices",
    lambda view: composite(view, three(), EdgeVisibility=True, VertexVisibility=True, VertexColor=(0.0, 1.0, 0.0)),
    others=0.3,
    dark=True,
)


@scene
def composite_without_normals(view):
    """Some blocks have normals, others none: they cannot share buffers."""
    data = blocks(block(-0.6, source=sphere(8, 0.3)), block(0.6))
    data.GetBlock(1).GetPointData().SetNormals(None)
    composite(view, data)


add_scene("composite_translucent", lambda view: composite(view, three(), Opacity=0.5), expect=(mix(BACKGROUND, FURNACE, 0.5),))


@scene
def composite_data_change(view):
    """Blocks come and go between frames."""
    composite(view, three())
    view.window.Render()
    view.mappers[0].SetInputDataObject(blocks(block(-0.6)))
    view.window.Render()
    view.mappers[0].SetInputDataObject(blocks(block(-0.6), None, block(0.6)))


@scene
def composite_selection_of_cells(view):
    composite(view, three())
    view.extra = select(CELLS)


@scene
def composite_pickability(view):
    composite_selection_of_cells(view)
    view.mappers[0].GetCompositeDataDisplayAttributes().SetBlockPickability(
        view.mappers[0].GetInputDataObject(0, 0).GetBlock(1), False
    )
    own_material_of(view, 3)


@scene(expect=(tuple(0.5 * c for c in FURNACE),))
def composite_replaced_light(view):
    composite(view, three())
    view.actors[0].GetShaderProperty().AddFragmentShaderReplacement(
        "//VTK::Light::Impl", True, "//VTK::Light::Impl\n  gl_FragData[0].rgb *= 0.5;\n", False
    )


@scene(expect=(FURNACE, modulated(COLORS[0])), others=0.02)
def composite_many(view):
    data = [block(0.12 * (k % 12) - 0.66, 0.12 * (k // 12) - 0.5, plane(1, 0.1)) for k in range(100)]
    composite(view, blocks(*data))
    for k in range(0, 100, 2):
        view.mappers[0].SetBlockColor(k + 1, *COLORS[0])


@scene(expect=BOTH + tuple(encode(a * c**2.2 for a, c in zip(OWN, color)) for color in COLORS), others=0.02, least=0.015)
def composite_material_of_a_block(view):
    """All blocks are clipped and textured."""
    of_two_materials(view)
    view.mappers[0].AddClippingPlane(made(vtkPlane, Normal=(0.0, 1.0, 0.0)))
    view.actors[0].SetTexture(stripes())


@scene(expect=(FURNACE, encode(OWN)))
def composite_material_by_name(view):
    data = three()
    for k, name in enumerate(("left", "middle", "right")):
        data.GetMetaData(k).Set(data.NAME(), name)
    composite(view, data)
    if view.factory.has_material:
        view.mappers[0].SetBlockBRDFByName("right", own_material())


@scene(
    expect=(
        FURNACE,
        encode(a * c**2.2 for a, c in zip(OWN, COLORS[0])),
        mix(BACKGROUND, FURNACE, 0.5),
    )
)
def composite_material_and_color(view):
    of_two_materials(view)
    view.mappers[0].SetBlockColor(2, *COLORS[0])
    view.mappers[0].SetBlockOpacity(3, 0.5)


@scene
def composite_in_two_viewports(view):
    of_two_materials(view)
    view.renderer.SetViewport(0.0, 0.0, 0.5, 1.0)
    right = view.add_renderer((0.5, 0.0, 1.0, 1.0))
    right.AddActor(view.actors[0])


@scene
def composite_lights(view):
    """Blocks under a spot: the same light reaches all."""
    composite(view, three())
    light(
        view, "SceneLight", Position=(0.0, 0.0, 2.0), FocalPoint=(0.1, 0.0, 0.0), Positional=True, ConeAngle=40.0, Exponent=1.0
    )


@scene
def composite_scaled_and_mirrored(view):
    composite(view, blocks(block(-0.5, source=sphere(8, 0.3)), block(0.5, source=sphere(8, 0.3))))
    view.actors[0].SetScale(-1.2, 0.7, 1.0)


@scene
def composite_backface_property(view):

    composite(view, three())
    back = made(vtkProperty, Color=(0.2, 0.9, 0.3))
    view.actors[0].SetBackfaceProperty(back)
    view.actors[0].RotateY(180.0)
