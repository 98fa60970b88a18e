// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Nonlinear least squares with few unknowns, each between two bounds: the method of Levenberg
 * (1944) and Marquardt (1963), whose steps end at the bounds (Kanzow, Yamashita, Fukushima 2004).
 * An unknown that lies at a bound, and that the sum of squares pushes outwards, does not move.
 */

#ifndef LevenbergMarquardt_h
#define LevenbergMarquardt_h

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <vector>

namespace measuredbrdf
{
struct LevenbergMarquardt
{
  Eigen::VectorXd Least, Most; // the bounds
  int MostIterations = 200;
  double Tolerance = 1e-6; // least share of the squares that an iteration has to take away
  /// Called with the number of iterations that are done and the sum of squares; false: stop.
  std::function<bool(int, double)> Proceed;
  bool Converged = false;

  /// From a start within the bounds to a minimum. getResiduals(x) gives a vector, getJacobian(x, r)
  /// the matrix of its derivatives where it is r. Returns the sum of squares.
  template <typename GetResiduals, typename GetJacobian>
  double Minimize(
    const GetResiduals& getResiduals, const GetJacobian& getJacobian, Eigen::VectorXd& x)
  {
    constexpr double mostDamping = 1e10, leastStep = 1e-10;
    Eigen::VectorXd residuals = getResiduals(x);
    double squares = residuals.squaredNorm();
    double damping = 1e-4; // of the matrix' diagonal
    this->Converged = false;
    for (int k = 0; this->Proceed(k, squares) && k < this->MostIterations && !this->Converged; ++k)
    {
      const Eigen::MatrixXd jacobian = getJacobian(x, residuals);
      Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(x.size(), x.size());
      matrix.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
      matrix.triangularView<Eigen::StrictlyUpper>() = matrix.transpose();
      const Eigen::VectorXd gradient = jacobian.transpose() * residuals;
      const double before = squares;
      for (bool isLower = false; !isLower && damping < mostDamping;)
      {
        Eigen::MatrixXd damped = matrix;
        damped.diagonal() *= 1.0 + damping;
        const Eigen::VectorXd step = this->FindStep(damped, gradient, x);
        const Eigen::VectorXd next = x + step;
        Eigen::VectorXd there = getResiduals(next);
        isLower = there.squaredNorm() < squares;
        damping = isLower ? std::max(0.1 * damping, 1e-12) : 5.0 * damping;
        if (isLower)
        {
          this->Converged = step.norm() <= leastStep * x.norm();
          x = next.cwiseMax(this->Least).cwiseMin(this->Most);
          residuals.swap(there);
          squares = residuals.squaredNorm();
        }
      }
      // Where no step lowers the squares, this is the minimum.
      this->Converged = this->Converged || before - squares <= this->Tolerance * before;
    }
    return squares;
  }

private:
  // The step to where the gradient of the quadratic model vanishes. Unknowns that would leave their
  // bounds go as far as those, and the others are solved for again.
  Eigen::VectorXd FindStep(
    const Eigen::MatrixXd& matrix, const Eigen::VectorXd& gradient, const Eigen::VectorXd& x) const
  {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(x.size());
    std::vector<Eigen::Index> fixed, leaving;
    do
    {
      fixed.insert(fixed.end(), leaving.begin(), leaving.end());
      leaving.clear();
      Eigen::MatrixXd rows = matrix;
      Eigen::VectorXd right = -gradient;
      for (const Eigen::Index k : fixed)
      {
        right -= matrix.col(k) * step[k];
        rows.row(k).setZero();
        rows.col(k).setZero();
        rows(k, k) = 1.0;
      }
      for (const Eigen::Index k : fixed)
      {
        right[k] = step[k];
      }
      step = rows.ldlt().solve(right);
      const Eigen::VectorXd within = (x + step).cwiseMax(this->Least).cwiseMin(this->Most);
      for (Eigen::Index k = 0; k < x.size(); ++k)
      {
        const bool isFixed = std::find(fixed.begin(), fixed.end(), k) != fixed.end();
        if (within[k] != x[k] + step[k] && !isFixed)
        {
          leaving.push_back(k);
        }
        step[k] = within[k] - x[k];
      }
    } while (!leaving.empty());
    return step;
  }
};
} // namespace measuredbrdf

#endif
