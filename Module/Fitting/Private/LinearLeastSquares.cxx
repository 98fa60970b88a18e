// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LinearLeastSquares.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace measuredbrdf
{
namespace
{
// Relative to the problem's own size: what rounding leaves, and what keeps H from being singular.
constexpr double Zero = 1e-11;
constexpr double Ridge = 1e-13;

class ActiveSet
{
public:
  ActiveSet(const SmallMatrix& H, const SmallVector& g, UnknownsAre constraint)
    : H(H)
    , G(g)
    , HasSum(constraint == UnknownsAre::Shares)
    , X(SmallVector::Zero(g.size()))
  {
    this->Free.reserve(MaximumNumberOfUnknowns);
    const double diagonal = std::max(H.diagonal().maxCoeff(), 0.0);
    this->RidgeValue = Ridge * diagonal + std::numeric_limits<double>::min();
    this->Tolerance = Zero * (diagonal + g.cwiseAbs().maxCoeff());
    if (this->HasSum) // the best of the corners
    {
      Eigen::Index corner = 0;
      (0.5 * H.diagonal() - g).minCoeff(&corner);
      this->X[corner] = 1.0;
      this->Free.push_back(static_cast<int>(corner));
      this->SolveFree();
    }
  }

  SmallVector Solve()
  {
    const int most = 3 * static_cast<int>(this->G.size()) + 10;
    for (int pass = 0; pass < most; ++pass)
    {
      const int entering = this->FindEntering();
      if (entering < 0)
      {
        break;
      }
      this->Free.push_back(entering);
      this->SolveFree();
      if (this->Z[this->Z.size() - 1] <= 0.0) // rounding only: it would not improve
      {
        break;
      }
      this->Descend();
    }
    return this->X;
  }

private:
  // The unknown at 0 whose growth improves most; -1: none.
  int FindEntering() const
  {
    const SmallVector gradient = this->G - this->H * this->X;
    int best = -1;
    double most = this->Tolerance;
    for (int k = 0; k < this->G.size(); ++k)
    {
      const double gain = gradient[k] - this->Multiplier;
      if (gain > most && std::find(this->Free.begin(), this->Free.end(), k) == this->Free.end())
      {
        best = k;
        most = gain;
      }
    }
    return best;
  }

  // The best values of the free unknowns, whatever their sign.
  void SolveFree()
  {
    SmallMatrix h = this->H(this->Free, this->Free);
    h.diagonal().array() += this->RidgeValue;
    SmallMatrix right = SmallMatrix::Ones(h.rows(), 2);
    right.col(0) = this->G(this->Free);
    const SmallMatrix solved = h.ldlt().solve(right);
    this->Z = solved.col(0);
    if (this->HasSum)
    {
      this->Multiplier = (this->Z.sum() - 1.0) / solved.col(1).sum();
      this->Z -= this->Multiplier * solved.col(1);
    }
  }

  // From X towards Z, dropping the unknowns that reach 0 on the way.
  void Descend()
  {
    while (!this->Free.empty())
    {
      const SmallVector x = this->X(this->Free);
      double step = 1.0;
      Eigen::Index leaving = -1;
      for (Eigen::Index a = 0; a < x.size(); ++a)
      {
        if (this->Z[a] <= 0.0 && x[a] / (x[a] - this->Z[a]) <= step)
        {
          step = x[a] / (x[a] - this->Z[a]);
          leaving = a;
        }
      }
      if (leaving < 0)
      {
        this->X(this->Free) = this->Z;
        return;
      }
      this->X(this->Free) = (x + step * (this->Z - x)).cwiseMax(0.0);
      this->X[this->Free[static_cast<std::size_t>(leaving)]] = 0.0;
      this->Free.erase(this->Free.begin() + leaving);
      this->SolveFree();
    }
  }

  const SmallMatrix& H;
  const SmallVector& G;
  bool HasSum;
  SmallVector X;
  SmallVector Z;         // of the free unknowns, in their order
  std::vector<int> Free; // the unknowns that are not held at 0
  double Multiplier = 0.0;
  double RidgeValue = 0.0;
  double Tolerance = 0.0;
};
}

//------------------------------------------------------------------------------
SmallVector SolveConstrained(const SmallMatrix& H, const SmallVector& g, UnknownsAre constraint)
{
  SmallVector x = ActiveSet(H, g, constraint).Solve();
  if (constraint == UnknownsAre::Shares && x.sum() > 0.0)
  {
    x /= x.sum(); // rounding
  }
  return x;
}

//------------------------------------------------------------------------------
SmallVector GetShareVariances(const SmallMatrix& H)
{
  const Eigen::Index n = H.rows();
  SmallVector variances = SmallVector::Zero(n);
  if (n < 2)
  {
    return variances;
  }
  // On the plane of constant sum, which H then maps to itself; across it is 1 / n.
  const Eigen::MatrixXd across = Eigen::MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n));
  const Eigen::MatrixXd plane = Eigen::MatrixXd::Identity(n, n) - across;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(plane * H * plane);
  const double least = 1e-12 * H.diagonal().maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k)
  {
    // What is left of the vector for sums of 1, and of rounding.
    const Eigen::ArrayXd squares = (plane * eigen.eigenvectors().col(k)).array().square();
    const double value = eigen.eigenvalues()[k];
    variances.array() +=
      value > least
        ? Eigen::ArrayXd(squares / value)
        : (squares > 1e-9).select(std::numeric_limits<double>::infinity(), Eigen::ArrayXd::Zero(n));
  }
  return variances;
}

//------------------------------------------------------------------------------
void SolveNonNegative(
  const Eigen::SparseMatrix<double>& H, const Eigen::VectorXd& g, Eigen::VectorXd& x)
{
  using Matrix = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;
  // In units where the diagonal is 1: what rounding leaves, and what keeps H from being singular.
  constexpr double zero = 1e-12, ridge = 1e-11;
  const Eigen::Index n = g.size();
  // Unknowns can differ by ten orders of magnitude: scale the diagonal to 1.
  const Vector diagonal = H.diagonal();
  const Vector scale = (diagonal.array() > 0.0).select(diagonal.cwiseSqrt().cwiseInverse(), 0.0);
  Matrix scaled = scale.asDiagonal() * H * scale.asDiagonal();
  for (Eigen::Index k = 0; k < n; ++k)
  {
    scaled.coeffRef(k, k) = 1.0 + ridge;
  }
  const Vector target = g.cwiseProduct(scale);
  const double tolerance = zero * target.cwiseAbs().maxCoeff();

  using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;
  Flags free = x.array() > 0.0;
  Eigen::SimplicialLDLT<Matrix> solver;
  solver.analyzePattern(scaled);
  Vector y = Vector::Zero(n);
  Eigen::Index fewest = n + 1;
  int patience = 3; // exchanges of whole blocks without progress before single ones
  for (Eigen::Index pass = 0; pass < 5 * n + 50; ++pass)
  {
    // Rows and columns of the unknowns that are not free become the identity's.
    Matrix restricted = scaled;
    for (Eigen::Index column = 0; column < n; ++column)
    {
      for (Matrix::InnerIterator it(restricted, column); it; ++it)
      {
        if (!free[it.row()] || !free[it.col()])
        {
          it.valueRef() = it.row() == it.col() ? 1.0 : 0.0;
        }
      }
    }
    solver.factorize(restricted);
    const Vector right = free.select(target, 0.0);
    y = solver.solve(right);
    const Vector gradient = scaled.selfadjointView<Eigen::Lower>() * y - target;
    Flags wrong(n);
    Eigen::Index last = 0;
    for (Eigen::Index k = 0; k < n; ++k)
    {
      wrong[k] = free[k] ? y[k] < -tolerance : gradient[k] < -tolerance;
      last = wrong[k] ? k : last;
    }
    if (!wrong.any())
    {
      break;
    }
    patience = wrong.count() < fewest ? 3 : patience - 1;
    fewest = std::min(fewest, wrong.count());
    if (patience < 0)
    {
      free[last] = !free[last];
    }
    else
    {
      free = free != wrong;
    }
  }
  x = y.cwiseMax(0.0).cwiseProduct(scale);
}
} // namespace measuredbrdf
