// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What is made of an environment once: its harmonics, its pyramid, its panels.

#include "EnvironmentHarmonics.h"
#include "EnvironmentPanels.h"
#include "EnvironmentPrecomputation.h"
#include "EnvironmentPyramid.h"
#include "HalfVector.h" // for Pi
#include "WignerD.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

using namespace measuredbrdf;

namespace
{
vtkNew<vtkEnvironment> NewNoise(int width, int height)
{
  std::mt19937 engine(2);
  std::vector<float> rgb(3 * std::size_t(width) * std::size_t(height));
  for (float& value : rgb)
  {
    value = static_cast<float>(engine() * 0x1p-32);
  }
  vtkNew<vtkEnvironment> environment;
  EXPECT_TRUE(environment->SetPixels(width, height, rgb));
  return environment;
}

// a_lm by its definition, over so many points a texel's side.
std::complex<double> SumPoints(vtkEnvironment* environment, int points, int channel, int l, int m)
{
  const WignerD function(m, 0, l);
  std::vector<double> d(static_cast<std::size_t>(l) + 1);
  const int width = points * environment->GetWidth();
  const int height = points * environment->GetHeight();
  std::complex<double> sum = 0.0;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      double rgb[3], direction[3];
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, direction);
      environment->GetRadiance(direction, rgb);
      if (x == 0)
      {
        function.Evaluate(std::acos(direction[1]), d.data());
      }
      const double azimuth = std::atan2(direction[0], direction[2]);
      const double solidAngle =
        2.0 * Pi / width * 2.0 * std::sin(Pi / (2.0 * height)) * std::sin(Pi * (y + 0.5) / height);
      sum += solidAngle * rgb[channel] * d[static_cast<std::size_t>(l - function.GetFirst())] *
             std::polar(1.0, -m * azimuth);
    }
  }
  return sum * std::sqrt((2.0 * l + 1.0) / (4.0 * Pi));
}
} // namespace

//------------------------------------------------------------------------------
// Any width: powers of two, primes, less columns than orders, and maps that are cut up.
TEST(EnvironmentHarmonics, AreIntegralsOfTheInterpolatedSky)
{
  for (const std::array<int, 2>& size :
    { std::array<int, 2>{ 131, 66 }, std::array<int, 2>{ 5, 3 } }) // a large prime; cut up
  {
    const auto environment = NewNoise(size[0], size[1]);
    for (const auto& [l, m] :
      { std::pair(9, 4), { 32, 5 }, { 64, 0 }, { 64, 60 }, { 150, 0 }, { 150, 149 } })
    {
      const auto expected = SumPoints(environment->GetSubdivided(), 8, 1, l, m);
      for (const int degree : { 9, 32, 64, 150 })
      {
        if (l <= degree && l >= degree / 4)
        {
          const EnvironmentHarmonics harmonics(environment, degree);
          EXPECT_LT(std::abs(harmonics.Get(1, l, m) - expected), 1e-3)
            << size[0] << " wide, degree " << degree << ", l " << l << ", m " << m << ": "
            << expected;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// The lower half's four meridians are the square's sides: what lies beside them there lies on the
// other half of the same side.
TEST(EnvironmentPyramid, IsContinuousAcrossAllFourFolds)
{
  const auto environment = NewNoise(256, 128);
  const EnvironmentPyramid pyramid(environment, {}, 768);
  const glm::dvec2 folds[4] = { { -1.0, 0.0 }, { 1.0, 0.0 }, { 0.0, -1.0 }, { 0.0, 1.0 } };
  for (int level = 0; level + 2 < pyramid.GetNumberOfLevels(); ++level)
  {
    for (const glm::dvec2& fold : folds)
    {
      const glm::dvec2 across(-fold.y, fold.x);
      double jump = 0.0;
      double contrast = 0.0;
      glm::vec3 last(0.0f);
      constexpr int count = 200;
      for (int k = 0; k < count; ++k)
      {
        const double polar = 0.5 * Pi * (1.0 + (k + 0.5) / count);
        const auto look = [&](double aside)
        {
          const glm::dvec2 flat = std::sin(polar) * glm::normalize(fold + aside * across);
          return pyramid.Sample(
            glm::vec3(glm::dvec3(flat, std::cos(polar))), static_cast<float>(level));
        };
        const glm::vec3 here = look(1e-5);
        jump += glm::distance(here, look(-1e-5));
        contrast += k > 0 ? glm::distance(here, last) : 0.0;
        last = here;
      }
      EXPECT_LT(jump, 0.03 * contrast) << "level " << level << ", " << fold.x << " " << fold.y;
    }
  }
}

// On every level and across every edge; the coarsest level is the mean.
TEST(EnvironmentPyramid, KeepsConstantsAndTheMean)
{
  const int sizes[5][2] = { { 1, 1 }, { 8, 4 }, { 37, 18 }, { 256, 128 }, { 1024, 512 } };
  for (const auto& size : sizes)
  {
    vtkNew<vtkEnvironment> environment;
    environment->SetPixels(
      size[0], size[1], std::vector<float>(static_cast<std::size_t>(3 * size[0] * size[1]), 3.0f));
    const EnvironmentPyramid pyramid(environment);
    for (const glm::vec4& texel : pyramid.GetAtlas())
    {
      EXPECT_TRUE(texel.x == 0.0f || std::abs(texel.x - 3.0f) < 3e-4f)
        << size[0] << ": " << texel.x;
    }
    const auto noise = NewNoise(size[0], size[1]);
    double total[3];
    noise->GetTotal(total);
    const glm::vec3 mean = EnvironmentPyramid(noise).Sample(glm::vec3(0.0f, 0.0f, 1.0f), 20.0f);
    EXPECT_NEAR(mean.y, total[1] / (4.0 * Pi), 1e-3 * total[1]) << size[0];
  }
}

namespace
{
// A radiance everywhere, and some in discs of 12 degrees about directions.
vtkSmartPointer<vtkEnvironment> MakePanels(
  float rest, const std::vector<std::pair<glm::dvec3, float>>& panels)
{
  constexpr int width = 128;
  constexpr int height = 64;
  std::vector<float> pixels;
  for (int k = 0; k < width * height; ++k)
  {
    glm::dvec3 d;
    vtkEnvironment::GetDirection((k % width + 0.5) / width, (k / width + 0.5) / height, &d.x);
    float value = rest;
    for (const auto& [direction, radiance] : panels)
    {
      value = glm::dot(d, direction) > std::cos(glm::radians(12.0)) ? radiance : value;
    }
    pixels.insert(pixels.end(), { value, value, 0.5f * value });
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  environment->SetPixels(width, height, pixels);
  return environment;
}

std::vector<measuredbrdf::EnvironmentPanels::Panel> FindPanels(vtkEnvironment* environment)
{
  const auto panels =
    environment->GetParts().GetPanels(environment, nullptr, []() { return true; });
  return panels ? panels->GetPanels() : std::vector<measuredbrdf::EnvironmentPanels::Panel>();
}
}

// Panels are found where they are, with their light, the brightest first; the rest is none.
TEST(EnvironmentPanels, AreFoundWithTheirLight)
{
  const glm::dvec3 left = glm::normalize(glm::dvec3(-1.0, 0.4, 0.3));
  const glm::dvec3 right = glm::normalize(glm::dvec3(0.6, 0.2, -0.9));
  const auto found = FindPanels(MakePanels(0.01f, { { left, 20.0f }, { right, 60.0f } }));
  ASSERT_GE(found.size(), 2u);
  EXPECT_GT(glm::dot(found[0].Direction, right), std::cos(glm::radians(10.0)));
  const double solidAngle = 2.0 * 3.14159265358979 * (1.0 - std::cos(glm::radians(12.0)));
  double light[2] = { 0.0, 0.0 };
  for (const auto& panel : found)
  {
    EXPECT_GE(panel.Concentration, 40.0);
    EXPECT_NEAR(panel.Irradiance.z, 0.5 * panel.Irradiance.x, 1e-4 * panel.Irradiance.x);
    const bool isLeft = glm::dot(panel.Direction, left) > glm::dot(panel.Direction, right);
    EXPECT_GT(glm::dot(panel.Direction, isLeft ? left : right), std::cos(glm::radians(15.0)));
    light[isLeft ? 0 : 1] += panel.Irradiance.x;
  }
  EXPECT_NEAR(light[0], 20.0 * solidAngle, 2.0 * solidAngle);
  EXPECT_NEAR(light[1], 60.0 * solidAngle, 6.0 * solidAngle);
}

TEST(EnvironmentPanels, AreNotInSmoothSkies)
{
  EXPECT_TRUE(FindPanels(MakePanels(1.0f, {})).empty());
  EXPECT_TRUE(FindPanels(MakePanels(0.0f, {})).empty());
  vtkNew<vtkEnvironment> tiny;
  tiny->SetPixels(2, 1, { 1.0f, 1.0f, 1.0f, 0.5f, 0.5f, 0.5f });
  EXPECT_TRUE(FindPanels(tiny).empty());
}

//------------------------------------------------------------------------------
// Several sets by one tree: each the same as by itself.
TEST(EnvironmentPrecomputation, SetsOfOneTreeAreThoseOfTheirOwn)
{
  const vtkNew<vtkEnvironment> environment = NewNoise(64, 32);
  const auto goOn = []() { return true; };
  EnvironmentPrecomputation together, apart;
  const std::vector<int> counts = { 300, 40, 7, 1 };
  const auto sets = together.GetLightSets(environment, nullptr, counts, goOn);
  ASSERT_EQ(sets.size(), counts.size());
  for (std::size_t k = 0; k < counts.size(); ++k)
  {
    const auto own = apart.GetLightSet(environment, nullptr, counts[k], goOn);
    ASSERT_EQ(own->GetNumberOfLights(), counts[k]);
    ASSERT_EQ(sets[k]->GetNumberOfLights(), counts[k]);
    for (int light = 0; light < counts[k]; ++light)
    {
      SCOPED_TRACE(light);
      glm::dvec3 a, b;
      sets[k]->GetDirection(light, &a.x);
      own->GetDirection(light, &b.x);
      EXPECT_LT(glm::distance(a, b), 1e-9);
      sets[k]->GetIrradiance(light, &a.x);
      own->GetIrradiance(light, &b.x);
      EXPECT_LT(glm::distance(a, b), 1e-12);
    }
  }
  EXPECT_TRUE(apart.GetLightSets(environment, nullptr, { 5, 0 }, goOn).empty());
  EXPECT_TRUE(apart.GetLightSets(environment, nullptr, { 9, 5 }, []() { return false; }).empty());
}
