// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Values and least squares of BasisFunctions of one azimuthal order |m|, over polar angles.
 */

#ifndef ZonalOperators_h
#define ZonalOperators_h

#include "BasisFunctions.h"

#include <Eigen/Dense>

#include <vector>

namespace measuredbrdf
{
/// radial_lm(x of each cosine): a column per degree l = m ... order.
inline Eigen::MatrixXd MakeRadialMatrix(
  const BasisFunctions& functions, int m, const std::vector<double>& cosines)
{
  const int n = functions.GetOrder();
  Eigen::MatrixXd matrix(cosines.size(), n + 1 - m);
  std::vector<double> radial(functions.GetNumberOfRadials());
  for (std::size_t q = 0; q < cosines.size(); ++q)
  {
    functions.EvaluateRadial(functions.ToX(cosines[q]), radial.data());
    for (int l = m; l <= n; ++l)
    {
      matrix(q, l - m) = radial[BasisFunctions::RadialIndex(l, m)];
    }
  }
  return matrix;
}

/// From samples at the cosines to the coefficients that minimize their weighted squared error plus
/// regularization * (sum of weights) / (4 pi) * sum of (l (l+1))^2 C^2.
inline Eigen::MatrixXd MakeLeastSquares(const BasisFunctions& functions, int m,
  const std::vector<double>& cosines, const std::vector<double>& weights, double regularization)
{
  const Eigen::MatrixXd radial = MakeRadialMatrix(functions, m, cosines);
  const Eigen::Index rows = radial.rows(), columns = radial.cols();
  const Eigen::Map<const Eigen::VectorXd> weight(weights.data(), rows);
  const Eigen::VectorXd root = weight.cwiseSqrt();
  // The penalty as further rows: a QR of this matrix keeps twice the digits of normal equations.
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(rows + columns, columns);
  system.topRows(rows) = root.asDiagonal() * radial;
  for (Eigen::Index column = 0; column < columns; ++column)
  {
    const double l = static_cast<double>(column) + m;
    system(rows + column, column) =
      std::sqrt(regularization * weight.sum() / (4.0 * Pi)) * l * (l + 1.0);
  }
  Eigen::MatrixXd samples = Eigen::MatrixXd::Zero(rows + columns, rows);
  samples.topRows(rows) = root.asDiagonal();
  return system.colPivHouseholderQr().solve(samples);
}
} // namespace measuredbrdf

#endif
