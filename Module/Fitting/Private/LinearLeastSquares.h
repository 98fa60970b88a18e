// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Linear least squares from the normal equations with constraints: small problems with unknowns >=
 * 0, or >= 0 with a sum of 1; large sparse ones with unknowns >= 0.
 */

#ifndef LinearLeastSquares_h
#define LinearLeastSquares_h

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace measuredbrdf
{
/// Most unknowns.
constexpr int MaximumNumberOfUnknowns = 32;

/// They live on the stack: millions of these problems are solved.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
  MaximumNumberOfUnknowns, MaximumNumberOfUnknowns>;
using SmallVector =
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, MaximumNumberOfUnknowns, 1>;

enum class UnknownsAre
{
  NonNegative,
  Shares // and their sum is 1
};

/**
 * The x that minimizes x'Hx/2 - g'x under the constraint, by the active-set method of Lawson and
 * Hanson (1974, "Solving least squares problems", chapter 23); the sum is kept by a Lagrange
 * multiplier (Nocedal and Wright 2006, section 16.5). H is symmetric positive semidefinite. Where
 * several x are best, one of them. The same input gives the same bits.
 */
SmallVector SolveConstrained(const SmallMatrix& H, const SmallVector& g, UnknownsAre constraint);

/// The variances of shares, for residuals of variance 1, where all of them are free: the diagonal
/// of the inverse of H on the plane of constant sum. Infinite where H has no inverse there.
SmallVector GetShareVariances(const SmallMatrix& H);

/**
 * The x >= 0 that minimizes x'Hx/2 - g'x, by block principal pivoting (Portugal, Judice, Vicente
 * 1994). H is symmetric positive semidefinite; only its lower triangle is read. On input, x says
 * which unknowns are probably free (> 0). Unknowns without an effect become 0.
 */
void SolveNonNegative(
  const Eigen::SparseMatrix<double>& H, const Eigen::VectorXd& g, Eigen::VectorXd& x);
} // namespace measuredbrdf

#endif
