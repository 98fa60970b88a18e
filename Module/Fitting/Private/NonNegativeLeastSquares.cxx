// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "NonNegativeLeastSquares.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace measuredbrdf
{
namespace
{
using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// In units where the diagonal is 1: what rounding leaves, and what keeps H from being singular.
constexpr double Zero = 1e-12;
constexpr double Ridge = 1e-11;

// H with the rows and columns of the unknowns that are not free replaced by the identity's.
Matrix Restrict(const Matrix& H, const std::vector<char>& free)
{
  Matrix restricted = H;
  for (int column = 0; column < restricted.outerSize(); ++column)
  {
    for (Matrix::InnerIterator it(restricted, column); it; ++it)
    {
      if (!free[it.row()] || !free[it.col()])
      {
        it.valueRef() = it.row() == it.col() ? 1.0 : 0.0;
      }
    }
  }
  return restricted;
}
}

//------------------------------------------------------------------------------
void SolveNonNegative(const Matrix& H, const Vector& g, Vector& x)
{
  const Eigen::Index n = g.size();
  // Unknowns can differ by ten orders of magnitude: scale the diagonal to 1.
  Vector scale = Vector::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k)
  {
    const double diagonal = H.coeff(k, k);
    scale[k] = diagonal > 0.0 ? 1.0 / std::sqrt(diagonal) : 0.0;
  }
  Matrix scaled = scale.asDiagonal() * H * scale.asDiagonal();
  for (Eigen::Index k = 0; k < n; ++k)
  {
    scaled.coeffRef(k, k) = 1.0 + Ridge;
  }
  const Vector target = g.cwiseProduct(scale);
  const double tolerance = Zero * target.cwiseAbs().maxCoeff();

  std::vector<char> free(static_cast<std::size_t>(n));
  for (Eigen::Index k = 0; k < n; ++k)
  {
    free[k] = x[k] > 0.0;
  }
  Eigen::SimplicialLDLT<Matrix> solver;
  solver.analyzePattern(scaled);
  Vector y = Vector::Zero(n);
  Eigen::Index fewest = n + 1;
  int patience = 3; // exchanges of whole blocks without progress before single ones
  for (Eigen::Index pass = 0; pass < 5 * n + 50; ++pass)
  {
    solver.factorize(Restrict(scaled, free));
    Vector right = target;
    for (Eigen::Index k = 0; k < n; ++k)
    {
      right[k] = free[k] ? right[k] : 0.0;
    }
    y = solver.solve(right);
    const Vector gradient = scaled.selfadjointView<Eigen::Lower>() * y - target;
    Eigen::Index wrong = 0, last = 0;
    const auto isWrong = [&](Eigen::Index k)
    { return free[k] ? y[k] < -tolerance : gradient[k] < -tolerance; };
    for (Eigen::Index k = 0; k < n; ++k)
    {
      wrong += isWrong(k) ? 1 : 0;
      last = isWrong(k) ? k : last;
    }
    if (wrong == 0)
    {
      break;
    }
    patience = wrong < fewest ? 3 : patience - 1;
    fewest = std::min(fewest, wrong);
    std::vector<char> next = free;
    for (Eigen::Index k = patience < 0 ? last : 0; k <= last; ++k)
    {
      next[k] = isWrong(k) ? !free[k] : free[k];
    }
    free = next;
  }
  x = y.cwiseMax(0.0).cwiseProduct(scale);
}
} // namespace measuredbrdf
