// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How a lamp's light is shared by a table and a sum for each pixel.
 */

#ifndef LampWindow_h
#define LampWindow_h

#include <glm/glm.hpp>

#include <cmath>

namespace measuredbrdf
{
/// A weight w over the angle between a lamp and the lobe's axis: 1 at the axis, flat there, and 0
/// from the window's radius on, to which it falls without an edge (C1). A pixel adds w f
/// cos(theta_i) of the lamps that its window holds; a table takes (1 - w) f cos(theta_i), which is
/// as smooth as the window is wide.
struct LampWindow
{
  /// Where it ends, in radians (docs/methods/hybrids.md).
  static constexpr double Radius = 0.7;

  LampWindow()
  {
    const double half = std::sin(0.5 * Radius);
    this->Reach = 0.25 / (half * half);
  }

  /// Of unit directions. The shader's vtkBRDFEnvironmentLamps.glsl does the same.
  double GetWeight(const glm::dvec3& lamp, const glm::dvec3& axis) const
  {
    const double x = 1.0 - this->GetNearness(lamp, axis);
    const double root = 1.0 - x * x;
    return x < 1.0 ? root * root : 0.0;
  }

  /// Of unit directions: 1 where the lamp is on the axis, 0 where the window ends, negative beyond.
  double GetNearness(const glm::dvec3& lamp, const glm::dvec3& axis) const
  {
    const glm::dvec3 away = lamp - axis;
    return 1.0 - this->Reach * glm::dot(away, away);
  }

  /// A lamp nearer than this, 10 degrees, is the sum of its parts; else one light. In a lobe's tail
  /// nobody tells, and frames under many lamps take a third less (docs/methods/lamps.md).
  static constexpr double PartsNearness = 0.935;

  /// How much of all directions the window covers: half of 1 - cos(radius).
  double GetShare() const { return 0.25 / this->Reach; }

  double Reach; // 1 / the squared distance of unit directions at which the window ends
};
} // namespace measuredbrdf

#endif
