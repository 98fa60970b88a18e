// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Angles of many vectors at once, in single precision. Private to the material room.
 */

#ifndef LaneAngles_h
#define LaneAngles_h

#include "HalfVector.h" // for Pi
#include "LaneVectors.h"

namespace measuredbrdf
{
// Chebyshev interpolation of asin(x) / x in x^2, x^2 <= 1/2, and of atan(x) / x, x <= 1, rounded:
// relative errors of 8e-8, with those of summing in single precision.
constexpr float AsinLaneSeries[] = { 1.0f, 0.16666955f, 0.074881144f, 0.04648085f, 0.016731389f,
  0.07553975f, -0.090086214f, 0.109673984f };
constexpr float AtanLaneSeries[] = { 1.0f, -0.33333036f, 0.19991872f, -0.14197798f, 0.10618371f,
  -0.07456855f, 0.042137623f, -0.015731249f, 0.0027662835f };

template <typename Vector, int Count>
MEASUREDBRDF_INLINE void SumLaneSeries(const float (&series)[Count], const Vector& x, Vector& sum)
{
  sum = 0.0f * x + series[Count - 1];
  for (int k = Count - 2; k >= 0; --k)
  {
    sum = sum * x + series[k];
  }
}

/// Of a light and the view: the square of their sum's length, and that of the sine of half of the
/// light's polar angle.
template <typename Vector>
MEASUREDBRDF_INLINE void FindSquares(const Vector& x, const Vector& y, const Vector& z,
  const float view[3], Vector& length, Vector& sine)
{
  const Vector sumX = x + view[0];
  const Vector sumY = y + view[1];
  const Vector sumZ = z + view[2];
  length = sumX * sumX + sumY * sumY + sumZ * sumZ;
  sine = 0.25f * (x * x + y * y + (z - 1.0f) * (z - 1.0f));
}

/// Light plus view, where it is longer, has a direction.
constexpr float LeastLaneSum = 1e-6f;

/// The half vector, from the length of light plus view: the normal where they are opposite.
template <typename Vector>
MEASUREDBRDF_INLINE void FindHalf(const Vector& x, const Vector& y, const Vector& z,
  const float view[3], const Vector& length, Vector& hX, Vector& hY, Vector& hZ)
{
  const Vector zero = 0.0f * length;
  const Vector least = zero + LeastLaneSum;
  const Vector scale = 1.0f / (length > least ? length : least);
  hX = length > least ? (x + view[0]) * scale : zero;
  hY = length > least ? (y + view[1]) * scale : zero;
  const Vector sumZ = (z + view[2]) * scale;
  hZ = length > least ? sumZ : zero + 1.0f;
}

/// The angle of unit vectors with one another, in quarter turns, 1 at most, from half the length of
/// their difference.
template <typename Vector>
MEASUREDBRDF_INLINE void FindQuarterTurns(const Vector& half, Vector& turns)
{
  const Vector square = half * half;
  SumLaneSeries(AsinLaneSeries, square, turns);
  turns *= static_cast<float>(4.0 / Pi) * half;
  const Vector one = 0.0f * turns + 1.0f;
  turns = turns < one ? turns : one;
}

/// The azimuth of (along, across) without its sign, in turns: 0 to 1/2. 0 of a vector without
/// length.
template <typename Vector>
MEASUREDBRDF_INLINE void FindTurns(const Vector& along, const Vector& across, Vector& turns)
{
  const Vector zero = 0.0f * along;
  const Vector a = along < zero ? -along : along;
  const Vector b = across < zero ? -across : across;
  const Vector larger = a > b ? a : b;
  const Vector smaller = a > b ? b : a;
  const Vector t = smaller / (larger > zero ? larger : zero + 1.0f);
  const Vector square = t * t;
  SumLaneSeries(AtanLaneSeries, square, turns);
  turns *= t * static_cast<float>(0.5 / Pi);
  turns = b > a ? 0.25f - turns : turns;
  turns = along < zero ? 0.5f - turns : turns;
}
} // namespace measuredbrdf

#endif
