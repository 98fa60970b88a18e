// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * FLIP, the difference that a person sees when two pictures alternate (Andersson et al., "FLIP: A
 * Difference Evaluator for Alternating Images", 2020), written from the paper.
 *
 * Colour: opponent space YCxCz, blurred by the eye's contrast sensitivity at 67 pixels per degree,
 * then CIELAB with Hunt's adjustment and the HyAB distance. Features: edges and points of the
 * luminance by derivatives of a Gaussian; where they differ, the colour difference counts for more.
 */

#ifndef Flip_h
#define Flip_h

#include <vector>

namespace measuredbrdf
{
/// FLIP of each pixel, in [0,1]: pictures of width x height sRGB-encoded triples in [0,1]. Beyond
/// the border the pixels on it go on.
std::vector<double> ComputeFlip(
  int width, int height, const std::vector<double>& picture, const std::vector<double>& reference);
} // namespace measuredbrdf

#endif
