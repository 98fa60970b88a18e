// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How a lamp's light is shared by a table and a sum for each pixel. Private to the module.
 */

#ifndef LampWindow_h
#define LampWindow_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
/// A weight w over the angle between a lamp and the lobe's axis: 1 at the axis, flat there, and 0
/// from the window's radius on, to which it falls without an edge (C1). A pixel adds w f
/// cos(theta_i) of the lamps that its window holds; a table takes (1 - w) f cos(theta_i), which is
/// as smooth as the window is wide.
struct LampWindow
{
  /// The radius, in rows of the table (docs/methods.md), and at most (radians).
  static constexpr double RadiusInRows = 6.0;
  static constexpr double LargestRadius = 0.7;

  static double GetRadius(int rows)
  {
    constexpr double pi = 3.14159265358979323846;
    return std::min(RadiusInRows * pi / (rows - 1.0), LargestRadius);
  }

  /// For a table of so many rows from pole to pole.
  explicit LampWindow(int rows)
  {
    const double half = std::sin(0.5 * GetRadius(rows));
    this->Reach = 0.25 / (half * half);
  }

  /// Of unit directions. The shader's vtkBRDFEnvironmentLamps.glsl does the same.
  double GetWeight(const glm::dvec3& lamp, const glm::dvec3& axis) const
  {
    const glm::dvec3 away = lamp - axis;
    const double x = this->Reach * glm::dot(away, away);
    const double root = 1.0 - x * x;
    return x < 1.0 ? root * root : 0.0;
  }

  /// How much of all directions the window covers: half of 1 - cos(radius).
  double GetShare() const { return 0.25 / this->Reach; }

  double Reach; // 1 / the squared distance of unit directions at which the window ends
};
} // namespace measuredbrdf

#endif
