// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The shading models that are written down as formulas of one light:
//
// glTF 2.0's metallic-roughness material. The core is appendix B of the specification (Khronos
// 2021), in its normative form: a mix of a metal and of a dielectric. KHR_materials_specular,
// _clearcoat, _sheen and _anisotropy are as their specifications define them (all ratified by
// Khronos).
//
// UsdPreviewSurface with the metallic workflow (UsdPreviewSurface specification 2.6). The
// specification names the inputs and leaves the formulas to the renderer; these are of the shader
// that OpenUSD publishes, usdShaders/shaders/previewSurface.glslfx (Pixar), without the constant
// 0.001 that it adds against divisions by zero.
//
// VTK's physically based shading, as in its fragment shader (VTK 9.1 to 9.6: vtkPBRFunctions.glsl
// and vtkOpenGLPolyDataMapper::ReplaceShaderLight). Image-based lighting approximates the sum of
// this over all directions.
#include "Lobes.h"

#include <algorithm>
#include <cmath>

namespace tool
{
namespace
{
using glm::dvec3;

struct GltfValues
{
  dvec3 BaseColor;
  double Metallic, Roughness, SpecularFactor;
  dvec3 SpecularColor;
  double Clearcoat, ClearcoatRoughness;
  dvec3 SheenColor;
  double SheenRoughness, AnisotropyStrength, AnisotropyRotation;
};

struct PreviewValues
{
  dvec3 DiffuseColor;
  double Metallic, Roughness, Index, Clearcoat, ClearcoatRoughness;
};

struct VtkValues
{
  dvec3 Color;
  double Metallic, Roughness, BaseIndex;
  dvec3 EdgeTint;
  double CoatStrength, CoatRoughness, CoatIndex, Anisotropy, Rotation;
};

constexpr double DielectricF0 = 0.04; // of an index of 1.5

//------------------------------------------------------------------------------
double Mix(double a, double b, double t) { return a + (b - a) * t; }

//------------------------------------------------------------------------------
// The fit L of the sheen's shadowing (Estevez and Kulla 2017, table 1).
double FitCharlie(double x, double alpha)
{
  const double t = Square(1.0 - alpha);
  const double a = Mix(21.5473, 25.3245, t);
  const double b = Mix(3.82987, 3.32435, t);
  const double c = Mix(0.19823, 0.16801, t);
  const double d = Mix(-1.97760, -1.27393, t);
  const double e = Mix(-4.32054, -4.85967, t);
  return a / (1.0 + b * std::pow(x, c)) + d * x + e;
}

//------------------------------------------------------------------------------
double ShadowCharlie(double cosine, double alpha)
{
  return cosine < 0.5 ? std::exp(FitCharlie(cosine, alpha))
                      : std::exp(2.0 * FitCharlie(0.5, alpha) - FitCharlie(1.0 - cosine, alpha));
}

//------------------------------------------------------------------------------
// The sheen lobe D V of KHR_materials_sheen (Estevez and Kulla 2017).
double GetCharlieSheen(double ndl, double ndv, double ndh, double roughness)
{
  const double alpha = Square(roughness);
  const double sine2 = std::max(1.0 - ndh * ndh, 0.0);
  const double d = (2.0 + 1.0 / alpha) * std::pow(sine2, 0.5 / alpha) / (2.0 * Pi);
  const double shadow = 1.0 + ShadowCharlie(ndv, alpha) + ShadowCharlie(ndl, alpha);
  return d / (shadow * 4.0 * ndv * ndl);
}

//------------------------------------------------------------------------------
// Integral of the sheen lobe times the cosine over the hemisphere.
double IntegrateCharlie(double ndv, double roughness)
{
  constexpr int cosines = 64;
  constexpr int azimuths = 48;
  const double r = std::sqrt(1.0 - ndv * ndv);
  double sum = 0.0;
  for (int j = 0; j < cosines; ++j)
  {
    const double ndl = (j + 0.5) / cosines;
    const double s = std::sqrt(1.0 - ndl * ndl);
    for (int k = 0; k < azimuths; ++k)
    {
      const double phi = Pi * (k + 0.5) / azimuths; // the other half is the same
      const double ldv = s * r * std::cos(phi) + ndl * ndv;
      const double ndh = (ndl + ndv) / std::sqrt(std::max(2.0 + 2.0 * ldv, 1e-12));
      sum += ndl * GetCharlieSheen(ndl, ndv, std::min(ndh, 1.0), roughness);
    }
  }
  return 2.0 * Pi * sum / (cosines * azimuths);
}

//------------------------------------------------------------------------------
// Its directional albedo, by a table over the view's cosine and the roughness that is computed
// once, at the middles of a grid's cells.
double GetCharlieAlbedo(double ndv, double roughness)
{
  constexpr int size = 24;
  static const std::vector<double> table = []()
  {
    std::vector<double> albedos;
    for (int k = 0; k < size * size; ++k)
    {
      albedos.push_back(IntegrateCharlie((k % size + 0.5) / size, (k / size + 0.5) / size));
    }
    return albedos;
  }();
  const double u = std::clamp(ndv * size - 0.5, 0.0, size - 1.0);
  const double v = std::clamp(roughness * size - 0.5, 0.0, size - 1.0);
  const int x = std::min(static_cast<int>(u), size - 2);
  const int y = std::min(static_cast<int>(v), size - 2);
  const double* at = &table[y * size + x];
  return Mix(Mix(at[0], at[1], u - x), Mix(at[size], at[size + 1], u - x), v - y);
}

//------------------------------------------------------------------------------
// V D of the base (appendix B.3.2; KHR_materials_anisotropy without the clamp of its sample code,
// which would darken grazing reflection).
double GetGltfSpecular(const GltfValues& v, const Directions& d, double alpha)
{
  const double strength = v.AnisotropyStrength;
  if (strength == 0.0)
  {
    return DistributeGGX(d.Half, alpha, alpha) * ShadowSeparately(d.NdL, d.NdV, alpha * alpha);
  }
  const double angle = v.AnisotropyRotation;
  const Directions turned(Turn(d.Light, angle), Turn(d.View, angle));
  const double along = Mix(alpha, 1.0, strength * strength);
  return DistributeGGX(turned.Half, along, alpha) * ShadowTogether(turned, along, alpha);
}

//------------------------------------------------------------------------------
double GetSheenScale(const GltfValues& v, const Directions& d)
{
  const double most = glm::max(glm::max(v.SheenColor.x, v.SheenColor.y), v.SheenColor.z);
  const double roughness = v.SheenRoughness;
  return std::max(
    1.0 - most * std::max(GetCharlieAlbedo(d.NdV, roughness), GetCharlieAlbedo(d.NdL, roughness)),
    0.0);
}

//------------------------------------------------------------------------------
dvec3 ShadeGltf(const double* numbers, const Directions& d)
{
  const auto v = ReadValues<GltfValues>(numbers);
  const dvec3 base = v.BaseColor;
  const double specular = GetGltfSpecular(v, d, Square(v.Roughness));
  const double s = Schlick(d.VdH);
  // dielectric_brdf of KHR_materials_specular; with neutral values that of appendix B.
  const double weight = v.SpecularFactor;
  const dvec3 f0 = weight * glm::min(DielectricF0 * v.SpecularColor, dvec3(1.0));
  const dvec3 fresnel = f0 + (dvec3(weight) - f0) * s;
  const double most = glm::max(glm::max(fresnel.x, fresnel.y), fresnel.z);
  const dvec3 dielectric = fresnel * specular + (1.0 - most) * base / Pi;
  const dvec3 metal = (base + (dvec3(1.0) - base) * s) * specular;
  dvec3 f = glm::mix(dielectric, metal, v.Metallic);

  const dvec3 sheen = v.SheenColor;
  if (sheen != dvec3(0.0))
  {
    f = f * GetSheenScale(v, d) + sheen * GetCharlieSheen(d.NdL, d.NdV, d.NdH, v.SheenRoughness);
  }
  const double coat = v.Clearcoat;
  if (coat > 0.0)
  {
    // fresnel_coat of appendix B takes n.v.
    const double share = coat * (DielectricF0 + (1.0 - DielectricF0) * Schlick(d.NdV));
    const double alpha = Square(v.ClearcoatRoughness);
    const double lobe =
      DistributeGGX(d.Half, alpha, alpha) * ShadowSeparately(d.NdL, d.NdV, alpha * alpha);
    f = glm::mix(f, dvec3(lobe), share);
  }
  return f;
}

//------------------------------------------------------------------------------
// GGX with Schlick's form of Smith's shadowing (Karis 2013), k = alpha / 2.
double GetPreviewLobe(const Directions& d, double roughness)
{
  const double alpha = roughness * roughness;
  const double k = 0.5 * alpha;
  const auto part = [k](double c) { return c * (1.0 - k) + k; };
  return DistributeGGX(d.Half, alpha, alpha) / (4.0 * part(d.NdL) * part(d.NdV));
}

//------------------------------------------------------------------------------
dvec3 ShadePreviewSurface(const double* numbers, const Directions& d)
{
  const auto v = ReadValues<PreviewValues>(numbers);
  const dvec3 color = v.DiffuseColor;
  const double metallic = v.Metallic;
  const double reflectance = ReflectanceOfIndex(v.Index);
  const double s = Schlick(d.VdH);
  const dvec3 f90 = glm::mix(dvec3(1.0), color, metallic);
  const dvec3 f0 = glm::mix(reflectance * f90, f90, metallic);
  const dvec3 fresnel = glm::mix(f0, f90, s);
  const dvec3 diffuse = color * ((1.0 - metallic) / Pi) * (dvec3(1.0) - fresnel);
  dvec3 f = diffuse + fresnel * GetPreviewLobe(d, v.Roughness);
  const double coat = v.Clearcoat;
  if (coat > 0.0)
  {
    f += dvec3(
      coat * (reflectance + (1.0 - reflectance) * s) * GetPreviewLobe(d, v.ClearcoatRoughness));
  }
  return f;
}

//------------------------------------------------------------------------------
// SpecularIsotropic without F: the shadowing takes roughness^2 where Heitz has alpha^2.
double GetPbrLobe(const Directions& d, double roughness)
{
  const double alpha = roughness * roughness;
  return DistributeGGX(d.Half, alpha, alpha) * ShadowTogether(d.NdL, d.NdV, alpha);
}

//------------------------------------------------------------------------------
double GetBaseLobe(const VtkValues& v, const Directions& d)
{
  const double roughness = v.Roughness;
  const double anisotropy = v.Anisotropy;
  if (anisotropy == 0.0)
  {
    return GetPbrLobe(d, roughness);
  }
  const double angle = 2.0 * Pi * v.Rotation;
  const Directions turned(Turn(d.Light, angle), Turn(d.View, angle));
  const double aspect = std::sqrt(1.0 - 0.9 * anisotropy); // Burley 2012
  const double x = std::max(roughness * roughness / aspect, 0.001);
  const double y = std::max(roughness * roughness * aspect, 0.001);
  return DistributeGGX(turned.Half, x, y) * ShadowTogether(turned, x, y);
}

//------------------------------------------------------------------------------
dvec3 ShadeVtkPbr(const double* numbers, const Directions& d)
{
  const auto v = ReadValues<VtkValues>(numbers);
  const dvec3 color = v.Color;
  const double metallic = v.Metallic;
  const double strength = v.CoatStrength;
  const double index = v.BaseIndex;
  const double coatIndex = v.CoatIndex;
  // vtkProperty::ComputeReflectanceOfBaseLayer.
  const double base =
    Mix(ReflectanceOfIndex(index), ReflectanceOfIndex(index / coatIndex), strength);
  const dvec3 f0 = glm::mix(dvec3(base), color, metallic);
  const double grazing = std::clamp(50.0 * 0.33 * (f0.x + f0.y + f0.z), 0.0, 1.0);
  const dvec3 f90 = glm::mix(dvec3(grazing), v.EdgeTint, metallic);
  const double s = Schlick(d.VdH);
  const dvec3 fresnel = f0 + (f90 - f0) * s;
  const dvec3 diffuse = (1.0 - metallic) / Pi * (dvec3(1.0) - fresnel) * color;
  const dvec3 specular = fresnel * GetBaseLobe(v, d);
  if (strength == 0.0)
  {
    return diffuse + specular;
  }
  const double coatF0 = ReflectanceOfIndex(coatIndex);
  const double coat = strength * (coatF0 + (1.0 - coatF0) * s);
  return diffuse * (1.0 - coat) + specular * Square(1.0 - coat) +
         dvec3(coat * GetPbrLobe(d, v.CoatRoughness));
}
}

//------------------------------------------------------------------------------
const std::vector<ShadingModel>& GetPbrModels()
{
  // glTF's specularColorFactor may exceed 1: "the product of specular color factor [...] and f0
  // reflectance from IOR is clamped to 1" (KHR_materials_specular). By hand, dielectrics get
  // reflectances of up to 0.08 (Burley 2012, "Physically Based Shading at Disney").
  static const std::vector<ShadingModel> models = {
    { "gltf", "glTF metallic-roughness",
      { { "baseColorFactor", 3, 0.0, 1.0, 1.0, Feature::Core, {} },
        { "metallicFactor", 1, 0.0, 1.0, 1.0, Feature::Core, Metals },
        { "roughnessFactor", 1, 0.05, 1.0, 1.0, Feature::Core, Roughnesses },
        { "specularFactor", 1, 0.0, 1.0, 1.0, Feature::Specular, { 0.9 } },
        { "specularColorFactor", 3, 0.0, 1.0 / DielectricF0, 1.0, Feature::Specular, { 1.0, 4.0 },
          2.0 },
        { "clearcoatFactor", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
        { "clearcoatRoughnessFactor", 1, 0.05, 1.0, 0.0, Feature::Coat, { 0.12, 0.35 } },
        { "sheenColorFactor", 3, 0.0, 1.0, 0.0, Feature::Sheen, { 0.1 } },
        { "sheenRoughnessFactor", 1, 0.1, 1.0, 0.0, Feature::Sheen, { 0.3, 0.7 } },
        { "anisotropyStrength", 1, 0.0, 1.0, 0.0, Feature::Anisotropy, { 0.4 } },
        { "anisotropyRotation", 1, 0.0, Pi, 0.0, Feature::Anisotropy, { 0.2, 1.7 } } },
      &ShadeGltf },
    { "preview_surface", "UsdPreviewSurface",
      { { "diffuseColor", 3, 0.0, 1.0, 0.18, Feature::Core, {} },
        { "metallic", 1, 0.0, 1.0, 0.0, Feature::Core, Metals },
        { "roughness", 1, 0.05, 1.0, 0.5, Feature::Core, Roughnesses },
        { "ior", 1, 1.0, 3.0, 1.5, Feature::Specular, { 1.3, 2.0 }, 2.0 },
        { "clearcoat", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
        { "clearcoatRoughness", 1, 0.05, 1.0, 0.01, Feature::Coat, { 0.12, 0.35 } } },
      &ShadePreviewSurface },
    { "vtk_pbr", "VTK's PBR",
      { { "Color", 3, 0.0, 1.0, 1.0, Feature::Core, {} },
        { "Metallic", 1, 0.0, 1.0, 0.0, Feature::Core, Metals },
        { "Roughness", 1, 0.05, 1.0, 0.5, Feature::Core, Roughnesses },
        { "BaseIOR", 1, 1.0, 3.0, 1.5, Feature::Specular, { 1.4, 2.0 }, 2.0 },
        { "EdgeTint", 3, 0.0, 1.0, 1.0, Feature::Specular, { 0.8, 0.3 } },
        { "CoatStrength", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
        { "CoatRoughness", 1, 0.05, 1.0, 0.0, Feature::Coat, { 0.12, 0.35 } },
        { "CoatIOR", 1, 1.0, 3.0, 2.0, Feature::Coat, { 1.5 }, 2.0 },
        { "Anisotropy", 1, 0.0, 1.0, 0.0, Feature::Anisotropy, { 0.4 } },
        { "AnisotropyRotation", 1, 0.0, 0.5, 0.0, Feature::Anisotropy, { 0.03, 0.27 } } },
      &ShadeVtkPbr }
  };
  return models;
}
} // namespace tool
