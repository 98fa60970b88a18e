// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The elementary BSDFs of MaterialX's physically based shading nodes (specification 1.39) as its
 * GLSL library, release 1.39.3, evaluates them for one light: pbrlib/genglsl. standard_surface and
 * open_pbr_surface are graphs of these.
 */

#ifndef MaterialXLobes_h
#define MaterialXLobes_h

#include "SurfaceModel.h"

namespace tool
{
/// What a BSDF reflects, and the share of light that it lets through to the layer below.
struct Layer
{
  glm::dvec3 Response = glm::dvec3(0.0); // f, without the cosine
  glm::dvec3 Throughput = glm::dvec3(1.0);
};

/// The BSDF `layer`: top over base.
inline glm::dvec3 Over(const Layer& top, const glm::dvec3& base)
{
  return top.Response + base * top.Throughput;
}

/// Widths of a GGX lobe along the tangent and the bitangent, in [1e-6, 1].
struct Widths
{
  Widths(double x, double y);

  double X, Y;
  double GetMean() const; // geometric
};

///@{
/// `roughness_anisotropy`, and OpenPBR's own `open_pbr_anisotropy`.
Widths GetStandardWidths(double roughness, double anisotropy);
Widths GetOpenPbrWidths(double roughness, double anisotropy);
///@}

/// `dielectric_bsdf` that reflects only.
Layer GetDielectric(
  const Directions& d, double weight, const glm::dvec3& tint, double index, const Widths& widths);

/// `conductor_bsdf` with an index of refraction n + i k; with n and k of `artistic_ior`
/// (Gulbrandsen 2014) for a reflectivity and an edge color.
glm::dvec3 GetConductor(const Directions& d, const glm::dvec3& reflectivity, const glm::dvec3& edge,
  const Widths& widths);

/// `generalized_schlick_bsdf` with the F82 tint (Hoffman 2019), reflecting 1 at 90 degrees.
glm::dvec3 GetSchlickMetal(const Directions& d, double weight, const glm::dvec3& color0,
  const glm::dvec3& color82, const Widths& widths);

///@{
/// `sheen_bsdf` with mode conty_kulla (Estevez and Kulla 2017) and mode zeltner (Zeltner et al.
/// 2022).
Layer GetContyKullaSheen(
  const Directions& d, double weight, const glm::dvec3& color, double roughness);
Layer GetZeltnerSheen(
  const Directions& d, double weight, const glm::dvec3& color, double roughness);
///@}
} // namespace tool

#endif
