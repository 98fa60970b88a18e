// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Filters pictures of one value per pixel with kernels that are a product of one along x and one
 * along y.
 */

#ifndef SeparableFilter_h
#define SeparableFilter_h

#include <vector>

namespace measuredbrdf
{
/// Rows one after the other.
struct Plane
{
  int Width;
  int Height;
  std::vector<double> Values;
};

/// Weights at -radius ... radius of a pixel: 2 radius + 1 of them.
using Kernel = std::vector<double>;

/// exp(-x^2 / (2 sigma^2)), divided by its sum.
Kernel MakeGaussian(double sigma, int radius);

/// The sum under both kernels. Beyond the border, the border's pixels are repeated.
Plane Filter(const Plane& plane, const Kernel& alongX, const Kernel& alongY);
} // namespace measuredbrdf

#endif
