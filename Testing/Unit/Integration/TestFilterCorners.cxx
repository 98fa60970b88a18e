// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Weights of corners as a texture unit rounds them, against what an NVIDIA H200 showed (driver
// 580.159, OpenGL): textures of two texels along each axis, of which only the last corner is 1, in
// 16384 places along x.
#include "Neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace
{
// The weight of x, in steps, at which the last corner's weight begins to be so many steps.
struct CornerStep
{
  int Weight;
  int First;
};

constexpr int CornerSteps = 256;

int InSteps(double weight)
{
  const double steps = weight * CornerSteps;
  EXPECT_EQ(steps, static_cast<int>(steps));
  return static_cast<int>(steps);
}
}

TEST(FilterCorners, OfTwoAxesAreAGraphicsCards)
{
  const measuredbrdf::FilterWeights filter{ 8 };
  // y at 0.3: the first and the last steps that were seen; then at the middle.
  for (const CornerStep& step : std::vector<CornerStep>{ { 1, 2 }, { 2, 5 }, { 3, 9 }, { 4, 12 },
         { 5, 15 }, { 6, 19 }, { 7, 22 }, { 75, 248 }, { 76, 252 }, { 77, 255 } })
  {
    EXPECT_EQ(InSteps(filter.GetCorners(step.First / 256.0, 0.3)[3]), step.Weight);
    EXPECT_EQ(InSteps(filter.GetCorners((step.First - 1) / 256.0, 0.3)[3]), step.Weight - 1);
  }
  for (int k = 1; k <= CornerSteps; ++k)
  {
    EXPECT_EQ(InSteps(filter.GetCorners(k / 256.0, 0.5)[3]), (k + 1) / 2);
  }
  for (const CornerStep& step : std::vector<CornerStep>{
         { 1, 12 }, { 2, 20 }, { 3, 26 }, { 4, 30 }, { 5, 34 }, { 252, 254 }, { 254, 255 } })
  {
    const double x = step.First / 256.0;
    EXPECT_EQ(InSteps(filter.GetCorners(x, x)[3]), step.Weight);
  }
}

TEST(FilterCorners, OfThreeAxesAreAGraphicsCards)
{
  const measuredbrdf::FilterWeights filter{ 8 };
  for (const CornerStep& step : std::vector<CornerStep>{ { 1, 3 }, { 2, 8 }, { 3, 15 }, { 4, 20 },
         { 5, 25 }, { 6, 31 }, { 7, 36 }, { 44, 241 }, { 45, 246 }, { 46, 252 } })
  {
    EXPECT_EQ(InSteps(filter.GetCorners(step.First / 256.0, 0.3, 0.6)[7]), step.Weight);
    EXPECT_EQ(InSteps(filter.GetCorners((step.First - 1) / 256.0, 0.3, 0.6)[7]), step.Weight - 1);
  }
  for (int k = 1; k <= CornerSteps; ++k)
  {
    EXPECT_EQ(InSteps(filter.GetCorners(k / 256.0, 0.5, 0.5)[7]), (k + 3) / 4);
  }
  for (const CornerStep& step : std::vector<CornerStep>{
         { 1, 32 }, { 2, 47 }, { 3, 55 }, { 4, 61 }, { 5, 67 }, { 250, 254 }, { 253, 255 } })
  {
    const double x = step.First / 256.0;
    EXPECT_EQ(InSteps(filter.GetCorners(x, x, x)[7]), step.Weight);
  }
}

TEST(FilterCorners, AddUpAndAreProductsWhereExact)
{
  for (const int bits : { 0, 4, 8 })
  {
    const measuredbrdf::FilterWeights filter{ bits };
    for (int k = 0; k < 1000; ++k)
    {
      const double x = k % 10 / 9.0;
      const double y = k / 10 % 10 / 9.0;
      const double z = k / 100 / 9.0;
      const std::array<double, 8> corners = filter.GetCorners(x, y, z);
      EXPECT_NEAR(std::accumulate(corners.begin(), corners.end(), 0.0), 1.0, 1e-14);
      EXPECT_GE(*std::min_element(corners.begin(), corners.end()), bits == 0 ? -1e-16 : 0.0);
      for (int c = 0; c < 8; ++c)
      {
        const double product =
          (c & 1 ? x : 1.0 - x) * (c & 2 ? y : 1.0 - y) * (c & 4 ? z : 1.0 - z);
        EXPECT_NEAR(corners[static_cast<std::size_t>(c)], product,
          bits == 0 ? 1e-15 : 2.5 * std::ldexp(1.0, -bits));
      }
    }
  }
}
