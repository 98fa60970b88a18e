// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What is worth having of things that have a cost and an error.
 */

#ifndef ParetoFront_h
#define ParetoFront_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace tool
{
/// Of anything; smaller is better for both. Points with a cost or error that is not finite don't
/// count.
struct CostPoint
{
  double Cost;
  double Error;

  bool IsFinite() const { return std::isfinite(this->Cost) && std::isfinite(this->Error); }
};

/// Indices of the points that no other one beats in one figure and equals or beats in the other,
/// by rising cost; of equal points the first.
inline std::vector<std::size_t> FindFront(const std::vector<CostPoint>& points)
{
  constexpr double last = std::numeric_limits<double>::infinity();
  const auto getKey = [&](std::size_t k)
  {
    const CostPoint& point = points[k];
    return point.IsFinite() ? std::make_pair(point.Cost, point.Error) : std::make_pair(last, last);
  };
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return getKey(a) < getKey(b); });
  std::vector<std::size_t> front;
  for (const std::size_t k : order)
  {
    if (points[k].IsFinite() && (front.empty() || points[k].Error < points[front.back()].Error))
    {
      front.push_back(k);
    }
  }
  return front;
}

/// The least cost of a point whose error is at most this; NaN where there is none.
inline double GetFrontCost(const std::vector<CostPoint>& points, double error)
{
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const CostPoint& point : points)
  {
    if (point.IsFinite() && point.Error <= error && !(point.Cost >= least))
    {
      least = point.Cost;
    }
  }
  return least;
}

/// Of positive values; NaN of none.
inline double GetGeometricMean(const std::vector<double>& values)
{
  const double sum = std::accumulate(values.begin(), values.end(), 0.0,
    [](double before, double value) { return before + std::log(value); });
  return std::exp(sum / static_cast<double>(values.size()));
}

/// The share in [0,1] of the way through the sorted values, linear between neighbors; NaN of none.
inline double GetQuantile(std::vector<double> values, double share)
{
  if (values.empty())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}
} // namespace tool

#endif
