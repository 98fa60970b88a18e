// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Eigenvalues and eigenvectors of symmetric matrices.
 */

#ifndef SymmetricEigen_h
#define SymmetricEigen_h

#include <Eigen/Core>

namespace measuredbrdf
{
struct SymmetricEigen
{
  /// Takes the lower triangle. In a file of its own, as compiling Eigen's solver takes seconds.
  explicit SymmetricEigen(const Eigen::MatrixXd& matrix);

  Eigen::VectorXd Values;  // ascending
  Eigen::MatrixXd Vectors; // unit columns, in that order
};
} // namespace measuredbrdf

#endif
