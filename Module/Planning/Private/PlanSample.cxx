// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanSearch.h"

#include "vtkNew.h"
#include "vtkRadianceMethods.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
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

// Of a picture's pairs: at least so many around all points alike, so that 4096 points have one each
// beside themselves; and so many where it varies, in rounds, each of which knows what those before
// it have found.
constexpr vtkIdType PairsAlike = 4097;
constexpr int PairsWhereItVaries = 4096;
constexpr int Rounds = 2;

constexpr double DrawnWidth = 12.0; // GetPictureRatios

void Append(vtkDoubleArray* from, vtkDoubleArray* to)
{
  for (vtkIdType k = 0; k < from->GetNumberOfTuples(); ++k)
  {
    to->InsertNextTuple(from->GetTuple(k));
  }
}

double GetFinite(double value) { return std::isfinite(value) ? value : 0.0; }

// Adds what a candidate says that further pairs reflect.
bool AddRadiance(PlanTask& task, PlanCandidate& candidate, const PlanPairs& pairs,
  vtkSmartPointer<vtkDoubleArray>& radiances)
{
  vtkNew<vtkDoubleArray> radiance;
  if (!Prepare(task, candidate) || !Integrate(task, candidate.Integrator, pairs, radiance))
  {
    return false;
  }
  if (!radiances)
  {
    radiances = vtkSmartPointer<vtkDoubleArray>::New();
    radiances->SetNumberOfComponents(3);
  }
  Append(radiance, radiances);
  return true;
}

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

bool SamplePairs(
  PlanTask& task, std::vector<PlanCandidate>& candidates, bool picture, PlanPairs& pairs)
{
  if (pairs.Normals->GetNumberOfTuples() <= PairsToCompare || task.IsAborted())
  {
    return !task.IsAborted();
  }
  std::optional<PlanPoints> points;
  if (picture)
  {
    points.emplace(pairs);
  }
  PlanPairs all = points ? points->DrawAlike(PairsAlike) : pairs;
  const auto first = std::find_if(candidates.begin(), candidates.end(),
    [](const PlanCandidate& candidate) { return vtkRadianceMethods::IsBuiltIn(candidate.Method); });
  const auto larger = std::find_if(first, candidates.end(),
    [&first](const PlanCandidate& other)
    { return other.Method == first->Method && other.Sizes > first->Sizes; });
  vtkSmartPointer<vtkDoubleArray> coarse, fine;
  const auto integrate = [&](const PlanPairs& further) {
    return AddRadiance(task, *first, further, coarse) && AddRadiance(task, *larger, further, fine);
  };
  const bool hasTwo = larger != candidates.end();
  if (hasTwo && !integrate(all))
  {
    return false;
  }
  for (int round = 0; points && hasTwo && round < Rounds; ++round)
  {
    std::vector<double> differences, radiances;
    GetValues(coarse, fine, differences, radiances);
    const PlanPairs more =
      points->DrawWhereItVaries(differences, radiances, PairsWhereItVaries / Rounds);
    if (more.Normals->GetNumberOfTuples() > 0 && !integrate(more))
    {
      return false;
    }
    Append(more.Normals, all.Normals);
    Append(more.Views, all.Views);
  }
  if (points)
  {
    points->Weigh(all);
  }
  pairs = ChoosePairs(all, coarse, fine, PairsToCompare);
  return true;
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
  draws = ScaleToSum(std::move(draws), count, 1.0); // each pair at most once
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
      if (!all.Points.empty())
      {
        chosen.Points.push_back(all.Points[k]);
      }
    }
  }
  return chosen;
}
} // namespace measuredbrdf
