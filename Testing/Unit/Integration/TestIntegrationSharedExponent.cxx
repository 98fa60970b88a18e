// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// RGB with a shared exponent, and the octahedral map that is stored so.

#include "Floats.h"
#include "LobePlacement.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

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
