# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the scenes have in common: a small window, a factory of mappers, and what a picture must show.

A scene is a function that fills a View, whose mappers a factory makes. It is drawn with these factories:
stock      VTK's own mappers
plain      ours without a material: the same picture and depth, bit by bit
furnace    ours with a Lambert material in a constant environment, scene lights off: the right answer is known
material   ours with a measured material in a varied environment, the scene's lights on: no message, no black hole
brushed    the same with an anisotropic material over a set of lights
"""

import functools
import math
from array import array
from collections import Counter

import vtkmeasuredbrdf as measured
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2 as opengl
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkFloatArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

ALBEDO = (0.8, 0.5, 0.2)
BACKGROUND = (0.1, 0.2, 0.4)  # in no picture by chance
SIZE = (120, 90)


def made(cls, **properties):
    """An object of VTK with properties: made(vtkTexture, Interpolate=True)."""
    made = cls()
    set_all(made, properties)
    return made


def set_all(target, properties):
    for name, value in properties.items():
        setter = getattr(target, "Set" + name)
        setter(*value) if isinstance(value, tuple) else setter(value)


def encode(linear):
    """Display values of linear colors, as the mapper and VTK's PBR write them."""
    return tuple(min(v, 1.0) ** (1.0 / 2.2) for v in linear)


def mix(a, b, share):
    return tuple(x + (y - x) * share for x, y in zip(a, b))


FURNACE = encode(ALBEDO)  # under radiance 1 from everywhere
MAGENTA = (1.0, 0.0, 1.0)
SMOOTH = {"expect": (), "others": 1.0}  # colors run across the surface: no palette, but nothing black


SHARED = []  # the window that most scenes are drawn in


def new_window(size=SIZE, multisamples=0):
    return made(vtkRenderWindow, OffScreenRendering=1, MultiSamples=multisamples, Size=size)


class View:
    """A window with one renderer and what the scene adds; by default a perspective view down -z."""

    def __init__(self, factory, lights=True, size=SIZE, multisamples=0):
        self.factory = factory
        self.own_window = None if size == SIZE and multisamples == 0 else new_window(size, multisamples)
        self.renderers = []
        self.actors = []
        self.mappers = []
        self.keep = []  # what Python must not let go
        self.renderer = self.add_renderer(lights=lights)
        # What the furnace's picture must show, see check_picture.
        self.expect = (FURNACE,)
        self.others = 0.0  # share of pixels that may have any other color: edges, for one
        self.tolerance = 2.5  # of 255
        self.least = 0.03  # share of pixels that must have each of these colors
        self.grab = None  # instead of the window's own pixels
        self.extra = None  # more to compare: selected ids, for one
        self.at_most = {}  # shares of colors of the material's pictures
        self.may_warn = ()  # parts of documented warnings
        self.has_furnace = True  # whether the scene means something without lights
        self.dark = False  # whether black pixels are right

    @property
    def window(self):
        """A window of the scene's own, for scenes that look at it; the others share one, whose shaders are compiled."""
        if self.own_window is None:
            self.own_window = new_window()
            for renderer in self.renderers:
                self.own_window.AddRenderer(renderer)
        return self.own_window

    def share_window(self):
        self.own_window = SHARED[0] if SHARED else new_window()
        SHARED[:] = [self.own_window]
        while self.own_window.GetRenderers().GetNumberOfItems():
            self.own_window.RemoveRenderer(self.own_window.GetRenderers().GetFirstRenderer())
        for renderer in self.renderers:
            self.own_window.AddRenderer(renderer)

    def add_renderer(self, viewport=(0.0, 0.0, 1.0, 1.0), lights=True):
        renderer = vtkRenderer()
        renderer.SetViewport(*viewport)
        renderer.SetBackground(*BACKGROUND)
        renderer.AutomaticLightCreationOff()
        if lights and self.factory.scene_lights:
            light = vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(0.6, 0.8, 1.0)
            renderer.AddLight(light)
        camera = renderer.GetActiveCamera()
        camera.SetPosition(0.4, 0.3, 3.0)
        camera.SetClippingRange(1.0, 6.0)
        self.factory.light(renderer)
        self.renderers.append(renderer)
        if self.own_window:
            self.own_window.AddRenderer(renderer)
        return renderer

    def add(self, source=None, renderer=None, mapper=None, **properties):
        """An actor of a source (or data, or a sphere); properties are vtkProperty's: Opacity=0.5."""
        if mapper is None:
            mapper = self.factory.mapper()
            connect(mapper, source if source is not None else sphere())
        actor = vtkActor()
        actor.SetMapper(mapper)
        set_all(actor.GetProperty(), properties)
        (renderer or self.renderer).AddActor(actor)
        self.actors.append(actor)
        self.mappers.append(mapper)
        return actor

    def draw(self):
        """Colors, and depth where the window has it, as bytes."""
        special = self.grab or self.extra or any(renderer.GetPass() for renderer in self.renderers)
        if self.own_window is None and not special:
            self.share_window()
        self.window.Render()
        if self.grab:
            return self.grab(self)
        width, height = self.window.GetSize()
        pixels = vtkUnsignedCharArray()
        self.window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels)
        depth = vtkFloatArray()
        self.window.GetZbufferData(0, 0, width - 1, height - 1, depth)
        return bytes(memoryview(pixels)), bytes(memoryview(depth))


def connect(mapper, source):
    if hasattr(source, "GetOutputPort"):
        mapper.SetInputConnection(source.GetOutputPort())
    else:
        mapper.SetInputDataObject(source)


def sphere(resolution=12, radius=0.7, center=(0.0, 0.0, 0.0)):
    return made(vtkSphereSource, ThetaResolution=resolution, PhiResolution=resolution, Radius=radius, Center=center)


def make_environment(radiance):
    """An environment of the radiance of a column, row and channel."""
    image = made(vtkImageData, Dimensions=(64, 32, 1))
    image.AllocateScalars(VTK_FLOAT, 3)
    for y in range(32):
        for x in range(64):
            for c in range(3):
                image.SetScalarComponentFromDouble(x, y, 0, c, radiance(x, y, c))
    environment = measured.vtkEnvironment()
    assert environment.SetImage(image)
    return environment


def varied_radiance(x, y, c):
    """Blue above, brown below, brighter on one side: nothing is black."""
    low, high = ((0.5, 0.3), (0.3, 0.6), (0.2, 1.0))[c]
    return (low + (high - low) * y / 31) * (1.5 if x < 20 else 1.0)


class Stock:
    """VTK's own."""

    scene_lights = True
    has_material = False

    def mapper(self):
        return vtkPolyDataMapper()

    def composite(self):
        """The class that draws composites: vtkCompositePolyDataMapper2 until VTK 9.2, then the other."""
        from vtkmodules.vtkCommonCore import vtkVersion

        if vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() < 903:
            return opengl.vtkCompositePolyDataMapper2()
        from vtkmodules.vtkRenderingCore import vtkCompositePolyDataMapper

        return vtkCompositePolyDataMapper()

    def light(self, renderer):
        """Add the environment to a renderer."""


class Dark(Stock):
    """VTK's own without lights: what the furnace leaves to the superclass must look so."""

    scene_lights = False


class Plain(Stock):
    """Ours without a material."""

    # VTK's mappers hide nothing of the furnace.

    def mapper(self):
        return made(measured.vtkMeasuredBRDFMapper, OcclusionMode=measured.vtkMeasuredBRDFMapper.OCCLUSION_OFF)

    def composite(self):
        return made(measured.vtkCompositeMeasuredBRDFMapper, OcclusionMode=measured.vtkMeasuredBRDFMapper.OCCLUSION_OFF)


class Material(Plain):
    """Ours with a material. One material and one environment: one plan for all scenes."""

    has_material = True
    first = None

    def __init__(self):
        self.brdf = measured.vtkEmbeddedMaterials.NewBRDF("gold-paint")
        self.environment = make_environment(varied_radiance)

    def _set(self, mapper):
        mapper.SetBRDF(self.brdf)
        mapper.SetEnvironment(self.environment)
        mapper.SetErrorTolerance(0.1)  # planned sooner
        self.first = self.first or mapper  # plans live as long as a mapper that drew with them
        return mapper

    def mapper(self):
        return self._set(super().mapper())

    def composite(self):
        return self._set(super().composite())


class Brushed(Material):
    """An anisotropic material over a set of lights."""

    def __init__(self):
        super().__init__()
        self.brdf = measured.vtkAshikhminShirleyBRDF()
        self.brdf.SetDiffuse(0.3, 0.2, 0.1)
        self.brdf.SetReflectance(0.2, 0.2, 0.2)
        self.brdf.SetExponents(5.0, 40.0)

    def _set(self, mapper):
        lights = measured.vtkLightSetRadianceIntegrator()
        lights.SetNumberOfLights(16)
        mapper.SetIntegrator(lights)
        return super()._set(mapper)


class Furnace(Material):
    """A Lambert material under the same light from everywhere."""

    scene_lights = False

    def __init__(self):
        self.brdf = measured.vtkLambertBRDF()
        self.brdf.SetAlbedo(*ALBEDO)
        self.environment = make_environment(lambda x, y, c: 1.0)


def check_picture(view, pixels):
    """Whether every pixel of the furnace is background or one of the colors expected; None, or what is wrong."""
    total = len(pixels) // 4
    palette = [BACKGROUND] + list(view.expect)
    counts = [0] * len(palette)
    strays = {}
    for color, count in colors_of(pixels).items():
        for index, wanted in enumerate(palette):
            if all(abs(c - 255.0 * w) <= view.tolerance for c, w in zip(color, wanted)):
                counts[index] += count
                break
        else:
            strays[color] = count
    problems = []
    if sum(strays.values()) > view.others * total:
        worst = sorted(strays, key=strays.get)[-4:]
        problems.append(
            "%d of %d pixels have colors that are not expected, most of all %s"
            % (sum(strays.values()), total, ", ".join("%s (%d)" % (c, strays[c]) for c in worst))
        )
    for wanted, count in list(zip(palette, counts))[1:]:
        if count < view.least * total:
            problems.append(
                "%d of %d pixels are %s, at least %d expected"
                % (count, total, tuple(round(255 * w) for w in wanted), view.least * total)
            )
    return "; ".join(problems) or None


def colors_of(pixels):
    """How many pixels have each color."""
    return Counter(zip(pixels[::4], pixels[1::4], pixels[2::4]))


def count(pixels, color):
    return colors_of(pixels)[color]


def is_finite(view):
    """Whether nothing in a frame buffer of floats is NaN or infinite; not asked of scenes with passes of their own."""
    renderers = view.window.GetRenderers().GetNumberOfItems()
    if view.renderer.GetPass() or renderers > 1 or view.renderer.GetUseFXAA() or view.window.GetStereoRender():
        return True
    parts = opengl.vtkRenderPassCollection()
    steps = [opengl.vtkLightsPass(), opengl.vtkOpaquePass(), opengl.vtkTranslucentPass()]
    for step in steps:
        parts.AddItem(step)
    sequence, camera, target = opengl.vtkSequencePass(), opengl.vtkCameraPass(), opengl.vtkFramebufferPass()
    sequence.SetPasses(parts)
    camera.SetDelegatePass(sequence)
    target.SetColorFormat(opengl.vtkTextureObject.Float32)
    target.SetDelegatePass(camera)
    view.renderer.SetPass(target)
    view.window.Render()
    texture = target.GetColorTexture()
    width, height, components = texture.GetWidth(), texture.GetHeight(), texture.GetComponents()
    values = array("f", bytes(4 * width * height * components))
    assert texture.Download().Download2D(VTK_FLOAT, values, [width, height], components, [0, 0])
    target.ReleaseGraphicsResources(view.window)
    view.renderer.SetPass(None)
    return all(map(math.isfinite, values))


SCENES = {}


def scene(function=None, **settings):
    """Registers a scene under its function's name: see add_scene."""
    if function is None:
        return functools.partial(scene, **settings)
    return add_scene(function.__name__, function, **settings)


def add_scene(name, function, lights=True, multisamples=0, **settings):
    """Registers a scene: a function that fills a view. The settings are members of View, set behind it."""
    assert name not in SCENES, name

    def fill(view):
        function(view)
        for member, value in settings.items():
            assert hasattr(view, member), member
            setattr(view, member, value)

    def make(factory):
        view = View(factory, lights=lights, multisamples=multisamples)
        fill(view)
        return view

    make.__module__ = function.__module__
    SCENES[name] = make
    return fill


class Unavailable(Exception):
    """Raised by a scene that this VTK has no classes for."""
