// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The kernel that blurs a function of theta_h over the sphere of half vectors.
 */

#ifndef ZonalKernel_h
#define ZonalKernel_h

#include <cmath>

namespace measuredbrdf
{
// Bessel function I_0(x) e^-x, x >= 0; relative error 2e-7 (Abramowitz and Stegun 9.8.1, 9.8.2).
inline double ScaledBessel(double x)
{
  if (x < 3.75)
  {
    const double t = x * x / (3.75 * 3.75);
    return std::exp(-x) *
           (1.0 +
             t * (3.5156229 +
                   t * (3.0899424 +
                         t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813))))));
  }
  const double t = 3.75 / x;
  return (0.39894228 +
           t *
             (0.01328592 +
               t * (0.00225319 +
                     t * (-0.00157565 +
                           t * (0.00916281 +
                                 t * (-0.02057706 +
                                       t * (0.02635537 + t * (-0.01647633 + t * 0.00392377)))))))) /
         std::sqrt(x);
}

/// Mean over the azimuth of the von Mises-Fisher distribution of concentration 1/variance about an
/// angle of b from the axis, at an angle of a; times the width sin b of the ring at b. Not
/// normalized.
inline double GetRingWeight(double a, double b, double variance)
{
  const double sine = std::sin(b);
  const double x = std::sin(a) * sine / variance;
  return ScaledBessel(x) * std::exp((std::cos(a - b) - 1.0) / variance) * sine;
}

/// Angle beyond which weights are below 1e-7 of the largest.
inline double GetRingReach(double variance) { return 6.0 * std::sqrt(variance); }
} // namespace measuredbrdf

#endif
