// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Exponentials and logarithms of many numbers at once, in single precision. Private to the material
 * room.
 */

#ifndef LanePowers_h
#define LanePowers_h

#include "LaneAngles.h" // for series
#include "LaneVectors.h"

namespace measuredbrdf
{
// Taylor series: of e^x, and of atanh(t) / t in t^2.
constexpr float ExpLaneSeries[] = { 1.0f, 1.0f, 1.0f / 2.0f, 1.0f / 6.0f, 1.0f / 24.0f,
  1.0f / 120.0f, 1.0f / 720.0f, 1.0f / 5040.0f };
constexpr float AtanhLaneSeries[] = { 1.0f, 1.0f / 3.0f, 1.0f / 5.0f, 1.0f / 7.0f, 1.0f / 9.0f,
  1.0f / 11.0f };

// ln 2 in two parts, the first of few digits: multiples of it are exact (Cody, Waite 1980).
constexpr float LargeLaneLn2 = 0.693359375f;
constexpr float SmallLaneLn2 = -2.12194440e-4f;

/// e^x of x <= 0: 0 below -87, where single precision ends.
template <typename Vector>
MEASUREDBRDF_INLINE void FindExp(const Vector& x, Vector& result)
{
  using Integers = typename LaneIntegers<Vector>::Type;
  const Vector zero = {};
  const Vector least = zero - 87.0f;
  const Vector inside = x > least ? x : least;
  Integers power; // of two, the nearest
  Convert(inside * 1.44269504f - 0.5f, power);
  Vector whole;
  Convert(power, whole);
  const Vector rest = inside - whole * LargeLaneLn2 - whole * SmallLaneLn2;
  SumLaneSeries(ExpLaneSeries, rest, result);
  const Integers bits = (power + 127) << 23;
  Vector scale;
  Load(&bits, scale);
  result = x > least ? result * scale : zero;
}

/// ln x of x in [1e-30, 1].
template <typename Vector>
MEASUREDBRDF_INLINE void FindLog(const Vector& x, Vector& result)
{
  using Integers = typename LaneIntegers<Vector>::Type;
  Integers bits;
  Load(&x, bits);
  const Integers power = (bits >> 23) - 126;
  bits = (bits & 0x007fffff) | 0x3f000000;
  Vector mantissa; // 1/2 to 1
  Load(&bits, mantissa);
  const Vector zero = 0.0f * x;
  const Vector root = zero + 0.70710678f;
  Vector whole;
  Convert(power, whole);
  whole = mantissa < root ? whole - 1.0f : whole;
  mantissa = mantissa < root ? 2.0f * mantissa : mantissa;
  const Vector t = (mantissa - 1.0f) / (mantissa + 1.0f);
  SumLaneSeries(AtanhLaneSeries, t * t, result);
  result = 2.0f * t * result + whole * SmallLaneLn2 + whole * LargeLaneLn2;
}

/// LogCosineRatio of HalfVector.h: ln(cosine^2) / s, where s is the square of the sine, at most 1.
template <typename Vector>
MEASUREDBRDF_INLINE void FindLogCosineRatio(const Vector& cosine, const Vector& s, Vector& ratio)
{
  const Vector zero = 0.0f * s;
  const Vector t = s / (2.0f - s);
  Vector small; // ln(1 - s) = -2 atanh(s / (2 - s))
  SumLaneSeries(AtanhLaneSeries, t * t, small);
  small *= -2.0f / (2.0f - s);
  const Vector square = cosine * cosine;
  const Vector least = zero + 1e-12f;
  Vector large;
  FindLog(square > least ? square : least, large);
  const Vector few = zero + 0.25f;
  large /= s > few ? s : few;
  ratio = s > few ? large : small;
}
} // namespace measuredbrdf

#endif
