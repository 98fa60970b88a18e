// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SymmetricEigen.h"

#include <Eigen/Eigenvalues>

namespace measuredbrdf
{
SymmetricEigen::SymmetricEigen(const Eigen::MatrixXd& matrix)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  this->Values = solver.eigenvalues();
  this->Vectors = solver.eigenvectors();
}
} // namespace measuredbrdf
