// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the adaptive sum is made of: squares of the sky by fours, many of them at once, and their
// queue.

#include "AdaptiveSum.h"
#include "LaneForms.h"
#include "TexelTree.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using namespace measuredbrdf;

//------------------------------------------------------------------------------
TEST(TexelTree, QuartersAreTheSquaresBelow)
{
  vtkNew<vtkEnvironment> environment;
  std::mt19937 engine(7);
  std::vector<float> rgb;
  for (int k = 0; k < 3 * 37 * 19; ++k) // odd: squares cross the map's edge
  {
    rgb.push_back(static_cast<float>(engine() * 0x1p-32));
  }
  ASSERT_TRUE(environment->SetPixels(37, 19, rgb));
  const TexelTree tree(environment);
  for (int level = tree.GetLowestLevel() + 1; level <= tree.GetHighestLevel(); ++level)
  {
    const int step = level < -1 ? 5 << -level : 1; // parts are many
    for (int y = 0; y < tree.GetHeight(level); y += step)
    {
      for (int x = 0; x < tree.GetWidth(level); x += step)
      {
        float directions[3][4], irradiances[3][4];
        float* const d[3] = { directions[0], directions[1], directions[2] };
        float* const i[3] = { irradiances[0], irradiances[1], irradiances[2] };
        tree.GetQuarters(level, x, y, d, i);
        for (int k = 0; k < 4; ++k)
        {
          const TexelTree::Light light = tree.Get(level - 1, 2 * x + k % 2, 2 * y + k / 2);
          for (int c = 0; c < 3; ++c)
          {
            EXPECT_NEAR(directions[c][k], light.Direction[c], 1e-6) << level;
            EXPECT_NEAR(irradiances[c][k], light.Irradiance[c], 2e-6 * light.Irradiance[c])
              << level << " " << x << " " << y << " " << k;
          }
        }
        if (level > 0)
        {
          EXPECT_EQ(tree.GetRest(level, x, y), static_cast<float>(tree.Get(level, x, y).Rest));
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Each kind of vectors, any number of middles, some of which do not count.
TEST(SquareMiddles, TurnsAndWeighs)
{
  std::mt19937 engine(13);
  const auto draw = [&engine] { return static_cast<float>(engine() * 0x1p-31 - 1.0); };
  const float rows[9] = { 0.36f, 0.48f, -0.8f, -0.8f, 0.6f, 0.0f, 0.48f, 0.64f, 0.6f };
  ForEachLaneForm(
    [&]()
    {
      for (const int count : { 1, 8, 13, 63, 64 })
      {
        SquareMiddles middles = {};
        float f[3][SquareMiddles::Most];
        for (int k = 0; k < count; ++k)
        {
          for (int c = 0; c < 3; ++c)
          {
            middles.Directions[c][k] = draw();
            middles.Irradiances[c][k] = count == 8 ? 1.0f : std::max(draw(), 0.0f);
          }
          if (count == 8) // all of them count
          {
            middles.Directions[0][k] = middles.Directions[1][k] = middles.Directions[2][k] = 1.0f;
          }
        }
        middles.Turn(count, rows);
        for (int k = 0; k < middles.Counting; ++k)
        {
          for (int c = 0; c < 3; ++c)
          {
            f[c][k] = static_cast<float>(c + 1) + middles.Lights[c][k];
          }
        }
        middles.Weigh(count, f);
        int counting = 0;
        for (int k = 0; k < count; ++k)
        {
          glm::vec3 local;
          float irradiance = 0.0f;
          for (int c = 0; c < 3; ++c)
          {
            local[c] = rows[3 * c] * middles.Directions[0][k] +
                       rows[3 * c + 1] * middles.Directions[1][k] +
                       rows[3 * c + 2] * middles.Directions[2][k];
            irradiance += middles.Irradiances[c][k];
          }
          EXPECT_NEAR(middles.Cosines[k], local.z, 1e-6f);
          const bool counts = local.z > 0.0f && irradiance > 0.0f;
          counting += counts ? 1 : 0;
          for (int c = 0; c < 3; ++c)
          {
            const float expected =
              counts ? (static_cast<float>(c + 1) + local[c]) * middles.Irradiances[c][k] * local.z
                     : 0.0f;
            EXPECT_NEAR(middles.Values[c][k], expected, 1e-5f) << count << " " << k;
          }
        }
        EXPECT_EQ(middles.Counting, counting);
      }
    });
}

//------------------------------------------------------------------------------
TEST(SquareMiddles, StaysFinite)
{
  const float rows[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
  ForEachLaneForm(
    [&]()
    {
      SquareMiddles middles = {};
      float f[3][SquareMiddles::Most];
      for (int c = 0; c < 3; ++c)
      {
        middles.Directions[c][0] = c == 2 ? 1.0f : 0.0f;
        middles.Irradiances[c][0] = 1e38f;
        f[c][0] = 1e5f;
      }
      middles.Turn(1, rows);
      middles.Weigh(1, f);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_EQ(middles.Values[c][0], 1e36f);
      }
    });
}
