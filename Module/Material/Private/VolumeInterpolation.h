// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Linear interpolation in a volume some of whose cells are invalid.
 */

#ifndef VolumeInterpolation_h
#define VolumeInterpolation_h

#include "HalfVector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// Two neighboring samples and their weights, along one axis.
struct AxisCorners
{
  int Index[2];
  double Weight[2];
};

/// Of coordinate u in [0,1]; a periodic axis takes any u.
inline AxisCorners FindCorners(double u, int n, bool periodic)
{
  double x = u * n - 0.5;
  if (!periodic)
  {
    x = std::clamp(x, 0.0, n - 1.0);
  }
  const double base = std::floor(x);
  const double w = x - base;
  int k0 = static_cast<int>(base);
  int k1 = k0 + 1;
  if (periodic)
  {
    k0 = ((k0 % n) + n) % n;
    k1 = ((k1 % n) + n) % n;
  }
  else
  {
    k1 = std::min(k1, n - 1);
  }
  return { { k0, k1 }, { 1.0 - w, w } };
}

/// Two neighboring samples along each axis of a volume.
struct VolumeCorners
{
  AxisCorners X, Y, Z;
};

/// Weighted sum of the valid corners, and their weights.
struct VolumeSum
{
  double Values[3] = { 0.0, 0.0, 0.0 };
  double Valid = 0.0;
};

/// The index of one of the eight.
inline std::size_t GetCorner(const VolumeCorners& corners, const int dimensions[3], int corner)
{
  return static_cast<std::size_t>(corners.X.Index[corner & 1]) +
         static_cast<std::size_t>(dimensions[0]) *
           (static_cast<std::size_t>(corners.Y.Index[(corner >> 1) & 1]) +
             static_cast<std::size_t>(dimensions[1]) *
               static_cast<std::size_t>(corners.Z.Index[corner >> 2]));
}

/// RGB triples of a volume, NaN: invalid.
inline VolumeSum GatherCorners(
  const std::vector<float>& volume, const int dimensions[3], const VolumeCorners& corners)
{
  VolumeSum sum;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int a = corner & 1, b = (corner >> 1) & 1, c = corner >> 2;
    const double w = corners.X.Weight[a] * corners.Y.Weight[b] * corners.Z.Weight[c];
    const float* v = &volume[3 * GetCorner(corners, dimensions, corner)];
    if (!std::isnan(v[0]))
    {
      sum.Valid += w;
      sum.Values[0] += w * v[0];
      sum.Values[1] += w * v[1];
      sum.Values[2] += w * v[2];
    }
  }
  return sum;
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
