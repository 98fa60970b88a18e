// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Distribution.h"
#include "LowDiscrepancy.h"
#include "SummedAreaTable.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

using measuredbrdf::Distribution1D;
using measuredbrdf::Distribution2D;
using measuredbrdf::SummedAreaTable;

namespace
{
double Uniform(std::mt19937& engine) { return engine() * 0x1p-32; }
} // namespace

//------------------------------------------------------------------------------
TEST(Distribution1D, ProbabilitiesAndInversion)
{
  const std::vector<double> weights = { 0.0, 1.0, 0.0, 3.0, -5.0,
    std::numeric_limits<double>::infinity(), 4.0, 0.0 };
  const Distribution1D d(weights.begin(), weights.end());
  ASSERT_EQ(d.GetSize(), 8u);
  EXPECT_DOUBLE_EQ(d.GetTotal(), 8.0);
  const double expected[8] = { 0.0, 0.125, 0.0, 0.375, 0.0, 0.0, 0.5, 0.0 };
  for (std::size_t k = 0; k < 8; ++k)
  {
    EXPECT_DOUBLE_EQ(d.GetProbability(k), expected[k]);
  }
  // u = F_k + remainder p_k, everywhere and at the boundaries.
  for (double u : { 0.0, 0.0624, 0.124999, 0.125, 0.3, 0.5, 0.75, 0.9999999 })
  {
    double remainder;
    const std::size_t k = d.Invert(u, remainder);
    EXPECT_GT(d.GetProbability(k), 0.0) << u;
    EXPECT_GE(remainder, 0.0);
    EXPECT_LT(remainder, 1.0);
    EXPECT_NEAR(d.GetCumulative(k) + remainder * d.GetProbability(k), u, 1e-15);
  }
  double remainder;
  EXPECT_EQ(d.Invert(0.0, remainder), 1u);
  EXPECT_EQ(d.Invert(0.125, remainder), 3u);
  EXPECT_EQ(d.Invert(1.0, remainder), 6u); // the last that can be drawn
  EXPECT_LT(remainder, 1.0);
}

//------------------------------------------------------------------------------
TEST(Distribution1D, WithoutWeightUniform)
{
  const std::vector<double> weights(4, 0.0);
  const Distribution1D d(weights.begin(), weights.end());
  EXPECT_TRUE(d.IsZero());
  double remainder;
  EXPECT_EQ(d.Invert(0.6, remainder), 2u);
  EXPECT_NEAR(remainder, 0.4, 1e-12);
}

//------------------------------------------------------------------------------
TEST(Distribution2D, SamplesFollowTheWeights)
{
  const std::size_t width = 6;
  const std::size_t height = 5;
  std::mt19937 engine(7);
  std::vector<double> weights(width * height);
  double total = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k)
  {
    const std::size_t row = k / width;
    weights[k] = row == 0 || row == 3 || k % 4 == 1 ? 0.0 : 0.1 + Uniform(engine);
    total += weights[k];
  }
  const Distribution2D d(weights, width, height);
  EXPECT_NEAR(d.GetTotal(), total, 1e-12);

  const int draws = 200000;
  std::vector<int> hits(weights.size(), 0);
  double sumX = 0.0;
  for (int k = 0; k < draws; ++k)
  {
    std::size_t x;
    std::size_t y;
    double inX;
    double inY;
    const double u = Uniform(engine);
    d.Invert(u, Uniform(engine), x, y, inX, inY);
    ++hits[y * width + x];
    sumX += inX;
  }
  double chiSquare = 0.0;
  int cells = 0;
  for (std::size_t k = 0; k < weights.size(); ++k)
  {
    const double p = d.GetProbability(k % width, k / width);
    EXPECT_NEAR(p, weights[k] / total, 1e-14);
    if (weights[k] == 0.0)
    {
      EXPECT_EQ(hits[k], 0);
      continue;
    }
    ++cells;
    chiSquare += (hits[k] - draws * p) * (hits[k] - draws * p) / (draws * p);
  }
  // Mean cells - 1, standard deviation sqrt(2 (cells - 1)): five of them.
  EXPECT_LT(chiSquare, cells - 1 + 5.0 * std::sqrt(2.0 * (cells - 1)));
  // Remainders are uniform again: mean 1/2, standard deviation 1/sqrt(12 n).
  EXPECT_NEAR(sumX / draws, 0.5, 5.0 / std::sqrt(12.0 * draws));
}

//------------------------------------------------------------------------------
TEST(LowDiscrepancy, RadicalInverseAndWrap)
{
  EXPECT_DOUBLE_EQ(measuredbrdf::RadicalInverse(6, 2), 0.375); // 110 -> .011
  EXPECT_DOUBLE_EQ(measuredbrdf::RadicalInverse(5, 3), 7.0 / 9.0);
  EXPECT_DOUBLE_EQ(measuredbrdf::Wrap01(1.25), 0.25);
  EXPECT_DOUBLE_EQ(measuredbrdf::Wrap01(-0.25), 0.75);
}

//------------------------------------------------------------------------------
TEST(SummedAreaTable, EqualsTheDirectSum)
{
  std::mt19937 engine(3);
  const int sizes[][2] = { { 1, 1 }, { 1, 9 }, { 300, 1 }, { 257, 31 } };
  for (const auto& size : sizes)
  {
    const int width = size[0];
    const int height = size[1];
    std::vector<double> values(std::size_t(width) * height);
    for (double& value : values)
    {
      value = Uniform(engine);
    }
    const SummedAreaTable table(width, height,
      [&](int y, double* row)
      { std::copy_n(&values[std::size_t(y) * width], std::size_t(width), row); });
    for (int k = 0; k < 200; ++k)
    {
      int x0 = static_cast<int>(engine() % (width + 1u));
      int x1 = static_cast<int>(engine() % (width + 1u));
      int y0 = static_cast<int>(engine() % (height + 1u));
      int y1 = static_cast<int>(engine() % (height + 1u));
      if (x0 > x1)
      {
        std::swap(x0, x1);
      }
      if (y0 > y1)
      {
        std::swap(y0, y1);
      }
      double direct = 0.0;
      for (int y = y0; y < y1; ++y)
      {
        for (int x = x0; x < x1; ++x)
        {
          direct += values[std::size_t(y) * width + x];
        }
      }
      ASSERT_NEAR(table.GetSum(x0, y0, x1, y1), direct, 1e-10);
    }
  }
}
