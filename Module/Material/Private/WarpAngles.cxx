// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WarpAngles.h"

#include "LaneVectors.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr int Most = WarpAngles::Most;

// Chebyshev interpolation of asin(x) / x in x^2, x^2 <= 1/2, and of atan(x) / x, x <= 1: relative
// errors of 8e-12 and 6e-11.
constexpr double AsinSeries[] = { 0.99999999999372968, 0.16666667019637998, 0.07499967233045457,
  0.044654714135912599, 0.030161629737058604, 0.024767972833444674, 0.0010201533982581168,
  0.086087409024912631, -0.19570593125536107, 0.38705744501203299, -0.39302402921020985,
  0.20553840696811676 };
constexpr double AtanSeries[] = { 0.99999999993901145, -0.33333331518190823, 0.19999909956747797,
  -0.14283948416908965, 0.11092984752044943, -0.08979050881073114, 0.07242283651729764,
  -0.054215299315188759, 0.0341334122367698, -0.016055152806075057, 0.0048272245603584452,
  -0.0006804967051721178 };

// No vectors are passed by value: without inlining that would depend on the processor.
template <typename Vector, int Count>
MEASUREDBRDF_INLINE void SumSeries(const double (&series)[Count], const Vector& x, Vector& sum)
{
  sum = 0.0 * x + series[Count - 1];
  for (int k = Count - 2; k >= 0; --k)
  {
    sum = sum * x + series[k];
  }
}

// What stays between the square roots, which are taken of whole arrays.
struct Steps
{
  double X[Most], Y[Most], Z[Most]; // the light
  double Length[Most];              // of light plus view, or its square
  double Sine[2][Most];             // of half of theta_i, theta_h, or its square
};

template <typename Vector>
MEASUREDBRDF_INLINE void AddView(Steps& steps, const double view[3], int k)
{
  Vector x, y, z;
  Load(steps.X + k, x);
  Load(steps.Y + k, y);
  Load(steps.Z + k, z);
  const Vector sumX = x + view[0];
  const Vector sumY = y + view[1];
  const Vector sumZ = z + view[2];
  const Vector length = sumX * sumX + sumY * sumY + sumZ * sumZ;
  const Vector sine = 0.25 * (x * x + y * y + (z - 1.0) * (z - 1.0));
  Store(length, steps.Length + k);
  Store(sine, steps.Sine[0] + k);
}

template <typename Vector>
MEASUREDBRDF_INLINE void FindHalf(Steps& steps, const double view[3], WarpAngles& angles, int k)
{
  Vector x, y, z, length;
  Load(steps.X + k, x);
  Load(steps.Y + k, y);
  Load(steps.Z + k, z);
  Load(steps.Length + k, length);
  const Vector least = 0.0 * length + 1e-12; // opposite directions: the normal
  const Vector scale = 1.0 / (length > least ? length : least);
  const Vector hX = length > least ? (x + view[0]) * scale : 0.0 * x;
  const Vector hY = length > least ? (y + view[1]) * scale : 0.0 * y;
  const Vector sumZ = (z + view[2]) * scale;
  const Vector hZ = length > least ? sumZ : 0.0 * sumZ + 1.0;
  const Vector sine = 0.25 * (hX * hX + hY * hY + (hZ - 1.0) * (hZ - 1.0));
  Store(sine, steps.Sine[1] + k);
  // The azimuth of h from that of the light, which is 0 for an upright light.
  const Vector size = x * x + y * y;
  const Vector fromX = size > 0.0 * size ? x : 0.0 * x + 1.0;
  const Vector along = fromX * hX + y * hY;
  const Vector across = fromX * hY - y * hX;
  const Vector a = along < 0.0 * along ? -along : along;
  const Vector b = across < 0.0 * across ? -across : across;
  const Vector larger = a > b ? a : b;
  const Vector smaller = a > b ? b : a;
  const Vector t = smaller / (larger > 0.0 * larger ? larger : 0.0 * larger + 1.0);
  const Vector square = t * t;
  Vector phi;
  SumSeries(AtanSeries, square, phi);
  phi *= t / (2.0 * Pi); // in turns
  phi = a > b ? phi : 0.25 - phi;
  phi = along < 0.0 * along ? 0.5 - phi : phi;
  phi = across < 0.0 * across ? 0.5 - phi : 0.5 + phi;
  Store(phi, angles.UnitPhiH + k);
}

template <typename Vector>
MEASUREDBRDF_INLINE void FindTheta(Steps& steps, WarpAngles& angles, int k)
{
  for (int i = 0; i < 2; ++i)
  {
    Vector sine, theta;
    Load(steps.Sine[i] + k, sine);
    const Vector square = sine * sine;
    SumSeries(AsinSeries, square, theta);
    theta *= 2.0 * sine;
    const Vector unit = theta * (2.0 / Pi);
    const Vector one = 0.0 * unit + 1.0;
    const Vector inside = unit < one ? unit : one;
    Store(inside, (i == 0 ? angles.UnitTheta : angles.UnitThetaH) + k);
    if (i == 0)
    {
      Store(theta, angles.Theta + k);
    }
  }
}

// Of n numbers, in place; n is a multiple of 4.
using Roots = void (*)(double* values, int n);

template <typename Vector>
MEASUREDBRDF_INLINE void Find(
  Steps& steps, int count, const double view[3], Roots takeRoots, WarpAngles& angles)
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(double));
  for (int k = 0; k < count; k += width)
  {
    AddView<Vector>(steps, view, k);
  }
  takeRoots(steps.Length, count);
  takeRoots(steps.Sine[0], count);
  for (int k = 0; k < count; k += width)
  {
    FindHalf<Vector>(steps, view, angles, k);
  }
  takeRoots(steps.Sine[1], count);
  for (int k = 0; k < count; k += width)
  {
    FindTheta<Vector>(steps, angles, k);
  }
  takeRoots(angles.UnitTheta, count);
  takeRoots(angles.UnitThetaH, count);
}

#ifdef MEASUREDBRDF_HAS_VECTORS
using Vector2 = double __attribute__((vector_size(16)));
using Vector4 = double __attribute__((vector_size(32)));

__attribute__((target("avx2,fma"))) void TakeRootsWide(double* values, int n)
{
  for (int k = 0; k < n; k += 4)
  {
    _mm256_storeu_pd(values + k, _mm256_sqrt_pd(_mm256_loadu_pd(values + k)));
  }
}

__attribute__((target("avx2,fma"))) void FindWide(
  Steps& steps, int count, const double view[3], WarpAngles& angles)
{
  Find<Vector4>(steps, count, view, TakeRootsWide, angles);
}

void TakeRoots(double* values, int n)
{
  for (int k = 0; k < n; k += 2)
  {
    _mm_storeu_pd(values + k, _mm_sqrt_pd(_mm_loadu_pd(values + k)));
  }
}
#endif

void TakeRootsOneByOne(double* values, int n)
{
  std::transform(values, values + n, values, [](double v) { return std::sqrt(v); });
}
}

void FindWarpAngles(
  int count, const double* lights, const double view[3], WarpAngles& angles, VectorForm form)
{
  Steps steps;
  const int whole = (count + 3) / 4 * 4; // the last one once more
  for (int k = 0; k < whole; ++k)
  {
    const double* light = lights + 3 * std::min(k, count - 1);
    steps.X[k] = light[0];
    steps.Y[k] = light[1];
    steps.Z[k] = light[2];
  }
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (form == VectorForm::Wide)
  {
    return FindWide(steps, whole, view, angles);
  }
  if (form == VectorForm::Narrow)
  {
    return Find<Vector2>(steps, whole, view, TakeRoots, angles);
  }
#endif
  static_cast<void>(form);
  Find<double>(steps, whole, view, TakeRootsOneByOne, angles);
}
} // namespace measuredbrdf
