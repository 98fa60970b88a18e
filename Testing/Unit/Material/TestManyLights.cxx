// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What materials give for many lights at once, in single precision and with each kind of vectors
// that the processor has, against f of one light in double precision.

#include "HalfVector.h"
#include "LaneForms.h"
#include "LaneMath.h"
#include "SharedData.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace
{
struct LightRows
{
  // What single precision makes of it, so that both precisions see the same.
  void Add(const glm::dvec3& light)
  {
    const glm::vec3 rounded(light);
    this->Directions.emplace_back(rounded);
    for (int c = 0; c < 3; ++c)
    {
      this->Values[c].push_back(rounded[c]);
    }
  }
  // After the last one was added.
  void SetPointers()
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Pointers[c] = this->Values[c].data();
    }
  }

  std::vector<glm::dvec3> Directions;
  std::vector<float> Values[3];
  const float* Pointers[3] = { nullptr, nullptr, nullptr };
};
}

using namespace measuredbrdf;

namespace
{
// The normal, the view, the mirror direction, light that nearly cancels the view, lights near the
// mirror direction and anywhere; no multiple of what is calculated at once.
struct ManyLights : LightRows
{
  explicit ManyLights(const glm::dvec3& view)
  {
    const glm::dvec3 mirror(-view.x, -view.y, view.z);
    this->Add({ 0.0, 0.0, 1.0 });
    this->Add(view);
    this->Add(mirror);
    this->Add(glm::normalize(glm::dvec3(-view.x, -view.y, 1e-5)));
    std::mt19937 engine(3);
    const auto draw = [&engine]() { return (engine() + 0.5) * 0x1p-32; };
    while (this->Directions.size() < 150)
    {
      const double z = draw();
      const double phi = 2.0 * Pi * draw();
      const glm::dvec3 any(
        std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z);
      const double share = this->Directions.size() % 3 == 0 ? 0.02 * draw() : 1.0;
      const glm::dvec3 light = glm::normalize(glm::mix(mirror, any, share));
      this->Add({ light.x, light.y, std::max(light.z, 1e-6) });
    }
    this->SetPointers();
  }
};

// How much of f may differ, of a light and a view.
using GetError = std::function<double(const glm::dvec3& light, const glm::dvec3& view)>;

template <typename BRDF>
void ExpectSame(BRDF* brdf, const GetError& getError)
{
  for (const double theta : { 0.0, 0.4, 1.2, 1.5 })
  {
    const glm::dvec3 view(0.6 * std::sin(theta), -0.8 * std::sin(theta), std::cos(theta));
    const ManyLights lights(view);
    ForEachLaneForm(
      [&]()
      {
        for (const std::size_t count : { std::size_t(1), std::size_t(8), lights.Directions.size() })
        {
          std::vector<float> f(3 * count + 3, -1.0f); // a number behind each channel stays
          float* const to[3] = { &f[0], &f[count + 1], &f[2 * count + 2] };
          brdf->EvaluateLights(static_cast<int>(count), lights.Pointers, &view.x, to);
          for (std::size_t k = 0; k < count; ++k)
          {
            const glm::dvec3& light = lights.Directions[k];
            glm::dvec3 expected;
            brdf->Evaluate(&light.x, &view.x, &expected.x);
            for (int c = 0; c < 3; ++c)
            {
              EXPECT_NEAR(to[c][k], expected[c], getError(light, view) * expected[c] + 1e-12)
                << "theta " << theta << ", light " << k << " of " << count;
            }
          }
          for (int c = 0; c < 3; ++c)
          {
            EXPECT_EQ(to[c][count], -1.0f);
          }
        }
      });
  }
}

template <typename BRDF>
void ExpectNumbers(BRDF* brdf)
{
  const glm::dvec3 view(std::sin(1.57), 0.0, std::cos(1.57));
  const ManyLights lights(view);
  std::vector<float> f(3 * 150);
  float* const to[3] = { &f[0], &f[150], &f[300] };
  brdf->EvaluateLights(150, lights.Pointers, &view.x, to);
  for (const float value : f)
  {
    EXPECT_TRUE(std::isfinite(value) && value >= 0.0f) << value;
  }
}

// Positive, and up to so many times their neighbors.
std::vector<float> Draw(std::size_t count, double ratio, std::mt19937& engine)
{
  std::vector<float> values;
  for (std::size_t k = 0; k < count; ++k)
  {
    values.push_back(static_cast<float>(0.5 * std::pow(ratio, engine() * 0x1p-32)));
  }
  return values;
}
}

//------------------------------------------------------------------------------
TEST(LaneMath, PowersAreThoseOfDoublePrecision)
{
  for (int k = 0; k <= 4000; ++k)
  {
    const double x = -0.0217f * static_cast<float>(k); // to -86.8
    EXPECT_NEAR(FindExp(Fill(static_cast<float>(x)))[0], std::exp(x), 3e-7 * std::exp(x));
    const auto number = static_cast<float>(std::exp(0.75 * x));
    EXPECT_NEAR(
      FindLog(Fill(number))[1], std::log(static_cast<double>(number)), 1.5e-7 - 1.5e-7 * x);
    const double s = k / 4000.0;
    const Floats cosine = Fill(static_cast<float>(std::sqrt(1.0 - s)));
    EXPECT_NEAR(FindLogCosineRatio(cosine, Fill(static_cast<float>(s)))[2], LogCosineRatio(s),
      (k < 4000 ? 2e-6 : 1e-4) * -LogCosineRatio(s))
      << s;
  }
  EXPECT_EQ(FindExp(Fill(-1e30f))[0], 0.0f);
}

//------------------------------------------------------------------------------
TEST(ManyLights, OfAshikhminShirley)
{
  for (const glm::dvec2& exponents : { glm::dvec2(0.0), glm::dvec2(20.0), glm::dvec2(1000.0, 50.0),
         glm::dvec2(1e5), glm::dvec2(1e6) })
  {
    for (const double index : { 0.0, 1.0, 1.7 }) // 0: Schlick
    {
      vtkNew<vtkAshikhminShirleyBRDF> brdf;
      brdf->SetExponents(exponents.x, exponents.y);
      brdf->SetSpecularScale(0.7, 1.0, 2.0);
      brdf->SetReflectance(0.9, 0.3, 0.04);
      brdf->SetDiffuse(0.1, 0.5, 0.0);
      brdf->SetIndexOfRefraction(std::max(index, 1.0));
      brdf->SetFresnelModel(
        index > 0.0 ? vtkAshikhminShirleyBRDF::DIELECTRIC : vtkAshikhminShirleyBRDF::SCHLICK);
      ExpectSame(brdf.Get(),
        [&exponents](const glm::dvec3& light, const glm::dvec3& view)
        {
          // An error of h counts by the exponents (so of sharp lobes only the peak is compared),
          // and more where light and view nearly cancel.
          const glm::dvec3 h = HalfVector(light, view);
          const double slope =
            (exponents.x * std::abs(h.x) + exponents.y * std::abs(h.y)) / std::max(h.z * h.z, 1e-3);
          return (3e-6 + 2e-7 * slope) / std::min(1.0, glm::length(light + view));
        });
    }
  }
  vtkNew<vtkAshikhminShirleyBRDF> hostile;
  hostile->SetExponents(1e6, 0.0);
  hostile->SetSpecularScale(-1.0, 1e300, 1.0);
  hostile->SetReflectance(1.0, 1.0, 1.0);
  ExpectNumbers(hostile.Get());
}

//------------------------------------------------------------------------------
// Light and view that are opposite, on the horizon: the half vector is the normal there.
TEST(ManyLights, OppositeDirections)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetExponents(100.0, 100.0);
  const glm::dvec3 view(1.0, 0.0, 1e-7);
  const glm::dvec3 opposite(-1.0, 0.0, 1e-7);
  LightRows lights;
  lights.Add(opposite);
  lights.SetPointers();
  float f[3];
  float* const to[3] = { &f[0], &f[1], &f[2] };
  brdf->EvaluateLights(1, lights.Pointers, &view.x, to);
  glm::dvec3 expected;
  brdf->Evaluate(&opposite.x, &view.x, &expected.x);
  EXPECT_NEAR(f[0], expected.x, 1e-3 * expected.x);
}

//------------------------------------------------------------------------------
TEST(ManyLights, OfTables)
{
  std::mt19937 engine(5);
  const int sizes[][3] = { { 9, 7, 5 }, { 24, 12, 10 }, { 1, 1, 1 }, { 2, 1, 3 } };
  for (const auto& size : sizes)
  {
    for (int kind = 0; kind < 16; ++kind)
    {
      const bool isHalf = kind % 2 == 0;
      std::vector<float> volume =
        Draw(static_cast<std::size_t>(3 * size[0] * size[1] * size[2]), 3.0, engine);
      for (std::size_t k = 0; k < volume.size() && kind >= 8; k += 21) // invalid cells: one by one
      {
        volume[k] = std::numeric_limits<float>::quiet_NaN();
      }
      vtkNew<vtkTabulatedBRDF> brdf;
      ASSERT_TRUE(brdf->SetVolume(
        isHalf ? vtkTabulatedBRDF::HALF_DIFFERENCE : vtkTabulatedBRDF::INCIDENT_OUTGOING,
        kind / 2 % 2 == 0 ? vtkTabulatedBRDF::HALF_TURN : vtkTabulatedBRDF::FULL_TURN, size,
        volume));
      brdf->SetCosineWeighted(kind / 4 % 2 == 1);
      ExpectSame(brdf.Get(),
        [isHalf](const glm::dvec3& light, const glm::dvec3& view)
        {
          // Where the half vector is the normal or the light, azimuths are any.
          const glm::dvec3 h = glm::normalize(light + view);
          const bool isAny =
            isHalf ? std::hypot(h.x, h.y) < 1e-3 || glm::length(h - light) < 1e-3
                   : std::hypot(light.x, light.y) < 1e-6 || std::hypot(view.x, view.y) < 1e-6;
          return isAny ? 2.0 : 2e-4 / std::min(1.0, glm::length(light + view));
        });
    }
  }
  vtkNew<vtkTabulatedBRDF> negative;
  std::vector<float> rgb(36, -1.0f);
  rgb[1] = std::numeric_limits<float>::max();
  const int dimensions[3] = { 3, 2, 2 };
  ASSERT_TRUE(negative->SetVolume(
    vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::HALF_TURN, dimensions, rgb));
  negative->SetCosineWeighted(true);
  ExpectNumbers(negative.Get());
}

//------------------------------------------------------------------------------
// Other sizes for each table, so that one is not taken for another.
TEST(ManyLights, OfAdaptiveWarps)
{
  std::mt19937 engine(5);
  const auto make = [&engine](const std::vector<int>& shape)
  {
    std::size_t count = 1;
    for (const int n : shape)
    {
      count *= static_cast<std::size_t>(n);
    }
    return vtkAdaptiveWarpBRDF::Table{ shape, Draw(count, 10.0, engine) };
  };
  for (const std::vector<float>& thetas :
    { std::vector<float>{ 0.0f, 0.1f, 0.5f, 1.2f, 1.5f }, std::vector<float>{ 0.7f } })
  {
    for (const bool jacobian : { false, true })
    {
      const auto slices = static_cast<int>(thetas.size());
      vtkAdaptiveWarpBRDF::Tables tables;
      tables.ThetaI = thetas;
      tables.PhiI = { 0.0f };
      tables.Jacobian = jacobian;
      tables.Ndf = make({ 3, 9 });
      tables.Sigma = make({ 2, 13 });
      std::copy_n(tables.Sigma.Values.begin(), 13, tables.Sigma.Values.begin() + 13);
      tables.Vndf = make({ 1, slices, 11, 17 });
      tables.Luminance = make({ 1, slices, 6, 6 });
      tables.Rgb = make({ 1, slices, 3, 5, 7 });
      vtkNew<vtkAdaptiveWarpBRDF> brdf;
      ASSERT_EQ(brdf->SetTables(tables), "");
      ExpectSame(brdf.Get(),
        [](const glm::dvec3& light, const glm::dvec3& view)
        {
          const glm::dvec3 h = HalfVector(light, view);
          const bool isAny =
            std::hypot(h.x, h.y) < 1e-3 || (std::hypot(light.x, light.y) < 1e-3 && light.z < 1.0);
          return isAny ? 10.0 : 4e-4 / std::min(1.0, glm::length(light + view));
        });
    }
  }
}

//------------------------------------------------------------------------------
TEST(ManyLights, OfAMeasuredMaterial)
{
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(SharedData + "/materials/rgl/chm_light_blue_rgb.bsdf");
  if (!std::ifstream(reader->GetFileName()).good())
  {
    GTEST_SKIP() << "no measured data at " << SharedData;
  }
  ASSERT_TRUE(reader->Read());
  auto* brdf = vtkAdaptiveWarpBRDF::SafeDownCast(reader->GetBRDF());
  ASSERT_TRUE(brdf);
  ExpectSame(brdf,
    [](const glm::dvec3& light, const glm::dvec3& view)
    {
      // Where h is nearly the normal, its azimuth is any; its elevation counts by the lobe's slope.
      const glm::dvec3 h = HalfVector(light, view);
      return (std::hypot(h.x, h.y) > 1e-4 ? 5e-4 : 0.1) / std::min(1.0, glm::length(light + view));
    });
}
