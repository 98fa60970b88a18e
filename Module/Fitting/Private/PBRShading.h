// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * VTK's physically based shading of one light, as in its fragment shader (VTK 9.1 to 9.6,
 * vtkPBRFunctions.glsl and vtkOpenGLPolyDataMapper::ReplaceShaderLight): GGX (Walter et al. 2007)
 * with the height-correlated Smith term (Heitz 2014), Schlick's Fresnel term (1994), a Lambertian
 * base, and a clear coat.
 *
 * Everything but the distribution is a polynomial in s = (1 - H.L)^5, so that the radiance of a
 * surface follows from a few moments of the light.
 */

#ifndef PBRShading_h
#define PBRShading_h

#include <algorithm>
#include <array>
#include <cmath>

namespace measuredbrdf
{
/// Moments of the light over a lobe (or over the cosine, divided by pi): the integrals of
/// lobe * s^n * L * cos, n = 0 to 3.
using PBRMoments = std::array<double, 4>;

/// Parameters other than the base color, with vtkProperty's names and ranges.
struct PBRParameters
{
  double Roughness = 0.5;
  double Metallic = 0.0;
  double BaseIOR = 1.5;
  double EdgeTint = 1.0; // gray
  double CoatStrength = 0.0;
  double CoatRoughness = 0.0;
  double CoatIOR = 2.0; // VTK's default
};

/// D V of a lobe: f is D V times the Fresnel term. VTK's V takes roughness^2 where Heitz has
/// alpha^2 = roughness^4; this function follows VTK.
inline double GetPBRLobe(double ndh, double ndv, double ndl, double roughness)
{
  constexpr double pi = 3.14159265358979323846;
  const double alpha2 = std::pow(roughness, 4);
  const double d = (ndh * alpha2 - ndh) * ndh + 1.0;
  const double a2 = roughness * roughness;
  const double smith =
    ndl * std::sqrt(a2 + ndv * (ndv - a2 * ndv)) + ndv * std::sqrt(a2 + ndl * (ndl - a2 * ndl));
  return alpha2 / (pi * d * d) * 0.5 / std::max(smith, 1e-12);
}

/// vtkProperty::ComputeReflectanceFromIOR.
inline double GetPBRReflectance(double to, double from)
{
  const double r = (to - from) / (to + from);
  return r * r;
}

/// vtkProperty::ComputeReflectanceOfBaseLayer.
inline double GetPBRBaseReflectance(const PBRParameters& p)
{
  return GetPBRReflectance(p.BaseIOR, 1.0) * (1.0 - p.CoatStrength) +
         GetPBRReflectance(p.BaseIOR, p.CoatIOR) * p.CoatStrength;
}

/// Reflectance at grazing incidence: of metals the edge tint, else low where F0 is below 2 %.
inline double GetPBRGrazing(const PBRParameters& p, const std::array<double, 3>& baseColor)
{
  const double base = GetPBRBaseReflectance(p);
  double sum = 0.0;
  for (const double color : baseColor)
  {
    sum += base + (color - base) * p.Metallic;
  }
  const double f90 = std::clamp(50.0 * 0.33 * sum, 0.0, 1.0);
  return f90 + (p.EdgeTint - f90) * p.Metallic;
}

/**
 * Radiance of one channel of base color c. diffuse, specular, coat: moments of the cosine / pi, of
 * the base's lobe and of the coat's.
 */
inline double GetPBRRadiance(const PBRParameters& p, double c, double f90,
  const PBRMoments& diffuse, const PBRMoments& specular, const PBRMoments& coat)
{
  const double base = GetPBRBaseReflectance(p);
  const double f0 = base + (c - base) * p.Metallic;
  const double df = f90 - f0; // F = f0 + df s
  const double q = p.CoatStrength;
  const double coatF0 = GetPBRReflectance(p.CoatIOR, 1.0);
  const double e = 1.0 - q * coatF0; // 1 - Fc = e - v s
  const double v = q * (1.0 - coatF0);
  const double through =
    (1.0 - f0) * e * diffuse[0] - ((1.0 - f0) * v + df * e) * diffuse[1] + df * v * diffuse[2];
  const double reflected = f0 * e * e * specular[0] +
                           (df * e * e - 2.0 * e * v * f0) * specular[1] +
                           (f0 * v * v - 2.0 * e * v * df) * specular[2] + df * v * v * specular[3];
  const double coated = q * (coatF0 * coat[0] + (1.0 - coatF0) * coat[1]);
  return (1.0 - p.Metallic) * c * through + reflected + coated;
}
} // namespace measuredbrdf

#endif
