// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanComparison.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr double LeastSine = 0.05;     // of twice the view's angle: few pairs look from there
constexpr double StandardErrors = 2.0; // that are added: what is predicted shall hold

constexpr double OwnWidth = 20.0; // GetPictureRatios: fewer pairs than are drawn

// The largest of the pictures' errors in units of that of all, by the geometric mean of what the
// candidate has on the few pairs that it was compared on and what a cheap one has on all that were
// drawn: the first is its own, and the second is nearly without chance (measured on 34 plans:
// docs/methods/planner.md, "Single pictures").
double GetLargestRatio(const std::vector<double>& own, const std::vector<double>& cheap)
{
  double largest = 1.0; // some picture has what all have in the mean
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    largest = std::max(largest, cheap.empty() ? own[k] : std::sqrt(own[k] * cheap[k]));
  }
  return largest;
}

// The difference that so much of the pixels, by weight, stay within.
double GetPercentile(
  const std::vector<double>& differences, const std::vector<double>& weights, double share)
{
  std::vector<std::pair<double, double>> pixels; // difference of one, and weight
  double left = 0.0;
  for (std::size_t k = 0; k < differences.size(); ++k)
  {
    pixels.emplace_back(differences[k] / weights[k], weights[k]);
    left += share * weights[k];
  }
  std::sort(pixels.begin(), pixels.end());
  const auto found = std::find_if(pixels.begin(), pixels.end(),
    [&left](const auto& pixel) { return (left -= pixel.second) <= 0.0; });
  return found == pixels.end() ? pixels.back().first : found->first;
}
}

// Standard errors are those of a ratio of weighted sums (Sarndal, Swensson, Wretman 1992, "Model
// Assisted Survey Sampling", 5.6; for draws from all views there are, not only from those that the
// sample was taken from): highlights are rare and decide.
PlanError Compare(const PlanComparison& comparison, vtkDoubleArray* radiance)
{
  const std::size_t count = static_cast<std::size_t>(radiance->GetNumberOfTuples());
  std::vector<double> weights = comparison.Pairs.Weights;
  weights.resize(count, 1.0);
  std::vector<double> differences(count, 0.0);
  std::vector<double> references(count, 0.0);
  for (std::size_t k = 0; k < count; ++k)
  {
    const auto at = 3 * static_cast<vtkIdType>(k);
    const glm::dvec3 reference = glm::make_vec3(comparison.Reference->GetPointer(at));
    const glm::dvec3 found = glm::make_vec3(radiance->GetPointer(at));
    differences[k] = weights[k] * glm::dot(glm::abs(found - reference), glm::dvec3(1.0));
    references[k] = weights[k] * glm::dot(reference, glm::dvec3(1.0));
  }
  const double sum = std::accumulate(references.begin(), references.end(), 0.0);
  if (!(sum > 0.0))
  {
    return {};
  }
  const double error = std::accumulate(differences.begin(), differences.end(), 0.0) / sum;
  double squares = 0.0; // of the residues
  for (std::size_t k = 0; k < count; ++k)
  {
    squares += std::pow(differences[k] - error * references[k], 2.0);
  }
  const double uncertainty =
    std::hypot(StandardErrors * std::sqrt(squares) / sum, comparison.ReferenceError);
  const std::vector<double> pictures =
    GetPictureRatios(comparison.Pairs, OwnWidth, differences, references);
  const double mean = sum / std::accumulate(weights.begin(), weights.end(), 0.0);
  return { error + uncertainty, uncertainty,
    GetLargestRatio(pictures, comparison.Pairs.Ratios) * (error + uncertainty),
    { GetPercentile(differences, weights, 0.95) / mean,
      GetPercentile(differences, weights, 0.99) / mean } };
}

std::vector<double> GetPictureRatios(const PlanPairs& pairs, double width,
  const std::vector<double>& differences, const std::vector<double>& references)
{
  const double sum = std::accumulate(references.begin(), references.end(), 0.0);
  const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) / sum;
  std::vector<double> ratios;
  if (!(mean > 0.0) || !(sum > 0.0))
  {
    return ratios;
  }
  for (const glm::dvec3& camera : pairs.Cameras)
  {
    double difference = 0.0;
    double reference = 0.0;
    for (std::size_t k = 0; k < differences.size(); ++k)
    {
      const auto tuple = static_cast<vtkIdType>(k);
      const glm::dvec3 normal = glm::make_vec3(pairs.Normals->GetPointer(3 * tuple));
      const glm::dvec3 view = glm::make_vec3(pairs.Views->GetPointer(3 * tuple));
      const double cosine = std::clamp(glm::dot(normal, view), -1.0, 1.0);
      const glm::dvec3 mirror = 2.0 * cosine * normal - view;
      const double turned = 2.0 * std::acos(cosine); // from the view to the mirror direction
      const double density = std::max(std::sin(turned), LeastSine); // of views that do so
      const double seen = std::acos(std::clamp(glm::dot(mirror, camera), -1.0, 1.0));
      const double x = (seen - turned) / glm::radians(width);
      const double share = std::max(1.0 - x * x, 0.0) / density;
      difference += share * differences[k];
      reference += share * references[k];
    }
    ratios.push_back(reference > 0.0 ? difference / reference / mean : 0.0);
  }
  return ratios;
}
} // namespace measuredbrdf
