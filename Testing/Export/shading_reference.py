#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""f of the shading models by other people's code, written down for tests that do without it.

    pip install materialx==1.39.3 usd-core moderngl numpy
    Testing/Export/shading_reference.py BUILD/bin/WriteExports -o Testing/Export/shading.json

standard_surface, open_pbr_surface   the GLSL that MaterialX generates from the .mtlx files which this project writes, run
                                     by OpenGL with one directional light
UsdPreviewSurface                    the GLSL of OpenUSD's own previewSurface.glslfx, run by OpenGL; its constant EPSILON
                                     is set to 0
glTF                                 the formulas of the specification's appendix B and of the extensions, typed in here a
                                     second time; the sheen's albedo is a fine sum
VTK                                  the text of vtkPBRFunctions.glsl and of the shader around it, typed in here a second
                                     time

OpenGL calculates in single precision.
"""

import argparse
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
PIXEL = np.array([[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [-1.0, 3.0, 0.0]], dtype="f4")


def make_pairs():
    """Local directions to the light and to the viewer: mirror, near it, grazing, retro, anywhere."""
    angles = [(0, 0, 0), (30, 30, 180), (30, 40, 170), (60, 60, 175), (75, 70, 180), (80, 20, 60), (20, 80, 300),
              (45, 45, 0), (50, 35, 90), (65, 10, 215), (15, 55, 130), (85, 84, 179)]
    pairs = []
    for k, (theta_i, theta_o, between) in enumerate(angles):
        turn = 0.7 * k  # the view's azimuth, for anisotropic models
        light = direction(math.radians(theta_i), turn + math.radians(between))
        pairs.append((light, direction(math.radians(theta_o), turn)))
    return pairs


def direction(theta, phi):
    return np.array([math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)])


def mix(a, b, t):
    return a + (b - a) * t


class Geometry:
    def __init__(self, light, view):
        self.L, self.V = light, view
        self.H = (light + view) / np.linalg.norm(light + view)
        self.NdotL, self.NdotV, self.NdotH = light[2], view[2], self.H[2]
        self.VdotH = float(view @ self.H)
        self.schlick = (1.0 - abs(self.VdotH)) ** 5


# glTF 2.0, appendix B


def gltf_specular_brdf(g, alpha):
    a2 = alpha**2
    d = a2 / (math.pi * (g.NdotH**2 * (a2 - 1.0) + 1.0) ** 2)
    shadow_l = 2.0 * g.NdotL / (g.NdotL + math.sqrt(a2 + (1.0 - a2) * g.NdotL**2))
    shadow_v = 2.0 * g.NdotV / (g.NdotV + math.sqrt(a2 + (1.0 - a2) * g.NdotV**2))
    return d * shadow_l * shadow_v / (4.0 * g.NdotL * g.NdotV)


def gltf_anisotropic_brdf(g, alpha, strength, rotation):
    t = np.array([math.cos(rotation), math.sin(rotation), 0.0])
    b = np.cross([0.0, 0.0, 1.0], t)
    at, ab = mix(alpha, 1.0, strength**2), alpha
    f = np.array([ab * (t @ g.H), at * (b @ g.H), at * ab * g.NdotH])
    w2 = at * ab / (f @ f)
    d = at * ab * w2 * w2 / math.pi
    ggx_v = g.NdotL * math.sqrt((at * (t @ g.V)) ** 2 + (ab * (b @ g.V)) ** 2 + g.NdotV**2)
    ggx_l = g.NdotV * math.sqrt((at * (t @ g.L)) ** 2 + (ab * (b @ g.L)) ** 2 + g.NdotL**2)
    return d * 0.5 / (ggx_v + ggx_l)


def charlie_l(x, alpha_g):
    s = (1.0 - alpha_g) ** 2
    a, b = mix(21.5473, 25.3245, s), mix(3.82987, 3.32435, s)
    c, d = mix(0.19823, 0.16801, s), mix(-1.97760, -1.27393, s)
    return a / (1.0 + b * x**c) + d * x + mix(-4.32054, -4.85967, s)


def charlie_lambda(cosine, alpha_g):
    low = np.exp(charlie_l(np.minimum(cosine, 0.5), alpha_g))
    high = np.exp(2.0 * charlie_l(0.5, alpha_g) - charlie_l(1.0 - np.maximum(cosine, 0.5), alpha_g))
    return np.where(np.asarray(cosine) < 0.5, low, high)


def charlie(ndl, ndv, ndh, roughness):
    alpha_g = roughness**2
    d = (2.0 + 1.0 / alpha_g) * (1.0 - np.minimum(ndh, 1.0) ** 2) ** (0.5 / alpha_g) / (2.0 * math.pi)
    return d / ((1.0 + charlie_lambda(ndv, alpha_g) + charlie_lambda(ndl, alpha_g)) * 4.0 * ndv * ndl)


def charlie_albedo(ndv, roughness, steps=800):
    z = (np.arange(steps) + 0.5) / steps
    phi = (np.arange(steps) + 0.5) / steps * math.pi
    z, phi = np.meshgrid(z, phi)
    s = np.sqrt(1.0 - z * z)
    v = np.array([math.sqrt(1.0 - ndv * ndv), 0.0, ndv])
    ldv = s * np.cos(phi) * v[0] + z * v[2]
    ndh = (z + ndv) / np.sqrt(2.0 + 2.0 * ldv)
    return float(np.mean(z * charlie(z, ndv, ndh, roughness)) * 2.0 * math.pi)


def shade_gltf(values, light, view):
    g = Geometry(light, view)
    get = lambda name, default: np.array(values.get(name, default), dtype=float)
    base, metallic = get("baseColorFactor", 1.0), get("metallicFactor", 1.0)
    alpha = get("roughnessFactor", 1.0) ** 2
    strength = get("anisotropyStrength", 0.0)
    lobe = gltf_specular_brdf(g, alpha)
    if strength > 0.0:
        lobe = gltf_anisotropic_brdf(g, alpha, strength, get("anisotropyRotation", 0.0))
    weight = get("specularFactor", 1.0)
    f0 = np.minimum(0.04 * get("specularColorFactor", [1.0, 1.0, 1.0]), 1.0) * weight
    fresnel = mix(f0, weight, g.schlick)
    dielectric = fresnel * lobe + (1.0 - fresnel.max()) * base / math.pi
    metal = mix(base, 1.0, g.schlick) * lobe
    f = mix(dielectric, metal, metallic)
    sheen = get("sheenColorFactor", [0.0, 0.0, 0.0])
    if sheen.max() > 0.0:
        r = float(get("sheenRoughnessFactor", 0.0))
        scale = 1.0 - sheen.max() * max(charlie_albedo(g.NdotV, r), charlie_albedo(g.NdotL, r))
        f = sheen * charlie(g.NdotL, g.NdotV, g.NdotH, r) + f * scale
    share = get("clearcoatFactor", 0.0) * mix(0.04, 1.0, (1.0 - g.NdotV) ** 5)
    if share > 0.0:
        f = mix(f, gltf_specular_brdf(g, get("clearcoatRoughnessFactor", 0.0) ** 2), share)
    return f


# VTK 9.1 to 9.6


def vtk_specular_isotropic(g, roughness):
    a = roughness * roughness
    d = (g.NdotH * a * a - g.NdotH) * g.NdotH + 1.0
    a2 = roughness * roughness
    ggx_v = g.NdotL * math.sqrt(a2 + g.NdotV * (g.NdotV - a2 * g.NdotV))
    ggx_l = g.NdotV * math.sqrt(a2 + g.NdotL * (g.NdotL - a2 * g.NdotL))
    return a * a / (math.pi * d * d) * 0.5 / (ggx_v + ggx_l)


def vtk_specular_anisotropic(g, roughness, anisotropy, rotation):
    n = np.array([0.0, 0.0, 1.0])
    r2pi = rotation * 2.0 * math.pi
    s, c = -math.sin(r2pi), math.cos(r2pi)
    t = c * np.array([1.0, 0.0, 0.0]) - s * np.cross(n, [1.0, 0.0, 0.0])
    b = np.cross(n, t)
    aspect = math.sqrt(1.0 - 0.9 * anisotropy)
    at, ab = max(roughness**2 / aspect, 0.001), max(roughness**2 * aspect, 0.001)
    a2 = at * ab
    d = np.array([ab * (t @ g.H), at * (b @ g.H), a2 * g.NdotH])
    b2 = a2 / (d @ d)
    length = lambda v: math.sqrt((at * (t @ v)) ** 2 + (ab * (b @ v)) ** 2 + v[2] ** 2)
    return a2 * b2 * b2 / math.pi * 0.5 / (g.NdotL * length(g.V) + g.NdotV * length(g.L))


def shade_vtk(values, light, view):
    g = Geometry(light, view)
    reflectance = lambda to, start: ((to - start) / (to + start)) ** 2
    albedo, metallic = np.array(values["Color"]), values["Metallic"]
    strength, coat_ior = values.get("CoatStrength", 0.0), values.get("CoatIOR", 2.0)
    ior = values.get("BaseIOR", 1.5)
    base_f0 = mix(reflectance(ior, 1.0), reflectance(ior, coat_ior), strength)
    f0 = mix(np.full(3, base_f0), albedo, metallic)
    f90 = mix(np.full(3, min(max(f0.sum() * 50.0 * 0.33, 0.0), 1.0)), np.array(values.get("EdgeTint", [1, 1, 1])), metallic)
    fresnel = f0 + (f90 - f0) * g.schlick
    if "Anisotropy" in values:
        lobe = vtk_specular_anisotropic(g, values["Roughness"], values["Anisotropy"], values["AnisotropyRotation"])
    else:
        lobe = vtk_specular_isotropic(g, values["Roughness"])
    specular = lobe * fresnel
    diffuse = (1.0 - metallic) * (1.0 - fresnel) * albedo / math.pi
    if strength == 0.0:
        return diffuse + specular
    coat_f0 = reflectance(coat_ior, 1.0)
    fc = coat_f0 + (1.0 - coat_f0) * g.schlick
    layer = vtk_specular_isotropic(g, values["CoatRoughness"]) * fc * strength
    fc *= strength
    return layer + specular * (1.0 - fc) ** 2 + diffuse * (1.0 - fc)


# OpenGL


class Screen:
    """One pixel of 32-bit floats."""

    def __init__(self):
        import moderngl

        self.context = moderngl.create_standalone_context(backend="egl")
        self.target = self.context.framebuffer([self.context.texture((1, 1), 4, dtype="f4")])

    def compile(self, vertex, fragment):
        return self.context.program(vertex_shader=vertex, fragment_shader=fragment)

    def draw(self, program, attributes):
        """attributes: name -> 3 x n array; the triangle covers the pixel, and all are constant but the position."""
        buffers = [(self.context.buffer(np.asarray(a, dtype="f4").tobytes()), f"{np.shape(a)[1]}f", name)
                   for name, a in attributes.items() if name in program]
        self.target.use()
        self.context.clear()
        self.context.vertex_array(program, buffers).render()
        return np.frombuffer(self.target.read(components=4, dtype="f4"), dtype="f4")[:3].astype(float)


def set_uniforms(program, values):
    for name, value in values.items():
        if name in program:
            program[name].value = tuple(np.ravel(value)) if np.ndim(value) else value


def generate_materialx(path):
    """The vertex and fragment shader of the document's one material."""
    import MaterialX as mx
    import MaterialX.PyMaterialXGenGlsl as mx_glsl
    import MaterialX.PyMaterialXGenShader as mx_gen

    search = mx.getDefaultDataSearchPath()
    library = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), search, library)
    document = mx.createDocument()
    mx.readFromXmlFile(document, path)
    document.importLibrary(library)
    generator = mx_glsl.GlslShaderGenerator.create()
    context = mx_gen.GenContext(generator)
    context.registerSourceCodeSearchPath(search)
    options = context.getOptions()
    options.hwMaxActiveLightSources = 1
    options.hwSpecularEnvironmentMethod = mx_gen.HwSpecularEnvironmentMethod.SPECULAR_ENVIRONMENT_NONE
    mx_gen.HwShaderGenerator.bindLightShader(document.getNodeDef("ND_directional_light"), 1, context)
    (material,) = mx_gen.findRenderableElements(document)
    shader = generator.generate("check", material, context)
    return shader.getSourceCode(mx_gen.VERTEX_STAGE), shader.getSourceCode(mx_gen.PIXEL_STAGE)


def shade_materialx(screen, path, pairs):
    vertex, fragment = generate_materialx(path)
    # Without an environment, 1.39.3 forgets to declare this one.
    fragment = re.sub(r"(#version.*\n)", r"\1#define u_refractionTwoSided false\n", fragment, count=1)
    program = screen.compile(vertex, fragment)
    identity = np.eye(4)
    results = []
    for light, view in pairs:
        set_uniforms(program, {
            "u_worldMatrix": identity, "u_viewProjectionMatrix": identity, "u_worldInverseTransposeMatrix": identity,
            "u_numActiveLightSources": 1, "u_lightData[0].type": 1, "u_lightData[0].direction": -light,
            "u_lightData[0].color": [1.0, 1.0, 1.0], "u_lightData[0].intensity": 1.0, "u_viewPosition": 1e3 * view,
        })
        rgb = screen.draw(program, {
            "i_position": PIXEL, "i_normal": [[0, 0, 1]] * 3, "i_tangent": [[1, 0, 0]] * 3,
        })
        results.append(rgb / light[2])
    return results


PREVIEW_MAIN = """#version 330
#define PI 3.14159265358979
struct LightingContributions { vec3 diffuse; vec3 specular; };
%s
uniform vec3 light, view, diffuseColor;
uniform float ior, metallic, roughness, clearcoat, clearcoatRoughness;
out vec4 result;
void main()
{
  vec3 h = normalize(light + view);
  LightingContributions c = evaluateLight(diffuseColor, false, ior, metallic, 1.0, vec3(0.0), roughness, clearcoat,
    vec3(1.0), clearcoatRoughness, 1.0, light.z, view.z, h.z, dot(view, h), vec3(1.0), vec3(1.0));
  result = vec4((c.diffuse + c.specular) / light.z, 1.0);
}
"""


def shade_preview_surface(screen, values, pairs):
    import pxr

    path = os.path.join(os.path.dirname(pxr.__file__), "pluginfo/usdShaders/resources/shaders/previewSurface.glslfx")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    text = re.search(r"-- glsl Preview\.Lighting\n(.*?)-- glsl", text, re.DOTALL).group(1)
    text = text.replace("#define EPSILON 0.001", "#define EPSILON 0.0").replace("const float R =", "float R =")
    program = screen.compile("#version 330\nin vec3 i_position;\nvoid main() { gl_Position = vec4(i_position, 1.0); }",
                             PREVIEW_MAIN % text)
    results = []
    for light, view in pairs:
        set_uniforms(program, {"ior": 1.5, "clearcoat": 0.0, "clearcoatRoughness": 0.01, **values, "light": light,
                               "view": view})
        results.append(screen.draw(program, {"i_position": PIXEL}))
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("writer", metavar="WRITER", help="the program WriteExports of the build")
    parser.add_argument("-o", "--output", required=True, help="JSON file to write")
    arguments = parser.parse_args()
    screen = Screen()
    cases_path = os.path.join(HERE, "cases.json")
    with open(cases_path, encoding="ascii") as file:
        cases = json.load(file)
    pairs = make_pairs()
    results = []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([arguments.writer, cases_path, folder], check=True)
        for case in cases:
            values = case["values"]
            if case["model"] == "gltf":
                f = [shade_gltf(values, *pair) for pair in pairs]
            elif case["model"] == "vtk_pbr":
                f = [shade_vtk(values, *pair) for pair in pairs]
            elif case["model"] == "preview_surface":
                f = shade_preview_surface(screen, values, pairs)
            else:
                f = shade_materialx(screen, os.path.join(folder, case["name"] + ".mtlx"), pairs)
            results.append({"name": case["name"], "f": [[float(f"{x:.7g}") for x in rgb] for rgb in f]})
    record = {
        "format": "measured-brdf shading models", "version": 1, "renderer": screen.context.info["GL_RENDERER"],
        "pairs": [{"i": list(light), "o": list(view)} for light, view in pairs], "results": results,
    }
    # A line for each pair and each case.
    fields = [f' "{key}": [\n  ' + ",\n  ".join(map(json.dumps, value)) + "\n ]" if isinstance(value, list)
              else f' "{key}": {json.dumps(value)}' for key, value in record.items()]
    with open(arguments.output, "w", encoding="ascii") as file:
        file.write("{\n" + ",\n".join(fields) + "\n}\n")


if __name__ == "__main__":
    sys.exit(main())
