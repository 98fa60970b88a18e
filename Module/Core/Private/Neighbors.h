// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Linear interpolation between samples at k + 1/2: indices and weights of two of n samples.
 */

#ifndef Neighbors_h
#define Neighbors_h

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
struct Neighbors
{
  int First;
  int Second;
  double Weight; // of Second

  template <typename T>
  T Mix(const T& first, const T& second) const
  {
    return first + this->Weight * (second - first);
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

/// A value at (u,v) in [0,1]^2 of a lat-long image whose texels get(x, y) gives: bilinear between
/// their centers, continued around the seam; beyond the outer rows' centers it is those rows.
template <typename Get>
auto InterpolateTexels(int width, int height, double u, double v, const Get& get)
{
  const Neighbors x = PeriodicNeighbors(u, width);
  const Neighbors y = ClampedNeighbors(v, height);
  return y.Mix(x.Mix(get(x.First, y.First), get(x.Second, y.First)),
    x.Mix(get(x.First, y.Second), get(x.Second, y.Second)));
}
} // namespace measuredbrdf

#endif
