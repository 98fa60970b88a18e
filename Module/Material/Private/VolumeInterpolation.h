// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Linear interpolation in a volume, some of whose cells may be invalid.
 */

#ifndef VolumeInterpolation_h
#define VolumeInterpolation_h

#include "HalfVector.h"
#include "Neighbors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace measuredbrdf
{
/// With less than this weight on valid corners there is no value. The shader has the same limit.
constexpr double MinimumValidWeight = 1e-4;

/// Angles of a pair in units of a half/difference volume's axes: phi_d (periodic), theta_d,
/// theta_h.
inline glm::dvec3 ToHalfDifferenceUnit(const glm::dvec3& i, const glm::dvec3& o, bool halfTurn)
{
  const HalfDifference angles = ToHalfDifference(i, o);
  return { angles.PhiD / (halfTurn ? Pi : 2.0 * Pi), angles.ThetaD * (2.0 / Pi),
    ThetaHToUnit(angles.ThetaH) };
}

/// Weighted sum of the valid corners, and their weights.
struct VolumeSum
{
  glm::dvec3 Values = glm::dvec3(0.0);
  double Valid = 0.0;
};

/// Of the two neighbors along each axis.
template <int Axes>
using VolumeCorners = std::array<Neighbors, Axes>;

/// Calls use(index of the cell, weight) for each corner; the first axis is the fastest. cell,
/// weight: of the axes beyond.
template <std::size_t Axes, std::size_t All, typename Use>
inline void VisitCorners(const int* dimensions, const std::array<Neighbors, All>& corners,
  std::size_t cell, double weight, const Use& use)
{
  if constexpr (Axes == 0)
  {
    use(cell, weight);
  }
  else
  {
    const Neighbors& axis = corners[Axes - 1];
    cell *= dimensions[Axes - 1];
    VisitCorners<Axes - 1>(
      dimensions, corners, cell + axis.First, weight * (1.0 - axis.Weight), use);
    VisitCorners<Axes - 1>(dimensions, corners, cell + axis.Second, weight * axis.Weight, use);
  }
}

/// All of them.
template <int Axes, typename Use>
void ForCorners(const int* dimensions, const VolumeCorners<Axes>& corners, const Use& use)
{
  VisitCorners<Axes>(dimensions, corners, 0, 1.0, use);
}

/// Of RGB triples of a volume, NaN: invalid.
template <int Axes>
VolumeSum GatherCorners(
  const std::vector<float>& volume, const int* dimensions, const VolumeCorners<Axes>& corners)
{
  VolumeSum sum;
  ForCorners<Axes>(dimensions, corners,
    [&](std::size_t cell, double weight)
    {
      const float* v = &volume[3 * cell];
      if (!std::isnan(v[0]))
      {
        sum.Valid += weight;
        sum.Values += weight * glm::dvec3(v[0], v[1], v[2]);
      }
    });
  return sum;
}

/// Of a half/difference volume, at coordinates of ToHalfDifferenceUnit.
inline VolumeCorners<3> FindHalfDifferenceCorners(const glm::dvec3& u, const int* dimensions)
{
  return { PeriodicNeighbors(u.x, dimensions[0]), ClampedNeighbors(u.y, dimensions[1]),
    ClampedNeighbors(u.z, dimensions[2]) };
}

/// The mean of the valid corners over the cosine that the volume holds.
inline void DivideByValid(const VolumeSum& sum, double cosine, double f[3])
{
  for (int c = 0; c < 3; ++c)
  {
    f[c] = sum.Valid > MinimumValidWeight ? sum.Values[c] / (sum.Valid * cosine) : 0.0;
  }
}
} // namespace measuredbrdf

#endif
