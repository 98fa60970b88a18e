// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Filters of pictures of one value per pixel, with kernels that are a product of one along x and
 * one along y; and the similarity of two pictures by them.
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

/// Pixels on each side of the one that a window belongs to.
constexpr int SimilarityRadius = 5;

/**
 * SSIM, the structural similarity index (Wang, Bovik, Sheikh, Simoncelli, "Image Quality
 * Assessment: From Error Visibility to Structural Similarity", 2004), written from the paper, about
 * each pixel, in [-1,1]; 1 means equal. It uses a Gaussian window of 11 x 11 pixels, sigma 1.5;
 * values in [0,1], C1 = 0.01^2, C2 = 0.03^2. Within SimilarityRadius of the border the window is
 * not whole: the paper leaves these pixels out.
 */
Plane ComputeSimilarity(const Plane& picture, const Plane& reference);
} // namespace measuredbrdf

#endif
