// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Dark rings about lamps in maps of radiance are lifted; what is resolved stays.

#include "RadianceTable.h"
#include "SynthesisLanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
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

//------------------------------------------------------------------------------
// As node by node, whatever the width.
TEST(RingLimiter, IsTheSameNodeByNode)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-3.0f, 9.0f);
  for (const int columns : { 4, 6, 18, 32 })
  {
    constexpr int rows = 7;
    std::vector<float> map(static_cast<std::size_t>(3 * rows * columns));
    std::generate(map.begin(), map.end(), [&]() { return value(random); });
    // Columns go round, and beyond a pole the meridian opposite goes on.
    const auto get = [columns](const std::vector<float>& of, int row, int column, int channel)
    {
      const bool isBeyond = row < 0 || row >= rows;
      const int at = row < 0 ? -row : row >= rows ? 2 * (rows - 1) - row : row;
      const int round = (column + columns + (isBeyond ? columns / 2 : 0)) % columns;
      return of[static_cast<std::size_t>(3 * (at * columns + round) + channel)];
    };
    std::vector<float> around(map.size());
    std::transform(
      map.begin(), map.end(), around.begin(), [](float of) { return std::max(of, 0.0f); });
    for (int pass = 0; pass < 8; ++pass) // blurred twice along and across, then the least
    {
      const std::vector<float> in = around;
      const int down = pass % 2;
      for (int k = 0; k < 3 * rows * columns; ++k)
      {
        const int row = k / 3 / columns, column = k / 3 % columns;
        const float a = get(in, row - down, column - 1 + down, k % 3);
        const float c = get(in, row + down, column + 1 - down, k % 3);
        const float b = in[static_cast<std::size_t>(k)];
        around[static_cast<std::size_t>(k)] =
          pass < 4 ? 0.25f * (a + c) + 0.5f * b : std::min({ a, b, c });
      }
    }
    std::vector<float> lifted = map;
    LiftDarkRingsOfMap(lifted.data(), rows, static_cast<std::size_t>(columns));
    int changed = 0;
    for (std::size_t k = 0; k < map.size(); ++k)
    {
      const float expected = around[k] > 0.0f ? std::max(map[k], 0.75f * around[k]) : map[k];
      EXPECT_FLOAT_EQ(lifted[k], expected) << columns << " columns, number " << k;
      changed += lifted[k] != map[k] ? 1 : 0;
    }
    EXPECT_GT(changed, 0);
  }
}
