// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What materials that evaluate many lights at once share: angles, powers and half vectors in
 * lanes, and the loop over the lights.
 */

#ifndef LaneMath_h
#define LaneMath_h

#include "HalfVector.h" // for Pi
#include "Lanes.h"

#include <algorithm>
#include <limits>

namespace measuredbrdf
{
// Chebyshev interpolation of asin(x) / x in x^2, x^2 <= 1/2, and of atan(x) / x, x <= 1, rounded:
// relative errors of 8e-8, with those of summing in single precision.
constexpr float AsinSeries[] = { 1.0f, 0.16666955f, 0.074881144f, 0.04648085f, 0.016731389f,
  0.07553975f, -0.090086214f, 0.109673984f };
constexpr float AtanSeries[] = { 1.0f, -0.33333036f, 0.19991872f, -0.14197798f, 0.10618371f,
  -0.07456855f, 0.042137623f, -0.015731249f, 0.0027662835f };
// Taylor series: of e^x, and of atanh(t) / t in t^2.
constexpr float ExpSeries[] = { 1.0f, 1.0f, 1.0f / 2.0f, 1.0f / 6.0f, 1.0f / 24.0f, 1.0f / 120.0f,
  1.0f / 720.0f, 1.0f / 5040.0f };
constexpr float AtanhSeries[] = { 1.0f, 1.0f / 3.0f, 1.0f / 5.0f, 1.0f / 7.0f, 1.0f / 9.0f,
  1.0f / 11.0f };

// ln 2 in two parts, the first of few digits: multiples of it are exact (Cody, Waite 1980).
constexpr float LargeLn2 = 0.693359375f;
constexpr float SmallLn2 = -2.12194440e-4f;

template <int Count>
MEASUREDBRDF_INLINE Floats SumSeries(const float (&series)[Count], Floats x)
{
  Floats sum = Fill(series[Count - 1]);
#pragma GCC unroll 16
  for (int k = Count - 2; k >= 0; --k)
  {
    sum = sum * x + series[k];
  }
  return sum;
}

/// The angle between two unit vectors in quarter turns, 1 at most, from half of their distance.
MEASUREDBRDF_INLINE Floats FindQuarterTurns(Floats half)
{
  const Floats turns = SumSeries(AsinSeries, half * half) * half * static_cast<float>(4.0 / Pi);
  return Smaller(turns, Fill(1.0f));
}

/// The azimuth of (along, across) without its sign, in turns: 0 to 1/2. 0 of a vector without
/// length.
MEASUREDBRDF_INLINE Floats FindTurns(Floats along, Floats across)
{
  const Floats a = Larger(along, -along);
  const Floats b = Larger(across, -across);
  const Floats larger = Larger(a, b);
  const Floats t = (a > b ? b : a) / (larger > 0.0f ? larger : Fill(1.0f));
  Floats turns = SumSeries(AtanSeries, t * t) * t * static_cast<float>(0.5 / Pi);
  turns = b > a ? 0.25f - turns : turns;
  return along < 0.0f ? 0.5f - turns : turns;
}

/// e^x of x <= 0: 0 below -87, where single precision ends.
MEASUREDBRDF_INLINE Floats FindExp(Floats x)
{
  const Floats inside = Larger(x, Fill(-87.0f));
  const Integers power = ToIntegers(inside * 1.44269504f - 0.5f); // of two, the nearest
  const Floats whole = ToFloats(power);
  const Floats rest = inside - whole * LargeLn2 - whole * SmallLn2;
  const Integers bits = (power + 127) << 23;
  const Floats scale = Load<Floats>(&bits);
  return x > -87.0f ? SumSeries(ExpSeries, rest) * scale : Floats{};
}

/// ln x of x in [1e-30, 1].
MEASUREDBRDF_INLINE Floats FindLog(Floats x)
{
  Integers bits = Load<Integers>(&x);
  Floats whole = ToFloats((bits >> 23) - 126);
  bits = (bits & 0x007fffff) | 0x3f000000;
  Floats mantissa = Load<Floats>(&bits); // 1/2 to 1
  const Integers isSmall = mantissa < 0.70710678f;
  whole = isSmall ? whole - 1.0f : whole;
  mantissa = isSmall ? 2.0f * mantissa : mantissa;
  const Floats t = (mantissa - 1.0f) / (mantissa + 1.0f);
  return 2.0f * t * SumSeries(AtanhSeries, t * t) + whole * SmallLn2 + whole * LargeLn2;
}

/// LogCosineRatio of HalfVector.h: ln(cosine^2) / s, where s is the square of the sine, at most 1.
MEASUREDBRDF_INLINE Floats FindLogCosineRatio(Floats cosine, Floats s)
{
  const Floats t = s / (2.0f - s);
  const Floats small = SumSeries(AtanhSeries, t * t) * (-2.0f / (2.0f - s)); // ln(1 - s)
  const Floats large = FindLog(Larger(cosine * cosine, Fill(1e-12f))) / Larger(s, Fill(0.25f));
  return s > 0.25f ? large : small;
}

/// Directions, one in each lane.
struct LaneDirections
{
  Floats X, Y, Z;
};

MEASUREDBRDF_INLINE Floats FindHalfDistance(const LaneDirections& a, const LaneDirections& b)
{
  const Floats x = a.X - b.X;
  const Floats y = a.Y - b.Y;
  const Floats z = a.Z - b.Z;
  return 0.5f * SquareRoot(x * x + y * y + z * z);
}

MEASUREDBRDF_INLINE LaneDirections FillDirections(const double direction[3])
{
  return { Fill(static_cast<float>(direction[0])), Fill(static_cast<float>(direction[1])),
    Fill(static_cast<float>(direction[2])) };
}

/// The half vectors of lights and a view: the normal where these are opposite. cosine: of a half
/// vector with the view.
MEASUREDBRDF_INLINE LaneDirections FindHalf(
  const LaneDirections& light, const LaneDirections& view, Floats& cosine)
{
  constexpr float least = 1e-6f; // a shorter sum has no direction
  const LaneDirections sum{ light.X + view.X, light.Y + view.Y, light.Z + view.Z };
  const Floats length = SquareRoot(sum.X * sum.X + sum.Y * sum.Y + sum.Z * sum.Z);
  const Floats scale = 1.0f / Larger(length, Fill(least));
  cosine = length > least ? 0.5f * length : view.Z;
  return { length > least ? sum.X * scale : Floats{}, length > least ? sum.Y * scale : Floats{},
    length > least ? sum.Z * scale : Fill(1.0f) };
}

/// What a material computes of LaneCount lights at a time; materials add to it what they need.
struct LaneState
{
  LaneDirections Light;
  Floats Color[3];
};

/**
 * Evaluates a material for any number of lights. lights: x, y and z, f: red, green and blue of all
 * of them. Each of the stages is called with the states of all lights of a batch before the next
 * one is: what one stage needs of the one before is long and slow to come by, and meanwhile the
 * processor works on other lights. The last one sets the colors, which are kept within [0, the
 * largest number].
 */
template <typename State, typename... Stages>
MEASUREDBRDF_INLINE void EvaluateLanes(
  int count, const float* const lights[3], float* const f[3], const Stages&... stages)
{
  constexpr int most = 64; // lights of a batch
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      for (int first = 0; first < count; first += most)
      {
        const int some = std::min(count - first, most);
        const int blocks = (some + LaneCount - 1) / LaneCount;
        State states[most / LaneCount];
        float rgb[3][most];
        for (int c = 0; c < 3; ++c)
        {
          std::copy_n(lights[c] + first, some, rgb[c]); // and the last one once more
          std::fill(rgb[c] + some, rgb[c] + blocks * LaneCount, rgb[c][some - 1]);
        }
        for (int k = 0; k < blocks; ++k)
        {
          states[k].Light = { Load<Floats>(rgb[0] + k * LaneCount),
            Load<Floats>(rgb[1] + k * LaneCount), Load<Floats>(rgb[2] + k * LaneCount) };
        }
        const auto run = [&](const auto& stage) MEASUREDBRDF_INLINED
        {
          for (int k = 0; k < blocks; ++k)
          {
            stage(states[k]);
          }
        };
        (run(stages), ...);
        for (int c = 0; c < 3; ++c)
        {
          for (int k = 0; k < blocks; ++k)
          {
            const Floats positive = Larger(states[k].Color[c], Floats{}); // not a number: 0
            Store(
              Smaller(positive, Fill(std::numeric_limits<float>::max())), rgb[c] + k * LaneCount);
          }
          std::copy_n(rgb[c], some, f[c] + first);
        }
      }
    });
}
} // namespace measuredbrdf

#endif
