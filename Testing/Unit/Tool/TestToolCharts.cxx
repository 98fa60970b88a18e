// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The tool's arithmetic of costs and errors.
#include "ParetoFront.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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
