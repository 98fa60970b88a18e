// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Low-discrepancy points: Halton's radical inverses (Halton 1960), and the golden ratio.
 */

#ifndef LowDiscrepancy_h
#define LowDiscrepancy_h

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
} // namespace measuredbrdf

#endif
