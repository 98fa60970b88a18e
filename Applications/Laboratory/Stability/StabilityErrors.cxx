// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StabilityErrors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tool::stability
{
//------------------------------------------------------------------------------
double GetRelativeL1(const std::vector<double>& x, const std::vector<double>& reference)
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    difference += std::abs(x[k] - reference[k]);
    sum += reference[k];
  }
  return difference == 0.0 ? 0.0 : difference / sum;
}

//------------------------------------------------------------------------------
double GetRelativeRMS(const std::vector<double>& x, const std::vector<double>& reference)
{
  double squares = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    squares += (x[k] - reference[k]) * (x[k] - reference[k]);
    sum += reference[k];
  }
  return std::sqrt(squares * static_cast<double>(x.size())) / sum;
}

//------------------------------------------------------------------------------
double GetMedianError(const std::vector<double>& x, const std::vector<double>& reference)
{
  std::vector<double> errors;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    if (!std::isfinite(x[k]))
    {
      return std::numeric_limits<double>::infinity();
    }
    if (reference[k] > 0.0)
    {
      errors.push_back(std::abs(x[k] - reference[k]) / reference[k]);
    }
  }
  if (errors.empty())
  {
    return 0.0;
  }
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  return errors[errors.size() / 2];
}

//------------------------------------------------------------------------------
double GetLargest(const std::vector<double>& x)
{
  double largest = 0.0;
  for (const double value : x)
  {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

//------------------------------------------------------------------------------
double CountBad(const std::vector<double>& x)
{
  return static_cast<double>(std::count_if(
    x.begin(), x.end(), [](double value) { return !(std::isfinite(value) && value >= 0.0); }));
}

//------------------------------------------------------------------------------
double FitSlope(const std::vector<double>& x, const std::vector<double>& y)
{
  double sums[4] = {};
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    const double u = std::log(x[k]);
    const double v = std::log(std::max(y[k], 1e-300));
    sums[0] += u;
    sums[1] += v;
    sums[2] += u * u;
    sums[3] += u * v;
  }
  const auto n = static_cast<double>(x.size());
  return (n * sums[3] - sums[0] * sums[1]) / (n * sums[2] - sums[0] * sums[0]);
}
} // namespace tool::stability
