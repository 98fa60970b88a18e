// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the photographs leave open: materials that look alike in them, and weights that are hardly
 * determined.
 */

#ifndef MapFindings_h
#define MapFindings_h

#include "MapFitData.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace measuredbrdf
{
struct IdentityFacts
{
  Eigen::MatrixXd Values; // of the result's materials: MaterialValues::Values
  double Residual = 0.0;  // sum of squares over all texels
  double Samples = 0.0;   // valid values of all texels
  double Texels = 0.0;    // that have a valid photograph
  // Of a library only:
  const std::vector<NamedMaterial>* Library = nullptr;
  Eigen::MatrixXd LibraryValues;
  std::vector<int> Chosen; // the result's materials in it
};

/// Standard deviation of each material's weight in a texel that all photographs see, where no
/// weight is 0: the residual's variance, propagated. Infinite where the photographs do not tell.
std::vector<double> GetWeightUncertainties(const IdentityFacts& facts);

/// For people, a sentence each.
std::vector<std::string> FindIdentityProblems(
  const IdentityFacts& facts, const MapFitResult& result);
} // namespace measuredbrdf

#endif
