// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the shading models have in common: the GGX distribution (Walter et al. 2007; Burley 2012 for
 * two widths), Smith's shadowing, Schlick's Fresnel term (1994).
 */

#ifndef Lobes_h
#define Lobes_h

#include "HalfVector.h"
#include "SurfaceModel.h"

#include <cmath>

namespace tool
{
using measuredbrdf::Pi;

inline double Square(double x) { return x * x; }

/// (1 - x)^5 of Schlick's Fresnel term.
inline double Schlick(double cosine) { return Square(Square(1.0 - cosine)) * (1.0 - cosine); }

/// Where searches of the core's metallic part and roughness begin.
const std::vector<double> Metals = { 0, 1, 0, 1, 0, 1, 0, 0.5, 0.5 };
const std::vector<double> Roughnesses = { 0.9, 0.9, 0.5, 0.5, 0.25, 0.25, 0.12, 0.12, 0.4 };

/// Reflectance at normal incidence of an index of refraction.
inline double ReflectanceOfIndex(double index) { return Square((index - 1.0) / (index + 1.0)); }

/// D of GGX with widths along x and y (Burley 2012, equation 13).
inline double DistributeGGX(const glm::dvec3& h, double alphaX, double alphaY)
{
  const double d = Square(h.x / alphaX) + Square(h.y / alphaY) + Square(h.z);
  return 1.0 / (Pi * alphaX * alphaY * d * d);
}

/// G / (4 n.l n.v) with G1(l) G1(v) (Walter et al. 2007, equation 34).
inline double ShadowSeparately(double ndl, double ndv, double alpha2)
{
  const auto part = [alpha2](double c) { return c + std::sqrt(alpha2 + (1.0 - alpha2) * c * c); };
  return 1.0 / (part(ndl) * part(ndv));
}

/// G / (4 n.l n.v), height-correlated (Heitz 2014, equation 99).
inline double ShadowTogether(double ndl, double ndv, double alpha2)
{
  const auto part = [alpha2](double c) { return std::sqrt(alpha2 + (1.0 - alpha2) * c * c); };
  return 0.5 / (ndv * part(ndl) + ndl * part(ndv));
}

/// The same with widths along x and y.
inline double ShadowTogether(const Directions& d, double alphaX, double alphaY)
{
  const auto part = [alphaX, alphaY](const glm::dvec3& v)
  { return std::sqrt(Square(alphaX * v.x) + Square(alphaY * v.y) + Square(v.z)); };
  return 0.5 / (d.NdV * part(d.Light) + d.NdL * part(d.View));
}

/// v in a frame whose x axis is turned by an angle in radians, counterclockwise about the normal.
inline glm::dvec3 Turn(const glm::dvec3& v, double angle)
{
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return { c * v.x + s * v.y, c * v.y - s * v.x, v.z };
}
} // namespace tool

#endif
