// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Sampling of polar angles for tables that must be fine at grazing angles: cos(theta) = low +
 * (1 - low) cos^2(alpha/2). Equal steps of alpha are equal steps of theta near the normal and
 * shrink with its square root towards the horizon. A function smooth in cos(theta) is even about
 * alpha = pi; one of azimuthal order m has the parity of m about alpha = 0. (GLSL twin:
 * vtkBRDFEnvironmentBasis.glsl)
 */

#ifndef CosinePowerWarp_h
#define CosinePowerWarp_h

#include "GaussLegendre.h" // for Quadrature

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// cos(theta) at alpha = pi t.
inline double WarpToCosine(double t, double low)
{
  const double c = std::cos(0.5 * Pi * t);
  return low + (1.0 - low) * c * c;
}

/// t = alpha / pi in [0, 1] of a cosine in [low, 1].
inline double CosineToWarp(double cosine, double low)
{
  const double x = std::clamp((cosine - low) / (1.0 - low), 0.0, 1.0);
  return std::atan2(std::sqrt(1.0 - x), std::sqrt(x)) * (2.0 / Pi);
}

/**
 * Integral over cos(theta) from low to 1 from samples at t = (k + 1/2) / n: exact for polynomials
 * of the cosine up to degree n - 1, positive weights (Fejer's first rule). Nodes are cosines.
 */
inline Quadrature WarpQuadrature(int n, double low)
{
  Quadrature rule;
  for (int k = 0; k < n; ++k)
  {
    const double t = (k + 0.5) / n;
    double sum = 1.0;
    for (int j = 1; j <= n / 2; ++j)
    {
      sum -= 2.0 * std::cos(2.0 * Pi * j * t) / (4.0 * j * j - 1.0);
    }
    rule.Nodes.push_back(WarpToCosine(t, low));
    rule.Weights.push_back((1.0 - low) * sum / n);
  }
  return rule;
}

/// Cubic interpolation of samples at t = (k + 1/2) / n, mirrored at both ends by their parity.
inline double InterpolateWarped(const double* samples, int n, int order, double t)
{
  const double sign = order % 2 == 0 ? 1.0 : -1.0;
  const auto at = [&](int k)
  { return k < 0 ? sign * samples[-1 - k] : samples[k < n ? k : 2 * n - 1 - k]; };
  const double x = t * n - 0.5;
  const int first = static_cast<int>(std::floor(x));
  const double u = x - first;
  // Lagrange's polynomial through four samples.
  return at(first - 1) * (-u * (u - 1.0) * (u - 2.0) / 6.0) +
         at(first) * ((u + 1.0) * (u - 1.0) * (u - 2.0) / 2.0) +
         at(first + 1) * (-(u + 1.0) * u * (u - 2.0) / 2.0) +
         at(first + 2) * ((u + 1.0) * u * (u - 1.0) / 6.0);
}
} // namespace measuredbrdf

#endif
