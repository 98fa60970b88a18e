// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The tool's arithmetic of costs and errors.
#include "ParetoFront.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
}

//------------------------------------------------------------------------------
TEST(ParetoFront, KnownPoints)
{
  const std::vector<tool::CostPoint> points = { { 10.0, 1.0 }, { 1.0, 10.0 }, { 5.0, 5.0 },
    { 6.0, 5.0 }, { 5.0, 6.0 }, { NotANumber, 0.0 }, { 0.0, Infinity }, { 20.0, 1.0 },
    { 10.0, 1.0 } };
  EXPECT_EQ(tool::FindFront(points), (std::vector<std::size_t>{ 1, 2, 0 }));
  EXPECT_TRUE(tool::FindFront({}).empty());
}

//------------------------------------------------------------------------------
TEST(ParetoFront, AgreesWithItsDefinition)
{
  std::mt19937 random(7);
  std::uniform_int_distribution<int> draw(0, 30);
  std::vector<tool::CostPoint> points;
  for (int k = 0; k < 200; ++k)
  {
    points.push_back({ static_cast<double>(draw(random)), static_cast<double>(draw(random)) });
  }
  const std::vector<std::size_t> front = tool::FindFront(points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const bool beaten = std::any_of(points.begin(), points.end(),
      [&](const tool::CostPoint& other)
      {
        return other.Cost <= points[k].Cost && other.Error <= points[k].Error &&
               (other.Cost < points[k].Cost || other.Error < points[k].Error);
      });
    const bool inFront = std::any_of(front.begin(), front.end(),
      [&](std::size_t other)
      { return points[other].Cost == points[k].Cost && points[other].Error == points[k].Error; });
    EXPECT_EQ(inFront, !beaten) << "point " << k;
  }
}

//------------------------------------------------------------------------------
TEST(ParetoFront, CostAtAnError)
{
  const std::vector<tool::CostPoint> points = { { 10.0, 1.0 }, { 2.0, 4.0 }, { 3.0, 3.0 },
    { NotANumber, 0.1 } };
  EXPECT_DOUBLE_EQ(tool::GetFrontCost(points, 5.0), 2.0);
  EXPECT_DOUBLE_EQ(tool::GetFrontCost(points, 3.0), 3.0);
  EXPECT_DOUBLE_EQ(tool::GetFrontCost(points, 2.9), 10.0);
  EXPECT_TRUE(std::isnan(tool::GetFrontCost(points, 0.5)));
}

//------------------------------------------------------------------------------
TEST(ParetoFront, Means)
{
  EXPECT_DOUBLE_EQ(tool::GetGeometricMean({ 1.0, 100.0 }), 10.0);
  EXPECT_TRUE(std::isnan(tool::GetGeometricMean({})));
  EXPECT_DOUBLE_EQ(tool::GetQuantile({ 4.0, 1.0, 3.0, 2.0 }, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(tool::GetQuantile({ 5.0, 1.0, 3.0 }, 0.25), 2.0);
  EXPECT_DOUBLE_EQ(tool::GetQuantile({ 5.0, 1.0, 3.0 }, 1.0), 5.0);
  EXPECT_DOUBLE_EQ(tool::GetQuantile({ 5.0 }, 0.75), 5.0);
  EXPECT_TRUE(std::isnan(tool::GetQuantile({}, 0.5)));
}
