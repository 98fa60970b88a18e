// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What is made of an environment once: its harmonics, its pyramid.

#include "EnvironmentHarmonics.h"
#include "EnvironmentPyramid.h"
#include "HalfVector.h" // for Pi
#include "WignerD.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <random>
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

// a_lm by its definition, texel by texel.
std::complex<double> SumTexels(vtkEnvironment* environment, int channel, int l, int m)
{
  const WignerD function(m, 0, l);
  std::vector<double> d(static_cast<std::size_t>(l) + 1);
  std::complex<double> sum = 0.0;
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      double rgb[3], direction[3];
      environment->GetPixel(x, y, rgb);
      environment->GetTexelDirection(x, y, direction);
      if (x == 0)
      {
        function.Evaluate(std::acos(direction[1]), d.data());
      }
      const double azimuth = std::atan2(direction[0], direction[2]);
      sum += environment->GetTexelSolidAngle(y) * rgb[channel] *
             d[static_cast<std::size_t>(l - function.GetFirst())] * std::polar(1.0, -m * azimuth);
    }
  }
  return sum * std::sqrt((2.0 * l + 1.0) / (4.0 * Pi));
}
} // namespace

//------------------------------------------------------------------------------
// Any width: powers of two, primes, less columns than orders.
TEST(EnvironmentHarmonics, AreTheSumOverTexels)
{
  for (const std::array<int, 2>& size : { std::array<int, 2>{ 128, 64 },
         std::array<int, 2>{ 131, 67 }, std::array<int, 2>{ 254, 64 }, std::array<int, 2>{ 1, 2 } })
  {
    const auto environment = NewNoise(size[0], size[1]);
    vtkEnvironment* summed = environment->GetSubdivided();
    for (const int degree : { 1, 9, 150 })
    {
      const EnvironmentHarmonics harmonics(environment, degree);
      for (const std::array<int, 2>& lm :
        { std::array<int, 2>{ 0, 0 }, std::array<int, 2>{ 1, 1 }, std::array<int, 2>{ 9, 4 },
          std::array<int, 2>{ 150, 0 }, std::array<int, 2>{ 150, 149 } })
      {
        for (int channel = 0; channel < 3 && lm[0] <= degree; ++channel)
        {
          const auto expected = SumTexels(summed, channel, lm[0], lm[1]);
          EXPECT_LT(std::abs(harmonics.Get(channel, lm[0], lm[1]) - expected), 1e-11)
            << size[0] << " wide, l " << lm[0] << ", m " << lm[1];
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
  const EnvironmentPyramid pyramid(environment, 0, 1.0);
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
