// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Distribution.h"
#include "LowDiscrepancy.h"
#include "RandomLight.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

using measuredbrdf::Distribution1D;
using measuredbrdf::Distribution2D;

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
    std::size_t x, y;
    double inX, inY;
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
// Without any weight every cell is as likely; rows of weight 0 among others never come.
TEST(Distribution2D, ZeroRows)
{
  const Distribution2D none(std::vector<double>(12, 0.0), 4, 3);
  EXPECT_TRUE(none.IsZero());
  std::set<std::size_t> cells;
  const Distribution2D middle({ 0, 0, 0, 0, 0, 2, 6, 0, 0, 0, 0, 0 }, 4, 3);
  for (int k = 0; k < 144; ++k)
  {
    std::size_t x, y;
    double inX, inY;
    const double u = (k % 12 + 0.5) / 12;
    const double v = (k / 12 + 0.5) / 12;
    none.Invert(u, v, x, y, inX, inY);
    EXPECT_NEAR(none.GetProbability(x, y), 1.0 / 12.0, 1e-15);
    cells.insert(4 * y + x);
    middle.Invert(u, v, x, y, inX, inY);
    EXPECT_EQ(y, 1u);
    EXPECT_EQ(x, u < 0.25 ? 1u : 2u);
  }
  EXPECT_EQ(cells.size(), 12u);
}

//------------------------------------------------------------------------------
TEST(LowDiscrepancy, RadicalInverseAndWrap)
{
  EXPECT_DOUBLE_EQ(measuredbrdf::RadicalInverse(6, 2), 0.375); // 110 -> .011
  EXPECT_DOUBLE_EQ(measuredbrdf::RadicalInverse(5, 3), 7.0 / 9.0);
  EXPECT_DOUBLE_EQ(measuredbrdf::Wrap01(1.25), 0.25);
  EXPECT_DOUBLE_EQ(measuredbrdf::Wrap01(-0.25), 0.75);
}
