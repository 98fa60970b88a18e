// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What is worth having of things that have a cost and an error.
 */

#ifndef ParetoFront_h
#define ParetoFront_h

#include <cstddef>
#include <vector>

namespace tool
{
/// Of anything; smaller is better for both. Points with a cost or error that is not finite don't
/// count.
struct CostPoint
{
  double Cost;
  double Error;
};

/// Indices of the points that no other one beats in one figure and equals or beats in the other,
/// by rising cost; of equal points the first.
std::vector<std::size_t> FindFront(const std::vector<CostPoint>& points);

/// The least cost of a point whose error is at most this; NaN where there is none.
double GetFrontCost(const std::vector<CostPoint>& points, double error);

/// Of positive values; NaN of none.
double GetGeometricMean(const std::vector<double>& values);

/// The share in [0,1] of the way through the sorted values, linear between neighbors; NaN of none.
double GetQuantile(std::vector<double> values, double share);
} // namespace tool

#endif
