// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanComparison.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr double StandardErrors = 2.0; // that are added: what is predicted shall hold
}

// Standard errors are those of a ratio of weighted sums (Sarndal, Swensson, Wretman 1992, "Model
// Assisted Survey Sampling", 5.6; for draws from all views there are, not only from those that the
// sample was taken from): highlights are rare and decide. Samples that were drawn apart, pooled,
// are a larger one.
PlanError Compare(const std::vector<const PlanComparison*>& comparisons,
  const std::vector<vtkDoubleArray*>& radiances)
{
  std::vector<double> differences, references;
  double difference = 0.0;
  double sum = 0.0;
  double ownError = 0.0;
  for (std::size_t n = 0; n < comparisons.size(); ++n)
  {
    const PlanComparison& comparison = *comparisons[n];
    ownError = std::max(ownError, comparison.ReferenceError);
    for (vtkIdType k = 0; k < radiances[n]->GetNumberOfTuples(); ++k)
    {
      const std::vector<double>& weights = comparison.Pairs.Weights;
      const double weight = weights.empty() ? 1.0 : weights[static_cast<std::size_t>(k)];
      differences.push_back(0.0);
      references.push_back(0.0);
      for (int c = 0; c < 3; ++c)
      {
        const double reference = comparison.Reference->GetComponent(k, c);
        differences.back() += weight * std::abs(radiances[n]->GetComponent(k, c) - reference);
        references.back() += weight * reference;
      }
      difference += differences.back();
      sum += references.back();
    }
  }
  if (!(sum > 0.0))
  {
    return {};
  }
  const double error = difference / sum;
  double squares = 0.0;
  for (std::size_t k = 0; k < differences.size(); ++k)
  {
    const double residue = differences[k] - error * references[k];
    squares += residue * residue;
  }
  const double uncertainty = std::hypot(StandardErrors * std::sqrt(squares) / sum, ownError);
  return { error + uncertainty, uncertainty };
}
} // namespace measuredbrdf
