// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The concentric map between the square [-1,1]^2 and the unit disc, which keeps areas (Shirley,
 * Chiu 1997, "A low distortion map between disk and square"): squares about the middle become
 * circles. Lifted by area it maps the hemisphere, too.
 */

#ifndef ConcentricMap_h
#define ConcentricMap_h

#include "HalfVector.h" // for Pi

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
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
