// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Low-discrepancy points: Halton's radical inverses (Halton 1960), the golden ratio, and pairs of
 * directions.
 */

#ifndef LowDiscrepancy_h
#define LowDiscrepancy_h

#include "HalfVector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace measuredbrdf
{
/// Of its multiples, any number are spread evenly over [0,1) (Wrap01).
constexpr double GoldenRatio = 0.61803398874989485;

/// Radical inverse of index in the given base, in [0,1).
inline double RadicalInverse(std::uint32_t index, std::uint32_t base)
{
  double result = 0.0;
  double digit = 1.0 / base;
  while (index > 0)
  {
    result += (index % base) * digit;
    index /= base;
    digit /= base;
  }
  return result < 1.0 ? result : 0x1.fffffffffffffp-1;
}

/// x moved cyclically by shift, in [0,1).
inline double Wrap01(double x)
{
  x -= static_cast<double>(static_cast<long long>(x));
  return x < 0.0 ? x + 1.0 : x;
}

/**
 * Sum of the negative parts over the sum of absolute values, of evaluate(i, o, f) at `count` pairs
 * of unit directions whose polar angles lie in two zones (begin and end in degrees, of i and of o);
 * 0 where all are 0.
 */
template <typename Evaluate>
double GetNegativeMass(
  const double incident[2], const double outgoing[2], int count, const Evaluate& evaluate)
{
  // Uniform in sin^2 of the polar angle.
  const auto draw = [](const double zone[2], double u, double v, double direction[3])
  {
    const double begin = std::pow(std::sin(zone[0] * (Pi / 180.0)), 2.0);
    const double end = std::pow(std::sin(zone[1] * (Pi / 180.0)), 2.0);
    SampleCosine(begin + u * (end - begin), v, direction);
  };
  double negative = 0.0;
  double total = 0.0;
  for (std::uint32_t n = 1; n <= static_cast<std::uint32_t>(count); ++n)
  {
    double i[3], o[3], f[3];
    draw(incident, RadicalInverse(n, 2), RadicalInverse(n, 3), i);
    draw(outgoing, RadicalInverse(n, 5), RadicalInverse(n, 7), o);
    evaluate(i, o, f);
    for (const double value : f)
    {
      total += std::abs(value);
      negative += std::max(-value, 0.0);
    }
  }
  return total > 0.0 ? negative / total : 0.0;
}
} // namespace measuredbrdf

#endif
