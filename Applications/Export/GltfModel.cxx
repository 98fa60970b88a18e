// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfModel.h"

#include "Lobes.h"

#include "vtkObjectFactory.h"

#include <algorithm>

namespace tool
{
namespace
{
// Where the values of a parameter begin.
enum Value : std::size_t
{
  BaseColor = 0,
  Metallic = 3,
  Roughness = 4,
  SpecularFactor = 5,
  SpecularColor = 6,
  Clearcoat = 9,
  ClearcoatRoughness = 10,
  SheenColor = 11,
  SheenRoughness = 14,
  AnisotropyStrength = 15,
  AnisotropyRotation = 16
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
/// Albedo over the view's cosine and the roughness, at the middles of a grid's cells.
struct CharlieTable
{
  static constexpr int Size = 24;
  std::array<double, Size * Size> Albedo;

  CharlieTable()
  {
    for (int y = 0; y < Size; ++y)
    {
      for (int x = 0; x < Size; ++x)
      {
        this->Albedo[static_cast<std::size_t>(y * Size + x)] =
          IntegrateCharlie((x + 0.5) / Size, (y + 0.5) / Size);
      }
    }
  }

  double Look(double ndv, double roughness) const
  {
    const double u = std::clamp(ndv * Size - 0.5, 0.0, Size - 1.0);
    const double v = std::clamp(roughness * Size - 0.5, 0.0, Size - 1.0);
    const int x = std::min(static_cast<int>(u), Size - 2);
    const int y = std::min(static_cast<int>(v), Size - 2);
    const double* at = &this->Albedo[static_cast<std::size_t>(y * Size + x)];
    return Mix(Mix(at[0], at[1], u - x), Mix(at[Size], at[Size + 1], u - x), v - y);
  }
};
}

vtkStandardNewMacro(GltfModel);

//------------------------------------------------------------------------------
double GetCharlieSheen(double ndl, double ndv, double ndh, double roughness)
{
  const double alpha = Square(roughness);
  const double sine2 = std::max(1.0 - ndh * ndh, 0.0);
  const double d = (2.0 + 1.0 / alpha) * std::pow(sine2, 0.5 / alpha) / (2.0 * Pi);
  const double shadow = 1.0 + ShadowCharlie(ndv, alpha) + ShadowCharlie(ndl, alpha);
  return d / (shadow * 4.0 * ndv * ndl);
}

//------------------------------------------------------------------------------
double GetCharlieAlbedo(double ndv, double roughness)
{
  static const CharlieTable table;
  return table.Look(ndv, roughness);
}

//------------------------------------------------------------------------------
const std::vector<ModelParameter>& GltfModel::GetParameters() const
{
  // specularColorFactor may exceed 1: "the product of specular color factor [...] and f0
  // reflectance from IOR is clamped to 1" (KHR_materials_specular). By hand, dielectrics get
  // reflectances of up to 0.08 (Burley 2012, "Physically Based Shading at Disney").
  static const std::vector<ModelParameter> parameters = { { "baseColorFactor", 3, 0.0, 1.0, 1.0,
                                                            Feature::Core, {} },
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
    { "anisotropyRotation", 1, 0.0, Pi, 0.0, Feature::Anisotropy, { 0.2, 1.7 } } };
  return parameters;
}

//------------------------------------------------------------------------------
// V D of the base (appendix B.3.2; KHR_materials_anisotropy without the clamp of its sample code,
// which would darken grazing reflection).
double GltfModel::GetSpecular(const Directions& d, double alpha) const
{
  const double strength = this->Values[AnisotropyStrength];
  if (strength == 0.0)
  {
    return DistributeGGX(d.Half, alpha, alpha) * ShadowSeparately(d.NdL, d.NdV, alpha * alpha);
  }
  const double angle = this->Values[AnisotropyRotation];
  const Directions turned(Turn(d.Light, angle), Turn(d.View, angle));
  const double along = Mix(alpha, 1.0, strength * strength);
  return DistributeGGX(turned.Half, along, alpha) * ShadowTogether(turned, along, alpha);
}

//------------------------------------------------------------------------------
double GltfModel::GetSheenScale(const Directions& d) const
{
  const double most = glm::max(
    glm::max(this->Values[SheenColor], this->Values[SheenColor + 1]), this->Values[SheenColor + 2]);
  const double roughness = this->Values[SheenRoughness];
  return std::max(
    1.0 - most * std::max(GetCharlieAlbedo(d.NdV, roughness), GetCharlieAlbedo(d.NdL, roughness)),
    0.0);
}

//------------------------------------------------------------------------------
glm::dvec3 GltfModel::Shade(const Directions& d) const
{
  const glm::dvec3 base = this->ColorAt(BaseColor);
  const double specular = this->GetSpecular(d, Square(this->Values[Roughness]));
  const double s = Schlick(d.VdH);
  // dielectric_brdf of KHR_materials_specular; with neutral values that of appendix B.
  const double weight = this->Values[SpecularFactor];
  const glm::dvec3 f0 =
    weight * glm::min(DielectricF0 * this->ColorAt(SpecularColor), glm::dvec3(1.0));
  const glm::dvec3 fresnel = f0 + (glm::dvec3(weight) - f0) * s;
  const double most = glm::max(glm::max(fresnel.x, fresnel.y), fresnel.z);
  const glm::dvec3 dielectric = fresnel * specular + (1.0 - most) * base / Pi;
  const glm::dvec3 metal = (base + (glm::dvec3(1.0) - base) * s) * specular;
  glm::dvec3 f = glm::mix(dielectric, metal, this->Values[Metallic]);

  const glm::dvec3 sheen = this->ColorAt(SheenColor);
  if (sheen != glm::dvec3(0.0))
  {
    f = f * this->GetSheenScale(d) +
        sheen * GetCharlieSheen(d.NdL, d.NdV, d.NdH, this->Values[SheenRoughness]);
  }
  const double coat = this->Values[Clearcoat];
  if (coat > 0.0)
  {
    // fresnel_coat of appendix B takes n.v.
    const double share = coat * (DielectricF0 + (1.0 - DielectricF0) * Schlick(d.NdV));
    const double alpha = Square(this->Values[ClearcoatRoughness]);
    const double lobe =
      DistributeGGX(d.Half, alpha, alpha) * ShadowSeparately(d.NdL, d.NdV, alpha * alpha);
    f = glm::mix(f, glm::dvec3(lobe), share);
  }
  return f;
}
} // namespace tool
