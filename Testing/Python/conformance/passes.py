# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of renderers and windows: lights, translucency, passes, selection, shader replacements, stereo, tiles."""

import math

import vtkmodules.vtkRenderingOpenGL2 as opengl
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkSelectionNode
from vtkmodules.vtkRenderingCore import (
    vtkCellPicker,
    vtkHardwareSelector,
    vtkLight,
    vtkPropPicker,
    vtkSkybox,
    vtkTexture,
    vtkWindowToImageFilter,
)

from .scene import ALBEDO, BACKGROUND, FURNACE, Unavailable, View, connect, encode, mix, scene, sphere
from .surfaces import STOCK, plane, smooth, stripes, with_tangents

HALF = mix(BACKGROUND, FURNACE, 0.5)


def light(view, kind, renderer=None, **settings):
    if not view.factory.scene_lights:
        return
    lamp = vtkLight()
    getattr(lamp, "SetLightTypeTo" + kind)()
    for name, value in settings.items():
        setter = getattr(lamp, "Set" + name)
        setter(*value) if isinstance(value, tuple) else setter(value)
    (renderer or view.renderer).AddLight(lamp)


# ---- lights


@scene
def no_lights(factory):
    view = View(factory, lights=False)
    view.add()
    return view


@scene
def automatic_light(factory):
    view = View(factory, lights=False)
    view.renderer.SetAutomaticLightCreation(factory.scene_lights)
    view.add(Specular=0.3)
    return view


@scene
def headlight(factory):
    view = View(factory, lights=False)
    light(view, "Headlight", Intensity=0.7, DiffuseColor=(1.0, 0.8, 0.6))
    view.add(Specular=0.3)
    return view


@scene
def directional_lights(factory):
    view = View(factory, lights=False)
    light(view, "SceneLight", Position=(1.0, 2.0, 3.0), DiffuseColor=(1.0, 0.2, 0.2))
    light(view, "CameraLight", Position=(-1.0, 0.5, 1.0), SpecularColor=(0.2, 1.0, 0.2))
    light(view, "SceneLight", Position=(-2.0, 0.0, 1.0), Switch=0)
    view.add(Specular=0.3)
    return view


@scene
def positional_lights(factory):
    view = View(factory, lights=False)
    light(view, "SceneLight", Position=(1.0, 1.0, 1.5), Positional=True, ConeAngle=180.0,
          AttenuationValues=(0.2, 0.1, 0.3))  # fmt: skip
    light(view, "SceneLight", Position=(0.0, 0.0, 2.0), FocalPoint=(0.1, 0.0, 0.0), Positional=True,
          ConeAngle=15.0, Exponent=3.0)  # fmt: skip
    view.add(Specular=0.3)
    return view


@scene
def lights_change(factory):
    """The kind of lights changes from frame to frame: so does the shader."""
    view = View(factory, lights=False)
    view.add()
    view.window.Render()
    light(view, "Headlight")
    view.window.Render()
    light(view, "SceneLight", Position=(1.0, 1.0, 1.5), Positional=True, ConeAngle=180.0)
    view.window.Render()
    view.renderer.RemoveAllLights()
    light(view, "CameraLight", Position=(-1.0, 0.5, 1.0))
    return view


@scene
def lighting_off(factory):
    view = View(factory)
    view.add(Lighting=False, Color=(0.3, 0.6, 0.9))
    view.expect = STOCK
    return view


@scene
def two_sided_lighting_off(factory):
    view = View(factory)
    view.renderer.TwoSidedLightingOff()
    view.add(Specular=0.3)
    return view


@scene
def image_based_lighting(factory):
    """VTK's own environment beside: the furnace has none of it, ours comes from the mapper."""
    view = View(factory)
    texture = stripes()
    texture.InterpolateOn()
    texture.MipmapOn()
    texture.SetColorModeToDirectScalars()
    view.renderer.UseImageBasedLightingOn()
    for setter in ("SetEnvironmentTexture",):
        getattr(view.renderer, setter)(texture)
    for part in (view.renderer.GetEnvMapIrradiance(), view.renderer.GetEnvMapPrefiltered()):
        for setter, value in (("SetIrradianceSize", 8), ("SetIrradianceStep", 0.3), ("SetPrefilterSize", 8),
                              ("SetPrefilterSamples", 8), ("SetPrefilterLevels", 2)):  # fmt: skip
            if hasattr(part, setter):
                getattr(part, setter)(value)
    if hasattr(view.renderer, "UseSphericalHarmonicsOff"):
        view.renderer.UseSphericalHarmonicsOff()
    table = view.renderer.GetEnvMapLookupTable() if hasattr(view.renderer, "GetEnvMapLookupTable") else None
    if table:
        table.SetLUTSize(16)
        table.SetLUTSamples(8)
    view.add(Interpolation=3, Metallic=0.5, Roughness=0.4)
    return view


@scene
def skybox(factory):
    view = View(factory)
    texture = stripes()
    texture.InterpolateOn()
    sky = vtkSkybox()
    sky.SetTexture(texture)
    sky.SetProjectionToSphere()
    view.renderer.AddActor(sky)
    view.add()
    view.others = 1.0
    return view


# ---- cameras and backgrounds


@scene
def parallel_projection(factory):
    view = View(factory)
    view.renderer.GetActiveCamera().ParallelProjectionOn()
    view.renderer.GetActiveCamera().SetParallelScale(1.0)
    view.add(Specular=0.5)
    return view


@scene
def reset_camera(factory):
    view = View(factory)
    view.add()
    view.renderer.ResetCamera()
    return view


@scene
def gradient_background(factory):
    view = View(factory)
    view.renderer.GradientBackgroundOn()
    view.renderer.SetBackground2(0.6, 0.5, 0.4)
    view.add()
    view.others = 1.0
    return view


@scene
def transparent_background(factory):
    view = View(factory)
    view.window.AlphaBitPlanesOn()
    view.renderer.SetBackgroundAlpha(0.0)
    view.add()
    return view


@scene
def multisamples(factory):
    view = View(factory, multisamples=4)
    view.add()
    view.others = 0.1
    return view


@scene
def smoothing(factory):
    view = View(factory)
    for kind in ("Line", "Point", "Polygon"):
        getattr(view.window, kind + "SmoothingOn")()
    view.add(EdgeVisibility=True)
    view.others, view.dark = 0.5, True
    return view


# ---- translucency


@scene
def translucent(factory):
    view = View(factory)
    view.add(plane(), Opacity=0.5)
    view.expect = (HALF,)
    return view


@scene
def translucent_closed(factory):
    """Front and back of a sphere, without order: weighted by VTK's own pass."""
    view = View(factory)
    view.add(Opacity=0.5)
    return smooth(view)


@scene
def blended_in_order(factory):
    """Without any order-independent pass: two layers, the far one first."""
    view = View(factory)
    if hasattr(view.renderer, "SetUseOIT"):
        view.renderer.SetUseOIT(False)
    view.add(plane(), Opacity=0.5)
    near = view.add(plane(size=0.5), Opacity=0.5)
    near.SetPosition(0.0, 0.0, 0.5)
    return smooth(view)


def layers(view):
    view.add(plane(), Opacity=0.5)
    near = view.add(plane(size=0.5), Opacity=0.5)
    near.SetPosition(0.0, 0.0, 0.5)
    opaque = view.add(plane(size=0.3))
    opaque.SetPosition(-0.3, -0.3, -0.5)
    view.expect = (HALF, mix(HALF, FURNACE, 0.5))
    view.others = 0.05
    return view


def peeled(view, dual=True):
    view.window.AlphaBitPlanesOn()
    view.renderer.UseDepthPeelingOn()
    view.renderer.SetMaximumNumberOfPeels(8)
    view.renderer.SetOcclusionRatio(0.0)
    return view


@scene
def depth_peeling(factory):
    return layers(peeled(View(factory)))


@scene
def depth_peeling_closed(factory):
    view = peeled(View(factory))
    view.add(Opacity=0.5)
    view.expect = (mix(HALF, FURNACE, 0.5),)
    view.others = 0.05
    return view


@scene
def depth_peeling_backface_property(factory):
    from vtkmodules.vtkRenderingCore import vtkProperty

    view = peeled(View(factory))
    actor = view.add(Opacity=0.5)
    back = vtkProperty()
    back.SetColor(0.9, 0.1, 0.1)
    back.SetOpacity(0.5)
    actor.SetBackfaceProperty(back)
    view.expect = (mix(HALF, FURNACE, 0.5),)
    view.others = 0.05
    return view


def sequence(*passes):
    collection = opengl.vtkRenderPassCollection()
    for part in passes:
        collection.AddItem(part)
    whole = opengl.vtkSequencePass()
    whole.SetPasses(collection)
    return whole


def explicit_passes(view, translucent_pass, opaque_pass=None):
    camera = opengl.vtkCameraPass()
    camera.SetDelegatePass(sequence(opengl.vtkLightsPass(), opaque_pass or opengl.vtkOpaquePass(), translucent_pass))
    return camera


def peeling_pass(view, cls, **settings):
    peel = cls()
    peel.SetTranslucentPass(opengl.vtkTranslucentPass())
    for name, value in settings.items():
        getattr(peel, "Set" + name)(value)
    view.window.AlphaBitPlanesOn()
    view.renderer.SetPass(explicit_passes(view, peel))
    return view


@scene
def depth_peeling_pass(factory):
    return layers(peeling_pass(View(factory), opengl.vtkDepthPeelingPass, MaximumNumberOfPeels=8))


@scene
def dual_depth_peeling_pass(factory):
    return layers(peeling_pass(View(factory), opengl.vtkDualDepthPeelingPass, MaximumNumberOfPeels=8))


@scene
def order_independent_pass(factory):
    view = peeling_pass(View(factory), opengl.vtkOrderIndependentTranslucentPass)
    view.add(plane(), Opacity=0.5)
    view.expect = (HALF,)
    return view


@scene
def forced_translucent(factory):
    view = View(factory)
    view.add().ForceTranslucentOn()
    return smooth(view)


@scene
def forced_opaque(factory):
    view = View(factory)
    view.add(plane(), Opacity=0.5).ForceOpaqueOn()
    view.expect = (HALF,)
    return view


@scene
def hidden_lines(factory):
    view = View(factory)
    view.renderer.UseHiddenLineRemovalOn()
    view.add(Representation=1)
    view.add(plane(3, 0.8), Representation=1, Color=(1.0, 1.0, 0.0))
    view.expect = STOCK
    return view


# ---- passes over the picture


def basic():
    return opengl.vtkRenderStepsPass()


def through(image_pass, view):
    image_pass.SetDelegatePass(basic())
    view.renderer.SetPass(image_pass)
    return view


@scene
def ssao(factory):
    view = View(factory)
    shade = opengl.vtkSSAOPass()
    shade.SetRadius(0.3)
    shade.SetKernelSize(8)
    shade.SetBias(0.01)
    view.add()
    view.add(plane()).SetPosition(0.0, 0.0, -0.3)
    return smooth(through(shade, view))


@scene
def ssao_by_the_renderer(factory):
    view = View(factory)
    if not hasattr(view.renderer, "SetUseSSAO"):
        raise Unavailable("vtkRenderer::UseSSAO came with VTK 9.1")
    view.renderer.UseSSAOOn()
    view.renderer.SetSSAORadius(0.3)
    view.renderer.SetSSAOKernelSize(8)
    view.add()
    view.add(plane()).SetPosition(0.0, 0.0, -0.3)
    return smooth(view)


def shadows(factory, positional):
    view = View(factory, lights=False)
    settings = {"Position": (1.0, 1.5, 2.5), "FocalPoint": (0.0, 0.0, 0.0)}
    if positional:
        settings.update(Positional=True, ConeAngle=40.0)
    # The baker wants a light in any case: the furnace has one of no intensity.
    lamp = vtkLight()
    lamp.SetLightTypeToSceneLight()
    for name, value in settings.items():
        setter = getattr(lamp, "Set" + name)
        setter(*value) if isinstance(value, tuple) else setter(value)
    if not factory.scene_lights:
        lamp.SetIntensity(0.0)
    view.renderer.AddLight(lamp)
    shadow = opengl.vtkShadowMapPass()
    baker = shadow.GetShadowMapBakerPass()
    baker.SetResolution(64)
    camera = opengl.vtkCameraPass()
    camera.SetDelegatePass(sequence(baker, shadow))
    view.renderer.SetPass(camera)
    view.add(sphere(radius=0.3))
    view.add(plane(1, 2.0)).SetPosition(0.0, 0.0, -0.6)
    view.renderer.ResetCameraClippingRange()
    view.dark = True
    return view


@scene
def shadow_maps_of_a_spot(factory):
    return shadows(factory, True)


@scene
def shadow_maps_of_a_sun(factory):
    return shadows(factory, False)


@scene
def fxaa(factory):
    view = View(factory)
    view.renderer.UseFXAAOn()
    view.add()
    view.others = 0.1
    return view


@scene
def ssaa(factory):
    view = View(factory)
    view.add()
    view.others = 0.15
    return through(opengl.vtkSSAAPass(), view)


def toned(mapping, function):
    def make(factory):
        view = View(factory)
        tone = opengl.vtkToneMappingPass()
        tone.SetToneMappingType(mapping)
        tone.SetExposure(1.5)
        view.add()
        # The background goes through it, too, where it is opaque.
        view.others, view.least = 0.9, 0.2
        view.expect = (encode(function(a) for a in ALBEDO),)
        return through(tone, view)

    return make


for name, mapping, function in (
    ("clamp", 0, lambda x: min(x, 1.0)),
    ("reinhard", 1, lambda x: x / (1.0 + x)),
    ("exponential", 2, lambda x: 1.0 - math.exp(-1.5 * x)),
):
    make = toned(mapping, function)
    make.__name__ = "tone_mapping_" + name
    scene(make)


@scene
def tone_mapping_filmic(factory):
    view = View(factory)
    tone = opengl.vtkToneMappingPass()
    tone.SetToneMappingType(3)
    view.add()
    return smooth(through(tone, view))


@scene
def edl(factory):
    view = View(factory)
    view.add()
    view.dark = True
    return smooth(through(opengl.vtkEDLShading(), view))


@scene
def blur(factory):
    view = View(factory)
    view.add()
    view.others = 0.3
    return through(opengl.vtkGaussianBlurPass(), view)


@scene
def sobel(factory):
    view = View(factory)
    view.add()
    view.expect, view.others, view.dark = (), 1.0, True
    return through(opengl.vtkSobelGradientMagnitudePass(), view)


@scene
def depth_of_field(factory):
    view = View(factory)
    view.renderer.GetActiveCamera().SetFocalDisk(0.05)
    focus = opengl.vtkDepthOfFieldPass()
    focus.AutomaticFocalDistanceOff()
    view.add()
    return smooth(through(focus, view))


@scene
def outline_glow(factory):
    view = View(factory)
    view.add()
    view.dark = True
    return smooth(through(opengl.vtkOutlineGlowPass(), view))


@scene
def lighting_map(factory):
    """Normals as colors for relighting: the superclass's business."""
    view = View(factory)
    normals = opengl.vtkLightingMapPass()
    normals.SetRenderType(opengl.vtkLightingMapPass.NORMALS)
    camera = opengl.vtkCameraPass()
    camera.SetDelegatePass(sequence(opengl.vtkLightsPass(), normals))
    view.renderer.SetPass(camera)
    view.add()
    view.has_furnace = False  # the pass itself needs lights
    view.dark = True
    return view


@scene
def framebuffer_pass(factory):
    view = View(factory)
    view.add()
    target = opengl.vtkFramebufferPass()
    target.SetColorFormat(1)
    target.SetDelegatePass(explicit_passes(view, opengl.vtkTranslucentPass()))
    view.renderer.SetPass(target)
    return view


@scene
def panorama(factory):
    view = View(factory)
    view.add()
    whole = opengl.vtkPanoramicProjectionPass()
    whole.SetCubeResolution(64)
    whole.SetAngle(270.0)
    view.renderer.GetActiveCamera().SetPosition(0.0, 0.0, 1.5)
    view.renderer.GetActiveCamera().SetClippingRange(0.1, 6.0)
    return smooth(through(whole, view))


# ---- windows


def stereo(kind):
    def make(factory):
        view = View(factory)
        view.window.SetStereoCapableWindow(1)
        view.window.SetStereoType(kind)
        view.window.StereoRenderOn()
        view.add()
        view.others = 1.0
        view.expect = () if kind in (2, 7, 8) else (FURNACE,)
        view.dark = True
        return view

    return make


for name, kind in (("red_blue", 2), ("interlaced", 3), ("anaglyph", 7), ("checkerboard", 8), ("split", 9)):
    make = stereo(kind)
    make.__name__ = "stereo_" + name
    scene(make)


def grab_by_filter(scale, kind):
    def grab(view):
        shot = vtkWindowToImageFilter()
        shot.SetInput(view.window)
        shot.SetScale(scale)
        shot.SetInputBufferType(kind)
        shot.ReadFrontBufferOff()
        shot.Update()
        image = shot.GetOutput()
        data = bytes(memoryview(image.GetPointData().GetScalars()))
        if image.GetNumberOfScalarComponents() == 4:
            return data, b""
        return b"".join(data[k : k + 3] + b"\xff" for k in range(0, len(data), 3)), b""

    return grab


@scene
def tiles(factory):
    view = View(factory)
    view.add()
    view.grab = grab_by_filter(2, 3)
    return view


@scene
def tiles_translucent(factory):
    view = View(factory)
    view.add(plane(), Opacity=0.5)
    view.grab = grab_by_filter(3, 3)
    view.expect = (HALF,)
    return view


@scene
def screenshot_with_alpha(factory):
    view = View(factory)
    view.window.AlphaBitPlanesOn()
    view.add()
    view.grab = grab_by_filter(1, 4)
    return view


@scene
def viewports(factory):
    view = View(factory)
    view.renderer.SetViewport(0.0, 0.0, 0.5, 1.0)
    actor = view.add()
    right = view.add_renderer((0.5, 0.0, 1.0, 0.5))
    right.AddActor(actor)
    top = view.add_renderer((0.5, 0.5, 1.0, 1.0), lights=False)
    view.add(plane(), renderer=top)
    return view


@scene
def window_layers(factory):
    view = View(factory)
    view.window.SetNumberOfLayers(2)
    view.add()
    front = view.add_renderer()
    front.SetLayer(1)
    view.add(sphere(radius=0.2), renderer=front).SetPosition(0.8, 0.5, 0.0)
    return view


@scene
def window_of_another_size(factory):
    view = View(factory)
    view.add()
    view.window.Render()
    view.window.SetSize(90, 110)
    return view


@scene
def srgb_window(factory):
    if vtkVersion().GetVTKMajorVersion() * 100 + vtkVersion().GetVTKMinorVersion() >= 903:
        raise Unavailable("since VTK 9.3 stock scenes abort under Xvfb in a window with an sRGB frame buffer")
    view = View(factory)
    view.window.UseSRGBColorSpaceOn()
    view.add()
    view.others = 1.0
    view.expect = ()
    return view


# ---- selection and picking


def selected(association, process_ids=False):
    def make(factory):
        view = View(factory)
        view.add(sphere(8))
        view.add(plane(2, 0.5)).SetPosition(0.6, 0.3, 0.4)

        def select(view):
            view.window.Render()
            selector = vtkHardwareSelector()
            selector.SetRenderer(view.renderer)
            selector.SetArea(0, 0, view.window.GetSize()[0] - 1, view.window.GetSize()[1] - 1)
            selector.SetFieldAssociation(association)
            selection = selector.Select()
            found = []
            for k in range(selection.GetNumberOfNodes()):
                node = selection.GetNode(k)
                prop = node.GetProperties().Get(vtkSelectionNode.PROP())
                ids = node.GetSelectionList()
                found.append((view.actors.index(prop), [ids.GetValue(i) for i in range(ids.GetNumberOfTuples())]))
            assert found, "nothing was selected"
            return sorted(found)

        view.extra = select
        return view

    return make


for name, association in (("points", vtkDataObject.FIELD_ASSOCIATION_POINTS),
                          ("cells", vtkDataObject.FIELD_ASSOCIATION_CELLS)):  # fmt: skip
    make = selected(association)
    make.__name__ = "selection_of_" + name
    scene(make)


@scene
def selection_through_translucent(factory):
    view = selected(vtkDataObject.FIELD_ASSOCIATION_CELLS)(factory)
    view.actors[1].GetProperty().SetOpacity(0.5)
    return smooth(view)


@scene
def selection_of_edges_and_wireframe(factory):
    view = selected(vtkDataObject.FIELD_ASSOCIATION_CELLS)(factory)
    view.actors[0].GetProperty().SetRepresentationToWireframe()
    view.actors[1].GetProperty().EdgeVisibilityOn()
    view.others, view.dark = 0.4, True
    return view


@scene
def picking(factory):
    view = View(factory)
    view.add()

    def pick(view):
        found = []
        for picker in (vtkCellPicker(), vtkPropPicker()):
            picker.Pick(60.0, 45.0, 0.0, view.renderer)
            found.append((view.actors.index(picker.GetActor()), picker.GetPickPosition()))
            if isinstance(picker, vtkCellPicker):
                found.append((picker.GetCellId(), picker.GetPickNormal()))
        return found

    view.extra = pick
    return view


@scene
def values_instead_of_colors(factory):
    """vtkValuePass draws arrays: the superclass's business."""
    from .surfaces import elevated

    view = View(factory)
    values = opengl.vtkValuePass()
    values.SetInputArrayToProcess(3, "Elevation")  # VTK_SCALAR_MODE_USE_POINT_FIELD_DATA
    values.SetInputComponentToProcess(0)
    camera = opengl.vtkCameraPass()
    camera.SetDelegatePass(sequence(opengl.vtkLightsPass(), values))
    view.renderer.SetPass(camera)
    view.add(elevated())

    def read(view):
        view.window.Render()
        image = values.GetFloatImageDataArray(view.renderer)
        return bytes(memoryview(image)) if image else None

    view.extra = read
    return smooth(view)


# ---- a program's own shader code


def replaced(view, tag, code, first=True, stage="Fragment"):
    shader = view.actors[0].GetShaderProperty()
    getattr(shader, "Add%sShaderReplacement" % stage)(tag, first, code, False)
    return view


@scene
def replaced_light(factory):
    """After the light: a change of the color that was written."""
    view = View(factory)
    view.add()
    replaced(view, "//VTK::Light::Impl", "//VTK::Light::Impl\n  gl_FragData[0].rgb = gl_FragData[0].brg;\n")
    view.expect = (tuple(FURNACE[k] for k in (2, 0, 1)),)
    return view


@scene
def replaced_light_with_stock_variables(factory):
    """VTK's own examples read what the stock mapper declares."""
    view = View(factory)
    view.add(Color=(0.2, 0.4, 0.6))
    replaced(view, "//VTK::Light::Impl",
             "//VTK::Light::Impl\n  gl_FragData[0] = vec4(0.5 * (ambientColor + diffuseColor), opacity);\n")  # fmt: skip
    return smooth(view)


@scene
def replaced_light_with_stock_sums(factory):
    """The same with the sums that the stock mapper has where there are lights."""
    view = View(factory)
    view.add()
    replaced(view, "//VTK::Light::Impl",
             "//VTK::Light::Impl\n  gl_FragData[0] = vec4(ambientColor + diffuse + specular, opacity);\n")  # fmt: skip
    view.has_furnace = False
    return view


@scene
def replaced_normal(factory):
    view = View(factory)
    view.add()
    replaced(view, "//VTK::Normal::Impl", "//VTK::Normal::Impl\n  normalVCVSOutput = normalize(normalVCVSOutput + vec3(0.1));\n")
    return view


@scene
def replaced_color(factory):
    view = View(factory)
    view.add()
    replaced(view, "//VTK::Color::Impl", "//VTK::Color::Impl\n  diffuseColor = vec3(0.9, 0.3, 0.2);\n")
    return view


@scene
def replaced_vertex_position(factory):
    view = View(factory)
    view.add()
    replaced(view, "//VTK::PositionVC::Dec", "//VTK::PositionVC::Dec\nout vec4 ownMC;\n", stage="Vertex")
    replaced(view, "//VTK::PositionVC::Impl", "//VTK::PositionVC::Impl\n  ownMC = vertexMC;\n", stage="Vertex")
    replaced(view, "//VTK::Light::Dec", "//VTK::Light::Dec\nin vec4 ownMC;\n")
    replaced(view, "//VTK::Light::Impl",
             "//VTK::Light::Impl\n  if (ownMC.x > 0.0) { gl_FragData[0].rgb *= 0.5; }\n", first=False)  # fmt: skip
    view.expect = (FURNACE, tuple(0.5 * c for c in FURNACE))
    return view


@scene
def own_shader_code(factory):
    """A whole fragment shader of the program's own."""
    view = View(factory)
    view.add()
    view.actors[0].GetShaderProperty().SetFragmentShaderCode(
        "//VTK::System::Dec\n//VTK::Output::Dec\nin vec3 normalVCVSOutput;\n"
        "void main()\n{\n  gl_FragData[0] = vec4(abs(normalize(normalVCVSOutput)), 1.0);\n}\n"
    )
    view.expect = "lit stock"  # without lights VTK has no normals for it
    return view


@scene
def own_uniforms(factory):
    view = View(factory)
    view.add()
    view.actors[0].GetShaderProperty().GetFragmentCustomUniforms().SetUniformf("gain", 0.5)
    replaced(view, "//VTK::Light::Impl", "//VTK::Light::Impl\n  gl_FragData[0].rgb *= gain;\n")
    view.expect = (tuple(0.5 * c for c in FURNACE),)
    return view


@scene
def own_vertex_attributes(factory):
    view = View(factory)
    view.add(with_tangents()).GetMapper().MapDataArrayToVertexAttribute("own", "Normals", 0, -1)
    replaced(view, "//VTK::Normal::Dec", "//VTK::Normal::Dec\nin vec3 own;\nout vec3 ownVS;\n", stage="Vertex")
    replaced(view, "//VTK::Normal::Impl", "//VTK::Normal::Impl\n  ownVS = own;\n", stage="Vertex")
    replaced(view, "//VTK::Normal::Dec", "//VTK::Normal::Dec\nin vec3 ownVS;\n")
    replaced(view, "//VTK::Light::Impl", "//VTK::Light::Impl\n  gl_FragData[0].rgb *= 0.5 + 0.5 * abs(ownVS);\n", first=False)
    return smooth(view)


@scene
def shaders_come_and_go(factory):
    view = replaced_light(factory)
    view.window.Render()
    view.actors[0].GetShaderProperty().ClearAllFragmentShaderReplacements()
    view.actors[0].Modified()
    view.window.Render()
    view.expect = (FURNACE,)
    return view


@scene
def resources_released(factory):
    """A second window after the first let go of everything."""
    view = View(factory)
    view.add()
    view.window.Render()
    view.window.Finalize()
    return view
