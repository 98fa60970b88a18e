// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Wigner's small d functions against closed forms, sums that define them, and Legendre functions.

#include "WignerD.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
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
// Varshalovich et al. 1988, tables 4.3, 4.4 and 4.6: rows m, columns k.
TEST(WignerD, ClosedForms)
{
  double worst = 0.0;
  for (const double theta : { 0.0, 0.3, 1.1, 0.5 * Pi, 2.2, 3.0, Pi })
  {
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    EXPECT_EQ(Get(0, 0, 0, theta), 1.0);
    const double r = s / std::sqrt(2.0);
    const double p = 0.5 * (1.0 + c);
    const double q = 0.5 * (1.0 - c);
    const double first[3][3] = { { p, r, q }, { -r, c, r }, { q, -r, p } }; // m = -1, 0, 1
    for (int m = -1; m <= 1; ++m)
    {
      for (int k = -1; k <= 1; ++k)
      {
        const double difference = Get(1, m, k, theta) - first[m + 1][k + 1];
        EXPECT_NEAR(difference, 0.0, 1e-14) << m << " " << k << " at " << theta;
        worst = std::max(worst, std::abs(difference));
      }
    }
    // All of degree 2 follow from these by symmetries.
    const double second[][3] = { { 2, 2, p * p }, { 2, 1, -s * p },
      { 2, 0, 0.25 * std::sqrt(6.0) * s * s }, { 2, -1, -s * q }, { 2, -2, q * q },
      { 1, 1, p * (2.0 * c - 1.0) }, { 1, 0, -std::sqrt(1.5) * s * c },
      { 1, -1, q * (2.0 * c + 1.0) }, { 0, 0, 0.5 * (3.0 * c * c - 1.0) } };
    for (const auto& row : second)
    {
      const int m = static_cast<int>(row[0]);
      const int k = static_cast<int>(row[1]);
      const double sign = (m - k) % 2 == 0 ? 1.0 : -1.0;
      EXPECT_NEAR(Get(2, m, k, theta), row[2], 1e-14) << m << " " << k << " at " << theta;
      EXPECT_NEAR(Get(2, -k, -m, theta), row[2], 1e-14) << m << " " << k << " at " << theta;
      EXPECT_NEAR(Get(2, k, m, theta), sign * row[2], 1e-14) << m << " " << k << " at " << theta;
      EXPECT_NEAR(Get(2, -m, -k, theta), sign * row[2], 1e-14) << m << " " << k << " at " << theta;
    }
  }
  std::printf("degree 1: largest difference %.1e\n", worst);
}

//------------------------------------------------------------------------------
TEST(WignerD, WignersSum)
{
  double worst = 0.0;
  for (const double theta : { 0.2, 1.3, 2.9 })
  {
    for (int l = 0; l <= 8; ++l)
    {
      for (int m = -l; m <= l; ++m)
      {
        for (int k = -l; k <= l; ++k)
        {
          const double difference = Get(l, m, k, theta) - GetSum(l, m, k, theta);
          ASSERT_NEAR(difference, 0.0, 1e-12) << l << " " << m << " " << k << " at " << theta;
          worst = std::max(worst, std::abs(difference));
        }
      }
    }
  }
  std::printf("all of degree <= 8: largest difference %.1e\n", worst);
}

//------------------------------------------------------------------------------
// The matrix of one degree is orthogonal, and turns by two angles are a turn by their sum.
TEST(WignerD, UnitaryAndAGroup)
{
  for (const int l : { 20, 64 })
  {
    const std::size_t size = 2 * static_cast<std::size_t>(l) + 1;
    const auto matrix = [&](double theta)
    {
      std::vector<double> d;
      for (int m = -l; m <= l; ++m)
      {
        for (int k = -l; k <= l; ++k)
        {
          d.push_back(Get(l, m, k, theta));
        }
      }
      return d;
    };
    double worst = 0.0;
    for (const double theta : { 1e-3, 0.4, 1.5, 2.6, 3.14 })
    {
      const std::vector<double> d = matrix(theta);
      for (std::size_t m = 0; m < size; ++m)
      {
        for (std::size_t n = 0; n < size; ++n)
        {
          double sum = 0.0;
          for (std::size_t k = 0; k < size; ++k)
          {
            sum += d[m * size + k] * d[n * size + k];
          }
          worst = std::max(worst, std::abs(sum - (m == n ? 1.0 : 0.0)));
        }
      }
    }
    EXPECT_LT(worst, 1e-10) << l;
    const std::vector<double> a = matrix(0.7), b = matrix(1.6), both = matrix(2.3);
    double product = 0.0;
    for (std::size_t m = 0; m < size; ++m)
    {
      for (std::size_t n = 0; n < size; ++n)
      {
        double sum = 0.0;
        for (std::size_t k = 0; k < size; ++k)
        {
          sum += a[m * size + k] * b[k * size + n];
        }
        product = std::max(product, std::abs(sum - both[m * size + n]));
      }
    }
    EXPECT_LT(product, 1e-10) << l;
    std::printf("l = %d: orthogonal to %.1e, d(a) d(b) = d(a + b) to %.1e\n", l, worst, product);
  }
}

//------------------------------------------------------------------------------
// d(0) is the unit matrix, d(pi)_mk = (-1)^(l - k) where m = -k and 0 elsewhere.
TEST(WignerD, Ends)
{
  double worst = 0.0;
  for (const int l : { 0, 1, 2, 7, 40, 129 })
  {
    const int step = l > 10 ? 9 : 1;
    for (int m = -l; m <= l; m += step)
    {
      for (int k = -l; k <= l; k += step)
      {
        const double start = Get(l, m, k, 0.0) - (m == k ? 1.0 : 0.0);
        const double end = Get(l, m, k, Pi) - (m == -k ? ((l - k) % 2 == 0 ? 1.0 : -1.0) : 0.0);
        EXPECT_NEAR(start, 0.0, 1e-11) << l << " " << m << " " << k;
        EXPECT_NEAR(end, 0.0, 1e-11) << l << " " << m << " " << k;
        worst = std::max({ worst, std::abs(start), std::abs(end) });
      }
    }
  }
  std::printf("at 0 and pi: largest difference %.1e\n", worst);
}

//------------------------------------------------------------------------------
// d^l_m0 = sqrt((l - m)! / (l + m)!) P^m_l with the Condon-Shortley phase, here by the fully
// normalized recursion in l, whose values are those of spherical harmonics; P^0_l by its own.
TEST(WignerD, LegendreFunctions)
{
  const int last = 300;
  double worst = 0.0;
  for (const double theta : { 0.01, 0.8, 0.5 * Pi, 2.0, 3.1 })
  {
    const double x = std::cos(theta);
    for (const int m : { 0, 1, 2, 5, 33, 150 })
    {
      // sqrt((l - m)! / (l + m)!) P^m_l from l = m on.
      double current = m % 2 == 0 ? 1.0 : -1.0;
      for (int j = 1; j <= m; ++j)
      {
        current *= std::sin(theta) * std::sqrt((2.0 * j - 1.0) / (2.0 * j));
      }
      double before = 0.0;
      std::vector<double> d(static_cast<std::size_t>(last - m) + 1);
      std::vector<double> negative(d.size());
      WignerD(m, 0, last).Evaluate(theta, d.data());
      WignerD(-m, 0, last).Evaluate(theta, negative.data());
      for (int l = m; l <= last; ++l)
      {
        const std::size_t at = static_cast<std::size_t>(l - m);
        worst = std::max(worst, std::abs(d[at] - current));
        ASSERT_NEAR(d[at], current, 1e-11) << l << " " << m << " at " << theta;
        ASSERT_NEAR(negative[at], m % 2 == 0 ? current : -current, 1e-11) << l << " " << -m;
        const double next =
          ((2.0 * l + 1.0) * x * current -
            std::sqrt((static_cast<double>(l) + m) * (static_cast<double>(l) - m)) * before) /
          std::sqrt((l + 1.0 + m) * (l + 1.0 - m));
        before = current;
        current = next;
      }
    }
  }
  std::printf("Legendre functions up to degree %d: largest difference %.1e\n", last, worst);
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
