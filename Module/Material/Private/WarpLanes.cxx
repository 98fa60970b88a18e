// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WarpLanes.h"

#include "HalfVector.h" // for Pi
#include "LaneAngles.h"
#include "LaneVectors.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// What stays between the square roots, which are taken of whole arrays.
struct LaneSteps
{
  float X[WarpLanes::Most], Y[WarpLanes::Most], Z[WarpLanes::Most]; // the light
  float Length[WarpLanes::Most];  // of light plus view, or its square
  float Sine[2][WarpLanes::Most]; // of half of theta_i, theta_h, or its square
};

template <typename Vector>
MEASUREDBRDF_INLINE void AddViewToLanes(LaneSteps& steps, const float view[3], int k)
{
  Vector x, y, z;
  Load(steps.X + k, x);
  Load(steps.Y + k, y);
  Load(steps.Z + k, z);
  Vector length, sine;
  FindSquares(x, y, z, view, length, sine);
  Store(length, steps.Length + k);
  Store(sine, steps.Sine[0] + k);
}

template <typename Vector>
MEASUREDBRDF_INLINE void FindHalfOfLanes(
  LaneSteps& steps, const float view[3], WarpLanes& lanes, int k)
{
  Vector x, y, z, length;
  Load(steps.X + k, x);
  Load(steps.Y + k, y);
  Load(steps.Z + k, z);
  Load(steps.Length + k, length);
  const Vector zero = 0.0f * length;
  Vector hX, hY, hZ;
  FindHalf(x, y, z, view, length, hX, hY, hZ);
  const Vector sine = 0.25f * (hX * hX + hY * hY + (hZ - 1.0f) * (hZ - 1.0f));
  Store(sine, steps.Sine[1] + k);
  // The azimuth of h from that of the light, which is 0 for an upright light.
  const Vector size = x * x + y * y;
  const Vector fromX = size > zero ? x : zero + 1.0f;
  const Vector along = fromX * hX + y * hY;
  const Vector across = fromX * hY - y * hX;
  Vector phi;
  FindTurns(along, across, phi);
  phi = across < zero ? 0.5f - phi : 0.5f + phi;
  Store(phi, lanes.UnitPhiH + k);
}

template <typename Vector>
MEASUREDBRDF_INLINE void FindThetaOfLanes(LaneSteps& steps, WarpLanes& lanes, int k)
{
  for (int i = 0; i < 2; ++i)
  {
    Vector sine, theta;
    Load(steps.Sine[i] + k, sine);
    const Vector square = sine * sine;
    SumLaneSeries(AsinLaneSeries, square, theta);
    theta *= 2.0f * sine;
    const Vector unit = theta * static_cast<float>(2.0 / Pi);
    const Vector one = 0.0f * unit + 1.0f;
    const Vector inside = unit < one ? unit : one;
    Store(inside, (i == 0 ? lanes.UnitTheta : lanes.UnitThetaH) + k);
    if (i == 0)
    {
      Store(theta, lanes.Theta + k);
    }
  }
}

template <typename Vector>
MEASUREDBRDF_INLINE void FindLanes(
  LaneSteps& steps, int count, const float view[3], LaneRoots takeRoots, WarpLanes& lanes)
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  for (int k = 0; k < count; k += width)
  {
    AddViewToLanes<Vector>(steps, view, k);
  }
  takeRoots(steps.Length, count);
  takeRoots(steps.Sine[0], count);
  for (int k = 0; k < count; k += width)
  {
    FindHalfOfLanes<Vector>(steps, view, lanes, k);
  }
  takeRoots(steps.Sine[1], count);
  for (int k = 0; k < count; k += width)
  {
    FindThetaOfLanes<Vector>(steps, lanes, k);
  }
  takeRoots(lanes.UnitTheta, count);
  takeRoots(lanes.UnitThetaH, count);
}

#ifdef MEASUREDBRDF_HAS_VECTORS
MEASUREDBRDF_WIDE void FindLanesWide(
  LaneSteps& steps, int count, const float view[3], WarpLanes& lanes)
{
  FindLanes<Float8>(steps, count, view, TakeLaneRootsWide, lanes);
}
#endif
}

void FindWarpLanes(
  int count, const float* const lights[3], const double view[3], WarpLanes& lanes, VectorForm form)
{
  LaneSteps steps;
  const float v[3] = { static_cast<float>(view[0]), static_cast<float>(view[1]),
    static_cast<float>(view[2]) };
  const int whole = (count + 15) / 16 * 16; // the last one once more
  float* const to[3] = { steps.X, steps.Y, steps.Z };
  for (int c = 0; c < 3; ++c)
  {
    std::copy_n(lights[c], count, to[c]);
    std::fill(to[c] + count, to[c] + whole, lights[c][count - 1]);
  }
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (form == VectorForm::Wide)
  {
    return FindLanesWide(steps, whole, v, lanes);
  }
  if (form == VectorForm::Narrow)
  {
    return FindLanes<Float4>(steps, whole, v, TakeLaneRootsNarrow, lanes);
  }
#endif
  static_cast<void>(form);
  FindLanes<float>(steps, whole, v, TakeLaneRootsOneByOne, lanes);
}
} // namespace measuredbrdf
