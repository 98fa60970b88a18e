// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the texels of tables hold: profiles, shared exponents, octahedral maps.

#include "Floats.h"
#include "LobePlacement.h"
#include "RadianceTable.h"

#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

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

//------------------------------------------------------------------------------
using measuredbrdf::GetOctahedralDirection;
using measuredbrdf::GetOctahedralPosition;
using measuredbrdf::GetOctahedralValue;
using measuredbrdf::PackSharedExponent;
using measuredbrdf::UnpackSharedExponent;

TEST(SharedExponent, ErrorIsAPartOfTheLargestComponent)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<float> power(-6.0f, 15.9f);
  for (int k = 0; k < 20000; ++k)
  {
    const glm::vec3 rgb(
      std::exp2(power(random)), std::exp2(power(random)), std::exp2(power(random)));
    const std::uint32_t texel = PackSharedExponent(rgb);
    const glm::vec3 back = UnpackSharedExponent(texel);
    const float bound = std::ldexp(std::max({ rgb.x, rgb.y, rgb.z }), -9);
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_LE(std::abs(back[c] - rgb[c]), bound);
    }
    ASSERT_EQ(PackSharedExponent(back), texel);
    // As graphics cards read it, and GLM.
    ASSERT_EQ(back, glm::unpackF3x9_E1x5(texel));
  }
}

TEST(SharedExponent, Ends)
{
  constexpr float largest = measuredbrdf::LargestSharedExponent;
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(PackSharedExponent(glm::vec3(0.0f)), 0u);
  EXPECT_EQ(UnpackSharedExponent(PackSharedExponent({ -1.0f, nan, 2.0f })), glm::vec3(0, 0, 2));
  EXPECT_EQ(UnpackSharedExponent(PackSharedExponent({ infinity, 1e9f, 0.0f })),
    glm::vec3(largest, largest, 0));
  EXPECT_EQ(UnpackSharedExponent(PackSharedExponent(glm::vec3(1.0f))), glm::vec3(1.0f));
  // Rounded up to the next power of two.
  EXPECT_EQ(UnpackSharedExponent(PackSharedExponent(glm::vec3(0.99999f))), glm::vec3(1.0f));
  EXPECT_EQ(UnpackSharedExponent(PackSharedExponent(glm::vec3(std::ldexp(1.0f, -24)))),
    glm::vec3(std::ldexp(1.0f, -24)));
  EXPECT_EQ(PackSharedExponent(glm::vec3(std::ldexp(1.0f, -26))), 0u);
}

TEST(OctahedralMap, ThereAndBack)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 2000; ++k)
  {
    const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec2 place = GetOctahedralPosition(d);
    ASSERT_TRUE(place.x >= 0.0 && place.x <= 1.0 && place.y >= 0.0 && place.y <= 1.0);
    ASSERT_LT(glm::length(GetOctahedralDirection(place) - d), 1e-12);
  }
}

// A smooth function of direction, around the whole sphere and across the folds.
TEST(OctahedralMap, HasNoSeam)
{
  constexpr int side = 65;
  const auto function = [](const glm::dvec3& d)
  { return 2.0 + d.x + 0.5 * d.y * d.z - 0.3 * d.x * d.z; };
  std::vector<std::uint32_t> map;
  for (int k = 0; k < side * side; ++k)
  {
    const glm::dvec2 place(k % side, k / side);
    map.push_back(
      PackSharedExponent(glm::vec3(function(GetOctahedralDirection(place / (side - 1.0))))));
  }
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 5000; ++k)
  {
    const glm::dvec3 d = glm::normalize(glm::dvec3(
      normal(random), k % 2 ? -std::abs(normal(random)) : normal(random), normal(random)));
    ASSERT_NEAR(GetOctahedralValue(map, side, d).x, function(d), 0.008) << d.x << " " << d.y;
  }
  for (const glm::dvec3& d : { glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0),
         glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1) })
  {
    EXPECT_NEAR(GetOctahedralValue(map, side, d).x, function(d), 0.005);
  }
}
