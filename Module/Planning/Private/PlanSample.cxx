// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanSearch.h"

#include "vtkRadianceMethods.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Of the draws: by the difference of two methods, by radiance, and by weight; the others are of all
// pairs alike, which are close together where lamps are.
constexpr double ShareByDifference = 0.35;
constexpr double ShareByRadiance = 0.2;
constexpr double ShareByWeight = 0.25;
constexpr double Start = 0.414; // of the steps through the draws: as good as random

constexpr double DrawnWidth = 12.0; // GetPictureRatios

double GetFinite(double value) { return std::isfinite(value) ? value : 0.0; }

// Of each pair: by how much the two differ, and what the second says.
void GetValues(vtkDoubleArray* coarse, vtkDoubleArray* fine, std::vector<double>& differences,
  std::vector<double>& radiances)
{
  const std::size_t number = static_cast<std::size_t>(fine->GetNumberOfTuples());
  differences.assign(number, 0.0);
  radiances.assign(number, 0.0);
  for (std::size_t k = 0; k < number; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = GetFinite(fine->GetComponent(static_cast<vtkIdType>(k), c));
      const double other = GetFinite(coarse->GetComponent(static_cast<vtkIdType>(k), c));
      differences[k] += std::abs(other - value);
      radiances[k] += std::abs(value);
    }
  }
}

// Weights scaled so that their sum is count, but each at most 1. Each round makes up for what the
// one before cut off.
std::vector<double> ScaleToSum(std::vector<double> weights, double count)
{
  for (int round = 0; round < 8; ++round)
  {
    double open = count; // what is left for those below 1
    double sum = 0.0;    // that these have
    for (const double weight : weights)
    {
      open -= weight < 1.0 ? 0.0 : 1.0;
      sum += weight < 1.0 ? weight : 0.0;
    }
    const double scale = sum > 0.0 ? std::max(open, 0.0) / sum : 0.0;
    for (double& weight : weights)
    {
      weight = weight < 1.0 ? std::min(weight * scale, 1.0) : 1.0;
    }
  }
  return weights;
}

// From the least on, those that are the same in any order.
std::vector<std::size_t> OrderByDifference(
  const std::vector<double>& differences, const std::vector<double>& weights)
{
  const std::size_t number = differences.size();
  std::vector<double> keys(number);
  for (std::size_t k = 0; k < number; ++k)
  {
    keys[k] = weights[k] > 0.0 ? differences[k] / weights[k] : 0.0;
  }
  std::vector<std::size_t> order(number);
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::mt19937 engine; // steps must not resonate with the sequence that drew the pairs
  for (std::size_t k = number; k > 1; --k)
  {
    std::swap(order[k - 1], order[engine() % k]);
  }
  std::stable_sort(order.begin(), order.end(),
    [&keys](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}
}

void SamplePairs(const PlanTask& task, std::vector<PlanCandidate>& candidates, PlanPairs& pairs)
{
  if (task.IsAborted())
  {
    throw PlanFailure("aborted");
  }
  if (pairs.Normals->GetNumberOfTuples() <= PairsToCompare)
  {
    return;
  }
  const auto first = std::find_if(candidates.begin(), candidates.end(),
    [](const PlanCandidate& candidate) { return vtkRadianceMethods::IsBuiltIn(candidate.Method); });
  const auto larger = std::find_if(first, candidates.end(),
    [&first](const PlanCandidate& other)
    { return other.Method == first->Method && other.Sizes > first->Sizes; });
  vtkSmartPointer<vtkDoubleArray> coarse, fine;
  if (larger != candidates.end())
  {
    Prepare(task, *first);
    coarse = Integrate(task, first->Integrator, pairs);
    Prepare(task, *larger);
    fine = Integrate(task, larger->Integrator, pairs);
  }
  pairs = ChoosePairs(pairs, coarse, fine, PairsToCompare);
}

PlanPairs ChoosePairs(const PlanPairs& all, vtkDoubleArray* coarse, vtkDoubleArray* fine, int count)
{
  const std::size_t number = static_cast<std::size_t>(all.Normals->GetNumberOfTuples());
  std::vector<double> weights = all.Weights;
  weights.resize(number, all.Weights.empty() ? 1.0 : 0.0);
  std::vector<double> differences(number), radiances(number);
  if (fine)
  {
    GetValues(coarse, fine, differences, radiances);
  }
  double sums[3] = {};
  for (std::size_t k = 0; k < number; ++k)
  {
    differences[k] *= weights[k];
    radiances[k] *= weights[k];
    sums[0] += differences[k];
    sums[1] += radiances[k];
    sums[2] += weights[k];
  }
  std::vector<double> draws(number);
  const double others =
    (1.0 - ShareByDifference - ShareByRadiance - ShareByWeight) / static_cast<double>(number);
  const double shares[3] = { sums[0] > 0.0 ? ShareByDifference / sums[0] : 0.0,
    sums[1] > 0.0 ? ShareByRadiance / sums[1] : 0.0, ShareByWeight / sums[2] };
  for (std::size_t k = 0; k < number; ++k)
  {
    draws[k] = count * (others + shares[0] * differences[k] + shares[1] * radiances[k] +
                         shares[2] * weights[k]);
  }
  draws = ScaleToSum(std::move(draws), count);
  PlanPairs chosen = MakeEmptyPairs();
  chosen.Cameras = all.Cameras;
  chosen.Ratios = GetPictureRatios(all, DrawnWidth, differences, radiances);
  double at = Start;
  // In equal steps through the draws of all: so a sample has some of every difference.
  for (const std::size_t k : OrderByDifference(differences, weights))
  {
    at -= draws[k];
    if (at < 0.0)
    {
      at += 1.0;
      chosen.Normals->InsertNextTuple(all.Normals->GetTuple(static_cast<vtkIdType>(k)));
      chosen.Views->InsertNextTuple(all.Views->GetTuple(static_cast<vtkIdType>(k)));
      chosen.Weights.push_back(weights[k] / draws[k]);
    }
  }
  return chosen;
}
} // namespace measuredbrdf
