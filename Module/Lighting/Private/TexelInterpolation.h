// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What an environment is between the centers of its texels: bilinear in its coordinates, continued
 * around the seam; beyond the first and the last row's centers it is those rows.
 */

#ifndef TexelInterpolation_h
#define TexelInterpolation_h

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
/// Two neighbors among the texels of one axis, and the second one's weight.
struct TexelNeighbors
{
  std::size_t First;
  std::size_t Second;
  double Weight;

  /// coordinate: 0 to 1 over so many texels.
  static TexelNeighbors InRow(double coordinate, std::size_t size)
  {
    const double position = coordinate * static_cast<double>(size) - 0.5;
    const double below = std::floor(position);
    const std::size_t first = below < 0.0 ? size - 1 : Limit(below, size);
    return { first, first + 1 < size ? first + 1 : 0, position - below };
  }
  static TexelNeighbors InColumn(double coordinate, std::size_t size)
  {
    const double last = static_cast<double>(size) - 1.0;
    const double position = std::clamp(coordinate * static_cast<double>(size) - 0.5, 0.0, last);
    const std::size_t first = Limit(std::floor(position), size);
    return { first, std::min(first + 1, size - 1), position - static_cast<double>(first) };
  }

  double Mix(double first, double second) const { return first + this->Weight * (second - first); }

private:
  static std::size_t Limit(double index, std::size_t size)
  {
    return std::min(static_cast<std::size_t>(index), size - 1);
  }
};

/// Radiance at (u,v) in [0,1]^2 from texels that pixel(x, y) gives, a pointer to RGB of any type.
template <typename Pixel>
void InterpolateTexels(
  std::size_t width, std::size_t height, double u, double v, Pixel&& pixel, double rgb[3])
{
  const TexelNeighbors x = TexelNeighbors::InRow(u, width);
  const TexelNeighbors y = TexelNeighbors::InColumn(v, height);
  const auto* p00 = pixel(x.First, y.First);
  const auto* p10 = pixel(x.Second, y.First);
  const auto* p01 = pixel(x.First, y.Second);
  const auto* p11 = pixel(x.Second, y.Second);
  for (int c = 0; c < 3; ++c)
  {
    rgb[c] = y.Mix(x.Mix(p00[c], p10[c]), x.Mix(p01[c], p11[c]));
  }
}
} // namespace measuredbrdf

#endif
