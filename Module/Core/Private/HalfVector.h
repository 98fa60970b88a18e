// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Half vectors and lobes about them in C++ (GLSL twin: shaders/vtkBRDFCommon.glsl).
 */

#ifndef HalfVector_h
#define HalfVector_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
constexpr double Pi = 3.14159265358979323846;

constexpr double ToRadians(double degrees) { return degrees * (Pi / 180.0); }
constexpr double ToDegrees(double radians) { return radians / (Pi / 180.0); }

/// h = (i+o)/|i+o|, the normal where i = -o (which only happens on the horizon).
inline glm::dvec3 HalfVector(const glm::dvec3& i, const glm::dvec3& o)
{
  const glm::dvec3 sum = i + o;
  const double length = glm::length(sum);
  return length > 1e-12 ? sum / length : glm::dvec3(0.0, 0.0, 1.0);
}

/**
 * ln(cos^2 theta) / sin^2 theta from s = sin^2 theta: cos^n theta = exp(n/2 s LogCosineRatio(s)).
 * Near the normal 1 - cos loses digits by cancellation; this form keeps them for sharp lobes
 * (n = 1e5).
 */
inline double LogCosineRatio(double s)
{
  s = std::min(s, 1.0 - 1e-12);
  return s > 1e-12 ? std::log1p(-s) / s : -1.0;
}

/// cos^n theta from s = sin^2 theta.
inline double PowerCosine(double n, double s) { return std::exp(0.5 * n * s * LogCosineRatio(s)); }

/**
 * Variance in h, per axis, of light whose directions vary by `spread` (1/kappa of a von
 * Mises-Fisher distribution), seen from o.h = c: i turns twice as far as h in the plane of both and
 * 2c as far out of it. The result is the mean of both that keeps the area, as in Wang et al. 2009
 * ("All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance"). The wider one (c^2) was
 * measured: it is better only for few lights on the sharpest lobes, and far worse at grazing
 * angles. The result is bounded where i and o are opposite.
 */
inline double HalfVectorSpread(double spread, double c)
{
  return spread / (4.0 * std::max(c, 1e-2));
}

/// Exponent of a lobe cos^n of h that this light widens: 1/n' = 1/n + variance, as for Gaussians.
inline double WidenedExponent(double n, double variance) { return n / (1.0 + n * variance); }

/// Schlick 1994: F0 + (1-F0)(1-c)^5.
inline double SchlickFresnel(double f0, double c)
{
  const double m = std::clamp(1.0 - c, 0.0, 1.0);
  const double m2 = m * m;
  return f0 + (1.0 - f0) * m2 * m2 * m;
}

/// Unpolarized Fresnel reflectance of a dielectric of relative index eta >= 1 (Cook, Torrance
/// 1982).
inline double DielectricFresnel(double eta, double c)
{
  const double g = std::sqrt(std::max(eta * eta + c * c - 1.0, 0.0));
  const double a = g + c > 0.0 ? (g - c) / (g + c) : 0.0;
  const double b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

/// i mirrored about h from o.
inline glm::dvec3 ReflectAbout(const glm::dvec3& o, const glm::dvec3& h)
{
  return 2.0 * glm::dot(o, h) * h - o;
}

/// Cosine-weighted direction about the normal from two uniform numbers; density cos(theta)/pi.
inline void SampleCosine(double u1, double u2, double d[3])
{
  const double r = std::sqrt(u1);
  d[0] = r * std::cos(2.0 * Pi * u2);
  d[1] = r * std::sin(2.0 * Pi * u2);
  d[2] = std::sqrt(std::max(1.0 - u1, 0.0));
}

/// Rusinkiewicz 1998: angles of h and of i seen from h. theta_h, theta_d in [0,pi/2], phi_d in
/// (-pi,pi].
struct HalfDifference
{
  double ThetaH;
  double ThetaD;
  double PhiD;
};

inline HalfDifference ToHalfDifference(const glm::dvec3& i, const glm::dvec3& o)
{
  const glm::dvec3 h = HalfVector(i, o);
  const double s = std::hypot(h.x, h.y);
  // Frame of h: t in the plane of h and the normal, b perpendicular to both; d = (i.t, i.b, i.h).
  const double cosPhi = s > 1e-7 ? h.x / s : 1.0;
  const double sinPhi = s > 1e-7 ? h.y / s : 0.0;
  const double dx = h.z * (cosPhi * i.x + sinPhi * i.y) - s * i.z;
  const double dy = cosPhi * i.y - sinPhi * i.x;
  const double dz = glm::dot(h, i);
  return { std::atan2(s, h.z), std::atan2(std::hypot(dx, dy), dz), std::atan2(dy, dx) };
}

/// The pair of directions with these angles, h in the xz plane.
inline void FromHalfDifference(const HalfDifference& angles, glm::dvec3& i, glm::dvec3& o)
{
  const double sh = std::sin(angles.ThetaH), ch = std::cos(angles.ThetaH);
  const double sd = std::sin(angles.ThetaD), cd = std::cos(angles.ThetaD);
  const glm::dvec3 d(sd * std::cos(angles.PhiD), sd * std::sin(angles.PhiD), cd);
  i = glm::dvec3(ch * d.x + sh * d.z, d.y, ch * d.z - sh * d.x);
  o = ReflectAbout(i, glm::dvec3(sh, 0.0, ch));
}

/// The theta_d at which i or o lies on the horizon, of theta_h and phi_d: i.z or o.z =
/// cos(theta_h) cos(theta_d) -+ sin(theta_h) sin(theta_d) cos(phi_d) = 0.
inline double FindHorizon(const HalfDifference& angles)
{
  return std::atan2(
    std::cos(angles.ThetaH), std::sin(angles.ThetaH) * std::abs(std::cos(angles.PhiD)));
}

/// Table coordinate of theta_h in [0,1]: fine where lobes are sharp (MERL's spacing); and back.
inline double ThetaHToUnit(double thetaH)
{
  return std::sqrt(std::clamp(thetaH * (2.0 / Pi), 0.0, 1.0));
}
inline double UnitToThetaH(double u) { return 0.5 * Pi * u * u; }

inline glm::dvec2 SquareToDisc(const glm::dvec2& p)
{
  const bool isAlongX = std::abs(p.x) > std::abs(p.y);
  const double radius = isAlongX ? p.x : p.y;
  const double phi = radius == 0.0 ? 0.0 : 0.25 * Pi * (isAlongX ? p.y / p.x : 2.0 - p.x / p.y);
  return { radius * std::cos(phi), radius * std::sin(phi) };
}

inline glm::dvec2 DiscToSquare(const glm::dvec2& d)
{
  const double radius = std::min(std::hypot(d.x, d.y), 1.0);
  const glm::dvec2 size = glm::abs(d);
  const bool isAlongX = size.x > size.y;
  const double angle = isAlongX ? std::atan2(size.y, size.x) : std::atan2(size.x, size.y);
  const double other = radius * angle * 4.0 / Pi;
  return { std::copysign(isAlongX ? radius : other, d.x),
    std::copysign(isAlongX ? other : radius, d.y) };
}

///@{
/// Unit directions above the horizon: areas on the square are solid angles (4 <-> 2 pi).
inline glm::dvec3 SquareToHemisphere(const glm::dvec2& p)
{
  const glm::dvec2 d = SquareToDisc(p);
  const double square = glm::dot(d, d);
  return glm::dvec3(d * std::sqrt(std::max(2.0 - square, 0.0)), 1.0 - square);
}

inline glm::dvec2 HemisphereToSquare(const glm::dvec3& d)
{
  return DiscToSquare(glm::dvec2(d) / std::sqrt(1.0 + std::max(d.z, 0.0)));
}
///@}
} // namespace measuredbrdf

#endif
