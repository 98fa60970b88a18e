// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Retro-reflective lobes, which reflect light back to where it came from (i about o: road signs,
 * cloth, dust). Samplers by half vectors miss them, because their cells are large far from the
 * normal. This class finds and samples such lobes.
 */

#ifndef RetroLobe_h
#define RetroLobe_h

#include "HalfVector.h" // Pi
#include "LocalFrame.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace measuredbrdf
{
class RetroLobe
{
public:
  /// A sampling density is too low if f cos exceeds it by this factor.
  static constexpr double LeastPeak = 4.0;

  explicit RetroLobe(const glm::dvec3& o)
    : View(FrameAbout(o))
  {
  }

  /// Unit i about o from two uniform numbers, with a log-uniform distance from o; it may lie below
  /// the horizon.
  glm::dvec3 Sample(const glm::dvec2& u) const
  {
    // 1 - cos of the angle from o.
    const double c = Core * std::expm1(u.x * GetRange());
    const double s = std::sqrt(std::max(c * (2.0 - c), 0.0));
    const double phi = 2.0 * Pi * u.y;
    return this->View * glm::dvec3(s * std::cos(phi), s * std::sin(phi), 1.0 - c);
  }

  /// Density of Sample in 1/sr; 0 beyond a right angle.
  double GetDensity(const glm::dvec3& i) const
  {
    const glm::dvec3 d = i - this->View[2];
    const double c = 0.5 * glm::dot(d, d);
    return c <= 1.0 ? 1.0 / (2.0 * Pi * GetRange() * (c + Core)) : 0.0;
  }

  /// Directions at and around o above the horizon, at which such a lobe is visible.
  std::vector<glm::dvec3> GetProbes() const
  {
    std::vector<glm::dvec3> probes(1, this->View[2]);
    for (const double angle : { 0.001, 0.004, 0.016, 0.064 })
    {
      for (int k = 0; k < 8; ++k)
      {
        const double phi = 0.25 * Pi * (k + 0.5);
        const glm::dvec3 i = this->View * glm::dvec3(std::sin(angle) * std::cos(phi),
                                            std::sin(angle) * std::sin(phi), std::cos(angle));
        if (i.z > 0.0)
        {
          probes.push_back(i);
        }
      }
    }
    return probes;
  }

  /// Whether value (f cos, sum of RGB) is too large for that sampling density (1/sr) near o.
  template <typename Value, typename Density>
  bool IsMissed(Value&& value, Density&& density) const
  {
    const std::vector<glm::dvec3> probes = this->GetProbes();
    return std::any_of(probes.begin(), probes.end(),
      [&](const glm::dvec3& i) { return value(i) > 3.0 * LeastPeak * density(i); });
  }

private:
  static constexpr double Core = 1e-6; // 1 - cos of 0.08 degrees: inside, draws are uniform
  static double GetRange() { return std::log1p(1.0 / Core); }

  Frame View;
};
} // namespace measuredbrdf

#endif
