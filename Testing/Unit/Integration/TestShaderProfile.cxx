// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What shaders read of a table's profile, by one fetch of the nearest of many texels.

#include "LobePlacement.h"
#include "RadianceTable.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

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

TEST(ShaderProfile, HoldsWhatIsInterpolated)
{
  RadianceTable table = MakeProfileOnly();
  for (const bool hasFloor : { false, true })
  {
    table.HasFloor = hasFloor;
    const std::vector<float> texels = table.GetShaderProfile();
    ASSERT_EQ(texels.size(), (hasFloor ? 8u : 4u) * ProfileTexels);
    for (int k = 0; k < ProfileTexels; ++k)
    {
      const double u = k / (ProfileTexels - 1.0);
      const double sine = std::sin(LobeViews::GetLastAngle() * (1.0 - (1.0 - u) * (1.0 - u)));
      const glm::dvec3 share = GetProfileValue(table.Profile, 1, u);
      const glm::dvec3 lambert = GetProfileValue(table.Profile, 2, u);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(texels[4 * k + c], share[c], 1e-6 * share[c]);
        EXPECT_NEAR(hasFloor ? texels[4 * (ProfileTexels + k) + c] : lambert[c], lambert[c], 1e-7);
      }
      EXPECT_NEAR(sine + texels[4 * k + 3], GetProfileValue(table.Profile, 0, u).z, 1e-6);
    }
  }
}
