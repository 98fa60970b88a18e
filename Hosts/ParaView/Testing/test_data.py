# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every kind of data that Surface draws: the same pixels are covered, and the material is on them."""
import os

import numpy as np
from paraview import servermanager, simple
from vtkmodules.vtkCommonDataModel import vtkNonOverlappingAMR, vtkUniformGrid
from vtkmodules.vtkIOXML import vtkXMLUniformGridAMRWriter

from common import OUTPUT, draw, get_plan, load_plugin, make_sphere, make_view

load_plugin()
BACKGROUNDS = ((0.2, 0.2, 0.2), (0.9, 0.1, 0.9))


def get_covered(view, name):
    """Picture, and the pixels that do not change with the background."""
    pictures = []
    for k, background in enumerate(BACKGROUNDS):
        view.Background = background
        pictures.append(draw(view, f"{name}-{k}"))
    return pictures[0], (pictures[0] == pictures[1]).all(axis=2)


def make_amr_file(source):
    """What the source gives, written and read again: as files of simulations are."""
    path = os.path.join(OUTPUT, "data.vthb")
    simple.SaveData(path, source, DataMode="Binary")  # 5.11 of Debian 12 cannot read raw data
    return simple.OpenDataFile(path)


def make_non_overlapping_amr():
    """Half of a box in one grid, the other half in four finer ones."""
    data = vtkNonOverlappingAMR()
    try:
        data.Initialize(2, [1, 4])
    except TypeError:  # later versions of VTK
        data.Initialize([1, 4])

    def put(level, index, origin, spacing):
        grid = vtkUniformGrid()
        grid.SetOrigin(origin)
        grid.SetSpacing(spacing, spacing, spacing)
        grid.SetDimensions(5, 5, 5)
        data.SetDataSet(level, index, grid)

    put(0, 0, (0, 0, 0), 0.25)
    for k in range(4):
        put(1, k, (1, 0.5 * (k % 2), 0.5 * (k // 2)), 0.125)
    writer = vtkXMLUniformGridAMRWriter()
    writer.SetInputDataObject(data)
    writer.SetDataModeToBinary()
    writer.SetFileName(os.path.join(OUTPUT, "non-overlapping.vth"))
    assert writer.Write()
    return simple.XMLUniformGridAMRReader(FileName=[writer.GetFileName()])


def make_rectilinear():
    source = simple.ProgrammableSource(OutputDataSetType="vtkRectilinearGrid")
    source.Script = """
from vtkmodules.vtkCommonCore import vtkDoubleArray
for axis in "XYZ":
    values = vtkDoubleArray()
    for value in (0.0, 0.1, 0.3, 0.7, 1.0):
        values.InsertNextValue(value)
    getattr(output.VTKObject, f"Set{axis}Coordinates")(values)
output.VTKObject.SetDimensions(5, 5, 5)
"""
    source.ScriptRequestInformation = """
self.GetExecutive().GetOutputInformation(0).Set(self.GetExecutive().WHOLE_EXTENT(), 0, 4, 0, 4, 0, 4)
"""
    return source


def make_kinds():
    """Sources by name."""
    pulse = simple.AMRGaussianPulseSource()
    grid = simple.HyperTreeGridSource() if hasattr(simple, "HyperTreeGridSource") else simple.HyperTreeGrid()
    random = simple.HyperTreeGridRandom()
    threshold = simple.Threshold(Input=random, Scalars=["CELLS", "Depth"], LowerThreshold=4, UpperThreshold=9)
    return {
        "amr": pulse,
        "amr-file": make_amr_file(pulse),
        "amr-2d": simple.HierarchicalFractal(),
        "amr-non-overlapping": make_non_overlapping_amr(),
        "tree": grid,
        "tree-random": random,
        "tree-with-holes": threshold,
        "tree-blocks": simple.GroupDatasets(Input=[grid]),
        "rectilinear": make_rectilinear(),
        "blocks-of-kinds": simple.GroupDatasets(Input=[make_sphere(Radius=1.4), simple.Wavelet(WholeExtent=[-1, 1] * 3)]),
    }


def check(name, source):
    view = make_view()
    source.UpdatePipeline()
    display = simple.Show(source, view)
    assert "Surface" in display.GetProperty("Representation").Available, name
    if display.ColorArrayName[1]:
        simple.ColorBy(display, None)
    display.Representation = "Surface"
    simple.ResetCamera(view)
    view.CameraPosition = [f + 4 * view.CameraParallelScale * d for f, d in zip(view.CameraFocalPoint, (0.5, 0.4, 0.77))]
    simple.ResetCamera(view)
    stock, stock_covered = get_covered(view, f"data-{name}-surface")
    assert "Measured Material" in display.GetProperty("Representation").Available, name
    display.Representation = "Measured Material"
    measured, covered = get_covered(view, f"data-{name}")
    plan = get_plan(display)
    changed = ((np.abs(stock - measured).max(axis=2) > 3) & covered).sum() / covered.sum()
    print(f"{name}: {display.SMProxy.GetXMLName()}, {covered.mean():.1%} covered, {changed:.1%} of it drawn otherwise, {plan}")
    assert stock_covered.mean() > 0.05, name
    assert (covered == stock_covered).all(), (name, (covered != stock_covered).sum())
    assert "error" in plan, (name, plan)
    assert changed > 0.8, (name, changed)
    simple.Delete(view)


def check_offers():
    """Wherever ParaView offers Surface. Cell grids are drawn by a mapper of their own."""
    manager = servermanager.vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
    names = manager.GetProxyDefinitionManager().NewSingleGroupIterator("representations")
    names.InitTraversal()
    offers = []
    while not names.IsDoneWithTraversal():
        name = names.GetProxyName()
        names.GoToNextItem()
        if not name.endswith("Representation") or name == "CellGridRepresentation":
            continue
        proxy = manager.NewProxy("representations", name)
        types = proxy.GetProperty("RepresentationTypesInfo")
        if types:
            proxy.UpdatePropertyInformation(types)
            texts = [types.GetElement(k) for k in range(types.GetNumberOfElements())]
            assert ("Surface" in texts) == ("Measured Material" in texts), (name, texts)
            offers += [name] if "Surface" in texts else []
    print("offered for", ", ".join(offers))
    assert len(offers) >= 6, offers


assert servermanager.ActiveConnection
check_offers()
for kind, kind_source in make_kinds().items():
    check(kind, kind_source)
print("passed")
