// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The shading models that MaterialX 1.39 builds as graphs of elementary BSDFs. Those BSDFs are as
// its GLSL library, release 1.39.3, evaluates them for one light: pbrlib/genglsl.
//
// standard_surface (Georgiev, Portsmouth, Zap, Renaud, Hughes 2019), the parts that reflect, by
// bxdf/standard_surface.mtlx, node definition 1.0.1: metal or (sheen, diffuse) below a dielectric,
// all below a coat.
//
// OpenPBR Surface 1.1 (Academy Software Foundation 2024), the parts that reflect, by
// bxdf/open_pbr_surface.mtlx: metal or diffuse below a dielectric, a coat that darkens and roughens
// what is below, fuzz on top.
#include "Lobes.h"

#include <algorithm>
#include <cmath>

namespace tool
{
namespace
{
using glm::dvec3;

constexpr double Epsilon = 1e-6; // M_FLOAT_EPS

/// What a BSDF reflects, and the share of light that it lets through to the layer below.
struct Layer
{
  dvec3 Response = dvec3(0.0); // f, without the cosine
  dvec3 Throughput = dvec3(1.0);
};

/// The BSDF `layer`: top over base.
dvec3 Over(const Layer& top, const dvec3& base) { return top.Response + base * top.Throughput; }

/// Widths of a GGX lobe along the tangent and the bitangent, in [1e-6, 1].
struct Widths
{
  Widths(double x, double y)
    : X(std::clamp(x, Epsilon, 1.0))
    , Y(std::clamp(y, Epsilon, 1.0))
  {
  }

  double X, Y;
  double GetMean() const { return std::sqrt(this->X * this->Y); } // geometric
};

/// Shares A and B of GGX' directional albedo: F0 A + F90 B.
struct AlbedoShares
{
  double A, B;
};

//------------------------------------------------------------------------------
// mx_ggx_dir_albedo_analytic: a rational fit in n.v and alpha.
AlbedoShares GetAlbedoShares(double x, double y)
{
  const double terms[9] = { 1.0, x, y, x * y, x * x, y * y, x * x * y, x * y * y, x * x * y * y };
  static const double factors[4][9] = { { 0.1003, -0.6303, 9.748, -2.038, 29.34, -8.245, -26.44,
                                          19.99, -5.448 },
    { 0.9345, -2.323, 2.229, -3.748, 1.424, -0.7684, 1.436, 0.2913, 0.6286 },
    { 1.0, -1.765, 8.263, 11.53, 28.96, -7.507, -36.11, 15.86, 33.37 },
    { 1.0, 0.2281, 15.94, -55.83, 13.08, 41.26, 54.9, 300.2, -285.1 } };
  double sums[4] = {};
  for (int row = 0; row < 4; ++row)
  {
    for (int k = 0; k < 9; ++k)
    {
      sums[row] += factors[row][k] * terms[k];
    }
  }
  return { std::clamp(sums[0] / sums[2], 0.0, 1.0), std::clamp(sums[1] / sums[3], 0.0, 1.0) };
}

//------------------------------------------------------------------------------
// mx_ggx_energy_compensation: for light that leaves after several reflections (Turquin 2019,
// equations 14 and 16).
dvec3 Compensate(const AlbedoShares& shares, const dvec3& fresnel)
{
  const double single = shares.A + shares.B;
  return dvec3(1.0) + fresnel * ((1.0 - single) / single);
}

//------------------------------------------------------------------------------
double GetLobe(const Directions& d, const Widths& widths)
{
  return DistributeGGX(d.Half, widths.X, widths.Y) *
         ShadowTogether(d.NdL, d.NdV, Square(widths.GetMean()));
}

//------------------------------------------------------------------------------
// mx_fresnel_conductor of one channel.
double GetConductorFresnel(double cosine, double n, double k)
{
  const double cosine2 = cosine * cosine;
  const double sine2 = 1.0 - cosine2;
  const double t0 = n * n - k * k - sine2;
  const double root = std::sqrt(t0 * t0 + 4.0 * n * n * k * k);
  const double t1 = root + cosine2;
  const double t2 = 2.0 * std::sqrt(std::max(0.5 * (root + t0), 0.0)) * cosine;
  const double s = (t1 - t2) / (t1 + t2);
  const double t3 = cosine2 * root + sine2 * sine2;
  const double t4 = t2 * sine2;
  return 0.5 * (s + s * (t3 - t4) / (t3 + t4));
}

//------------------------------------------------------------------------------
// mx_artistic_ior of one channel, then its reflectance.
double GetArtisticFresnel(double cosine, double reflectivity, double edge)
{
  const double r = std::clamp(reflectivity, 0.0, 0.99);
  const double least = (1.0 - r) / (1.0 + r);
  const double most = (1.0 + std::sqrt(r)) / (1.0 - std::sqrt(r));
  const double n = most + (least - most) * edge;
  const double k2 = (Square(n + 1.0) * r - Square(n - 1.0)) / (1.0 - r);
  return GetConductorFresnel(cosine, n, std::sqrt(std::max(k2, 0.0)));
}

//------------------------------------------------------------------------------
// mx_imageworks_sheen_dir_albedo_analytic.
double GetContyKullaAlbedo(double x, double y)
{
  const double upper = 13.67300 - 68.78018 * x + 799.08825 * y - 905.00061 * x * y +
                       60.28956 * x * x + 1086.96473 * y * y;
  const double lower = 1.0 + 61.57746 * x + 442.78211 * y + 2597.49308 * x * y + 121.81241 * x * x +
                       3045.55075 * y * y;
  return std::clamp(upper / lower, 0.0, 1.0);
}

//------------------------------------------------------------------------------
// mx_zeltner_sheen_dir_albedo: a Gaussian in n.v.
double GetZeltnerAlbedo(double x, double y)
{
  const double s = y * (0.0206607 + 1.58491 * y) / (0.0379424 + y * (1.32227 + y));
  const double m =
    y * (-0.193854 + y * (-1.14885 + y * (1.7932 - 0.95943 * y * y))) / (0.046391 + y);
  const double o =
    y * (0.000654023 + (-0.0207818 + 0.119681 * y) * y) / (1.26264 + y * (-1.92021 + y));
  return std::exp(-0.5 * Square((x - m) / s)) / (s * std::sqrt(2.0 * Pi)) + o;
}

//------------------------------------------------------------------------------
// mx_zeltner_sheen_brdf: a linearly transformed cosine, with the cosine of the light.
double GetZeltnerLobe(const Directions& d, double y)
{
  const double x = d.NdV;
  const double a = (2.58126 * x + 0.813703 * y) * y / (1.0 + 0.310327 * x * x + 2.60994 * x * y);
  const double b = std::sqrt(1.0 - x) * (y - 1.0) * y * y * y /
                   (0.0000254053 + 1.71228 * x - 1.71506 * x * y + 1.34174 * y * y);
  // The light in the frame whose x axis is the view's.
  const double r = std::sqrt(d.View.x * d.View.x + d.View.y * d.View.y);
  const dvec3 light = r > 0.0 ? Turn(d.Light, std::atan2(d.View.y, d.View.x)) : d.Light;
  const dvec3 w(a * light.x + b * light.z, a * light.y, light.z);
  return std::max(w.z, 0.0) / Pi * Square(a / glm::dot(w, w));
}

//------------------------------------------------------------------------------
// `roughness_anisotropy`.
Widths GetStandardWidths(double roughness, double anisotropy)
{
  const double alpha = std::clamp(roughness * roughness, Epsilon, 1.0);
  const double aspect = std::sqrt(1.0 - std::clamp(anisotropy, 0.0, 0.98));
  return Widths(std::min(alpha / aspect, 1.0), alpha * aspect);
}

//------------------------------------------------------------------------------
// OpenPBR's own `open_pbr_anisotropy`.
Widths GetOpenPbrWidths(double roughness, double anisotropy)
{
  const double ratio = 1.0 - anisotropy;
  const double x = roughness * roughness * std::sqrt(2.0 / (ratio * ratio + 1.0));
  return Widths(x, ratio * x);
}

//------------------------------------------------------------------------------
// `dielectric_bsdf` that reflects only; its index is at least 1.
Layer GetDielectric(
  const Directions& d, double weight, const dvec3& tint, double index, const Widths& widths)
{
  Layer layer;
  if (weight < Epsilon)
  {
    return layer;
  }
  const AlbedoShares shares = GetAlbedoShares(d.NdV, widths.GetMean());
  const double fresnel = measuredbrdf::DielectricFresnel(index, d.VdH);
  const dvec3 compensation = Compensate(shares, dvec3(fresnel));
  layer.Response = weight * fresnel * GetLobe(d, widths) * compensation * tint;
  layer.Throughput =
    dvec3(1.0) - weight * (ReflectanceOfIndex(index) * shares.A + shares.B) * compensation;
  return layer;
}

//------------------------------------------------------------------------------
// `conductor_bsdf` with an index of refraction n + i k; with n and k of `artistic_ior` (Gulbrandsen
// 2014) for a reflectivity and an edge color.
dvec3 GetConductor(
  const Directions& d, const dvec3& reflectivity, const dvec3& edge, const Widths& widths)
{
  dvec3 fresnel;
  for (int c = 0; c < 3; ++c)
  {
    fresnel[c] = GetArtisticFresnel(d.VdH, reflectivity[c], edge[c]);
  }
  return fresnel * GetLobe(d, widths) *
         Compensate(GetAlbedoShares(d.NdV, widths.GetMean()), fresnel);
}

//------------------------------------------------------------------------------
// `generalized_schlick_bsdf` with the F82 tint (Hoffman 2019), reflecting 1 at 90 degrees.
dvec3 GetSchlickMetal(const Directions& d, double weight, const dvec3& color0, const dvec3& color82,
  const Widths& widths)
{
  // mx_fresnel_hoffman_schlick: Schlick's term less one that is largest at a cosine of 1/7.
  constexpr double most = 1.0 / 7.0;
  const double factor = 1.0 / (most * Schlick(most) * (1.0 - most));
  const dvec3 a = glm::mix(color0, dvec3(1.0), Schlick(most)) * (dvec3(1.0) - color82) * factor;
  const dvec3 fresnel =
    glm::mix(color0, dvec3(1.0), Schlick(d.VdH)) - a * (d.VdH * Schlick(d.VdH) * (1.0 - d.VdH));
  return weight * fresnel * GetLobe(d, widths) *
         Compensate(GetAlbedoShares(d.NdV, widths.GetMean()), fresnel);
}

//------------------------------------------------------------------------------
// `sheen_bsdf` with mode conty_kulla (Estevez and Kulla 2017).
Layer GetContyKullaSheen(const Directions& d, double weight, const dvec3& color, double roughness)
{
  Layer layer;
  if (weight < Epsilon)
  {
    return layer;
  }
  const double inverse = 1.0 / std::max(roughness, 0.005);
  const double distribution =
    (2.0 + inverse) * std::pow(std::max(1.0 - d.NdH * d.NdH, 0.0), 0.5 * inverse) / (2.0 * Pi);
  layer.Response = weight * color * distribution / (4.0 * (d.NdL + d.NdV - d.NdL * d.NdV));
  layer.Throughput = dvec3(1.0 - weight * GetContyKullaAlbedo(d.NdV, roughness));
  return layer;
}

//------------------------------------------------------------------------------
// `sheen_bsdf` with mode zeltner (Zeltner et al. 2022).
Layer GetZeltnerSheen(const Directions& d, double weight, const dvec3& color, double roughness)
{
  Layer layer;
  if (weight < Epsilon)
  {
    return layer;
  }
  const double y = std::clamp(roughness, 0.01, 1.0);
  const double albedo = GetZeltnerAlbedo(d.NdV, y);
  layer.Response = weight * color * albedo * GetZeltnerLobe(d, y) / d.NdL;
  layer.Throughput = dvec3(1.0 - weight * albedo);
  return layer;
}

/// The values of both models, which have the same parameters in the same order.
struct LayeredValues
{
  dvec3 BaseColor;
  double Metalness, Roughness, Specular;
  dvec3 SpecularColor;
  double SpecularIndex, Coat, CoatRoughness, CoatIndex, Sheen;
  dvec3 SheenColor;
  double SheenRoughness, Anisotropy, Rotation;
};

//------------------------------------------------------------------------------
// Directions in a frame that is turned by a share of a turn, clockwise about the normal: MaterialX'
// rotate3d turns so.
Directions TurnClockwise(const Directions& d, double turns)
{
  const double angle = -2.0 * Pi * turns;
  return turns == 0.0 ? d : Directions(Turn(d.Light, angle), Turn(d.View, angle));
}

//------------------------------------------------------------------------------
dvec3 ShadeStandardSurface(const double* numbers, const Directions& directions)
{
  const auto v = ReadValues<LayeredValues>(numbers);
  const Directions d = TurnClockwise(directions, v.Anisotropy > 0.0 ? v.Rotation : 0.0);
  const Widths widths = GetStandardWidths(v.Roughness, v.Anisotropy);
  const Layer sheen = GetContyKullaSheen(d, v.Sheen, v.SheenColor, v.SheenRoughness);
  const Layer dielectric = GetDielectric(d, v.Specular, v.SpecularColor, v.SpecularIndex, widths);
  const dvec3 metal = GetConductor(d, v.BaseColor, v.Specular * v.SpecularColor, widths);
  const dvec3 f = glm::mix(Over(dielectric, Over(sheen, v.BaseColor / Pi)), metal, v.Metalness);
  const Layer coat =
    GetDielectric(d, v.Coat, dvec3(1.0), v.CoatIndex, GetStandardWidths(v.CoatRoughness, 0.0));
  return Over(coat, f);
}

//------------------------------------------------------------------------------
// The base looks rougher through a rough coat.
double GetCoatedRoughness(const LayeredValues& v)
{
  const double own = v.Roughness;
  const double coated =
    std::pow(std::min(2.0 * std::pow(v.CoatRoughness, 4) + std::pow(own, 4), 1.0), 0.25);
  return own + (coated - own) * v.Coat;
}

//------------------------------------------------------------------------------
// The index relative to the coat's, and scaled for the reflectance that specular_weight asks for.
double GetCoatedIndex(const LayeredValues& v)
{
  const double own = v.SpecularIndex;
  const double ratio = own / v.CoatIndex;
  const double eta = own + (std::max(ratio, 1.0 / ratio) - own) * v.Coat;
  const double f0 = std::clamp(v.Specular * ReflectanceOfIndex(eta), 0.0, 0.99999);
  const double root = std::copysign(std::sqrt(f0), eta - 1.0);
  return (1.0 + root) / (1.0 - root);
}

//------------------------------------------------------------------------------
// Light that the coat reflects back onto the base.
dvec3 GetDarkening(const LayeredValues& v)
{
  const double index = v.CoatIndex;
  const double back = 1.0 - (1.0 - ReflectanceOfIndex(index)) / (index * index);
  const dvec3 base = v.BaseColor;
  const dvec3 albedo = glm::mix(base, base * v.Specular, v.Metalness);
  const dvec3 darkening = dvec3(1.0 - back) / (dvec3(1.0) - albedo * back);
  return glm::mix(dvec3(1.0), darkening, v.Coat);
}

//------------------------------------------------------------------------------
dvec3 ShadeOpenPbr(const double* numbers, const Directions& directions)
{
  const auto v = ReadValues<LayeredValues>(numbers);
  const Directions d = TurnClockwise(directions, v.Anisotropy > 0.0 ? v.Rotation : 0.0);
  const Widths widths = GetOpenPbrWidths(GetCoatedRoughness(v), v.Anisotropy);
  // The diffuse part at base_diffuse_roughness 0: Lambert.
  const dvec3 plastic =
    Over(GetDielectric(d, 1.0, v.SpecularColor, GetCoatedIndex(v), widths), v.BaseColor / Pi);
  const dvec3 metal =
    GetSchlickMetal(d, v.Specular, v.BaseColor, v.Specular * v.SpecularColor, widths);
  dvec3 f = glm::mix(plastic, metal, v.Metalness) * glm::clamp(GetDarkening(v), 0.0, 1.0);
  f = Over(
    GetDielectric(d, v.Coat, dvec3(1.0), v.CoatIndex, GetOpenPbrWidths(v.CoatRoughness, 0.0)), f);
  return Over(GetZeltnerSheen(d, v.Sheen, v.SheenColor, v.SheenRoughness), f);
}
}

//------------------------------------------------------------------------------
const std::vector<ShadingModel>& GetMaterialXModels()
{
  // Weights of the base are written as 1: they only scale base_color. OpenPBR's rotation, in turns,
  // is no input of its node: files turn the node's tangent.
  static const std::vector<ShadingModel> models = {
    { "standard_surface", "standard_surface",
      { { "base_color", 3, 0.0, 1.0, 0.8, Feature::Core, {} },
        { "metalness", 1, 0.0, 1.0, 0.0, Feature::Core, Metals },
        { "specular_roughness", 1, 0.05, 1.0, 0.2, Feature::Core, Roughnesses },
        { "specular", 1, 0.0, 1.0, 1.0, Feature::Specular, { 0.9 } },
        { "specular_color", 3, 0.0, 1.0, 1.0, Feature::Specular, { 0.8 } },
        { "specular_IOR", 1, 1.0, 3.0, 1.5, Feature::Specular, { 1.5, 2.0 }, 2.0 },
        { "coat", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
        { "coat_roughness", 1, 0.05, 1.0, 0.1, Feature::Coat, { 0.12, 0.35 } },
        { "coat_IOR", 1, 1.0, 3.0, 1.5, Feature::Coat, { 1.5 }, 2.0 },
        { "sheen", 1, 0.0, 1.0, 0.0, Feature::Sheen, { 0.2 } },
        { "sheen_color", 3, 0.0, 1.0, 1.0, Feature::Sheen, { 0.5 } },
        { "sheen_roughness", 1, 0.05, 1.0, 0.3, Feature::Sheen, { 0.3, 0.7 } },
        { "specular_anisotropy", 1, 0.0, 0.98, 0.0, Feature::Anisotropy, { 0.4 } },
        { "specular_rotation", 1, 0.0, 0.5, 0.0, Feature::Anisotropy, { 0.03, 0.27 } } },
      &ShadeStandardSurface },
    { "open_pbr", "open_pbr_surface",
      { { "base_color", 3, 0.0, 1.0, 0.8, Feature::Core, {} },
        { "base_metalness", 1, 0.0, 1.0, 0.0, Feature::Core, Metals },
        { "specular_roughness", 1, 0.05, 1.0, 0.3, Feature::Core, Roughnesses },
        { "specular_weight", 1, 0.0, 1.0, 1.0, Feature::Specular, { 0.9 } },
        { "specular_color", 3, 0.0, 1.0, 1.0, Feature::Specular, { 0.8 } },
        { "specular_ior", 1, 1.0, 3.0, 1.5, Feature::Specular, { 1.5, 2.0 }, 2.0 },
        { "coat_weight", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
        { "coat_roughness", 1, 0.05, 1.0, 0.0, Feature::Coat, { 0.12, 0.35 } },
        { "coat_ior", 1, 1.0, 3.0, 1.6, Feature::Coat, { 1.6 }, 2.0 },
        { "fuzz_weight", 1, 0.0, 1.0, 0.0, Feature::Sheen, { 0.2 } },
        { "fuzz_color", 3, 0.0, 1.0, 1.0, Feature::Sheen, { 0.5 } },
        { "fuzz_roughness", 1, 0.05, 1.0, 0.5, Feature::Sheen, { 0.3, 0.7 } },
        { "specular_roughness_anisotropy", 1, 0.0, 0.98, 0.0, Feature::Anisotropy, { 0.4 } },
        { "tangent_rotation", 1, 0.0, 0.5, 0.0, Feature::Anisotropy, { 0.03, 0.27 } } },
      &ShadeOpenPbr }
  };
  return models;
}
} // namespace tool
