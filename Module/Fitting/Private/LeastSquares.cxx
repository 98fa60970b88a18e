// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LeastSquares.h"

#include "vtkMeasuredBRDFConfigure.h"

#if MEASUREDBRDF_WITH_CERES
#include <ceres/ceres.h>
#endif

namespace measuredbrdf
{
#if MEASUREDBRDF_WITH_CERES
namespace
{
//------------------------------------------------------------------------------
class Residuals : public ceres::CostFunction
{
public:
  explicit Residuals(const LeastSquaresProblem& problem)
    : Problem(problem)
  {
    this->set_num_residuals(problem.NumberOfResiduals);
    this->mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.Lower.size()));
  }
  bool Evaluate(
    double const* const* parameters, double* residuals, double** jacobians) const override
  {
    this->Problem.Evaluate(parameters[0], residuals, jacobians ? jacobians[0] : nullptr);
    return true;
  }

private:
  const LeastSquaresProblem& Problem;
};

//------------------------------------------------------------------------------
class Watcher : public ceres::IterationCallback
{
public:
  explicit Watcher(const LeastSquaresProblem& problem)
    : Problem(problem)
  {
  }
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override
  {
    return this->Problem.Proceed(summary.iteration, summary.step_is_successful, 2.0 * summary.cost)
             ? ceres::SOLVER_CONTINUE
             : ceres::SOLVER_ABORT;
  }

private:
  const LeastSquaresProblem& Problem;
};
}

//------------------------------------------------------------------------------
std::string GetLeastSquaresAbsence() { return ""; }

//------------------------------------------------------------------------------
LeastSquaresResult SolveLeastSquares(
  const LeastSquaresProblem& problem, std::vector<double>& parameters)
{
  ceres::Problem solved;
  solved.AddResidualBlock(new Residuals(problem), nullptr, parameters.data());
  for (std::size_t k = 0; k < parameters.size(); ++k)
  {
    solved.SetParameterLowerBound(parameters.data(), static_cast<int>(k), problem.Lower[k]);
    solved.SetParameterUpperBound(parameters.data(), static_cast<int>(k), problem.Upper[k]);
  }
  Watcher watcher(problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.num_threads = 1; // the same sums in the same order: the same result
  options.max_num_iterations = problem.MaximumNumberOfIterations;
  options.function_tolerance = problem.Tolerance;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  options.callbacks.push_back(&watcher);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &solved, &summary);
  // Ceres' cost is half the sum of squares.
  return { 2.0 * summary.final_cost, summary.termination_type == ceres::CONVERGENCE,
    summary.IsSolutionUsable(), summary.message };
}
#else
//------------------------------------------------------------------------------
std::string GetLeastSquaresAbsence()
{
  return "this build has no Ceres (MEASUREDBRDF_WITH_CERES): Blinn-Phong and Ashikhmin-Shirley "
         "lobes cannot be fitted";
}

//------------------------------------------------------------------------------
LeastSquaresResult SolveLeastSquares(const LeastSquaresProblem&, std::vector<double>&)
{
  LeastSquaresResult result;
  result.Message = GetLeastSquaresAbsence();
  return result;
}
#endif
} // namespace measuredbrdf
