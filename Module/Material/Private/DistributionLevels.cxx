// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DistributionLevels.h"

#include "HalfVector.h"
#include "ZonalKernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
// Levels of larger tables are made at this many angles and interpolated: 24 x 256^2 weights.
constexpr int MaximumAngles = 256;

// Variance of the Blinn lobe with p's ratio of peak to projected integral: (n+2)/2pi for cos^n.
double FindOwnVariance(int nTheta, const std::vector<float>& p)
{
  double integral = 0.0;
  double peak = 0.0;
  for (int k = 0; k < nTheta; ++k)
  {
    const float* rgb = &p[3 * static_cast<std::size_t>(k)];
    const double value = static_cast<double>(rgb[0]) + rgb[1] + rgb[2];
    const double low = std::sin(UnitToThetaH(static_cast<double>(k) / nTheta));
    const double high = std::sin(UnitToThetaH((k + 1.0) / nTheta));
    integral += value * Pi * (high * high - low * low);
    peak = std::max(peak, value);
  }
  const double exponent = integral > 0.0 ? 2.0 * Pi * peak / integral - 2.0 : 1.0;
  return 1.0 / std::clamp(exponent, 1.0, 1e6);
}
} // namespace

//------------------------------------------------------------------------------
DistributionLevels::DistributionLevels(int nTheta, const std::vector<float>& p)
  : OwnVariance(FindOwnVariance(nTheta, p))
  , Rows(p)
{
  // Rings of p at up to MaximumAngles angles.
  const int n = std::min(nTheta, MaximumAngles);
  std::vector<double> angles;
  std::vector<double> widths;
  std::vector<glm::dvec3> values;
  for (int k = 0; k < n; ++k)
  {
    const double u = (k + 0.5) / n;
    angles.push_back(UnitToThetaH(u));
    widths.push_back(UnitToThetaH((k + 1.0) / n) - UnitToThetaH(static_cast<double>(k) / n));
    const Neighbors t = ClampedNeighbors(u, nTheta);
    const float* first = &p[3 * static_cast<std::size_t>(t.First)];
    const float* second = &p[3 * static_cast<std::size_t>(t.Second)];
    values.push_back(glm::mix(glm::dvec3(first[0], first[1], first[2]),
      glm::dvec3(second[0], second[1], second[2]), t.Weight));
  }

  std::vector<glm::dvec3> blurred(static_cast<std::size_t>(n));
  for (int level = 1; level < Count; ++level)
  {
    const double variance =
      this->OwnVariance * (std::pow(1.0 + 1.0 / this->OwnVariance, level / (Count - 1.0)) - 1.0);
    const double reach = GetRingReach(variance);
    for (int a = 0; a < n; ++a)
    {
      const std::size_t self = static_cast<std::size_t>(a);
      glm::dvec3 sum(0.0);
      double total = 0.0;
      const auto first = std::lower_bound(angles.begin(), angles.end(), angles[self] - reach);
      const auto last = std::upper_bound(angles.begin(), angles.end(), angles[self] + reach);
      for (auto it = first; it != last; ++it)
      {
        const std::size_t b = static_cast<std::size_t>(it - angles.begin());
        const double weight = widths[b] * GetRingWeight(angles[self], *it, variance);
        sum += weight * values[b];
        total += weight;
      }
      blurred[self] = total > 0.0 ? sum / total : values[self];
    }
    for (int k = 0; k < nTheta; ++k)
    {
      const Neighbors t = ClampedNeighbors((k + 0.5) / nTheta, n);
      const glm::dvec3 value = glm::mix(blurred[static_cast<std::size_t>(t.First)],
        blurred[static_cast<std::size_t>(t.Second)], t.Weight);
      for (int c = 0; c < 3; ++c)
      {
        this->Rows.push_back(static_cast<float>(value[c]));
      }
    }
  }
}

//------------------------------------------------------------------------------
Neighbors DistributionLevels::Find(double variance) const
{
  const double level =
    (Count - 1) *
    std::min(std::log1p(variance / this->OwnVariance) / std::log1p(1.0 / this->OwnVariance), 1.0);
  const int first = std::min(static_cast<int>(level), Count - 2);
  return { first, first + 1, level - first };
}
} // namespace measuredbrdf
