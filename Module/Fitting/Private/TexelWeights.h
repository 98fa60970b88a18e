// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Convex weights of each texel, and which of many materials to mix.
 */

#ifndef TexelWeights_h
#define TexelWeights_h

#include "TexelSums.h"

#include <functional>
#include <vector>

namespace measuredbrdf
{
struct WeightSolution
{
  SmallVector Weights; // all 0: no photograph of this texel is valid
  double Residual = 0; // sum of squares that is left
};

/// The best convex weights of some of the materials for a texel.
WeightSolution SolveTexel(const TexelSums& sums, std::size_t k, const std::vector<int>& columns);

struct SelectionOptions
{
  int Most = 4;                        // materials
  double Tolerance = 0.02;             // a material must lower the sum of squares by this share
  std::function<bool(double)> Proceed; // share done; false: stop
};

/**
 * Which materials describe all texels best: forward selection, that is orthogonal matching pursuit
 * (Tropp, Gilbert, Strauss 2006, for many signals at once) with convex weights, then exchanges of
 * one material for another and removals while they pay. Empty if it was stopped or there is no
 * texel with a valid photograph.
 */
std::vector<int> SelectMaterials(const TexelSums& sums, const SelectionOptions& options);
} // namespace measuredbrdf

#endif
