// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Least squares of the bases' polar parts, one azimuthal order at a time: for real bases
 * radial_lm(x) cos/sin(m phi) the azimuthal orders never mix.
 */

#ifndef ZonalOperators_h
#define ZonalOperators_h

#include "BasisFunctions.h"

#include <Eigen/Dense>

#include <vector>

namespace measuredbrdf
{
/// Values radial_lm at the cosines: rows = cosines, columns l = m..order.
Eigen::MatrixXd MakeRadialMatrix(
  const BasisFunctions& functions, int m, const std::vector<double>& cosines);

/**
 * The matrix that takes samples g at the cosines to the coefficients minimizing
 * sum_q w_q (g_q - sum_l c_l radial_lm)^2 + regularization sum_q w_q sum_l (l(l+1))^2 c_l^2 / 4 pi.
 */
Eigen::MatrixXd MakeLeastSquares(const BasisFunctions& functions, int m,
  const std::vector<double>& cosines, const std::vector<double>& weights, double regularization);
} // namespace measuredbrdf

#endif
