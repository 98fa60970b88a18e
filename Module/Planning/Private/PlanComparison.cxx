// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanComparison.h"

#include "PlanPictures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace measuredbrdf
{
namespace
{
constexpr double StandardErrors = 2.0; // that are added: what is predicted shall hold

// What the texture units of graphics cards lose by interpolating with weights of 8 bits: relative
// L1 of the smallest table, in the mean of seven materials under three maps. Larger tables and
// other methods lose 0.0003 to 0.0008 (docs/methods/pixel-cost.md, "The weights of texture units").
constexpr double FilterWeights = 0.0013;

constexpr double OwnWidth = 20.0; // PictureSums: fewer pairs than are drawn

// The largest of the pictures' errors in units of that of all, by the geometric mean of what the
// candidate has on the few pairs that it was compared on and what a cheap one has on all that were
// drawn: the first is its own, and the second is nearly without chance (measured on 34 plans:
// docs/methods/single-pictures.md).
double GetLargestRatio(const PictureSums& own, const std::vector<double>& cheap)
{
  const std::vector<double> ratios = own.GetRatios();
  double largest = 1.0; // some picture has what all have in the mean
  for (std::size_t k = 0; k < ratios.size(); ++k)
  {
    largest = std::max(largest, cheap.empty() ? ratios[k] : std::sqrt(ratios[k] * cheap[k]));
  }
  return largest;
}

// The residues' squares. Pairs about the same point are no draws of their own: their residues are
// summed first, as those of clusters (Sarndal, Swensson, Wretman 1992, 5.6 with 4.2).
double SumSquares(const std::vector<const PlanComparison*>& comparisons,
  const std::vector<double>& differences, const std::vector<double>& references, double error)
{
  std::vector<double> residues;
  std::size_t before = 0;
  double squares = 0.0;
  for (const PlanComparison* comparison : comparisons)
  {
    const std::size_t count = static_cast<std::size_t>(comparison->Reference->GetNumberOfTuples());
    const std::vector<std::size_t>& points = comparison->Pairs.Points;
    for (std::size_t k = 0; k < count; ++k)
    {
      const double residue = differences[before + k] - error * references[before + k];
      if (points.empty())
      {
        squares += residue * residue;
        continue;
      }
      residues.resize(std::max(residues.size(), points[k] + 1), 0.0);
      residues[points[k]] += residue;
    }
    before += count;
  }
  return std::inner_product(residues.begin(), residues.end(), residues.begin(), squares);
}
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
  PictureSums pictures(OwnWidth);
  for (std::size_t n = 0; n < comparisons.size(); ++n)
  {
    const PlanComparison& comparison = *comparisons[n];
    ownError = std::max(ownError, comparison.ReferenceError);
    const std::size_t before = differences.size();
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
    const auto start = static_cast<std::ptrdiff_t>(before);
    pictures.Add(comparison.Pairs, { differences.begin() + start, differences.end() },
      { references.begin() + start, references.end() });
  }
  if (!(sum > 0.0))
  {
    return {};
  }
  const double error = difference / sum;
  const double squares = SumSquares(comparisons, differences, references, error);
  const double uncertainty =
    std::hypot(StandardErrors * std::sqrt(squares) / sum, ownError, FilterWeights);
  const double ratio = GetLargestRatio(pictures, comparisons.front()->Pairs.Ratios);
  return { error + uncertainty, uncertainty, ratio * (error + uncertainty) };
}
} // namespace measuredbrdf
