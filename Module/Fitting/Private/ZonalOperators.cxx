// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ZonalOperators.h"

#include <numeric>

namespace measuredbrdf
{
//------------------------------------------------------------------------------
Eigen::MatrixXd MakeRadialMatrix(
  const BasisFunctions& functions, int m, const std::vector<double>& cosines)
{
  const int n = functions.GetOrder();
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(cosines.size()), n + 1 - m);
  std::vector<double> radial(static_cast<std::size_t>(functions.GetNumberOfRadials()));
  for (std::size_t q = 0; q < cosines.size(); ++q)
  {
    functions.EvaluateRadial(functions.ToX(cosines[q]), radial.data());
    for (int l = m; l <= n; ++l)
    {
      matrix(static_cast<Eigen::Index>(q), l - m) =
        radial[static_cast<std::size_t>(BasisFunctions::RadialIndex(l, m))];
    }
  }
  return matrix;
}

//------------------------------------------------------------------------------
Eigen::MatrixXd MakeLeastSquares(const BasisFunctions& functions, int m,
  const std::vector<double>& cosines, const std::vector<double>& weights, double regularization)
{
  const Eigen::MatrixXd radial = MakeRadialMatrix(functions, m, cosines);
  const Eigen::Index rows = radial.rows();
  const Eigen::Index columns = radial.cols();
  const Eigen::VectorXd root = Eigen::Map<const Eigen::VectorXd>(weights.data(), rows).cwiseSqrt();
  // The penalty as further rows: a QR of this matrix keeps twice the digits of normal equations.
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(rows + columns, columns);
  system.topRows(rows) = root.asDiagonal() * radial;
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (Eigen::Index column = 0; column < columns; ++column)
  {
    const double l = static_cast<double>(column) + m;
    system(rows + column, column) = std::sqrt(regularization * total / (4.0 * Pi)) * l * (l + 1.0);
  }
  Eigen::MatrixXd samples = Eigen::MatrixXd::Zero(rows + columns, rows);
  samples.topRows(rows) = root.asDiagonal();
  return system.colPivHouseholderQr().solve(samples);
}
} // namespace measuredbrdf
