// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TabulatedLanes.h"

#include "HalfVector.h" // for Pi
#include "LaneAngles.h"
#include "LaneVectors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace measuredbrdf
{
namespace
{
// Red, green, blue and another number, without vectors.
struct FourNumbers
{
  float Values[4];
  float operator[](int k) const { return this->Values[k]; }
};

MEASUREDBRDF_INLINE void AddWeighted(FourNumbers& sum, const FourNumbers& four, float weight)
{
  for (int k = 0; k < 3; ++k)
  {
    sum.Values[k] += weight * four.Values[k];
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
MEASUREDBRDF_INLINE void AddWeighted(Float4& sum, const Float4& four, float weight)
{
  sum += weight * four;
}
#endif

// The samples about coordinates in turns or quarter turns, in units of the axis.
template <typename Vector>
MEASUREDBRDF_INLINE void StoreCorners(
  const Vector& unit, int count, bool periodic, int* first, int* second, float* weight)
{
  using Integers = typename LaneIntegers<Vector>::Type;
  const Vector zero = 0.0f * unit;
  const auto n = static_cast<float>(count);
  Vector x = unit * n - 0.5f;
  if (periodic) // unit > -1
  {
    x += 2.0f * n;
  }
  else
  {
    const Vector last = zero + (n - 1.0f);
    x = x > zero ? x : zero;
    x = x < last ? x : last;
  }
  Integers base;
  Convert(x, base);
  Vector whole;
  Convert(base, whole);
  const Vector rest = x - whole;
  const Integers all = Integers{} + count;
  const Integers none = Integers{};
  for (int turn = 0; turn < 3 && periodic; ++turn)
  {
    base = base >= all ? base - all : base;
  }
  const Integers next = base + 1;
  const Integers beyond = periodic ? none : all - 1;
  const Integers after = next >= all ? beyond : next;
  Store(base, first);
  Store(after, second);
  Store(rest, weight);
}
}

// Of each light: its direction, its coordinates along the axes, and the samples about them.
struct TabulatedLanes::Steps
{
  float X[Most], Y[Most], Z[Most];
  float Length[Most];  // of light plus view, or its square
  float Sine[2][Most]; // half the length of a difference of unit vectors, or its square
  float Units[3][Most];
  int First[3][Most], Second[3][Most];
  float Weights[3][Most];
  float Colors[3][Most];
};

// Azimuth, theta_o, theta_i.
template <typename Vector>
MEASUREDBRDF_INLINE void TabulatedLanes::PlaceByLight(
  Steps& steps, const float view[3], int whole) const
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  const double theta = std::atan2(std::hypot(view[0], view[1]), view[2]) * (2.0 / Pi);
  for (int k = 0; k < whole; k += width)
  {
    Vector x, y, z, turns, quarters;
    Load(steps.X + k, x);
    Load(steps.Y + k, y);
    Load(steps.Z + k, z);
    const Vector along = x * view[0] + y * view[1];
    const Vector across = x * view[1] - y * view[0];
    FindTurns(along, across, turns);
    const Vector zero = 0.0f * turns;
    const Vector signedTurns = across < zero ? -turns : turns;
    const Vector azimuth = this->HalfTurn ? 2.0f * turns : signedTurns;
    Store(azimuth, steps.Units[0] + k);
    const Vector second = zero + static_cast<float>(theta);
    Store(second, steps.Units[1] + k);
    Load(steps.Sine[0] + k, quarters);
    Vector third;
    FindQuarterTurns(quarters, third);
    Store(third, steps.Units[2] + k);
  }
}

// phi_d, theta_d, and the square of theta_h's coordinate.
template <typename Vector>
MEASUREDBRDF_INLINE void TabulatedLanes::PlaceByHalf(
  Steps& steps, const float view[3], int whole) const
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  for (int k = 0; k < whole; k += width)
  {
    Vector x, y, z, length;
    Load(steps.X + k, x);
    Load(steps.Y + k, y);
    Load(steps.Z + k, z);
    Load(steps.Length + k, length);
    const Vector zero = 0.0f * length;
    Vector hX, hY, hZ;
    FindHalf(x, y, z, view, length, hX, hY, hZ);
    // The frame of h: along the plane of h and the normal, and across it. Times h's sine.
    const Vector square = hX * hX + hY * hY;
    const Vector tiny = zero + 1e-14f;
    const Vector cosine = square > tiny ? hX : zero + 1.0f;
    const Vector sine = square > tiny ? hY : zero;
    const Vector below = square > tiny ? square * z : zero;
    const Vector along = hZ * (cosine * x + sine * y) - below;
    const Vector across = cosine * y - sine * x;
    Vector turns;
    FindTurns(along, across, turns);
    turns = across < zero ? -turns : turns;
    turns *= this->HalfTurn ? 2.0f : 1.0f;
    Store(turns, steps.Units[0] + k);
    const Vector aside = 0.25f * ((x - hX) * (x - hX) + (y - hY) * (y - hY) + (z - hZ) * (z - hZ));
    const Vector tilt = 0.25f * (square + (hZ - 1.0f) * (hZ - 1.0f));
    Store(aside, steps.Sine[0] + k);
    Store(tilt, steps.Sine[1] + k);
  }
}

template <typename Vector>
MEASUREDBRDF_INLINE void TabulatedLanes::FindPlaces(Steps& steps, int whole) const
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  const bool periodic[3] = { this->HalfDifference || !this->HalfTurn, false, false };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int k = 0; k < whole; k += width)
    {
      Vector unit;
      Load(steps.Units[axis] + k, unit);
      StoreCorners(unit, this->Dimensions[axis], periodic[axis], steps.First[axis] + k,
        steps.Second[axis] + k, steps.Weights[axis] + k);
    }
  }
}

template <typename Four>
MEASUREDBRDF_INLINE void TabulatedLanes::LookUp(Steps& steps, int k) const
{
  const auto width = static_cast<std::size_t>(this->Dimensions[0]);
  const auto height = static_cast<std::size_t>(this->Dimensions[1]);
  const auto left = static_cast<std::size_t>(steps.First[0][k]);
  const auto right = static_cast<std::size_t>(steps.Second[0][k]);
  const std::size_t y[2] = { static_cast<std::size_t>(steps.First[1][k]),
    static_cast<std::size_t>(steps.Second[1][k]) };
  const std::size_t z[2] = { static_cast<std::size_t>(steps.First[2][k]),
    static_cast<std::size_t>(steps.Second[2][k]) };
  const float u = steps.Weights[0][k];
  const float v = steps.Weights[1][k];
  const float w = steps.Weights[2][k];
  const float weights[4] = { (1.0f - v) * (1.0f - w), v * (1.0f - w), (1.0f - v) * w, v * w };
  Four sum = {};
  for (int row = 0; row < 4; ++row)
  {
    const std::size_t first = width * (y[row % 2] + height * z[row / 2]);
    for (const bool isRight : { false, true })
    {
      const std::size_t at = 3 * (first + (isRight ? right : left));
      const float weight = weights[row] * (isRight ? u : 1.0f - u);
      Four color;
      if (at + 4 <= this->Volume.size())
      {
        Load(this->Volume.data() + at, color);
      }
      else // the last sample
      {
        const float last[4] = { this->Volume[at], this->Volume[at + 1], this->Volume[at + 2],
          0.0f };
        Load(last, color);
      }
      AddWeighted(sum, color, weight);
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    steps.Colors[c][k] = sum[c];
  }
}

template <typename Vector, typename Four>
MEASUREDBRDF_INLINE void TabulatedLanes::EvaluateAll(
  Steps& steps, int count, const float view[3], LaneRoots takeRoots, float* const f[3]) const
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  const int whole = (count + 7) / 8 * 8;
  for (int k = 0; k < whole; k += width)
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
  if (this->HalfDifference)
  {
    takeRoots(steps.Length, whole);
    this->PlaceByHalf<Vector>(steps, view, whole);
    takeRoots(steps.Sine[0], whole);
    takeRoots(steps.Sine[1], whole);
    for (int i = 0; i < 2; ++i)
    {
      for (int k = 0; k < whole; k += width)
      {
        Vector half, turns;
        Load(steps.Sine[i] + k, half);
        FindQuarterTurns(half, turns);
        Store(turns, steps.Units[1 + i] + k);
      }
    }
    takeRoots(steps.Units[2], whole);
  }
  else
  {
    takeRoots(steps.Sine[0], whole);
    this->PlaceByLight<Vector>(steps, view, whole);
  }
  this->FindPlaces<Vector>(steps, whole);
  for (int k = 0; k < count; ++k)
  {
    this->LookUp<Four>(steps, k);
  }
  const float scale = this->CosineWeighted ? 1.0f / view[2] : 1.0f;
  for (int c = 0; c < 3; ++c)
  {
    for (int k = 0; k < whole; k += width)
    {
      Vector color;
      Load(steps.Colors[c] + k, color);
      const Vector zero = {};
      const Vector largest = zero + std::numeric_limits<float>::max();
      const Vector value = color > zero ? color * scale : zero; // not a number: 0
      const Vector finite = value <= largest ? value : largest;
      Store(finite, f[c] + k);
    }
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
MEASUREDBRDF_WIDE void TabulatedLanes::EvaluateWide(
  Steps& steps, int count, const float view[3], float* const f[3]) const
{
  this->EvaluateAll<Float8, Float4>(steps, count, view, TakeLaneRootsWide, f);
}
#endif

void TabulatedLanes::Evaluate(int count, const float* const lights[3], const double view[3],
  float* const f[3], VectorForm form) const
{
  Steps steps;
  const float v[3] = { static_cast<float>(view[0]), static_cast<float>(view[1]),
    static_cast<float>(view[2]) };
  const int whole = (count + 7) / 8 * 8; // the last one once more
  float* const to[3] = { steps.X, steps.Y, steps.Z };
  for (int c = 0; c < 3; ++c)
  {
    std::copy_n(lights[c], count, to[c]);
    std::fill(to[c] + count, to[c] + whole, lights[c][count - 1]);
    std::fill(steps.Colors[c] + count, steps.Colors[c] + whole, 0.0f);
  }
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (form == VectorForm::Wide)
  {
    return this->EvaluateWide(steps, count, v, f);
  }
  if (form == VectorForm::Narrow)
  {
    return this->EvaluateAll<Float4, Float4>(steps, count, v, TakeLaneRootsNarrow, f);
  }
#endif
  static_cast<void>(form);
  this->EvaluateAll<float, FourNumbers>(steps, count, v, TakeLaneRootsOneByOne, f);
}

void TabulatedLanes::EvaluateMany(
  int count, const float* const lights[3], const double view[3], float* const f[3]) const
{
  for (int first = 0; first < count; first += Most)
  {
    const int some = std::min(count - first, Most);
    const float* const from[3] = { lights[0] + first, lights[1] + first, lights[2] + first };
    float rgb[3][Most];
    float* const to[3] = { rgb[0], rgb[1], rgb[2] };
    this->Evaluate(some, from, view, to);
    for (int c = 0; c < 3; ++c)
    {
      std::copy_n(rgb[c], some, f[c] + first);
    }
  }
}
} // namespace measuredbrdf
