// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Dark rings about lamps in maps of radiance are lifted; what is resolved stays.

#include "SynthesisLanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

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
    measuredbrdf::LiftDarkRingsOfMap(lifted.data(), rows, static_cast<std::size_t>(columns));
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
