// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Nonlinear least squares with few unknowns, each between two bounds: Ceres' Levenberg-Marquardt.
 */

#ifndef LeastSquares_h
#define LeastSquares_h

#include <Eigen/Core>
#include <ceres/ceres.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <limits>

namespace measuredbrdf
{
struct LeastSquares
{
  Eigen::VectorXd Least, Most; // the bounds
  int MostIterations = 200;
  double Tolerance = 1e-6; // least share of the squares that an iteration has to take away
  /// Called with the number of iterations that are done and the sum of squares; false: stop.
  std::function<bool(int, double)> Proceed;
  bool Converged = false;

  /// Moves x from a start within the bounds to a minimum. getResiduals(x) gives the residuals r,
  /// getJacobian(x, r) the matrix of their derivatives. Returns the sum of squares, or infinity
  /// where Ceres failed. Exceptions of the two functions are thrown again here.
  template <typename GetResiduals, typename GetJacobian>
  double Minimize(
    const GetResiduals& getResiduals, const GetJacobian& getJacobian, Eigen::VectorXd& x)
  {
    std::exception_ptr thrown;
    Cost<GetResiduals, GetJacobian> cost(getResiduals, getJacobian, x, thrown);
    Watcher watcher(*this, thrown);
    ceres::Problem::Options kept;
    kept.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(kept);
    problem.AddResidualBlock(&cost, nullptr, x.data());
    for (int k = 0; k < x.size(); ++k)
    {
      problem.SetParameterLowerBound(x.data(), k, this->Least[k]);
      problem.SetParameterUpperBound(x.data(), k, this->Most[k]);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.num_threads = 1; // the same sums in the same order: the same result
    options.max_num_iterations = this->MostIterations;
    options.function_tolerance = this->Tolerance;
    options.parameter_tolerance = 1e-10;
    // Bounds make Ceres search along each step; a cubic would take the derivatives at every trial.
    options.line_search_interpolation_type = ceres::QUADRATIC;
    options.logging_type = ceres::SILENT;
    options.callbacks.push_back(&watcher);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (thrown)
    {
      std::rethrow_exception(thrown);
    }
    this->Converged = summary.termination_type == ceres::CONVERGENCE;
    // Ceres' cost is half the sum of squares.
    return summary.termination_type == ceres::FAILURE ? std::numeric_limits<double>::infinity()
                                                      : 2.0 * summary.final_cost;
  }

private:
  template <typename GetResiduals, typename GetJacobian>
  class Cost : public ceres::CostFunction
  {
  public:
    Cost(const GetResiduals& residuals, const GetJacobian& jacobian, const Eigen::VectorXd& start,
      std::exception_ptr& thrown)
      : Residuals(residuals)
      , Jacobian(jacobian)
      , X(start)
      , Values(residuals(start))
      , Thrown(thrown)
    {
      this->set_num_residuals(static_cast<int>(this->Values.size()));
      this->mutable_parameter_block_sizes()->push_back(static_cast<int>(start.size()));
    }

    bool Evaluate(
      double const* const* parameters, double* residuals, double** jacobians) const override
    {
      try
      {
        const int size = this->parameter_block_sizes()[0];
        const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(parameters[0], size);
        if (x != this->X) // Ceres asks for a step's residuals, and once more with the derivatives
        {
          this->Values = this->Residuals(x);
          this->X = x;
        }
        Eigen::Map<Eigen::VectorXd>(residuals, this->Values.size()) = this->Values;
        if (jacobians && jacobians[0])
        {
          Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            jacobians[0], this->Values.size(), size) = this->Jacobian(x, this->Values);
        }
        return true;
      }
      catch (...)
      {
        this->Thrown = std::current_exception();
        return false;
      }
    }

  private:
    const GetResiduals& Residuals;
    const GetJacobian& Jacobian;
    mutable Eigen::VectorXd X, Values; // the last ones
    std::exception_ptr& Thrown;
  };

  struct Watcher : ceres::IterationCallback
  {
    Watcher(const LeastSquares& owner, std::exception_ptr& thrown)
      : Owner(owner)
      , Thrown(thrown)
    {
    }

    ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override
    {
      try
      {
        this->Squares = std::min(this->Squares, 2.0 * summary.cost);
        return !this->Thrown && this->Owner.Proceed(summary.iteration, this->Squares)
                 ? ceres::SOLVER_CONTINUE
                 : ceres::SOLVER_ABORT;
      }
      catch (...)
      {
        this->Thrown = std::current_exception();
        return ceres::SOLVER_ABORT;
      }
    }

    const LeastSquares& Owner;
    std::exception_ptr& Thrown;
    double Squares = std::numeric_limits<double>::infinity();
  };
};
} // namespace measuredbrdf

#endif
