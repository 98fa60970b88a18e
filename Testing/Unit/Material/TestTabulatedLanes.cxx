// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A tabulated volume looked up for many lights at once, in single precision, in each form that the
// processor has, against vtkTabulatedBRDF's f of one light.

#include "LightRows.h"
#include "TabulatedLanes.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr double Turn = 6.283185307179586;

// Positive, and different in each cell: up to 3 times its neighbors.
std::vector<float> DrawVolume(const int dimensions[3], std::mt19937& engine)
{
  std::vector<float> rgb(
    static_cast<std::size_t>(3 * dimensions[0] * dimensions[1] * dimensions[2]));
  for (float& value : rgb)
  {
    value = 0.5f + static_cast<float>(engine() * 0x1p-32);
  }
  return rgb;
}

// 61 lights: no multiple of the numbers that are calculated at once.
struct ManyLights : LightRows
{
  explicit ManyLights(const glm::dvec3& view)
  {
    this->Add({ 0.0, 0.0, 1.0 });
    this->Add(view);
    this->Add({ -view.x, -view.y, view.z });
    this->Add(glm::normalize(glm::dvec3(-view.x, -view.y, 1e-6)));
    std::mt19937 engine(3);
    while (this->Directions.size() < 61)
    {
      const double z = (engine() + 0.5) * 0x1p-32;
      const double phi = Turn * engine() * 0x1p-32;
      const double s = std::sqrt(1.0 - z * z);
      this->Add({ s * std::cos(phi), s * std::sin(phi), z });
    }
    this->SetPointers();
  }
};
}

//------------------------------------------------------------------------------
TEST(TabulatedLanes, AreTheTableInEachForm)
{
  std::mt19937 engine(5);
  const int sizes[][3] = { { 9, 7, 5 }, { 24, 12, 10 }, { 1, 1, 1 }, { 2, 1, 3 } };
  for (const auto& dimensions : sizes)
  {
    for (int kind = 0; kind < 8; ++kind)
    {
      const bool half = kind % 2 == 0;
      const bool halfTurn = kind / 2 % 2 == 0;
      const bool weighted = kind / 4 == 1;
      vtkNew<vtkTabulatedBRDF> brdf;
      ASSERT_TRUE(brdf->SetVolume(
        half ? vtkTabulatedBRDF::HALF_DIFFERENCE : vtkTabulatedBRDF::INCIDENT_OUTGOING,
        halfTurn ? vtkTabulatedBRDF::HALF_TURN : vtkTabulatedBRDF::FULL_TURN, dimensions,
        DrawVolume(dimensions, engine)));
      brdf->SetCosineWeighted(weighted);
      const TabulatedLanes lanes{ brdf->GetVolume(), dimensions, half, halfTurn, weighted };
      for (const double theta : { 0.0, 0.4, 1.2, 1.5 })
      {
        const glm::dvec3 view(0.6 * std::sin(theta), -0.8 * std::sin(theta), std::cos(theta));
        const ManyLights lights(view);
        for (int form = 0; form <= static_cast<int>(GetWidestForm()); ++form)
        {
          for (const int count : { 1, 8, 61 })
          {
            float f[3][TabulatedLanes::Most];
            float* const to[3] = { f[0], f[1], f[2] };
            lanes.Evaluate(count, lights.Pointers, &view.x, to, static_cast<VectorForm>(form));
            for (int k = 0; k < count; ++k)
            {
              const glm::dvec3& light = lights.Directions[static_cast<std::size_t>(k)];
              glm::dvec3 expected;
              brdf->Evaluate(&light.x, &view.x, &expected.x);
              // Where the half vector is the normal or the light, azimuths are any.
              const glm::dvec3 h = glm::normalize(light + view);
              const bool isAny =
                half ? std::hypot(h.x, h.y) < 1e-3 || glm::length(h - light) < 1e-3
                     : std::hypot(light.x, light.y) < 1e-6 || std::hypot(view.x, view.y) < 1e-6;
              const double error = isAny ? 2.0 : 2e-4 / std::min(1.0, glm::length(light + view));
              for (int c = 0; c < 3; ++c)
              {
                EXPECT_NEAR(f[c][k], expected[c], error * expected[c])
                  << "kind " << kind << " form " << form << " theta " << theta << " light " << k
                  << " of " << count << ", " << dimensions[0] << " samples";
              }
            }
          }
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(TabulatedLanes, NoValueIsNegativeOrNoNumber)
{
  const int dimensions[3] = { 3, 2, 2 };
  vtkNew<vtkTabulatedBRDF> brdf;
  std::vector<float> rgb(36, -1.0f);
  rgb[1] = std::numeric_limits<float>::max();
  ASSERT_TRUE(brdf->SetVolume(
    vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::HALF_TURN, dimensions, rgb));
  brdf->SetCosineWeighted(true);
  const glm::dvec3 view(std::sin(1.5), 0.0, std::cos(1.5));
  const ManyLights lights(view);
  float f[3][TabulatedLanes::Most];
  float* const to[3] = { f[0], f[1], f[2] };
  brdf->EvaluateLights(61, lights.Pointers, &view.x, to);
  for (int c = 0; c < 3; ++c)
  {
    for (int k = 0; k < 61; ++k)
    {
      EXPECT_TRUE(std::isfinite(f[c][k]) && f[c][k] >= 0.0f) << c << " " << k << " " << f[c][k];
    }
  }
}

//------------------------------------------------------------------------------
// More lights than are evaluated at once; and with invalid cells, which are left out.
TEST(TabulatedLanes, ManyLightsAreEvaluatedAsOneByOne)
{
  const int dimensions[3] = { 12, 9, 8 };
  std::mt19937 engine(7);
  std::vector<float> rgb = DrawVolume(dimensions, engine);
  for (const bool isValid : { true, false })
  {
    for (std::size_t k = 0; k < rgb.size() && !isValid; k += 21)
    {
      rgb[k] = std::numeric_limits<float>::quiet_NaN();
    }
    vtkNew<vtkTabulatedBRDF> brdf;
    ASSERT_TRUE(brdf->SetVolume(
      vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, rgb));
    const glm::dvec3 view = glm::normalize(glm::dvec3(0.5, 0.2, 0.7));
    const ManyLights some(view);
    std::vector<float> lights[3], f[3];
    const float* from[3];
    float* to[3];
    for (int c = 0; c < 3; ++c)
    {
      for (int round = 0; round < 3; ++round)
      {
        lights[c].insert(lights[c].end(), some.Values[c].begin() + 2, some.Values[c].end());
      }
      f[c].resize(lights[c].size());
      from[c] = lights[c].data();
      to[c] = f[c].data();
    }
    brdf->EvaluateLights(static_cast<int>(lights[0].size()), from, &view.x, to);
    for (std::size_t k = 0; k < lights[0].size(); ++k)
    {
      const glm::dvec3 light(lights[0][k], lights[1][k], lights[2][k]);
      glm::dvec3 expected;
      brdf->Evaluate(&light.x, &view.x, &expected.x);
      const glm::dvec3 h = glm::normalize(light + view);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(f[c][k], expected[c], (std::hypot(h.x, h.y) < 1e-3 ? 2.0 : 2e-4) * expected[c])
          << k;
      }
    }
  }
}
