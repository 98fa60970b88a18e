// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "RandomLight.h"
#include "SpherePairs.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <random>
#include <set>
#include <utility>
#include <vector>

using measuredbrdf::Pi;

namespace
{
using Region = std::array<int, 4>;

// Black but for one texel.
void SetSingle(vtkEnvironment* environment, int width, int height, int x, int y,
  const glm::vec3& color, float background = 0.0f)
{
  std::vector<float> rgb(3 * std::size_t(width) * height, background);
  std::copy_n(&color.x, 3, &rgb[3 * (std::size_t(y) * width + x)]);
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
}

// Of an environment or of lights.
template <typename Object>
glm::dvec3 GetTotal(Object* object)
{
  glm::dvec3 total;
  object->GetTotal(&total.x);
  return total;
}

double GetLuminance(const glm::dvec3& rgb) { return vtkEnvironment::GetLuminance(&rgb.x); }

template <typename Object>
double GetTotalLuminance(Object* object)
{
  return GetLuminance(GetTotal(object));
}

glm::dvec3 GetDirection(vtkLightSet* lights, int index)
{
  glm::dvec3 d;
  lights->GetDirection(index, &d.x);
  return d;
}

glm::dvec3 GetIrradiance(vtkLightSet* lights, int index)
{
  glm::dvec3 irradiance;
  lights->GetIrradiance(index, &irradiance.x);
  return irradiance;
}

Region GetRegion(vtkLightSet* lights, int index)
{
  Region region;
  EXPECT_TRUE(lights->GetRegion(index, region.data()));
  return region;
}

std::set<Region> GetRegions(vtkLightSet* lights)
{
  std::set<Region> all;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    all.insert(GetRegion(lights, k));
  }
  return all;
}

// Sum of luminance x |direction - centroid|^2 over a region, by the definition: two passes, no
// difference of near numbers.
double GetVariance(vtkEnvironment* environment, const Region& r)
{
  environment = environment->GetSubdivided();
  double energy = 0.0;
  glm::dvec3 sum(0.0);
  std::vector<std::pair<double, glm::dvec3>> texels;
  for (int y = r[1]; y < r[3]; ++y)
  {
    for (int x = r[0]; x < r[2]; ++x)
    {
      glm::dvec3 rgb, d;
      environment->GetPixel(x, y, &rgb.x);
      environment->GetTexelDirection(x, y, &d.x);
      const double w = GetLuminance(rgb) * environment->GetTexelSolidAngle(y);
      energy += w;
      sum += w * d;
      texels.emplace_back(w, d);
    }
  }
  const glm::dvec3 centroid = energy > 0.0 ? sum / energy : glm::dvec3(0.0);
  double variance = 0.0;
  for (const auto& [w, d] : texels)
  {
    variance += w * glm::dot(d - centroid, d - centroid);
  }
  return variance;
}

double GetResidual(vtkEnvironment* environment, vtkLightSet* lights)
{
  double sum = 0.0;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    sum += GetVariance(environment, GetRegion(lights, k));
  }
  return sum / GetTotalLuminance(environment);
}

// All light, in regions that tile the map.
void ExpectSane(vtkEnvironment* environment, vtkLightSet* lights)
{
  const glm::dvec3 total = GetTotal(environment);
  EXPECT_LT(glm::length(GetTotal(lights) - total), 1e-12 * glm::length(total));
  environment = environment->GetSubdivided();
  std::vector<int> cover(std::size_t(environment->GetWidth()) * environment->GetHeight(), 0);
  double solidAngle = 0.0;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    EXPECT_NEAR(glm::length(GetDirection(lights, k)), 1.0, 1e-14);
    EXPECT_TRUE(std::isfinite(lights->GetConcentration(k)));
    EXPECT_GE(lights->GetConcentration(k), 0.0);
    EXPECT_GT(lights->GetSolidAngle(k), 0.0);
    solidAngle += lights->GetSolidAngle(k);
    const Region r = GetRegion(lights, k);
    for (int y = r[1]; y < r[3]; ++y)
    {
      for (int x = r[0]; x < r[2]; ++x)
      {
        ++cover[std::size_t(y) * environment->GetWidth() + x];
      }
    }
  }
  EXPECT_EQ(std::count(cover.begin(), cover.end(), 1), std::ptrdiff_t(cover.size()));
  EXPECT_NEAR(solidAngle, 4.0 * Pi, 1e-11);
}

SpherePairs MakePairs()
{
  SpherePairs pairs;
  pairs.AddRandom(60, 3);
  return pairs;
}

// Of green, against the exact sum.
struct Errors
{
  double RMS;    // of the difference, relative to the RMS of the exact values
  double Median; // of the relative differences
};

Errors Compare(
  const std::vector<glm::dvec3>& exact, vtkRadianceIntegrator* integrator, const SpherePairs& pairs)
{
  const std::vector<glm::dvec3> radiance = pairs.Integrate(integrator);
  double squares = 0.0;
  double sum = 0.0;
  std::vector<double> relative;
  for (std::size_t k = 0; k < exact.size(); ++k)
  {
    const double difference = radiance[k].y - exact[k].y;
    squares += difference * difference;
    sum += exact[k].y * exact[k].y;
    relative.push_back(std::abs(difference) / exact[k].y);
  }
  std::nth_element(
    relative.begin(), relative.begin() + std::ptrdiff_t(relative.size() / 2), relative.end());
  return { std::sqrt(squares / sum), relative[relative.size() / 2] };
}

std::vector<vtkSmartPointer<vtkLightSetGenerator>> MakeGenerators()
{
  std::vector<vtkSmartPointer<vtkLightSetGenerator>> generators(3);
  for (int method = 0; method < 3; ++method)
  {
    generators[method] = vtkSmartPointer<vtkLightSetGenerator>::New();
    generators[method]->SetMethod(method);
  }
  return generators;
}

bool IsRandom(vtkLightSetGenerator* generator)
{
  return generator->GetMethod() == vtkLightSetGenerator::IMPORTANCE;
}
} // namespace

//------------------------------------------------------------------------------
TEST(LightSet, AddsAndRefuses)
{
  vtkNew<vtkLightSet> lights;
  ErrorCatcher errors(lights);
  const double direction[3] = { 0.0, 3.0, 4.0 };
  const double irradiance[3] = { 1.0, 2.0, 3.0 };
  EXPECT_TRUE(lights->AddLight(direction, irradiance, 0.5));
  lights->SetLastRegion(1, 2, 3, 4);
  EXPECT_TRUE(lights->AddLight(direction, irradiance));
  EXPECT_LT(glm::distance(GetDirection(lights, 0), glm::dvec3(0.0, 0.6, 0.8)), 1e-15);
  EXPECT_EQ(lights->GetSolidAngle(0), 0.5);
  EXPECT_EQ(GetRegion(lights, 0), (Region{ 1, 2, 3, 4 }));
  int region[4];
  EXPECT_FALSE(lights->GetRegion(1, region));
  EXPECT_EQ(errors.Take(), 0);

  const double zero[3] = { 0.0, 0.0, 0.0 };
  const double nan[3] = { std::nan(""), 0.0, 1.0 };
  const double negative[3] = { 1.0, -1e-9, 0.0 };
  EXPECT_FALSE(lights->AddLight(zero, irradiance));
  EXPECT_FALSE(lights->AddLight(nan, irradiance));
  EXPECT_FALSE(lights->AddLight(direction, negative));
  EXPECT_FALSE(lights->AddLight(direction, nan));
  EXPECT_EQ(errors.Take(), 4);
  EXPECT_FALSE(lights->AddLight(direction, irradiance, 0.1, -1.0));
  EXPECT_FALSE(lights->AddLight(direction, irradiance, 0.1, std::nan("")));
  EXPECT_EQ(errors.Take(), 2);
  EXPECT_EQ(lights->GetNumberOfLights(), 2);
  EXPECT_EQ(GetTotal(lights.Get()), glm::dvec3(2.0, 4.0, 6.0));
  EXPECT_EQ(GetIrradiance(lights, 2), glm::dvec3(0.0)); // outside
  lights->RemoveAllLights();
  EXPECT_EQ(lights->GetNumberOfLights(), 0);
}

//------------------------------------------------------------------------------
TEST(Generators, RefuseBadArguments)
{
  vtkNew<vtkEnvironment> empty;
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 8, 4);
  vtkNew<vtkLightSet> lights;
  for (const auto& generator : MakeGenerators())
  {
    ASSERT_TRUE(generator->Generate(environment, 4, lights));
    ErrorCatcher errors(generator);
    generator->SetMethod(3);
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_FALSE(generator->Generate(nullptr, 4, lights));
    EXPECT_FALSE(generator->Generate(empty, 4, lights));
    EXPECT_FALSE(generator->Generate(environment, 4, nullptr));
    for (const int count : { 0, -4, 2 * vtkLightSetGenerator::MaximumNumberOfLights })
    {
      EXPECT_FALSE(generator->Generate(environment, count, lights));
    }
    EXPECT_EQ(errors.Take(), 6);
    EXPECT_EQ(lights->GetNumberOfLights(), 4);
    if (generator->GetMethod() == vtkLightSetGenerator::MEDIAN_CUT)
    {
      EXPECT_FALSE(generator->Generate(environment, 100, lights));
      EXPECT_EQ(errors.Take(), 1);
      EXPECT_NE(errors.GetText().find("power of two"), std::string::npos);
    }
    else
    {
      EXPECT_TRUE(generator->Generate(environment, 100, lights));
      EXPECT_EQ(lights->GetNumberOfLights(), 100);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Generators, KeepTheEnergy)
{
  vtkNew<vtkLightSet> lights;
  const int sizes[][2] = { { 1, 1 }, { 1, 7 }, { 9, 1 }, { 33, 17 }, { 128, 64 } };
  for (const auto& size : sizes)
  {
    vtkNew<vtkEnvironment> environment;
    SetRandom(environment, size[0], size[1]);
    for (const auto& generator : MakeGenerators())
    {
      for (int count : { 1, 16, 256, 1024 })
      {
        ASSERT_TRUE(generator->Generate(environment, count, lights));
        EXPECT_LE(lights->GetNumberOfLights(), count);
        const double expected = GetTotalLuminance(environment.Get());
        EXPECT_NEAR(GetTotalLuminance(lights.Get()), expected, 1e-11 * expected);
        if (!IsRandom(generator))
        {
          ExpectSane(environment, lights);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(Generators, SingleBrightTexel)
{
  const int width = 128;
  const int height = 64;
  vtkNew<vtkEnvironment> environment;
  SetSingle(environment, width, height, 5, 11, { 3.0, 2.0, 1.0 });
  glm::dvec3 center;
  environment->GetTexelDirection(5, 11, &center.x);
  vtkNew<vtkLightSet> lights;
  for (const auto& generator : MakeGenerators())
  {
    ASSERT_TRUE(generator->Generate(environment, 64, lights));
    ASSERT_EQ(lights->GetNumberOfLights(), IsRandom(generator) ? 64 : 1);
    double solidAngle = 0.0;
    for (int k = 0; k < lights->GetNumberOfLights(); ++k)
    {
      const glm::dvec3 d = GetDirection(lights, k);
      double u, v;
      vtkEnvironment::GetCoordinates(&d.x, u, v);
      EXPECT_EQ(static_cast<int>(u * width), 5);
      EXPECT_EQ(static_cast<int>(v * height), 11);
      EXPECT_TRUE(IsRandom(generator) || glm::distance(d, center) < 1e-14);
      solidAngle += lights->GetSolidAngle(k);
    }
    const double texel = environment->GetTexelSolidAngle(11);
    EXPECT_TRUE(!IsRandom(generator) || std::abs(solidAngle - texel) < 1e-14);
    EXPECT_LT(glm::distance(GetTotal(lights.Get()), texel * glm::dvec3(3.0, 2.0, 1.0)), 2e-14);
  }
}

//------------------------------------------------------------------------------
// Black maps give no lights. A light a texel at most, but large texels are areas.
TEST(Generators, OfUniformMaps)
{
  vtkNew<vtkEnvironment> environment;
  vtkNew<vtkLightSet> lights;
  for (const auto& generator : MakeGenerators())
  {
    ASSERT_TRUE(environment->SetPixels(8, 4, std::vector<float>(96, 0.0f)));
    EXPECT_TRUE(generator->Generate(environment, 64, lights));
    EXPECT_EQ(lights->GetNumberOfLights(), 0);
    ASSERT_TRUE(environment->SetPixels(8, 4, std::vector<float>(96, 1.0f)));
    ASSERT_TRUE(generator->Generate(environment, 64, lights));
    EXPECT_EQ(lights->GetNumberOfLights(), 64);
    ASSERT_TRUE(environment->SetPixels(128, 64, std::vector<float>(3 * 128 * 64, 1.0f)));
    ASSERT_TRUE(generator->Generate(environment, 1 << 17, lights));
    EXPECT_EQ(lights->GetNumberOfLights(), IsRandom(generator) ? 1 << 17 : 8192);
  }
}

//------------------------------------------------------------------------------
TEST(MedianCut, HalvesAreBalanced)
{
  // Smooth energy: every region's share differs from 1/N by a texel row or column per cut.
  const int width = 512;
  const int height = 256;
  std::vector<float> rgb;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const float value = 2.0f + std::sin(0.03f * x) * std::cos(0.05f * y);
      rgb.insert(rgb.end(), { value, value, value });
    }
  }
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
  vtkNew<vtkLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 64, lights));
  ASSERT_EQ(lights->GetNumberOfLights(), 64);
  const double share = GetTotalLuminance(environment.Get()) / 64;
  for (int k = 0; k < 64; ++k)
  {
    const double own = GetLuminance(GetIrradiance(lights, k));
    EXPECT_NEAR(own, share, 0.06 * share);
  }
}

//------------------------------------------------------------------------------
TEST(MedianCut, PolarRegionsAreCutInLatitude)
{
  // Constant map, 8 regions: halves, quarters in x (pi x pi -> pi/2 x pi), then each
  // quarter is higher than wide: cut in y at the equator.
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetPixels(128, 64, std::vector<float>(128 * 64 * 3, 1.0f)));
  vtkNew<vtkLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 8, lights));
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    // On directions: the octant's centroid has latitude atan(1/sqrt 2), not 45 degrees.
    const glm::dvec3 d = GetDirection(lights, k);
    double u, v;
    vtkEnvironment::GetCoordinates(&d.x, u, v);
    EXPECT_NEAR(std::remainder(u - 0.125, 0.25), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(v - 0.5) * Pi, std::atan(std::sqrt(0.5)), 2e-3);
  }
  // Octants are pi/2 x pi/2, but narrower by the cosine of 45 degrees: cut in y, where the sine of
  // the latitude is nearest to 1/2 (10 rows of 2.8 degrees: 0.471; 11 rows: 0.514).
  ASSERT_TRUE(generator->Generate(environment, 16, lights));
  std::set<Region> expected;
  for (int x = 0; x < 128; x += 32)
  {
    expected.insert({ { x, 0, x + 32, 21 }, { x, 21, x + 32, 32 }, { x, 32, x + 32, 43 },
      { x, 43, x + 32, 64 } });
  }
  EXPECT_EQ(GetRegions(lights), expected);
}

//------------------------------------------------------------------------------
TEST(Importance, SameOnEveryMachine)
{
  // Two halves, 1:3 in luminance x solid angle: std::mt19937's first outputs are fixed by the
  // standard (seed 1: 1791095845, 4282876139, ...), so the lights are too.
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb;
  for (int k = 0; k < 3 * 128 * 64; ++k)
  {
    rgb.push_back(k % (3 * 128) < 3 * 64 ? 1.0f : 3.0f);
  }
  ASSERT_TRUE(environment->SetPixels(128, 64, rgb));
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethodToImportance();
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 1, lights));
  const double shift = 1791095845.0 / 4294967296.0;
  const double jitter = 4282876139.0 / 4294967296.0;
  const glm::dvec3 d = GetDirection(lights, 0);
  double u, v;
  vtkEnvironment::GetCoordinates(&d.x, u, v);
  EXPECT_NEAR(u, 0.5 + 0.5 * (shift - 0.25) / 0.75, 1e-12);
  EXPECT_NEAR(d.y, 2.0 * jitter - 1.0, 1e-12);
  generator->SetSeed(2);
  ASSERT_TRUE(generator->Generate(environment, 1, lights));
  EXPECT_GT(glm::distance(GetDirection(lights, 0), d), 0.01);
}

//------------------------------------------------------------------------------
TEST(Importance, Unbiased)
{
  // First moments of every channel, over many seeds, against the sum over texels.
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 24, 12, 9);
  vtkEnvironment* texels = environment->GetSubdivided();
  glm::dmat3 expected(0.0);
  for (int k = 0; k < texels->GetWidth() * texels->GetHeight(); ++k)
  {
    const int x = k % texels->GetWidth(), y = k / texels->GetWidth();
    glm::dvec3 direction, rgb;
    texels->GetTexelDirection(x, y, &direction.x);
    texels->GetPixel(x, y, &rgb.x);
    expected += texels->GetTexelSolidAngle(y) * glm::outerProduct(direction, rgb);
  }
  constexpr int runs = 1500;
  glm::dmat3 sum(0.0), squares(0.0);
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethodToImportance();
  vtkNew<vtkLightSet> lights;
  for (int run = 0; run < runs; ++run)
  {
    generator->SetSeed(static_cast<unsigned int>(100 + run));
    ASSERT_TRUE(generator->Generate(environment, 16, lights));
    glm::dmat3 estimate(0.0);
    for (int k = 0; k < lights->GetNumberOfLights(); ++k)
    {
      estimate += glm::outerProduct(GetDirection(lights, k), GetIrradiance(lights, k));
    }
    sum += estimate;
    squares += glm::matrixCompMult(estimate, estimate);
  }
  for (int k = 0; k < 9; ++k)
  {
    const double mean = sum[k / 3][k % 3] / runs;
    const double error = std::sqrt((squares[k / 3][k % 3] / runs - mean * mean) / runs);
    EXPECT_NEAR(mean, expected[k / 3][k % 3], 5.0 * error) << "moment " << k;
    EXPECT_GT(error, 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(LightConcentration, FromVariance)
{
  // Of a von Mises-Fisher distribution itself: r = coth(kappa) - 1/kappa, v = 1 - r^2. The closed
  // form is within 4 % of the exact inverse (Banerjee et al. 2005).
  for (double kappa : { 0.5, 2.0, 10.0, 1e3, 1e6 })
  {
    const double r = 1.0 / std::tanh(kappa) - 1.0 / kappa;
    const double v = (1.0 - r) * (1.0 + r);
    EXPECT_NEAR(vtkLightSet::GetConcentrationOfVariance(v), kappa, 0.04 * kappa);
  }
  EXPECT_EQ(vtkLightSet::GetConcentrationOfVariance(0.0), 0.0);
  EXPECT_NEAR(vtkLightSet::GetConcentrationOfVariance(1.0), 3e-3, 1e-8); // all around, not Dirac
}

//------------------------------------------------------------------------------
TEST(Variance, ClosedFormIsTheDefinition)
{
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethodToVariance();
  vtkNew<vtkLightSet> lights;
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 64, 32);
  for (int count : { 1, 2, 64, 1000 })
  {
    ASSERT_TRUE(generator->Generate(environment, count, lights));
    ASSERT_EQ(lights->GetNumberOfLights(), count);
    for (int k = 0; k < count; ++k)
    {
      const double v =
        GetVariance(environment, GetRegion(lights, k)) / GetLuminance(GetIrradiance(lights, k));
      // One texel: Dirac.
      const double kappa = v < 1e-20 ? 0.0 : vtkLightSet::GetConcentrationOfVariance(v);
      // V/E = 2/kappa comes from a difference of numbers near 1.
      EXPECT_NEAR(lights->GetConcentration(k), kappa, kappa * (1e-8 + 1e-15 * kappa));
    }
    ExpectSane(environment, lights);
  }
}

//------------------------------------------------------------------------------
TEST(Variance, FirstCutIsTheBestOne)
{
  const int width = 128;
  const int height = 64;
  vtkNew<vtkEnvironment> environment;
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethodToVariance();
  vtkNew<vtkLightSet> lights;
  for (unsigned int trial = 0; trial < 6; ++trial)
  {
    SetRandom(environment, width, height, trial);
    double best = 1e30;
    Region expected = {};
    for (int cut = 1; cut < width + height; ++cut)
    {
      const bool inX = cut < width;
      const Region first = inX ? Region{ 0, 0, cut, height } : Region{ 0, 0, width, cut - width };
      const Region second =
        inX ? Region{ cut, 0, width, height } : Region{ 0, cut - width, width, height };
      const double cost = GetVariance(environment, first) + GetVariance(environment, second);
      if (cut != width && cost < best)
      {
        best = cost;
        expected = first;
      }
    }
    ASSERT_TRUE(generator->Generate(environment, 2, lights));
    EXPECT_EQ(GetRegion(lights, 0), expected);
  }
}

//------------------------------------------------------------------------------
TEST(Variance, SetsAreNestedAndFollowThePixelsNotTheRotation)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 64, 32);
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethodToVariance();
  vtkNew<vtkLightSet> lights;
  std::set<Region> last;
  double residual = 2.0;
  for (int count = 1; count < 100; ++count)
  {
    ASSERT_TRUE(generator->Generate(environment, count, lights));
    const auto now = GetRegions(lights);
    std::vector<Region> gone, come;
    std::set_difference(last.begin(), last.end(), now.begin(), now.end(), std::back_inserter(gone));
    std::set_difference(now.begin(), now.end(), last.begin(), last.end(), std::back_inserter(come));
    if (count > 1)
    {
      EXPECT_EQ(gone.size(), 1u);
      EXPECT_EQ(come.size(), 2u);
    }
    EXPECT_LT(GetResidual(environment, lights), residual);
    residual = GetResidual(environment, lights);
    last = now;
  }
  environment->SetRotationY(33.0);
  ASSERT_TRUE(generator->Generate(environment, 99, lights));
  EXPECT_EQ(GetRegions(lights), last);
  SetRandom(environment, 64, 32, 2);
  ASSERT_TRUE(generator->Generate(environment, 99, lights));
  EXPECT_NE(GetRegions(lights), last);
}

//------------------------------------------------------------------------------
// A sun of the sunrise's radiance before a dim sky is split off, however little area it has.
TEST(Variance, FindsTheSun)
{
  vtkNew<vtkEnvironment> environment;
  vtkNew<vtkLightSet> lights;
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethodToVariance();
  SetSingle(environment, 512, 256, 100, 170, glm::vec3(222208.0f), 1e-3f);
  EXPECT_TRUE(generator->Generate(environment, 64, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 64);
  ExpectSane(environment, lights);
  glm::dvec3 center;
  environment->GetTexelDirection(100, 170, &center.x);
  bool isFound = false;
  for (int k = 0; k < 64; ++k)
  {
    isFound = isFound || glm::distance(GetDirection(lights, k), center) < 1e-6;
  }
  EXPECT_TRUE(isFound);
}

//------------------------------------------------------------------------------
TEST(Variance, RadianceConverges)
{
  // Twice the lights, about half the error: 16 to 1024 lights bring it down by 64 at a rate of 1.
  const SpherePairs pairs = MakePairs();
  vtkNew<vtkLightSetGenerator> medianCut;
  vtkNew<vtkLightSetGenerator> greedy;
  greedy->SetMethodToVariance();
  vtkNew<vtkLightSet> lights;
  for (bool hall : { false, true })
  {
    vtkNew<vtkEnvironment> environment;
    hall ? environment->SetToProceduralHall() : environment->SetToProceduralSky();
    vtkNew<vtkBlinnPhongBRDF> lobe;
    lobe->SetExponent(20.0);
    const std::vector<glm::dvec3> exact = pairs.IntegrateExactly(lobe, environment);
    vtkNew<vtkLightSetRadianceIntegrator> integrator;
    integrator->SetBRDF(lobe);
    integrator->SetLightSet(lights);
    std::vector<double> errors;
    for (int count : { 16, 64, 256, 1024 })
    {
      ASSERT_TRUE(medianCut->Generate(environment, count, lights));
      const Errors median = Compare(exact, integrator, pairs);
      ASSERT_TRUE(greedy->Generate(environment, count, lights));
      const Errors ours = Compare(exact, integrator, pairs);
      if (count >= 64)
      {
        EXPECT_LT(ours.RMS, median.RMS / 2.0);
        EXPECT_LT(ours.Median, median.Median / 2.0);
        EXPECT_LT(ours.RMS, 2.0 * 0.06 * 20.0 * GetResidual(environment, lights));
      }
      errors.push_back(ours.RMS);
    }
    EXPECT_LT(errors.back(), errors.front() / 64.0);
  }
}

//------------------------------------------------------------------------------
TEST(SoftLights, NoSpreadIsHard)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkBlinnPhongBRDF> phong;
  vtkNew<vtkAshikhminShirleyBRDF> shirley;
  vtkNew<vtkDistributionBRDF> distribution;
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(shirley);
  ASSERT_TRUE(resampler->ResampleTo(8, 8, 20));
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(phong);
  sum->AddTerm(distribution);
  const double i[3] = { 0.1, 0.2, 0.9 }, below[3] = { 0.1, 0.2, -0.1 };
  const double o[3] = { 0.1, -0.4, 0.8 };
  for (vtkBRDF* brdf : std::initializer_list<vtkBRDF*>{ lambert.Get(), phong.Get(), shirley.Get(),
         distribution.Get(), resampler->GetOutput(), sum.Get() })
  {
    SCOPED_TRACE(brdf->GetClassName());
    brdf->Prepare();
    double hard[3];
    brdf->Evaluate(i, o, hard);
    const auto get = [&](const double light[3], double spread)
    {
      double soft[3];
      brdf->EvaluateSoft(light, o, spread, soft);
      return soft[1];
    };
    EXPECT_EQ(get(i, 0.0), hard[1]);
    EXPECT_NEAR(get(i, 1e-9), hard[1], 1e-6 * hard[1]);
    EXPECT_EQ(get(i, std::nan("")), hard[1]);
    for (const double spread : { 1e-3, 1.0, 1e300 })
    {
      EXPECT_TRUE(std::isfinite(get(i, spread)) && get(i, spread) >= 0.0);
    }
    EXPECT_EQ(get(below, 0.1), 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(SoftLights, AreTheMeanOverTheLight)
{
  // Against the mean of f over a von Mises-Fisher distribution about i, near the mirror direction
  // of a normal view, where the widths add up exactly for Gaussians.
  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetExponent(400.0);
  const double o[3] = { 0.0, 0.0, 1.0 };
  for (double kappa : { 50.0, 200.0, 1000.0 })
  {
    for (double angle : { 0.0, 0.05, 0.1 })
    {
      const double i[3] = { std::sin(angle), 0.0, std::cos(angle) };
      double mean = 0.0;
      constexpr int side = 200; // rings, and points of each
      for (int k = 0; k < side * side; ++k)
      {
        const double c = 1.0 + std::log((k / side + 0.5) / side) / kappa; // cosine to i
        const double s = std::sqrt(1.0 - c * c);
        const double phi = 2.0 * Pi * (k % side + 0.5) / side;
        const double x = s * std::cos(phi);
        const double d[3] = { x * i[2] + c * i[0], s * std::sin(phi), c * i[2] - x * i[0] };
        double f[3];
        phong->Evaluate(d, o, f);
        mean += f[1] / (side * side);
      }
      double soft[3];
      phong->EvaluateSoft(i, o, 1.0 / kappa, soft);
      EXPECT_NEAR(soft[1], mean, 0.05 * mean) << kappa << " " << angle;
    }
  }
}

//------------------------------------------------------------------------------
// The median error of 64 soft lights against that of hard ones, for lobes of exponent 500.
TEST(SoftLights, LowerTheErrorOfSharpLobesAndTables)
{
  const SpherePairs pairs = MakePairs();
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethodToVariance();
  vtkNew<vtkLightSet> lights;
  for (bool hall : { false, true })
  {
    vtkNew<vtkEnvironment> environment;
    hall ? environment->SetToProceduralHall() : environment->SetToProceduralSky();
    ASSERT_TRUE(generator->Generate(environment, 64, lights));
    vtkNew<vtkBlinnPhongBRDF> phong;
    phong->SetExponent(500.0);
    vtkNew<vtkDistributionBRDF> distribution;
    distribution->SetBlinnDistribution(500.0);
    vtkNew<vtkBRDFResampler> resampler;
    resampler->SetInput(distribution);
    ASSERT_TRUE(resampler->ResampleTo(18, 45, 90));
    for (vtkBRDF* lobe :
      std::initializer_list<vtkBRDF*>{ phong.Get(), distribution.Get(), resampler->GetOutput() })
    {
      const std::vector<glm::dvec3> exact = pairs.IntegrateExactly(lobe, environment);
      vtkNew<vtkLightSetRadianceIntegrator> integrator;
      integrator->SetBRDF(lobe);
      integrator->SetLightSet(lights);
      const Errors hard = Compare(exact, integrator, pairs);
      integrator->SoftLightsOn();
      const Errors soft = Compare(exact, integrator, pairs);
      EXPECT_LT(soft.Median, hard.Median / 1.5) << hall << lobe->GetClassName();
      EXPECT_LT(soft.RMS, hard.RMS) << hall << lobe->GetClassName();
    }
  }
}
