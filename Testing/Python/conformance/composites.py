# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of composite data: block attributes, nesting, empty and null blocks, selection, a material per block."""

from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject,
    vtkMultiBlockDataSet,
    vtkPartitionedDataSet,
    vtkPartitionedDataSetCollection,
    vtkPlane,
    vtkPolyData,
)
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes

import vtkmeasuredbrdf as measured

from .passes import light, selected
from .scene import ALBEDO, BACKGROUND, FURNACE, Unavailable, View, encode, mix, scene, sphere
from .surfaces import COLORS, add_colors, data_of, elevated, modulated, plane, smooth, stripes


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


def composite(factory, data, attributes=True, **properties):
    view = View(factory)
    mapper = factory.composite()
    mapper.SetInputDataObject(data)
    if attributes:
        mapper.SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes())
    view.add(mapper=mapper, **properties)
    return view


@scene
def composite_plain(factory):
    return composite(factory, three(), attributes=False)


@scene
def composite_of_one_dataset(factory):
    return composite(factory, block(0.0))


@scene
def composite_partitions(factory):
    whole = vtkPartitionedDataSetCollection()
    for k in range(3):
        part = vtkPartitionedDataSet()
        part.SetPartition(0, block(0.6 * k - 0.6, -0.3))
        part.SetPartition(1, block(0.6 * k - 0.6, 0.3))
        whole.SetPartitionedDataSet(k, part)
    return composite(factory, whole)


@scene
def composite_nested(factory):
    return composite(factory, blocks(blocks(block(-0.6), block(0.0)), blocks(blocks(block(0.6)))))


@scene
def composite_empty_and_null(factory):
    return composite(factory, blocks(None, vtkPolyData(), block(0.0), None, vtkMultiBlockDataSet()))


@scene
def composite_all_empty(factory):
    view = composite(factory, blocks(None, vtkPolyData()))
    view.expect = ()
    return view


@scene
def composite_block_visibility(factory):
    view = composite(factory, three())
    view.mappers[0].SetBlockVisibility(2, False)
    return view


@scene
def composite_block_colors(factory):
    view = composite(factory, three())
    for k, color in enumerate(COLORS):
        view.mappers[0].SetBlockColor(k + 1, *color)
    view.expect = tuple(modulated(c) for c in COLORS) + (FURNACE,)
    return view


@scene
def composite_block_opacity(factory):
    view = composite(factory, three())
    view.mappers[0].SetBlockOpacity(1, 0.5)
    view.expect = (FURNACE, mix(BACKGROUND, FURNACE, 0.5))
    return view


@scene
def composite_block_opacity_peeled(factory):
    view = composite_block_opacity(factory)
    view.window.AlphaBitPlanesOn()
    view.renderer.UseDepthPeelingOn()
    return view


@scene
def composite_attributes_of_a_branch(factory):
    view = composite(factory, blocks(blocks(block(-0.6), block(0.0)), block(0.6)))
    view.mappers[0].SetBlockColor(1, *COLORS[0])  # both blocks below
    view.expect = (modulated(COLORS[0]), FURNACE)
    return view


@scene
def composite_attributes_change(factory):
    view = composite_block_colors(factory)
    view.window.Render()
    view.mappers[0].RemoveBlockColors()
    view.mappers[0].SetBlockVisibility(1, False)
    view.window.Render()
    view.mappers[0].RemoveBlockVisibilities()
    view.expect = (FURNACE,)
    return view


@scene
def composite_scalars_of_points(factory):
    return smooth(composite(factory, blocks(data_of(elevated()), block(0.9))))


@scene
def composite_scalars_of_cells(factory):
    data = three()
    for k in range(3):
        part = data.GetBlock(k)
        part.GetCellData().SetScalars(add_colors(part.GetCellData(), part.GetNumberOfCells()))
    view = composite(factory, data)
    view.expect = tuple(modulated(c) for c in COLORS)
    return view


@scene
def composite_scalars_of_some_blocks(factory):
    data = three()
    part = data.GetBlock(1)
    array = vtkFloatArray()
    array.SetName("some")
    for k in range(part.GetNumberOfPoints()):
        array.InsertNextValue(k / 8.0)
    part.GetPointData().AddArray(array)
    view = composite(factory, data)
    mapper = view.mappers[0]
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("some")
    mapper.SetScalarRange(0.0, 1.0)
    mapper.SetColorMissingArraysWithNanColor(True)
    return smooth(view)


@scene
def composite_edges(factory):
    view = composite(factory, three(), EdgeVisibility=True, EdgeColor=(1.0, 0.0, 1.0), LineWidth=3.0)
    view.expect, view.others = (FURNACE, (1.0, 0.0, 1.0)), 0.2
    return view


@scene
def composite_wireframe(factory):
    view = composite(factory, three(), Representation=1)
    view.expect = "stock"
    return view


@scene
def composite_vertices(factory):
    view = composite(factory, three(), EdgeVisibility=True, VertexVisibility=True, VertexColor=(0.0, 1.0, 0.0))
    view.others, view.dark = 0.3, True
    return view


@scene
def composite_without_normals(factory):
    """Some blocks have normals, others none: they cannot share buffers."""
    data = blocks(block(-0.6, source=sphere(8, 0.3)), block(0.6))
    data.GetBlock(1).GetPointData().SetNormals(None)
    return composite(factory, data)


@scene
def composite_translucent(factory):
    view = composite(factory, three(), Opacity=0.5)
    view.expect = (mix(BACKGROUND, FURNACE, 0.5),)
    return view


@scene
def composite_data_change(factory):
    """Blocks come and go between frames."""
    view = composite(factory, three())
    view.window.Render()
    view.mappers[0].SetInputDataObject(blocks(block(-0.6)))
    view.window.Render()
    view.mappers[0].SetInputDataObject(blocks(block(-0.6), None, block(0.6)))
    return view


@scene
def composite_selection_of_cells(factory):
    def make(factory):
        view = composite(factory, three())
        view.extra = selected(vtkDataObject.FIELD_ASSOCIATION_CELLS)(factory).extra
        return view

    return make(factory)


@scene
def composite_pickability(factory):
    view = composite_selection_of_cells(factory)
    view.mappers[0].GetCompositeDataDisplayAttributes().SetBlockPickability(
        view.mappers[0].GetInputDataObject(0, 0).GetBlock(1), False
    )
    return view


@scene
def composite_replaced_light(factory):
    view = composite(factory, three())
    view.actors[0].GetShaderProperty().AddFragmentShaderReplacement(
        "//VTK::Light::Impl", True, "//VTK::Light::Impl\n  gl_FragData[0].rgb *= 0.5;\n", False
    )
    view.expect = (tuple(0.5 * c for c in FURNACE),)
    return view


@scene
def composite_many(factory):
    data = [block(0.12 * (k % 12) - 0.66, 0.12 * (k // 12) - 0.5, plane(1, 0.1)) for k in range(100)]
    view = composite(factory, blocks(*data))
    for k in range(0, 100, 2):
        view.mappers[0].SetBlockColor(k + 1, *COLORS[0])
    view.expect, view.others = (FURNACE, modulated(COLORS[0])), 0.02
    return view


OWN = (0.2, 0.6, 0.9)


def own_material():
    brdf = measured.vtkLambertBRDF()
    brdf.SetAlbedo(*OWN)
    return brdf


@scene
def composite_material_of_a_block(factory):
    view = composite(factory, three())
    if factory.has_material:
        view.mappers[0].SetBlockBRDF(2, own_material())
    view.expect = (FURNACE, encode(OWN))
    return view


@scene
def composite_material_by_name(factory):
    data = three()
    for k, name in enumerate(("left", "middle", "right")):
        data.GetMetaData(k).Set(data.NAME(), name)
    view = composite(factory, data)
    if factory.has_material:
        view.mappers[0].SetBlockBRDFByName("right", own_material())
    view.expect = (FURNACE, encode(OWN))
    return view


@scene
def composite_material_and_color(factory):
    view = composite_material_of_a_block(factory)
    view.mappers[0].SetBlockColor(2, *COLORS[0])
    view.mappers[0].SetBlockOpacity(3, 0.5)
    view.expect = (
        FURNACE,
        encode(a * c**2.2 for a, c in zip(OWN, COLORS[0])),
        mix(BACKGROUND, FURNACE, 0.5),
    )
    return view


@scene
def composite_copied(factory):
    """ShallowCopy takes over the material, those of blocks, and VTK's attributes."""
    view = composite_material_of_a_block(factory)
    copy = factory.composite()
    copy.SetInputDataObject(view.mappers[0].GetInputDataObject(0, 0))
    copy.ShallowCopy(view.mappers[0])
    view.actors[0].SetMapper(copy)
    view.mappers.append(copy)
    return view


@scene
def composite_in_two_viewports(factory):
    view = composite_material_of_a_block(factory)
    view.renderer.SetViewport(0.0, 0.0, 0.5, 1.0)
    right = view.add_renderer((0.5, 0.0, 1.0, 1.0))
    right.AddActor(view.actors[0])
    return view


@scene
def composite_clipped(factory):
    view = composite(factory, three())
    clip = vtkPlane()
    clip.SetNormal(0.0, 1.0, 0.0)
    view.mappers[0].AddClippingPlane(clip)
    return view


@scene
def composite_lights(factory):
    """Blocks under a spot: the same light reaches all."""
    view = composite(factory, three())
    light(view, "SceneLight", Position=(0.0, 0.0, 2.0), FocalPoint=(0.1, 0.0, 0.0), Positional=True,
          ConeAngle=40.0, Exponent=1.0)  # fmt: skip
    return view


@scene
def composite_texture(factory):
    view = composite(factory, three())
    view.actors[0].SetTexture(stripes(colors=(COLORS[0],) * 2))
    view.expect = (modulated(COLORS[0]),)
    return view


@scene
def composite_scaled_and_mirrored(factory):
    view = composite(factory, blocks(block(-0.5, source=sphere(8, 0.3)), block(0.5, source=sphere(8, 0.3))))
    view.actors[0].SetScale(-1.2, 0.7, 1.0)
    return view


@scene
def composite_backface_property(factory):
    from vtkmodules.vtkRenderingCore import vtkProperty

    view = composite(factory, three())
    back = vtkProperty()
    back.SetColor(0.2, 0.9, 0.3)
    view.actors[0].SetBackfaceProperty(back)
    view.actors[0].RotateY(180.0)
    return view
