// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Spherical harmonics of the clamped cosine (Ramamoorthi, Hanrahan 2001).
 */

#ifndef ClampedCosine_h
#define ClampedCosine_h

#include "LogFactorial.h"

#include <cmath>

namespace measuredbrdf
{
/// Of degree l and order 0 about the cosine's axis; the others are 0.
inline double GetClampedCosine(int l)
{
  constexpr double pi = 3.14159265358979323846;
  double value = l == 1 ? 2.0 * pi / 3.0 : 0.0;
  if (l % 2 == 0)
  {
    value = 2.0 * pi * (l % 4 == 0 ? -1.0 : 1.0) / ((l + 2.0) * (l - 1.0)) *
            std::exp(LogFactorial(l) - 2.0 * LogFactorial(l / 2) - l * std::log(2.0));
  }
  return value * std::sqrt((2.0 * l + 1.0) / (4.0 * pi));
}
} // namespace measuredbrdf

#endif
