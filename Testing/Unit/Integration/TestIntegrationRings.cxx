// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Dark rings about lamps in maps of radiance are lifted; what is resolved stays.

#include "RingLimiter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

using measuredbrdf::LiftDarkRings;

namespace
{
constexpr int Rows = 17;
constexpr int Columns = 32;

std::size_t At(int row, int column) { return 3 * static_cast<std::size_t>(row * Columns + column); }

std::vector<float> MakeMap(float value)
{
  return std::vector<float>(3 * static_cast<std::size_t>(Rows * Columns), value);
}
}

//------------------------------------------------------------------------------
TEST(RingLimiter, LiftsADarkRing)
{
  std::vector<float> map = MakeMap(2.0f);
  for (int row = 7; row <= 9; ++row)
  {
    for (const int column : { 31, 0, 1 }) // across the seam
    {
      map[At(row, column)] = -50.0f;
    }
  }
  map[At(8, 0)] = 1000.0f;
  LiftDarkRings(map, Rows, Columns);
  EXPECT_EQ(map[At(8, 0)], 1000.0f);
  EXPECT_GT(map[At(8, 1)], 0.8f);
  EXPECT_LT(map[At(8, 1)], 2.0f);
  EXPECT_GT(map[At(7, 31)], 0.8f);
  EXPECT_EQ(map[At(8, 1) + 1], 2.0f); // the other channels had no ring
  EXPECT_EQ(map[At(3, 16)], 2.0f);
}

//------------------------------------------------------------------------------
TEST(RingLimiter, LeavesWhatIsResolvedAndWhatIsNegative)
{
  std::vector<float> smooth = MakeMap(-1.0f);
  for (int row = 0; row < Rows; ++row)
  {
    for (int column = 0; column < Columns; ++column)
    {
      const float x = static_cast<float>(column - 16), y = static_cast<float>(row - 8);
      smooth[At(row, column)] = 0.01f + 100.0f * std::exp(-(x * x + y * y) / 8.0f);
      smooth[At(row, column) + 2] = column < 16 ? 1.0f : 0.0f; // an edge
    }
  }
  std::vector<float> lifted = smooth;
  LiftDarkRings(lifted, Rows, Columns);
  for (std::size_t k = 0; k < smooth.size(); ++k)
  {
    EXPECT_FLOAT_EQ(lifted[k], smooth[k])
      << "row " << k / 3 / Columns << ", column " << k / 3 % Columns << ", channel " << k % 3;
  }
}
