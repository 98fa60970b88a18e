// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Ashikhmin-Shirley's f of many lights at once, in single precision, in each form that the
// processor has, against f of one light in double precision.

#include "AshikhminShirleyLanes.h"
#include "HalfVector.h"
#include "LanePowers.h"
#include "LightRows.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkNew.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <random>
#include <vector>

using namespace measuredbrdf;

namespace
{
// The mirror direction, near it, and anywhere; no multiple of what is calculated at once.
struct SomeLights : LightRows
{
  explicit SomeLights(const glm::dvec3& view)
  {
    const glm::dvec3 mirror(-view.x, -view.y, view.z);
    this->Add(mirror);
    this->Add(view);
    this->Add({ 0.0, 0.0, 1.0 });
    this->Add(glm::normalize(glm::dvec3(-view.x, -view.y, 1e-5)));
    std::mt19937 engine(3);
    const auto draw = [&engine]() { return (engine() + 0.5) * 0x1p-32; };
    while (this->Directions.size() < 150)
    {
      const double z = draw();
      const double phi = 2.0 * Pi * draw();
      const glm::dvec3 any(
        std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z);
      const double share = this->Directions.size() % 3 == 0 ? 1.0 : 0.02 * draw();
      const glm::dvec3 light = glm::normalize(glm::mix(mirror, any, share));
      this->Add({ light.x, light.y, std::max(light.z, 1e-6) });
    }
    this->SetPointers();
  }
};

struct Result
{
  explicit Result(std::size_t count)
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Values[c].assign(count, -1.0f);
      this->Pointers[c] = this->Values[c].data();
    }
  }
  std::vector<float> Values[3];
  float* Pointers[3];
};
}

//------------------------------------------------------------------------------
TEST(LanePowers, AreThoseOfDoublePrecision)
{
  for (int k = 0; k <= 4000; ++k)
  {
    const float x = -0.0217f * static_cast<float>(k); // to -86.8
    float power;
    FindExp(x, power);
    EXPECT_NEAR(power, std::exp(static_cast<double>(x)), 3e-7 * std::exp(static_cast<double>(x)));
    const float number = std::exp(0.75f * x);
    float logarithm;
    FindLog(number, logarithm);
    EXPECT_NEAR(logarithm, std::log(static_cast<double>(number)), 1.5e-7 - 1.5e-7 * x);
    const double s = k / 4000.0;
    float ratio;
    FindLogCosineRatio(static_cast<float>(std::sqrt(1.0 - s)), static_cast<float>(s), ratio);
    const double expected = LogCosineRatio(s);
    EXPECT_NEAR(ratio, expected, (k < 4000 ? 2e-6 : 1e-4) * -expected) << s;
  }
  float power;
  FindExp(-1e30f, power);
  EXPECT_EQ(power, 0.0f);
}

//------------------------------------------------------------------------------
TEST(AshikhminShirleyLanes, AreTheModelInEachForm)
{
  constexpr double scale[3] = { 0.7, 1.0, 2.0 };
  constexpr double reflectance[3] = { 0.9, 0.3, 0.04 };
  constexpr double diffuse[3] = { 0.1, 0.5, 0.0 };
  double largest = 0.0;
  for (const glm::dvec2& exponents : { glm::dvec2(0.0), glm::dvec2(20.0), glm::dvec2(1000.0, 50.0),
         glm::dvec2(1e5), glm::dvec2(1e6) })
  {
    const double nu = exponents.x;
    const double nv = exponents.y;
    for (const double index : { 0.0, 1.0, 1.7 }) // 0: Schlick
    {
      vtkNew<vtkAshikhminShirleyBRDF> brdf;
      brdf->SetExponents(nu, nv);
      brdf->SetSpecularScale(scale);
      brdf->SetReflectance(reflectance);
      brdf->SetDiffuse(diffuse);
      brdf->SetIndexOfRefraction(std::max(index, 1.0));
      brdf->SetFresnelModel(
        index > 0.0 ? vtkAshikhminShirleyBRDF::DIELECTRIC : vtkAshikhminShirleyBRDF::SCHLICK);
      AshikhminShirleyLanes lanes{};
      lanes.Exponents[0] = static_cast<float>(nu);
      lanes.Exponents[1] = static_cast<float>(nv);
      lanes.Index = static_cast<float>(index);
      for (int c = 0; c < 3; ++c)
      {
        lanes.Specular[c] =
          static_cast<float>(scale[c] * std::sqrt((nu + 1.0) * (nv + 1.0)) / (8.0 * Pi));
        lanes.Fresnel[c] = static_cast<float>(reflectance[c]);
        lanes.Diffuse[c] =
          static_cast<float>(28.0 / (23.0 * Pi) * diffuse[c] * (1.0 - reflectance[c]));
      }
      for (const double theta : { 0.0, 0.4, 1.2, 1.55 })
      {
        const glm::dvec3 view(0.6 * std::sin(theta), -0.8 * std::sin(theta), std::cos(theta));
        const SomeLights lights(view);
        const std::size_t count = lights.Directions.size();
        for (int form = -1; form <= static_cast<int>(GetWidestForm()); ++form)
        {
          Result f(count);
          if (form < 0)
          {
            brdf->EvaluateLights(static_cast<int>(count), lights.Pointers, &view.x, f.Pointers);
          }
          else
          {
            lanes.EvaluateMany(static_cast<int>(count), lights.Pointers, &view.x, f.Pointers,
              static_cast<VectorForm>(form));
          }
          for (std::size_t k = 0; k < count; ++k)
          {
            const glm::dvec3& light = lights.Directions[k];
            glm::dvec3 expected;
            brdf->Evaluate(&light.x, &view.x, &expected.x);
            // An error of h counts by the exponents (so of sharp lobes only the peak is compared),
            // and more where light and view nearly cancel.
            const glm::dvec3 h = HalfVector(light, view);
            const double slope =
              (nu * std::abs(h.x) + nv * std::abs(h.y)) / std::max(h.z * h.z, 1e-3);
            const double error = (3e-6 + 2e-7 * slope) / std::min(1.0, glm::length(light + view));
            for (int c = 0; c < 3; ++c)
            {
              EXPECT_NEAR(f.Values[c][k], expected[c], error * expected[c] + 1e-12)
                << nu << " " << nv << " index " << index << " theta " << theta << " form " << form
                << " light " << k;
              largest =
                std::max(largest, std::abs(static_cast<double>(f.Values[c][k]) - expected[c]) /
                                    std::max(expected[c], 1e-4));
            }
          }
        }
      }
    }
  }
  std::printf("largest relative error: %.1e\n", largest);
}

//------------------------------------------------------------------------------
// Light and view that are opposite, on the horizon: the half vector is the normal there.
TEST(AshikhminShirleyLanes, OppositeDirections)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetExponents(100.0, 100.0);
  const glm::dvec3 view(1.0, 0.0, 1e-7);
  const float light[3] = { -1.0f, 0.0f, 1e-7f };
  const float* const from[3] = { &light[0], &light[1], &light[2] };
  Result f(1);
  brdf->EvaluateLights(1, from, &view.x, f.Pointers);
  const glm::dvec3 opposite(-1.0, 0.0, 1e-7);
  glm::dvec3 expected;
  brdf->Evaluate(&opposite.x, &view.x, &expected.x);
  EXPECT_NEAR(f.Values[0][0], expected.x, 1e-3 * expected.x);
}

//------------------------------------------------------------------------------
TEST(AshikhminShirleyLanes, NoValueIsNegativeOrNoNumber)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetExponents(1e6, 0.0);
  brdf->SetSpecularScale(-1.0, 1e300, 1.0);
  brdf->SetReflectance(1.0, 1.0, 1.0);
  const glm::dvec3 view(std::sin(1.57), 0.0, std::cos(1.57));
  const SomeLights lights(view);
  Result f(150);
  brdf->EvaluateLights(150, lights.Pointers, &view.x, f.Pointers);
  for (int c = 0; c < 3; ++c)
  {
    for (std::size_t k = 0; k < 150; ++k)
    {
      EXPECT_TRUE(std::isfinite(f.Values[c][k]) && f.Values[c][k] >= 0.0f) << c << " " << k;
    }
  }
}
