# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""What surfaces hide from themselves: the figures of docs/methods/self-occlusion.md and, with --bounce, of bounced-light.md.

The error of drawing without it, with a factor of ambient occlusion, with vtkSurfaceVisibilityFilter's arrays (black) and with
--bounce also with one bounce, over meshes x materials x maps; and the time of a frame. A line of CSV for each.

The truth of a pixel is what the mapper draws without occlusion, times the share of its light that traced samples find visible, so
errors are those of occlusion alone. With --bounce, what the same samples find with a bounce and not without comes to it; two seeds
tell its noise.
"""

import argparse
import itertools
import math
import time
from array import array

import numpy as np
import vtkmeasuredbrdf as measured
import vtkmodules.vtkRenderingOpenGL2 as opengl
from common import Environment, find_environment, find_material, get_stem, make, to_array
from meshes import HIDING, make_hiding
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow

SIDE = 500
LAMP_DEGREES = 1.2  # as planners have it
MODES = ("off", "black", "bounce")
MATTE = {"lambert": (1.0, 1.0, 1.0), "grey": (0.5, 0.5, 0.5), "orange": (0.7, 0.3, 0.1)}


def make_material(name):
    if name in MATTE:
        return make(measured.vtkLambertBRDF, Albedo=MATTE[name])
    if name.startswith("blinn"):
        return make(measured.vtkBlinnPhongBRDF, Specular=(0.5, 0.5, 0.5), Exponent=float(name[5:]))
    found = find_material(f"rgl/{name}_rgb.bsdf") or find_material(name)
    return found and found.brdf


class Window:
    """An offscreen window with a frame buffer of floats, and the rays of its pixels."""

    def __init__(self, mapper, surface):
        self.renderer = make(vtkRenderer, AutomaticLightCreation=False, EnvironmentUp=(0.0, 1.0, 0.0))
        self.renderer.AddActor(make(vtkActor, Mapper=mapper))
        self.window = make(vtkRenderWindow, OffScreenRendering=1, MultiSamples=0, Size=(SIDE, SIDE))
        self.window.AddRenderer(self.renderer)
        center, size = np.array(surface.GetCenter()), surface.GetLength()
        self.eye = center + size * np.array((0.9, 0.8, 1.3))
        camera = self.renderer.GetActiveCamera()
        camera.SetFocalPoint(center)
        camera.SetPosition(self.eye)
        camera.SetViewUp(0.0, 1.0, 0.0)
        camera.SetViewAngle(32.0)
        camera.SetClippingRange(0.1 * size, 10.0 * size)
        forward = (center - self.eye) / np.linalg.norm(center - self.eye)
        right = np.cross(forward, (0.0, 1.0, 0.0))
        right /= np.linalg.norm(right)
        self.axes = right, np.cross(right, forward), forward
        steps = opengl.vtkRenderPassCollection()
        steps.AddItem(opengl.vtkLightsPass())
        steps.AddItem(opengl.vtkOpaquePass())
        self.camera_pass = make(opengl.vtkCameraPass, DelegatePass=make(opengl.vtkSequencePass, Passes=steps))
        self.target = make(opengl.vtkFramebufferPass, DelegatePass=self.camera_pass)
        self.target.SetColorFormat(opengl.vtkTextureObject.Float32)
        self.renderer.SetPass(self.target)

    def get_directions(self, x, y):
        """Through the middles of pixels."""
        right, up, forward = self.axes
        scale = math.tan(math.radians(16.0))
        across, along = ((2.0 * (at + 0.5) / SIDE - 1.0)[:, None] * scale for at in (x, y))
        return forward + across * right + along * up

    def draw(self):
        self.window.Render()
        self.window.WaitForCompletion()

    def render(self):
        """Display values, shape (SIDE, SIDE, 3), from the bottom."""
        self.draw()
        texture = self.target.GetColorTexture()
        components = texture.GetComponents()
        values = array("f", bytes(4 * SIDE * SIDE * components))
        assert texture.Download().Download2D(VTK_FLOAT, values, [SIDE, SIDE], components, [0, 0])
        return np.frombuffer(values, np.float32).reshape(SIDE, SIDE, components)[..., :3]


def write(file, picture):
    image = make(vtkImageData, Dimensions=(SIDE, SIDE, 1))
    image.GetPointData().SetScalars(to_array((255.0 * picture.clip(0.0, 1.0) + 0.5).astype(np.uint8).reshape(-1, 3)))
    make(vtkPNGWriter, InputData=image, FileName=file).Write()


def find_pixels(scene, window, count):
    """So many pixels that show the surface not at a grazing angle: their places, what their rays hit, and views."""
    x, y = np.random.default_rng(7).integers(0, SIDE, (2, 20 * count))
    directions = window.get_directions(x, y)
    views = -directions / np.linalg.norm(directions, axis=1, keepdims=True)

    def cast(chosen):
        hits = vtkPolyData()
        assert scene.CastRays(to_array(np.tile(window.eye, (len(chosen), 1))), to_array(directions[chosen]), hits)
        return hits

    arrays = cast(np.arange(len(x))).GetPointData()
    facing = (vtk_to_numpy(arrays.GetArray("Normals")) * views).sum(axis=1) > 0.05  # false for NaN
    chosen = np.flatnonzero(facing & (vtk_to_numpy(arrays.GetArray("Surface")) >= 0))[:count]
    return (y[chosen], x[chosen]), cast(chosen), to_array(views[chosen])


def trace(scene, points, material, environment, samples, bounces=0, seed=0):
    """Radiance, and radiance if nothing were hidden, of the same samples."""
    integrator = make(measured.vtkTracedRadianceIntegrator, Scene=scene, BRDF=material, Environment=environment,
                      NumberOfSamples=samples, NumberOfBounces=bounces, Seed=seed, UnoccludedReference=False)  # fmt: skip
    radiance, unoccluded = vtkDoubleArray(), vtkDoubleArray()
    assert integrator.Integrate(*points, radiance, unoccluded)
    return vtk_to_numpy(radiance), vtk_to_numpy(unoccluded)


def trace_bounce(*case, samples):
    """What one bounce adds, and the sum of its standard errors."""
    first, second = (trace(*case, samples, 1, seed)[0] - trace(*case, samples, 0, seed)[0] for seed in range(2))
    return 0.5 * (first + second), 0.5 * np.abs(first - second).sum()


def set_mode(mapper, mode):
    mapper.SetOcclusionMode(mapper.OCCLUSION_OFF if mode == "off" else mapper.OCCLUSION_ON)
    mapper.SetOcclusionBounce(mode == "bounce")


def time_frames(mapper, window, modes, rounds):
    """The least processor time of a frame by each mode, in ms."""
    least = {mode: math.inf if mode in modes and rounds else 0.0 for mode in MODES}
    for _, mode in itertools.product(range(rounds), modes):
        set_mode(mapper, mode)
        window.draw()
        begin = time.process_time()
        window.draw()
        window.draw()
        least[mode] = min(least[mode], 500.0 * (time.process_time() - begin))
    return list(least.values())


def measure(name, materials, maps, options):
    """A line for each material and map; returns their errors."""
    surface = make_hiding(name)
    visibility = make(measured.vtkSurfaceVisibilityFilter, BothSides=options.bounce)
    visibility.SetInputData(surface)
    if options.rays:
        visibility.SetNumberOfRays(options.rays)
    times = [time.process_time()]
    for bounce in (False, options.bounce):
        visibility.SetBounce(bounce)
        visibility.Update()
        times.append(time.process_time())
    scene = measured.vtkTracedScene()
    scene.AddSurface(surface)
    mapper = measured.vtkMeasuredBRDFMapper()
    mapper.SetInputConnection(visibility.GetOutputPort())
    window = Window(mapper, surface)
    places, *points = find_pixels(scene, window, options.pixels)
    white = Environment(np.ones((32, 64, 3), np.float32)).environment
    seen, everything = trace(scene, points, make_material("lambert"), white, options.truth)
    ambient = seen / everything
    modes = MODES if options.bounce else MODES[:2]
    rows = []
    for (material_name, material), (map_name, environment) in itertools.product(materials.items(), maps.items()):
        mapper.SetBRDF(material)
        mapper.SetEnvironment(environment)
        mapper.SetIntegrator(make(measured.vtkHybridRadianceIntegrator, LightAngle=LAMP_DEGREES))
        shown = {}
        for mode in modes:
            set_mode(mapper, mode)
            picture = window.render()
            shown[mode] = picture[places].astype(float) ** 2.2
            if options.pictures:
                write(f"{options.pictures}/{name}-{material_name}-{get_stem(map_name)}-{mode}.png", picture)
        case = scene, points, material, environment
        seen, everything = trace(*case, options.truth)
        truth = shown["off"] * seen / np.maximum(everything, 1e-12)
        noise = 0.0
        if options.bounce:
            added, noise = trace_bounce(*case, samples=options.samples // 2)
            truth += added
        drawn = [shown["off"], shown["off"] * ambient, shown["black"], shown.get("bounce", truth)]
        errors = [100.0 * np.abs(radiance - truth).sum() / truth.sum() for radiance in drawn]
        cells = [name, surface.GetNumberOfPoints(), f"{times[1] - times[0]:.2f}", f"{times[2] - times[1]:.2f}", material_name,
                 map_name, f"{100.0 * noise / truth.sum():.2f}", *(f"{error:.2f}" for error in errors),
                 *(f"{frame:.1f}" for frame in time_frames(mapper, window, modes, options.rounds))]  # fmt: skip
        print(",".join(map(str, cells)), flush=True)
        rows.append(errors)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bounce", action="store_true", help="compare with traced light that bounces once")
    parser.add_argument("--meshes", nargs="+", help=f"{', '.join(HIDING)}, or .vtp files with point normals")
    parser.add_argument("--maps", nargs="+", help="files of the data folder, or embedded names")
    parser.add_argument("--materials", nargs="+", help="lambert, grey, orange, blinnEXPONENT, or names of RGL's files")
    parser.add_argument("--pixels", type=int, default=300, help="of each picture")
    parser.add_argument("--truth", type=int, default=8192, help="traced directions of each pixel, for what is visible")
    parser.add_argument("--samples", type=int, default=1024, help="traced directions of each pixel, for a bounce")
    parser.add_argument("--rays", type=int, default=0, help="from each point; 0: as the filter has it")
    parser.add_argument("--rounds", type=int, default=0, help="of frames for times; 0: none")
    parser.add_argument("--pictures", help="folder for pictures")
    options = parser.parse_args()
    if options.bounce:
        usual = (("gear", "isosurface", "knob", "molecule"), ("city.exr", "interior.exr", "studio.exr"),
                 ("lambert", "grey", "orange", "blinn50", "satin_purple"))  # fmt: skip
    else:
        usual = (("bumps", "gear", "isosurface", "knob", "molecule", "torus"),
                 ("city.exr", "courtyard.exr", "interior.exr", "studio.exr", "sunset.exr", "pmndrs_sunrise.hdr"),
                 ("lambert", "blinn50", "blinn400", "cardboard", "satin_purple", "vch_ultra_pink"))  # fmt: skip
    meshes, map_names, names = (asked or usually for asked, usually in
                                zip((options.meshes, options.maps, options.materials), usual))  # fmt: skip
    found = {name: find_environment(name) for name in map_names}
    maps = {name: environment.environment for name, environment in found.items() if environment}
    materials = {name: material for name in names if (material := make_material(name))}
    print("mesh,points,trace s,bounce s,material,map,noise %,off %,ambient %,black %,bounce %,"
          "frame off ms,frame black ms,frame bounce ms")  # fmt: skip
    rows = np.array([row for mesh in meshes for row in measure(mesh, materials, maps, options)])
    for name, row in (("mean", rows.mean(axis=0)), ("worst", rows.max(axis=0))):
        print(f"{name},,,,,,," + ",".join(f"{error:.2f}" for error in row))
    worse = rows[:, 3] > rows[:, 2] if options.bounce else rows[:, 2] > rows[:, 0]
    print(f"worse than {'black' if options.bounce else 'off'},{worse.sum()} of {len(rows)}")


if __name__ == "__main__":
    main()
