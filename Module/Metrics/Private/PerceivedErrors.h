// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a person sees of an error, each written from its papers:
 *
 * CIEDE2000, the difference of two colors (Sharma, Wu, Dalal 2005).
 *
 * FLIP, the difference that shows when two pictures alternate (Andersson et al., "FLIP: A
 * Difference Evaluator for Alternating Images", 2020), and the exposures and tone mapping at which
 * HDR-FLIP computes it (Andersson et al., "Visualizing Errors in Rendered High Dynamic Range
 * Images", 2021). Color: opponent space YCxCz, blurred by the eye's contrast sensitivity at the
 * papers' 67.02 pixels per degree, then CIELAB with Hunt's adjustment and the HyAB distance.
 * Features: edges and points of the luminance by derivatives of a Gaussian; where they differ, the
 * color difference has a larger weight.
 *
 * SSIM, the structural similarity index (Wang, Bovik, Sheikh, Simoncelli, "Image Quality
 * Assessment: From Error Visibility to Structural Similarity", 2004).
 */

#ifndef PerceivedErrors_h
#define PerceivedErrors_h

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace measuredbrdf
{
/// A color, or those of a picture's pixels side by side.
using Colors = Eigen::Array3Xd;
/// A number for each pixel.
using Values = Eigen::Array<double, 1, Eigen::Dynamic>;
/// The same as a picture, (x, y).
using Plane = Eigen::ArrayXXd;

/// CIELAB of linear Rec. 709, relative to white.
Colors ToLab(const Colors& linear);

double GetDeltaE2000(const Eigen::Array3d& lab1, const Eigen::Array3d& lab2);

/// Pixels on each side of the one that a window of SSIM belongs to.
constexpr int SimilarityRadius = 5;

/**
 * SSIM about each pixel, in [-1,1]; 1 means equal. It uses a Gaussian window of 11 x 11 pixels,
 * sigma 1.5; values in [0,1], C1 = 0.01^2, C2 = 0.03^2. Within SimilarityRadius of the border the
 * window is not whole: the paper leaves these pixels out.
 */
Plane ComputeSimilarity(const Plane& picture, const Plane& reference);

/// FLIP of each pixel, in [0,1]: pictures of linear Rec. 709 in [0,1]. Beyond the border, the
/// border's pixels are repeated.
Values ComputeFlip(int width, int height, const Colors& picture, const Colors& reference);

/**
 * Exposures: factors of radiance, powers of 2 at equal distances of about a stop, at least two. The
 * first brings the reference's largest luminance to 0.85 of the display, the last brings the median
 * there. A median below 2^-23 of the largest is replaced by that value. There must be at least one
 * luminance, and the largest must be above 0.
 */
std::vector<double> FindExposures(std::vector<double> luminances);

/**
 * HDR-FLIP of each pixel, in [0,1]: the largest FLIP over the exposures of linear Rec. 709
 * radiance, tone mapped by the papers' fit of the ACES curve. goOn, where there is one, gets the
 * share done before each exposure; where it returns false, the result is empty.
 */
Values ComputeHDRFlip(int width, int height, const Colors& picture, const Colors& reference,
  const std::vector<double>& exposures, const std::function<bool(double)>& goOn = nullptr);
} // namespace measuredbrdf

#endif
