// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Error measures of stability cases: of values x against a reference r.
 */

#ifndef StabilityErrors_h
#define StabilityErrors_h

#include <vector>

namespace tool::stability
{
///@{
/// mean |x - r| / mean r; sqrt(mean (x - r)^2) / mean r; median of |x - r| / r; infinite where
/// values are not finite.
double GetRelativeL1(const std::vector<double>& x, const std::vector<double>& reference);
double GetRelativeRMS(const std::vector<double>& x, const std::vector<double>& reference);
double GetMedianError(const std::vector<double>& x, const std::vector<double>& reference);
///@}

/// Largest |x|.
double GetLargest(const std::vector<double>& x);

/// How many values are negative or not finite.
double CountBad(const std::vector<double>& x);

/// Slope of log y against log x by least squares.
double FitSlope(const std::vector<double>& x, const std::vector<double>& y);
} // namespace tool::stability

#endif
