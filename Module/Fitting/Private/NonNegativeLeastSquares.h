// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Linear least squares with all unknowns >= 0, from the normal equations.
 */

#ifndef NonNegativeLeastSquares_h
#define NonNegativeLeastSquares_h

#include <Eigen/SparseCore>

namespace measuredbrdf
{
/**
 * The x >= 0 that minimizes x'Hx/2 - g'x, by block principal pivoting (Portugal, Judice, Vicente
 * 1994). H is symmetric positive semidefinite; only its lower triangle is read. On input, x says
 * which unknowns are probably free (> 0). Unknowns without an effect become 0.
 */
void SolveNonNegative(
  const Eigen::SparseMatrix<double>& H, const Eigen::VectorXd& g, Eigen::VectorXd& x);
} // namespace measuredbrdf

#endif
