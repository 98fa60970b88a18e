# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The representation in one process: every kind of data, its properties, states, traces, selections, levels of detail."""
import os
import re

import numpy as np
from paraview import servermanager, simple, smstate
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

from common import (OUTPUT, draw, get_difference, get_plan, get_selectors, load_plugin, look, make_sphere, make_view, read, show,
                    write)

load_plugin()


def test_properties_change_the_picture():
    view = make_view()
    look(view)
    sphere = make_sphere()
    display = show(sphere, view)
    first = draw(view, "gold-paint")
    # Properties of one element are live objects in Python: what stood before is written out.
    changes = {
        "MeasuredMaterial": ("gold-paint", "nickel"),
        "MeasuredEnvironment": ("Automatic", "sky"),
        "MeasuredEnvironmentRotation": (0.0, 90.0),
        "MeasuredEnvironmentUpAxis": ("Y", "Z"),
        "UseViewLights": (0, 1),
    }
    for name, (before, after) in changes.items():
        setattr(display, name, after)
        picture = draw(view, "with-" + name)
        assert get_difference(picture, first)[0] > 20, name
        setattr(display, name, before)
        assert get_difference(draw(view, "again"), first)[0] <= 1, name
    # A coarser tolerance may draw by another method, within both tolerances.
    display.ErrorTolerance = 0.2
    assert get_difference(draw(view, "coarse"), first)[1] < 12
    coarse = get_plan(display)
    display.ErrorTolerance = 0.01
    draw(view, "fine")
    assert get_plan(display) != coarse


def test_rotation_keeps_the_environment():
    """Plans and textures belong to the environment, which turns: one copy for all angles."""
    view = make_view()
    look(view)
    display = show(make_sphere(), view, MeasuredEnvironment="hall")

    def get_environment():
        actors = view.GetRenderer().GetActors()
        mappers = {str(actors.GetItemAsObject(k).GetMapper()) for k in range(actors.GetNumberOfItems())}
        lines = {line.strip() for text in mappers if "MeasuredBRDFMapper" in text for line in text.splitlines()}
        return [line for line in lines if line.startswith("Environment: ")]

    pictures, environments = [], []
    for angle in (30.0, 60.0, 120.0, 0.0):
        display.MeasuredEnvironmentRotation = angle
        pictures.append(draw(view, "rotation"))
        environments.append(get_environment())
    assert len(environments[0]) == 1, environments
    assert environments == environments[:1] * 4, environments
    assert get_difference(pictures[0], pictures[2])[0] > 20


def test_lights_of_the_view():
    """The light kit lights nothing; lights of the user's do, where the kit is off."""
    view = make_view()
    look(view)
    display = show(make_sphere(), view, MeasuredMaterial="pink-felt")
    with_kit = draw(view, "lights-kit")
    view.UseLight = 0
    assert get_difference(draw(view, "lights-none"), with_kit)[0] <= 1
    light = simple.AddLight(view)
    with_light = draw(view, "lights-own")
    assert (with_light - with_kit).max() > 20
    view.UseLight = 1
    assert get_difference(draw(view, "lights-kit-again"), with_kit)[0] <= 1
    simple.RemoveLight(light)


def test_material_maps():
    """Above the middle one material, below it another; between two values a blend."""
    view = make_view()
    look(view)
    sphere = make_sphere()
    data = simple.Calculator(Input=sphere, ResultArrayName="half", Function="coordsY > 0")
    simple.Hide(sphere)
    display = show(data, view)
    alone = {}
    for name in ("nickel", "pink-felt"):
        display.MeasuredMaterial = name
        alone[name] = draw(view, "map-" + name)
    display.MeasuredMaterial = "blue-rubber"
    plain = draw(view, "map-others")
    display.MaterialMapArray = "half"
    display.MapMaterials = ["0", "nickel", "1", "pink-felt"]
    pictures = {}
    for mode in ("Classes", "Values"):
        display.MaterialMapMode = mode
        picture = pictures[mode] = draw(view, "map-" + mode)
        assert get_plan(display).count("\n") == 1, get_plan(display)  # a line for each material
        for name, rows in (("pink-felt", slice(170, 240)), ("nickel", slice(60, 130))):
            assert np.abs(picture[rows] - alone[name][rows]).max() <= 6, (mode, name)
    assert np.abs(pictures["Classes"] - pictures["Values"]).max() > 6  # a border, a blend
    display.MapMaterials = ["1", "pink-felt"]  # the rest is of the material above
    display.MaterialMapMode = "Classes"
    picture = draw(view, "map-rest")
    assert np.abs(picture[60:130] - plain[60:130]).max() <= 6
    display.MaterialMapMode = "None"
    assert get_difference(draw(view, "map-none"), plain)[0] <= 1


def write_weights(name, columns):
    """An image of 64 x 64 texels: a list of components for each of as many stripes, from the left."""
    pixels = np.repeat(np.array(columns), 64 // len(columns), axis=0)
    path = os.path.join(OUTPUT, name + ".png")
    write(path, np.broadcast_to(255 * pixels, (64, *pixels.shape)))
    return path


def test_weight_images():
    """Left one material, right another, by the red and the green of an image; a second image goes on counting."""
    view = make_view()
    look(view)
    display = show(simple.Plane(), view)
    alone = {}
    for name in ("nickel", "pink-felt", "violet-rubber", "blue-rubber"):
        display.MeasuredMaterial = name
        alone[name] = draw(view, "images-" + name)
    display.MapMaterials = ["0", "nickel", "1", "pink-felt", "2", "gold-paint", "3", "delrin", "4", "violet-rubber"]
    display.MaterialMapMode = "Images"
    # Red and green, then the red of the next image, and nothing.
    first = write_weights("weights-1", [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]])
    second = write_weights("weights-2", [[0, 0, 0], [0, 0, 0], [1, 0, 0], [0, 0, 0]])
    display.WeightImages = [first, second]
    picture = draw(view, "images")
    covered = np.where(np.abs(alone["pink-felt"][150] - 51).max(axis=1) > 3)[0]
    left, width = covered[0], (covered[-1] + 1 - covered[0]) / 4
    for k, name in enumerate(("nickel", "pink-felt", "violet-rubber", "blue-rubber")):
        columns = slice(int(left + (k + 0.15) * width), int(left + (k + 0.85) * width))
        assert np.abs(picture[60:240, columns] - alone[name][60:240, columns]).max() <= 6, name
    assert get_plan(display).count("error") >= 3, get_plan(display)
    # Two gray images are the weights of two materials.
    gray = [os.path.join(OUTPUT, f"weights-gray-{k}.png") for k in range(2)]
    for k, path in enumerate(gray):
        write(path, np.broadcast_to(255.0 * (np.arange(64) // 32 == k)[None, :, None], (64, 64, 1)))
    display.MapMaterials = ["0", "nickel", "1", "pink-felt"]
    display.WeightImages = gray
    picture = draw(view, "images-gray")
    for k, name in enumerate(("nickel", "pink-felt")):
        columns = slice(int(left + (2 * k + 0.15) * width), int(left + (2 * k + 1.85) * width))
        assert np.abs(picture[60:240, columns] - alone[name][60:240, columns]).max() <= 6, name
    display.WeightImages = []
    display.MaterialMapMode = "None"
    assert get_difference(draw(view, "images-none"), alone["blue-rubber"])[0] <= 1


def draw_interactively(view, name):
    view.InteractiveRender()
    grab = vtkWindowToImageFilter()
    grab.SetInput(view.GetRenderWindow())
    grab.ShouldRerenderOff()
    grab.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.join(OUTPUT, name + ".png"))
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()
    return read(os.path.join(OUTPUT, name + ".png"))


def test_levels_of_detail_show_maps():
    """While the camera moves, too, the material above is another than the one below."""
    view = make_view()
    look(view)
    view.LODThreshold = 0.0
    sphere = simple.Sphere(ThetaResolution=200, PhiResolution=200)
    data = simple.Calculator(Input=sphere, ResultArrayName="half", Function="coordsY > 0")
    display = show(data, view)
    display.PlanInBackground = 0
    alone = {}
    for name in ("nickel", "pink-felt"):
        display.MeasuredMaterial = name
        draw(view, "moving-still")
        alone[name] = draw_interactively(view, "moving-" + name)
    assert get_difference(alone["nickel"], draw(view, "moving-still"))[0] > 6  # another mesh
    display.MeasuredMaterial = "blue-rubber"
    display.MaterialMapArray = "half"
    display.MapMaterials = ["0", "nickel", "1", "pink-felt"]
    display.MaterialMapMode = "Classes"
    draw(view, "moving-still")
    picture = draw_interactively(view, "moving-map")
    for name, rows in (("pink-felt", slice(180, 240)), ("nickel", slice(60, 120))):
        assert np.abs(picture[rows] - alone[name][rows]).max() <= 6, name


def test_scalars_modulate_or_do_nothing():
    view = make_view()
    look(view)
    sphere = make_sphere()
    display = show(sphere, view)
    plain = draw(view, "plain")
    simple.ColorBy(display, ("POINTS", "Normals", "X"))
    display.Representation = "Measured Material"
    assert get_difference(draw(view, "colored"), plain)[0] > 40
    display.ModulateByScalars = 0
    assert get_difference(draw(view, "colors-ignored"), plain)[0] <= 1


def test_blocks_have_materials():
    left = make_sphere(registrationName="Left", Center=[-0.5, 0, 0], Radius=0.4)
    right = make_sphere(registrationName="Right", Center=[0.5, 0, 0], Radius=0.4)
    group = simple.GroupDatasets(Input=[left, right])
    group.UpdatePipeline()
    view = make_view()
    look(view, distance=4)
    display = show(group, view)
    same = draw(view, "blocks-same")
    display.BlockMaterials = [get_selectors(group)[1], "nickel"]
    other = draw(view, "blocks")
    middle = other.shape[1] // 2
    assert get_difference(same[:, :middle], other[:, :middle])[0] <= 1
    assert get_difference(same[:, middle:], other[:, middle:])[0] > 20
    assert get_plan(display).count("error") == 2, get_plan(display)
    display.BlockMaterials = []
    assert get_difference(draw(view, "blocks-again"), same)[0] <= 1


def test_missing_normals_are_made():
    view = make_view()
    look(view)
    sphere = simple.Sphere(ThetaResolution=24, PhiResolution=24)
    bare = simple.ProgrammableFilter(Input=sphere)
    bare.Script = "output.VTKObject.GetPointData().SetNormals(None)\noutput.VTKObject.GetPointData().RemoveArray('Normals')"
    display = show(bare, view)
    display.MeasuredMaterial = "nickel"
    smooth = draw(view, "normals-made")
    display.GenerateMissingNormals = 0
    assert get_difference(draw(view, "normals-missing"), smooth)[0] > 40


def test_state_and_trace():
    view = make_view()
    look(view)
    display = show(make_sphere(), view)
    display.MeasuredMaterial = "violet-rubber"
    display.MeasuredEnvironment = "hall"
    display.ErrorTolerance = 0.05
    display.MaximumCost = 4
    display.OcclusionMode = "On"
    display.OcclusionBounce = 1
    before = draw(view, "state-before")
    state = os.path.join(OUTPUT, "state.pvsm")
    simple.SaveState(state)
    # Traces and Python states are written by the same code.
    script = smstate.get_state()
    for name, value in (
        ("Representation", "'Measured Material'"),
        ("MeasuredMaterial", "'violet-rubber'"),
        ("MeasuredEnvironment", "'hall'"),
        ("ErrorTolerance", "0.05"),
        ("MaximumCost", "4"),
        ("OcclusionMode", "'On'"),
        ("OcclusionBounce", "1"),
    ):
        assert re.search(rf"\b{name} ?= ?{value}", script), (name, value, script)
    simple.ResetSession()
    load_plugin()
    simple.LoadState(state)
    view = simple.GetActiveViewOrCreate("RenderView")
    view.UseFXAA = 0  # ParaView takes it from its settings, not from the state
    assert get_difference(draw(view, "state-after"), before)[0] <= 1
    display = simple.GetDisplayProperties(simple.GetSources().popitem()[1], view)
    assert (display.OcclusionMode, display.OcclusionBounce) == ("On", 1), (display.OcclusionMode, display.OcclusionBounce)


def test_levels_of_detail_and_selection():
    view = make_view()
    look(view)
    sphere = simple.Sphere(ThetaResolution=200, PhiResolution=200)
    display = show(sphere, view)
    view.LODThreshold = 0.0
    still = draw(view, "still")
    view.InteractiveRender()
    assert get_plan(display)
    # Selections know their cells, and leave the picture as it was.
    simple.SelectSurfaceCells(Rectangle=[140, 140, 160, 160], View=view)
    selection = sphere.GetSelectionInput(0)
    assert selection is not None
    simple.ClearSelection(sphere)
    assert get_difference(draw(view, "still-again"), still)[0] <= 1


def make_bowl():
    """It hides most of the sky from its inside, which faces -z."""
    bowl = simple.Sphere(ThetaResolution=48, PhiResolution=32, EndPhi=115)
    simple.Hide(bowl)
    return bowl


def get_inside(picture):
    return picture[130:170, 130:170]


def test_occlusion():
    """Off, on, decided by the error, with a bounce."""
    view = make_view()
    look(view, direction=(0, 0, -1))
    display = show(make_bowl(), view, MeasuredMaterial="pink-felt")
    pictures = {}
    for mode in ("Off", "Auto", "On"):
        display.OcclusionMode = mode
        pictures[mode] = draw(view, "occlusion-" + mode)
        assert ("modeled" in get_plan(display)) == (mode == "Auto"), (mode, get_plan(display))
    assert get_inside(pictures["Off"] - pictures["On"]).mean() > 20
    assert get_difference(pictures["Auto"], pictures["On"])[0] <= 1
    display.OcclusionBounce = 1
    bounced = draw(view, "occlusion-bounce")
    assert 2 < get_inside(bounced - pictures["On"]).mean()
    assert (bounced <= pictures["Off"] + 1).all()


def test_occlusion_in_animations():
    """A surface that changes in each frame is modeled in all of them."""
    view = make_view()
    look(view, direction=(0, 0, -1))
    bowl = make_bowl()
    scene = simple.GetAnimationScene()
    scene.PlayMode = "Sequence"
    scene.NumberOfFrames = 6
    track = simple.GetAnimationTrack("EndPhi", proxy=bowl)
    track.KeyFrames = [simple.CompositeKeyFrame(KeyTime=time, KeyValues=[value]) for time, value in ((0, 125), (1, 95))]
    display = show(bowl, view, MeasuredMaterial="pink-felt")
    frames = {}
    for mode in ("Auto", "On"):
        display.OcclusionMode = mode
        path = os.path.join(OUTPUT, f"animation-{mode}.png")
        simple.SaveAnimation(path, view, ImageResolution=[300, 300], FrameWindow=[0, 5])
        frames[mode] = [read(os.path.join(OUTPUT, f"animation-{mode}.{k:04}.png")) for k in range(6)]
    for k, (auto, on) in enumerate(zip(*frames.values())):
        assert get_difference(auto, on)[0] <= 1, k
    assert get_inside(frames["On"][-1] - frames["On"][0]).mean() > 5


def test_extract_and_delete_while_shown():
    view = make_view()
    look(view)
    sphere = make_sphere()
    show(sphere, view)
    draw(view, "before-delete")
    simple.Delete(sphere)
    empty = draw(view, "deleted")
    assert (np.abs(empty - 51) <= 3).all()
    del sphere


if __name__ == "__main__":
    assert servermanager.ActiveConnection
    for name, test in list(globals().items()):
        if name.startswith("test_") and callable(test):
            print("--", name, flush=True)
            test()
            simple.ResetSession()
            load_plugin()
    print("passed")
