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
    vtkWindowToImageFilter,
)

from .scene import ALBEDO, BACKGROUND, FURNACE, SMOOTH, Unavailable, add_scene, encode, made, mix, scene, sphere
from .surfaces import STOCK, elevated, plane, stripes, with_tangents

HALF = mix(BACKGROUND, FURNACE, 0.5)


def light(view, kind, renderer=None, **settings):
    if not view.factory.scene_lights:
        return
    lamp = made(vtkLight, **settings)
    getattr(lamp, "SetLightTypeTo" + kind)()
    (renderer or view.renderer).AddLight(lamp)


# ---- lights


add_scene("no_lights", lambda view: view.add(), lights=False)


@scene(lights=False)
def automatic_light(view):
    view.renderer.SetAutomaticLightCreation(view.factory.scene_lights)
    view.add(Specular=0.3)


@scene(lights=False)
def headlight(view):
    light(view, "Headlight", Intensity=0.7, DiffuseColor=(1.0, 0.8, 0.6))
    view.add(Specular=0.3)


@scene(lights=False)
def directional_lights(view):
    light(view, "SceneLight", Position=(1.0, 2.0, 3.0), DiffuseColor=(1.0, 0.2, 0.2))
    light(view, "CameraLight", Position=(-1.0, 0.5, 1.0), SpecularColor=(0.2, 1.0, 0.2))
    light(view, "SceneLight", Position=(-2.0, 0.0, 1.0), Switch=0)
    view.add(Specular=0.3)


@scene(lights=False)
def positional_lights(view):
    light(view, "SceneLight", Position=(1.0, 1.0, 1.5), Positional=True, ConeAngle=180.0, AttenuationValues=(0.2, 0.1, 0.3))
    light(
        view, "SceneLight", Position=(0.0, 0.0, 2.0), FocalPoint=(0.1, 0.0, 0.0), Positional=True, ConeAngle=15.0, Exponent=3.0
    )
    view.add(Specular=0.3)


@scene(lights=False)
def lights_change(view):
    """The kind of lights changes from frame to frame: so does the shader."""
    view.add()
    view.window.Render()
    light(view, "Headlight")
    view.window.Render()
    light(view, "SceneLight", Position=(1.0, 1.0, 1.5), Positional=True, ConeAngle=180.0)
    view.window.Render()
    view.renderer.RemoveAllLights()
    light(view, "CameraLight", Position=(-1.0, 0.5, 1.0))


add_scene("lighting_off", lambda view: view.add(Lighting=False, Color=(0.3, 0.6, 0.9)), expect=STOCK)


@scene
def two_sided_lighting_off(view):
    view.renderer.TwoSidedLightingOff()
    view.add(Specular=0.3)


@scene
def image_based_lighting(view):
    """VTK's own environment beside: the furnace has none of it, ours comes from the mapper."""
    texture = stripes()
    texture.InterpolateOn()
    texture.MipmapOn()
    texture.SetColorModeToDirectScalars()
    view.renderer.UseImageBasedLightingOn()
    view.renderer.SetEnvironmentTexture(texture)
    for part in (view.renderer.GetEnvMapIrradiance(), view.renderer.GetEnvMapPrefiltered()):
        for setter, value in (
            ("SetIrradianceSize", 8),
            ("SetIrradianceStep", 0.3),
            ("SetPrefilterSize", 8),
            ("SetPrefilterSamples", 8),
            ("SetPrefilterLevels", 2),
        ):
            if hasattr(part, setter):
                getattr(part, setter)(value)
    if hasattr(view.renderer, "UseSphericalHarmonicsOff"):
        view.renderer.UseSphericalHarmonicsOff()
    table = view.renderer.GetEnvMapLookupTable() if hasattr(view.renderer, "GetEnvMapLookupTable") else None
    if table:
        table.SetLUTSize(16)
        table.SetLUTSamples(8)
    view.add(Interpolation=3, Metallic=0.5, Roughness=0.4)


@scene(others=1.0)
def skybox(view):
    texture = stripes()
    texture.InterpolateOn()
    sky = made(vtkSkybox, Texture=texture)
    sky.SetProjectionToSphere()
    view.renderer.AddActor(sky)
    view.add()


# ---- cameras and backgrounds


@scene
def parallel_projection(view):
    view.renderer.GetActiveCamera().ParallelProjectionOn()
    view.renderer.GetActiveCamera().SetParallelScale(1.0)
    view.add(Specular=0.5)


@scene
def transparent_background(view):
    view.window.AlphaBitPlanesOn()
    view.renderer.SetBackgroundAlpha(0.0)
    view.add()


add_scene("multisamples", lambda view: view.add(), multisamples=4, others=0.1)


@scene(others=0.5, dark=True)
def smoothing(view):
    for kind in ("Line", "Point", "Polygon"):
        getattr(view.window, kind + "SmoothingOn")()
    view.add(EdgeVisibility=True)


# ---- translucency


add_scene("translucent", lambda view: view.add(plane(), Opacity=0.5), expect=(HALF,))
# Front and back of a sphere, without order: weighted by VTK's own pass.
add_scene("translucent_closed", lambda view: view.add(Opacity=0.5), **SMOOTH)


@scene(**SMOOTH)
def blended_in_order(view):
    """Without any order-independent pass: two layers, the far one first."""
    if hasattr(view.renderer, "SetUseOIT"):
        view.renderer.SetUseOIT(False)
    view.add(plane(), Opacity=0.5)
    near = view.add(plane(size=0.5), Opacity=0.5)
    near.SetPosition(0.0, 0.0, 0.5)


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


add_scene("depth_peeling", lambda view: layers(peeled(view)))


@scene(expect=(mix(HALF, FURNACE, 0.5),), others=0.05)
def depth_peeling_closed(view):
    peeled(view)
    view.add(Opacity=0.5)


def sequence(*passes):
    collection = opengl.vtkRenderPassCollection()
    for part in passes:
        collection.AddItem(part)
    return made(opengl.vtkSequencePass, Passes=collection)


def camera_pass(*passes):
    return made(opengl.vtkCameraPass, DelegatePass=sequence(*passes))


def explicit_passes(translucent_pass):
    return camera_pass(opengl.vtkLightsPass(), opengl.vtkOpaquePass(), translucent_pass)


def peeling_pass(view, cls, **settings):
    view.window.AlphaBitPlanesOn()
    view.renderer.SetPass(explicit_passes(made(cls, TranslucentPass=opengl.vtkTranslucentPass(), **settings)))
    return view


add_scene("depth_peeling_pass", lambda view: layers(peeling_pass(view, opengl.vtkDepthPeelingPass, MaximumNumberOfPeels=8)))
add_scene(
    "dual_depth_peeling_pass", lambda view: layers(peeling_pass(view, opengl.vtkDualDepthPeelingPass, MaximumNumberOfPeels=8))
)


@scene(expect=(HALF,))
def order_independent_pass(view):
    peeling_pass(view, opengl.vtkOrderIndependentTranslucentPass)
    view.add(plane(), Opacity=0.5)


add_scene("forced_translucent", lambda view: view.add().ForceTranslucentOn(), **SMOOTH)


@scene(expect=STOCK)
def hidden_lines(view):
    view.renderer.UseHiddenLineRemovalOn()
    view.add(Representation=1)
    view.add(plane(3, 0.8), Representation=1, Color=(1.0, 1.0, 0.0))


# ---- passes over the picture


def through(image_pass, view):
    image_pass.SetDelegatePass(opengl.vtkRenderStepsPass())
    view.renderer.SetPass(image_pass)


@scene(**SMOOTH)
def ssao(view):
    shade = made(opengl.vtkSSAOPass, Radius=0.3, KernelSize=8, Bias=0.01)
    view.add()
    view.add(plane()).SetPosition(0.0, 0.0, -0.3)
    through(shade, view)


def shadows(view, **settings):
    # The baker wants a light in any case: the furnace has one of no intensity.
    lamp = made(vtkLight, Position=(1.0, 1.5, 2.5), Intensity=float(view.factory.scene_lights), **settings)
    lamp.SetLightTypeToSceneLight()
    view.renderer.AddLight(lamp)
    shadow = opengl.vtkShadowMapPass()
    baker = shadow.GetShadowMapBakerPass()
    baker.SetResolution(64)
    view.renderer.SetPass(camera_pass(baker, shadow))
    view.add(sphere(radius=0.3))
    view.add(plane(1, 2.0)).SetPosition(0.0, 0.0, -0.6)
    view.renderer.ResetCameraClippingRange()


add_scene("shadow_maps_of_a_spot", lambda view: shadows(view, Positional=True, ConeAngle=40.0), lights=False, dark=True)
add_scene("shadow_maps_of_a_sun", shadows, lights=False, dark=True)


@scene(others=0.1)
def fxaa(view):
    view.renderer.UseFXAAOn()
    view.add()


@scene(others=0.15)
def ssaa(view):
    view.add()
    through(opengl.vtkSSAAPass(), view)


def toned(mapping):
    def draw(view):
        view.add()
        through(made(opengl.vtkToneMappingPass, ToneMappingType=mapping, Exposure=1.5), view)

    return draw


for mapping, (name, function) in enumerate(
    {
        "clamp": lambda x: min(x, 1.0),
        "reinhard": lambda x: x / (1.0 + x),
        "exponential": lambda x: 1.0 - math.exp(-1.5 * x),
    }.items()
):
    # The background goes through it, too, where it is opaque.
    expect = (encode(function(a) for a in ALBEDO),)
    add_scene("tone_mapping_" + name, toned(mapping), others=0.9, least=0.2, expect=expect)


@scene(**SMOOTH, dark=True)
def edl(view):
    view.add()
    through(opengl.vtkEDLShading(), view)


@scene(others=0.3)
def blur(view):
    view.add()
    through(opengl.vtkGaussianBlurPass(), view)


@scene(expect=(), others=1.0, dark=True)
def sobel(view):
    view.add()
    through(opengl.vtkSobelGradientMagnitudePass(), view)


@scene(**SMOOTH)
def depth_of_field(view):
    view.renderer.GetActiveCamera().SetFocalDisk(0.05)
    focus = made(opengl.vtkDepthOfFieldPass, AutomaticFocalDistance=False)
    view.add()
    through(focus, view)


@scene(**SMOOTH, dark=True)
def outline_glow(view):
    view.add()
    through(opengl.vtkOutlineGlowPass(), view)


# the pass itself needs lights
@scene(has_furnace=False, dark=True)
def lighting_map(view):
    """Normals as colors for relighting: the superclass's business."""
    normals = made(opengl.vtkLightingMapPass, RenderType=opengl.vtkLightingMapPass.NORMALS)
    view.renderer.SetPass(camera_pass(opengl.vtkLightsPass(), normals))
    view.add()


@scene
def framebuffer_pass(view):
    view.add()
    target = made(opengl.vtkFramebufferPass, ColorFormat=1, DelegatePass=explicit_passes(opengl.vtkTranslucentPass()))
    view.renderer.SetPass(target)


@scene(**SMOOTH)
def panorama(view):
    view.add()
    whole = made(opengl.vtkPanoramicProjectionPass, CubeResolution=64, Angle=270.0)
    view.renderer.GetActiveCamera().SetPosition(0.0, 0.0, 1.5)
    view.renderer.GetActiveCamera().SetClippingRange(0.1, 6.0)
    through(whole, view)


# ---- windows


def stereo(kind):
    def draw(view):
        view.window.SetStereoCapableWindow(1)
        view.window.SetStereoType(kind)
        view.window.StereoRenderOn()
        view.add()

    return draw


for name, kind in (("red_blue", 2), ("interlaced", 3), ("split", 9)):
    add_scene("stereo_" + name, stereo(kind), others=1.0, expect=() if kind == 2 else (FURNACE,), dark=True)


def grab_by_filter(scale, kind):
    def grab(view):
        shot = made(vtkWindowToImageFilter, Input=view.window, Scale=scale, InputBufferType=kind, ReadFrontBuffer=False)
        shot.Update()
        image = shot.GetOutput()
        data = bytes(memoryview(image.GetPointData().GetScalars()))
        if image.GetNumberOfScalarComponents() == 4:
            return data, b""
        return b"".join(data[k : k + 3] + b"\xff" for k in range(0, len(data), 3)), b""

    return grab


@scene
def tiles(view):
    view.add()
    view.grab = grab_by_filter(2, 3)


@scene
def viewports(view):
    view.renderer.SetViewport(0.0, 0.0, 0.5, 1.0)
    actor = view.add()
    right = view.add_renderer((0.5, 0.0, 1.0, 0.5))
    right.AddActor(actor)
    top = view.add_renderer((0.5, 0.5, 1.0, 1.0), lights=False)
    view.add(plane(), renderer=top)


@scene
def window_layers(view):
    view.window.SetNumberOfLayers(2)
    view.add()
    front = view.add_renderer()
    front.SetLayer(1)
    view.add(sphere(radius=0.2), renderer=front).SetPosition(0.8, 0.5, 0.0)


@scene(others=1.0, expect=())
def srgb_window(view):
    if vtkVersion().GetVTKMajorVersion() * 100 + vtkVersion().GetVTKMinorVersion() >= 903:
        raise Unavailable("since VTK 9.3 stock scenes abort under Xvfb in a window with an sRGB frame buffer")
    view.window.UseSRGBColorSpaceOn()
    view.add()


# ---- selection and picking


POINTS, CELLS = vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataObject.FIELD_ASSOCIATION_CELLS


def select(association):
    """What a selector finds in the whole view: each actor with its ids."""

    def run(view):
        view.window.Render()
        width, height = view.window.GetSize()
        selector = made(
            vtkHardwareSelector,
            Renderer=view.renderer,
            Area=(0, 0, width - 1, height - 1),
            FieldAssociation=association,
        )
        selection = selector.Select()
        found = []
        for k in range(selection.GetNumberOfNodes()):
            node = selection.GetNode(k)
            prop = node.GetProperties().Get(vtkSelectionNode.PROP())
            block = node.GetProperties().Get(vtkSelectionNode.COMPOSITE_INDEX())
            ids = node.GetSelectionList()
            ids = [ids.GetValue(i) for i in range(ids.GetNumberOfTuples())]
            found.append((view.actors.index(prop), ids, block))
        assert found, "nothing was selected"
        return sorted(found)

    return run


def selected(view, association=CELLS):
    view.add(sphere(8))
    view.add(plane(2, 0.5)).SetPosition(0.6, 0.3, 0.4)
    view.extra = select(association)


add_scene("selection_of_points", lambda view: selected(view, POINTS))
add_scene("selection_of_cells", selected)


@scene(**SMOOTH)
def selection_through_translucent(view):
    selected(view)
    view.actors[1].GetProperty().SetOpacity(0.5)


@scene(others=0.4, dark=True)
def selection_of_edges_and_wireframe(view):
    selected(view)
    view.actors[0].GetProperty().SetRepresentationToWireframe()
    view.actors[1].GetProperty().EdgeVisibilityOn()


@scene
def picking(view):
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


@scene(**SMOOTH)
def values_instead_of_colors(view):
    """vtkValuePass draws arrays: the superclass's business."""

    values = opengl.vtkValuePass()
    values.SetInputArrayToProcess(3, "Elevation")  # VTK_SCALAR_MODE_USE_POINT_FIELD_DATA
    values.SetInputComponentToProcess(0)
    view.renderer.SetPass(camera_pass(opengl.vtkLightsPass(), values))
    view.add(elevated())

    def read(view):
        view.window.Render()
        image = values.GetFloatImageDataArray(view.renderer)
        return bytes(memoryview(image)) if image else None

    view.extra = read


# ---- a program's own shader code


def replaced(view, part, code, first=True, stage="Fragment"):
    """The program's code follows the shader's own part."""
    tag = "//VTK::" + part
    add = getattr(view.actors[0].GetShaderProperty(), "Add%sShaderReplacement" % stage)
    add(tag, first, tag + "\n" + code + "\n", False)


@scene(expect=(tuple(FURNACE[k] for k in (2, 0, 1)),))
def replaced_light(view):
    """After the light: a change of the color that was written."""
    view.add()
    replaced(view, "Light::Impl", "  gl_FragData[0].rgb = gl_FragData[0].brg;")


@scene(**SMOOTH)
def replaced_light_with_stock_variables(view):
    """VTK's own examples read what the stock mapper declares."""
    view.add(Color=(0.2, 0.4, 0.6))
    replaced(view, "Light::Impl", "  gl_FragData[0] = vec4(0.5 * (ambientColor + diffuseColor), opacity);")


@scene(has_furnace=False)
def replaced_light_with_stock_sums(view):
    """The same with the sums that the stock mapper has where there are lights."""
    view.add()
    replaced(view, "Light::Impl", "  gl_FragData[0] = vec4(ambientColor + diffuse + specular, opacity);")


@scene
def replaced_normal(view):
    view.add()
    replaced(view, "Normal::Impl", "  normalVCVSOutput = normalize(normalVCVSOutput + vec3(0.1));")


@scene(expect=(FURNACE, tuple(0.5 * c for c in FURNACE)))
def replaced_vertex_position(view):
    view.add()
    replaced(view, "PositionVC::Dec", "out vec4 ownMC;", stage="Vertex")
    replaced(view, "PositionVC::Impl", "  ownMC = vertexMC;", stage="Vertex")
    replaced(view, "Light::Dec", "in vec4 ownMC;")
    replaced(view, "Light::Impl", "  if (ownMC.x > 0.0) { gl_FragData[0].rgb *= 0.5; }", first=False)


# without lights VTK has no normals for it
@scene(expect="lit stock")
def own_shader_code(view):
    """A whole fragment shader of the program's own."""
    view.add()
    view.actors[0].GetShaderProperty().SetFragmentShaderCode(
        "//VTK::System::Dec\n//VTK::Output::Dec\nin vec3 normalVCVSOutput;\n"
        "void main()\n{\n  gl_FragData[0] = vec4(abs(normalize(normalVCVSOutput)), 1.0);\n}\n"
    )


@scene(expect=(tuple(0.5 * c for c in FURNACE),))
def own_uniforms(view):
    view.add()
    view.actors[0].GetShaderProperty().GetFragmentCustomUniforms().SetUniformf("gain", 0.5)
    replaced(view, "Light::Impl", "  gl_FragData[0].rgb *= gain;")


@scene(**SMOOTH)
def own_vertex_attributes(view):
    view.add(with_tangents()).GetMapper().MapDataArrayToVertexAttribute("own", "Normals", 0, -1)
    replaced(view, "Normal::Dec", "in vec3 own;\nout vec3 ownVS;", stage="Vertex")
    replaced(view, "Normal::Impl", "  ownVS = own;", stage="Vertex")
    replaced(view, "Normal::Dec", "in vec3 ownVS;")
    replaced(view, "Light::Impl", "  gl_FragData[0].rgb *= 0.5 + 0.5 * abs(ownVS);", first=False)


@scene(expect=(FURNACE,))
def shaders_come_and_go(view):
    replaced_light(view)
    view.window.Render()
    view.actors[0].GetShaderProperty().ClearAllFragmentShaderReplacements()
    view.actors[0].Modified()
    view.window.Render()
