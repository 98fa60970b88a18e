// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What shaders read of a table's profile, by one fetch of the nearest of many texels.

#include "LobePlacement.h"
#include "RadianceCore.h"
#include "RadianceTable.h"
#include "ShaderProfile.h"
#include "ShaderWeights.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

using namespace measuredbrdf;

namespace
{
constexpr int ProfileAngles = 12;

// Lobes that leave the mirror direction towards the horizon, over a darkening Lambert part.
RadianceTable MakeProfileOnly()
{
  RadianceTable table(17, ProfileAngles, 8);
  constexpr std::size_t size = RadianceTable::ProfileSize;
  table.Profile.resize(3 * 3 * size);
  for (std::size_t k = 0; k < size; ++k)
  {
    const double theta = LobeViews::GetAngle(static_cast<int>(k));
    const double delta = 0.9 * theta;
    const glm::dvec3 rows[3] = { { LobeViews::GetKnotPosition(theta, ProfileAngles),
                                   std::cos(delta), std::sin(delta) },
      glm::dvec3(3e-5, 2e-5, 1e-5) * std::exp(-3.0 * theta), // 100 to 1
      glm::dvec3(0.3, 0.01, 0.0) * std::cos(theta) };
    for (std::size_t row = 0; row < 3; ++row)
    {
      for (int c = 0; c < 3; ++c)
      {
        table.Profile[3 * (row * size + k) + static_cast<std::size_t>(c)] =
          static_cast<float>(rows[row][c]);
      }
    }
  }
  return table;
}
}

// As vtkBRDFEnvironmentTable.glsl takes a texel apart.
TEST(ShaderProfile, HoldsWhatIsInterpolated)
{
  const RadianceTable table = MakeProfileOnly();
  const ShaderProfile profile(table);
  ASSERT_EQ(profile.Texels.size(), 4 * ShaderProfile::Size);
  double largest[3] = {};
  const glm::dvec3 brightest = GetProfileValue(table.Profile, 2, 0.0) + glm::dvec3(1e-30);
  for (int k = 0; k <= 5000; ++k)
  {
    const double u = k / 5000.0;
    const double sine = std::sin(LobeViews::GetLastAngle() * (1.0 - (1.0 - u) * (1.0 - u)));
    const auto texel = static_cast<std::size_t>(u * (ShaderProfile::Size - 1.0) + 0.5);
    const double nearest = GetNearestPosition(u);
    const glm::dvec3 axis = GetProfileValue(table.Profile, 0, u);
    const glm::dvec3 share = GetProfileValue(table.Profile, 1, nearest);
    const glm::dvec3 lambert = GetProfileValue(table.Profile, 2, nearest);
    for (std::size_t c = 0; c < 4; ++c)
    {
      const float pair = profile.Texels[4 * texel + c];
      const float whole = std::floor(pair);
      const double rest = pair - whole;
      if (c < 3)
      {
        const int at = static_cast<int>(c);
        largest[0] =
          std::max(largest[0], std::abs(std::pow(whole * profile.Share[c], 2.0) / share[at] - 1.0));
        largest[1] =
          std::max(largest[1], std::abs(std::pow(rest * profile.Lambert[c], 2.0) - lambert[at]) /
                                 (0.05 * brightest[at] + lambert[at]));
      }
      else
      {
        largest[2] = std::max(largest[2], std::abs(sine + pair - axis.z));
      }
    }
  }
  // Half a step; of the sine half a texel.
  std::printf("share %.1e, Lambert part %.1e, sine %.1e\n", largest[0], largest[1], largest[2]);
  EXPECT_LT(largest[0], 1.5e-3); // of what is a hundredth of the largest
  EXPECT_LT(largest[1], 2e-3);
  EXPECT_LT(largest[2], 1.2e-4);
}

// The mirror direction itself has no steps.
TEST(ShaderProfile, MirrorsExactly)
{
  RadianceTable table = MakeProfileOnly();
  constexpr std::size_t size = RadianceTable::ProfileSize;
  for (std::size_t k = 0; k < size; ++k)
  {
    table.Profile[3 * k + 2] =
      static_cast<float>(std::sin(LobeViews::GetAngle(static_cast<int>(k))));
  }
  // What interpolation between the views leaves of the sine.
  const ShaderProfile profile(table);
  for (std::size_t k = 0; k < ShaderProfile::Size; ++k)
  {
    EXPECT_LT(std::abs(profile.Texels[4 * k + 3]), 2e-4);
  }
}

// Read as the shader reads them: weights are rounded by at most half a step of their roots, and
// unpacking is exact.
TEST(ShaderWeights, HoldsThoseOfModes)
{
  RadianceCore core(8);
  core.Orders = { 0, 1, 1 }; // nine numbers: two texels
  constexpr std::size_t size = LobeViews::NumberOfViews;
  core.Profile.resize(3 * 4 * size);
  for (std::size_t k = 0; k < core.Profile.size(); ++k)
  {
    const bool isNone = k >= 3 * 3 * size && k % 3 == 2; // the last mode's blue
    const double amplitude = k % 3 == 1 ? 1e-5 : 3.0;
    core.Profile[k] =
      isNone ? 0.0f : static_cast<float>(amplitude * std::sin(0.1 * static_cast<double>(k)));
  }
  core.SetUnits();
  ASSERT_EQ(core.Units.size(), 9u);
  EXPECT_NEAR(core.Units[0], 3.0 / 2047.0 / 2047.0, 1e-9);
  EXPECT_NEAR(core.Units[1], 1e-5 / 2047.0 / 2047.0, 1e-14);
  EXPECT_EQ(core.Units[8], 0.0f);
  const ShaderWeights packed(core);
  ASSERT_EQ(packed.Rows, 2);
  ASSERT_EQ(packed.Texels.size(), 2 * 4 * ShaderWeights::Size);
  EXPECT_EQ(ShaderWeights::GetName(2), "high0.z");
  EXPECT_EQ(ShaderWeights::GetName(5), "low0.y");
  EXPECT_EQ(ShaderWeights::GetName(8), "high1.x");
  for (std::size_t k = 0; k < ShaderWeights::Size; k += 89)
  {
    const double u = static_cast<double>(k) / (ShaderWeights::Size - 1.0);
    for (std::size_t number = 0; number < 9; ++number)
    {
      const float both = packed.Texels[4 * (number / 8 * ShaderWeights::Size + k) + number % 4];
      const float high = std::floor(both);
      const double steps = (number % 8 < 4 ? high : (both - high) * 4096.0f) - 2047.0f;
      const int channel = static_cast<int>(number % 3);
      EXPECT_EQ(steps, core.GetSteps(number / 3, u)[channel]);
      const glm::dvec3 wanted = GetProfileValue(core.Profile, 1 + static_cast<int>(number / 3), u);
      const double unit = static_cast<double>(core.Units[number]);
      EXPECT_NEAR(
        steps * std::abs(steps) * unit, wanted[channel], (1.01 * std::abs(steps) + 0.26) * unit);
    }
  }
}
