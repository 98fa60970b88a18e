// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Linear interpolation between samples at k + 1/2: indices and weights of two of n samples; and the
 * steps in which texture units have these weights.
 */

#ifndef Neighbors_h
#define Neighbors_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
struct Neighbors
{
  int First;
  int Second;
  double Weight; // of Second
};

constexpr int MostFilterBits = 23; // a float's

/// Weights in steps of 2^-Bits; 0: any (vtkRadianceIntegrator::SetFilterWeightBits).
///
/// Texture units round each axis' weight, and the products that are the corners' weights as well: a
/// corner that takes share x of its side y has Round(x y), and its neighbor the rest, so that they
/// add up to 1. Three axes are rounded in the order x z, then y. So does an NVIDIA H200
/// (docs/graphics-card.md).
struct FilterWeights
{
  int Bits = 0;

  double Round(double weight) const
  {
    return this->Bits > 0 ? std::ldexp(std::round(std::ldexp(weight, this->Bits)), -this->Bits)
                          : weight;
  }

  /// Of the texels at (0, 0), (1, 0), (0, 1), (1, 1).
  std::array<double, 4> GetCorners(double x, double y) const
  {
    const double u = this->Round(x);
    const double v = this->Round(y);
    const double both = this->Round(u * v);
    return { 1.0 - u - v + both, u - both, v - both, both };
  }

  /// Of these four at z = 0, then at z = 1.
  std::array<double, 8> GetCorners(double x, double y, double z) const
  {
    const std::array<double, 4> slice = this->GetCorners(x, z);
    const double v = this->Round(y);
    std::array<double, 8> corners;
    for (std::size_t k = 0; k < 4; ++k)
    {
      const double upper = this->Round(slice[k] * v);
      const std::size_t first = k % 2 + 4 * (k / 2);
      corners[first] = slice[k] - upper;
      corners[first + 2] = upper;
    }
    return corners;
  }
};

/// Neighbors of coordinate u in [0,1]; constant beyond the outermost samples.
inline Neighbors ClampedNeighbors(double u, int n)
{
  const double x = std::clamp(u * n - 0.5, 0.0, n - 1.0);
  const int first = std::min(static_cast<int>(x), std::max(n - 2, 0));
  return { first, std::min(first + 1, n - 1), x - first };
}

/// Neighbors of coordinate u, which is periodic with period 1.
inline Neighbors PeriodicNeighbors(double u, int n)
{
  const double x = (u - std::floor(u)) * n - 0.5;
  const double base = std::floor(x);
  const int first = (static_cast<int>(base) + n) % n;
  return { first, (first + 1) % n, x - base };
}
} // namespace measuredbrdf

#endif
