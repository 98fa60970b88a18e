// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * FLIP, the difference that a person sees when two pictures alternate (Andersson et al., "FLIP: A
 * Difference Evaluator for Alternating Images", 2020), and the exposures and tone mapping at which
 * HDR-FLIP computes it (Andersson et al., "Visualizing Errors in Rendered High Dynamic Range
 * Images", 2021), written from the papers.
 *
 * Color: opponent space YCxCz, blurred by the eye's contrast sensitivity at the papers' 67.02
 * pixels per degree, then CIELAB with Hunt's adjustment and the HyAB distance. Features: edges and
 * points of the luminance by derivatives of a Gaussian; where they differ, the color difference
 * has a larger weight.
 *
 * And SSIM, which is computed by the same filters.
 */

#ifndef Flip_h
#define Flip_h

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace measuredbrdf
{
/// A picture of one value a pixel, (x, y).
using Plane = Eigen::ArrayXXd;

/// Pixels on each side of the one that a window of SSIM belongs to.
constexpr int SimilarityRadius = 5;

/**
 * SSIM, the structural similarity index (Wang, Bovik, Sheikh, Simoncelli, "Image Quality
 * Assessment: From Error Visibility to Structural Similarity", 2004), written from the paper, about
 * each pixel, in [-1,1]; 1 means equal. It uses a Gaussian window of 11 x 11 pixels, sigma 1.5;
 * values in [0,1], C1 = 0.01^2, C2 = 0.03^2. Within SimilarityRadius of the border the window is
 * not whole: the paper leaves these pixels out.
 */
Plane ComputeSimilarity(const Plane& picture, const Plane& reference);

/// FLIP of each pixel, in [0,1]: pictures of width x height linear Rec. 709 triples in [0,1].
/// Beyond the border, the border's pixels are repeated.
std::vector<double> ComputeFlip(
  int width, int height, const std::vector<double>& picture, const std::vector<double>& reference);

/**
 * Exposures: factors of radiance, powers of 2 at equal distances of about a stop, at least two. The
 * first brings the reference's largest luminance to 0.85 of the display, the last brings the median
 * there. A median below 2^-23 of the largest is replaced by that value. There must be at least one
 * luminance, and the largest must be above 0.
 */
std::vector<double> FindExposures(std::vector<double> luminances);

/// Radiance times exposure -> linear display light in [0,1]: the papers' fit of the ACES curve
/// (Narkowicz 2015), its input times 0.6.
double ToneMapACES(double value);

/**
 * HDR-FLIP of each pixel, in [0,1]: the largest FLIP over the exposures of linear Rec. 709
 * radiance, tone mapped. goOn, where there is one, gets the share done before each exposure; where
 * it returns false, the result is empty.
 */
std::vector<double> ComputeHDRFlip(int width, int height, const std::vector<double>& picture,
  const std::vector<double>& reference, const std::vector<double>& exposures,
  const std::function<bool(double)>& goOn = nullptr);
} // namespace measuredbrdf

#endif
