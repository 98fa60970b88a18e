// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SymmetricEigen.h"

#include <gtest/gtest.h>

TEST(SymmetricEigen, AscendingPairsOfAMatrix)
{
  Eigen::MatrixXd matrix(4, 4);
  matrix << 4.0, -1.0, 0.5, 2.0, -1.0, -3.0, 0.25, 1.0, 0.5, 0.25, 9.0, -0.5, 2.0, 1.0, -0.5, 0.0;
  const measuredbrdf::SymmetricEigen eigen(matrix);
  ASSERT_EQ(eigen.Values.size(), 4);
  for (Eigen::Index k = 0; k < 3; ++k)
  {
    EXPECT_LT(eigen.Values[k], eigen.Values[k + 1]);
  }
  const Eigen::MatrixXd& vectors = eigen.Vectors;
  const Eigen::MatrixXd scaled = vectors * eigen.Values.asDiagonal();
  EXPECT_LT((matrix * vectors - scaled).cwiseAbs().maxCoeff(), 1e-13);
  const Eigen::MatrixXd products = vectors.transpose() * vectors;
  EXPECT_LT((products - Eigen::MatrixXd::Identity(4, 4)).cwiseAbs().maxCoeff(), 1e-14);
}
