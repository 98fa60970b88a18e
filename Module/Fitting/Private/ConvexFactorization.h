// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Non-negative factors of photographs: materials' values times texels' convex weights.
 */

#ifndef ConvexFactorization_h
#define ConvexFactorization_h

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace measuredbrdf
{
struct FactorizationOptions
{
  int Materials = 4; // at most MaximumNumberOfUnknowns
  unsigned int Seed = 1;
  int MostIterations = 200;
  double Tolerance = 1e-5;             // relative change of the sum of squares that ends it
  double Compactness = 1e-3;           // how strongly materials are drawn together
  std::function<bool(double)> Proceed; // share done; false: stop
};

struct Factorization
{
  Eigen::MatrixXd Values;  // [row, material], >= 0
  Eigen::MatrixXd Weights; // [material, texel], >= 0, sums of 1
  double RelativeError = 0.0;
  int Iterations = 0;
  bool Converged = false;
  bool Stopped = false;
};

/**
 * data, [row, texel] with three rows a photograph, as values times weights. mask, where it is not
 * empty, is not 0 where data say nothing: [texel][photograph]. Alternating constrained least
 * squares (Lawrence et al. 2006, section 4), from the texels that lie farthest apart: the
 * successive projection algorithm (Gillis and Vavasis 2014) in the affine subspace of the largest
 * variance. Masked entries take the model's values in each round.
 *
 * Larger simplices around the data fit them as well, so materials are drawn together: Compactness
 * times the number of texels times the mean squared distance between materials is added to the sum
 * of squares (Berman et al. 2004, "ICE: a statistical approach to identifying endmembers"). The
 * same input and seed give the same bits on any number of threads.
 */
Factorization Factorize(const Eigen::MatrixXf& data, const std::vector<unsigned char>& mask,
  const FactorizationOptions& options);
} // namespace measuredbrdf

#endif
