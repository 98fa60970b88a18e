// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SimplexLeastSquares.h"

#include "SymmetricEigen.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

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
    const double diagonal = std::max(H.diagonal().maxCoeff(), 0.0);
    this->RidgeValue = Ridge * diagonal + std::numeric_limits<double>::min();
    this->Tolerance = Zero * (diagonal + g.cwiseAbs().maxCoeff());
    if (this->HasSum) // the best of the corners
    {
      Eigen::Index corner = 0;
      (0.5 * H.diagonal() - g).minCoeff(&corner);
      this->X[corner] = 1.0;
      this->Free[this->Count++] = static_cast<int>(corner);
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
      this->Free[this->Count++] = entering;
      this->SolveFree();
      if (this->Z[this->Count - 1] <= 0.0) // rounding only: it would not improve
      {
        this->Count--;
        break;
      }
      this->Descend();
    }
    return this->X;
  }

private:
  bool IsFree(int k) const
  {
    return std::find(this->Free, this->Free + this->Count, k) != this->Free + this->Count;
  }

  // The unknown at 0 whose growth improves most; -1: none.
  int FindEntering() const
  {
    const SmallVector gradient = this->G - this->H * this->X;
    int best = -1;
    double most = this->Tolerance;
    for (int k = 0; k < this->G.size(); ++k)
    {
      const double gain = gradient[k] - this->Multiplier;
      if (gain > most && !this->IsFree(k))
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
    SmallMatrix h(this->Count, this->Count);
    SmallMatrix right(this->Count, 2);
    for (int a = 0; a < this->Count; ++a)
    {
      for (int b = 0; b < this->Count; ++b)
      {
        h(a, b) = this->H(this->Free[a], this->Free[b]);
      }
      h(a, a) += this->RidgeValue;
      right(a, 0) = this->G[this->Free[a]];
      right(a, 1) = 1.0;
    }
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
    while (this->Count > 0)
    {
      double step = 1.0;
      int leaving = -1;
      for (int a = 0; a < this->Count; ++a)
      {
        const double x = this->X[this->Free[a]];
        if (this->Z[a] <= 0.0 && x / (x - this->Z[a]) <= step)
        {
          step = x / (x - this->Z[a]);
          leaving = a;
        }
      }
      for (int a = 0; a < this->Count; ++a)
      {
        double& x = this->X[this->Free[a]];
        x = leaving < 0 ? this->Z[a] : std::max(x + step * (this->Z[a] - x), 0.0);
      }
      if (leaving < 0)
      {
        return;
      }
      this->X[this->Free[leaving]] = 0.0;
      std::copy(this->Free + leaving + 1, this->Free + this->Count, this->Free + leaving);
      this->Count--;
      this->SolveFree();
    }
  }

  const SmallMatrix& H;
  const SmallVector& G;
  bool HasSum;
  SmallVector X;
  SmallVector Z; // of the free unknowns, in their order
  int Free[MaximumNumberOfUnknowns];
  int Count = 0;
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
  // Helmert's basis of the plane: each column compares an unknown with those before it.
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, n - 1);
  for (Eigen::Index k = 1; k < n; ++k)
  {
    const double length = std::sqrt(static_cast<double>(k * (k + 1)));
    basis.col(k - 1).head(k).setConstant(1.0 / length);
    basis(k, k - 1) = -static_cast<double>(k) / length;
  }
  const SymmetricEigen eigen(basis.transpose() * H * basis);
  const Eigen::MatrixXd vectors = basis * eigen.Vectors;
  const double least = 1e-12 * H.diagonal().maxCoeff();
  for (Eigen::Index k = 0; k < n - 1; ++k)
  {
    const double value = eigen.Values[k];
    for (Eigen::Index row = 0; row < n; ++row)
    {
      const double square = std::pow(vectors(row, k), 2);
      variances[row] += value > least   ? square / value
                        : square > 1e-9 ? std::numeric_limits<double>::infinity()
                                        : 0.0;
    }
  }
  return variances;
}
} // namespace measuredbrdf
