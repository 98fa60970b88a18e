// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Non-linear least squares within bounds, by Ceres (Levenberg-Marquardt).
 */

#ifndef LeastSquares_h
#define LeastSquares_h

#include <functional>
#include <string>
#include <vector>

namespace measuredbrdf
{
struct LeastSquaresProblem
{
  int NumberOfResiduals;
  std::vector<double> Lower, Upper; // bounds of each parameter
  /// residuals, and where jacobian is not null its rows, one per residual.
  std::function<void(const double* parameters, double* residuals, double* jacobian)> Evaluate;
  /// Called after each iteration with the sum of squares; false: stop.
  std::function<bool(int iteration, bool successful, double sum)> Proceed;
  int MaximumNumberOfIterations;
  double Tolerance; // relative change of the sum that ends it
};

struct LeastSquaresResult
{
  double Sum = 0.0; // of the squares
  bool Converged = false;
  bool Usable = false;
  std::string Message; // what the solver said
};

/// Empty, or why this build cannot solve such problems.
std::string GetLeastSquaresAbsence();

/// From parameters to the best ones, which take their place.
LeastSquaresResult SolveLeastSquares(
  const LeastSquaresProblem& problem, std::vector<double>& parameters);
} // namespace measuredbrdf

#endif
