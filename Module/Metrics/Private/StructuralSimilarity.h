// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * SSIM, the structural similarity index (Wang, Bovik, Sheikh, Simoncelli, "Image Quality
 * Assessment: From Error Visibility to Structural Similarity", 2004), written from the paper.
 */

#ifndef StructuralSimilarity_h
#define StructuralSimilarity_h

#include "SeparableFilter.h"

namespace measuredbrdf
{
/// Pixels on each side of the one that a window belongs to.
constexpr int SimilarityRadius = 5;

/**
 * SSIM about each pixel, in [-1,1]; 1 means equal. It uses a Gaussian window of 11 x 11 pixels,
 * sigma 1.5; values in [0,1], C1 = 0.01^2, C2 = 0.03^2. Within SimilarityRadius of the border the
 * window is not whole: the paper leaves these pixels out.
 */
Plane ComputeSimilarity(const Plane& picture, const Plane& reference);
} // namespace measuredbrdf

#endif
