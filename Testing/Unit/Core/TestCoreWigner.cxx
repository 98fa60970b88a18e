// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Wigner's small d functions against closed forms, sums that define them, and Legendre functions.

#include "WignerD.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

using measuredbrdf::WignerD;

namespace
{
constexpr double Pi = 3.14159265358979323846;

// One value; 0 where the degree is too low for m and k.
double Get(int l, int m, int k, double theta)
{
  const WignerD functions(m, k, l);
  if (functions.GetFirst() > l)
  {
    return 0.0;
  }
  std::vector<double> d(static_cast<std::size_t>(l - functions.GetFirst()) + 1);
  functions.Evaluate(theta, d.data());
  return d.back();
}

// Wigner's own sum (Varshalovich et al. 1988, 4.3.1 (2)); cancels for large l.
double GetSum(int l, int m, int k, double theta)
{
  const double c = std::cos(0.5 * theta);
  const double s = std::sin(0.5 * theta);
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  double sum = 0.0;
  for (int j = std::max(0, k - m); j <= std::min(l + k, l - m); ++j)
  {
    sum += ((m - k + j) % 2 == 0 ? 1.0 : -1.0) * std::pow(c, 2 * l + k - m - 2 * j) *
           std::pow(s, m - k + 2 * j) /
           (factorial(l + k - j) * factorial(j) * factorial(m - k + j) * factorial(l - m - j));
  }
  return sum * std::sqrt(factorial(l + m) * factorial(l - m) * factorial(l + k) * factorial(l - k));
}
} // namespace

//------------------------------------------------------------------------------
TEST(WignerD, WignersSum)
{
  for (const double theta : { 0.0, 0.2, 1.3, 2.9, Pi })
  {
    for (int l = 0; l <= 8; ++l)
    {
      for (int m = -l; m <= l; ++m)
      {
        for (int k = -l; k <= l; ++k)
        {
          ASSERT_NEAR(Get(l, m, k, theta), GetSum(l, m, k, theta), 1e-12)
            << l << " " << m << " " << k << " at " << theta;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Neither over- nor underflow where cos^1000 is involved; no value of an orthogonal matrix exceeds
// 1, and sum over l of (2l + 1)/2 d(theta)^2 grows, so they are not all 0 either.
TEST(WignerD, HighDegrees)
{
  const int last = 512;
  for (const int m : { 0, 1, -1, 255, -256, 511, -512, 512 })
  {
    for (const int k : { 0, 2, -3, 256, -511, 512 })
    {
      const WignerD functions(m, k, last);
      EXPECT_EQ(functions.GetFirst(), std::max(std::abs(m), std::abs(k)));
      std::vector<double> d(static_cast<std::size_t>(last - functions.GetFirst()) + 1);
      double largest = 0.0;
      for (const double theta : { 0.0, 1e-9, 1e-3, 1.0, 0.5 * Pi, 2.0, Pi - 1e-9, Pi })
      {
        functions.Evaluate(theta, d.data());
        for (const double value : d)
        {
          ASSERT_TRUE(std::isfinite(value)) << m << " " << k << " " << theta;
          ASSERT_LE(std::abs(value), 1.0 + 1e-10) << m << " " << k << " " << theta;
          largest = std::max(largest, std::abs(value));
        }
      }
      if (std::abs(m) != std::abs(k) && functions.GetFirst() < last - 1)
      {
        EXPECT_GT(largest, 1e-3) << m << " " << k;
      }
    }
  }
  // Degrees below |m| or |k|: nothing is written.
  double untouched = 7.0;
  WignerD(3, 0, 2).Evaluate(1.0, &untouched);
  EXPECT_EQ(untouched, 7.0);
}
