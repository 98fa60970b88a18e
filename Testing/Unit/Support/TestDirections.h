// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Directions from angles about the normal (z), and what a material reflects between two of them.
 */

#ifndef TestDirections_h
#define TestDirections_h

#include "vtkBRDF.h"

#include <glm/glm.hpp>

#include <cmath>

/// Angles in radians. Beyond pi / 2: below the surface.
inline glm::dvec3 FromAngles(double theta, double phi)
{
  return { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta) };
}

inline glm::dvec3 FromDegrees(double theta, double phi)
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  return FromAngles(theta * degree, phi * degree);
}

inline glm::dvec3 Evaluate(vtkBRDF* brdf, const glm::dvec3& i, const glm::dvec3& o)
{
  glm::dvec3 f;
  brdf->Evaluate(&i.x, &o.x, &f.x);
  return f;
}

#endif
