// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ParetoFront.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

//------------------------------------------------------------------------------
bool IsFinite(const tool::CostPoint& point)
{
  return std::isfinite(point.Cost) && std::isfinite(point.Error);
}
}

namespace tool
{
//------------------------------------------------------------------------------
std::vector<std::size_t> FindFront(const std::vector<CostPoint>& points)
{
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (IsFinite(points[k]))
    {
      order.push_back(k);
    }
  }
  std::stable_sort(order.begin(), order.end(),
    [&points](std::size_t a, std::size_t b)
    {
      return points[a].Cost != points[b].Cost ? points[a].Cost < points[b].Cost
                                              : points[a].Error < points[b].Error;
    });
  std::vector<std::size_t> front;
  for (const std::size_t k : order)
  {
    if (front.empty() || points[k].Error < points[front.back()].Error)
    {
      front.push_back(k);
    }
  }
  return front;
}

//------------------------------------------------------------------------------
double GetFrontCost(const std::vector<CostPoint>& points, double error)
{
  double least = NaN;
  for (const CostPoint& point : points)
  {
    if (IsFinite(point) && point.Error <= error && !(point.Cost >= least))
    {
      least = point.Cost;
    }
  }
  return least;
}

//------------------------------------------------------------------------------
double GetGeometricMean(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += std::log(value);
  }
  return values.empty() ? NaN : std::exp(sum / static_cast<double>(values.size()));
}

//------------------------------------------------------------------------------
double GetQuantile(std::vector<double> values, double share)
{
  if (values.empty())
  {
    return NaN;
  }
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}
} // namespace tool
