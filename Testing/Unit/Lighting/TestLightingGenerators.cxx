// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "RandomLight.h"
#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkImportanceLightSetGenerator.h"
#include "vtkLightSet.h"
#include "vtkMath.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>

using measuredbrdf::Pi;

namespace
{
using Color = std::array<double, 3>;

// Black but for one texel.
void SetSingle(vtkEnvironment* environment, int width, int height, int x, int y, Color color,
  float background = 0.0f)
{
  std::vector<float> rgb(3 * std::size_t(width) * height, background);
  for (int c = 0; c < 3; ++c)
  {
    rgb[3 * (std::size_t(y) * width + x) + c] = static_cast<float>(color[c]);
  }
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
}

Color GetTotal(vtkEnvironment* environment)
{
  Color total;
  environment->GetTotal(total.data());
  return total;
}

Color GetTotal(vtkLightSet* lights)
{
  Color total;
  lights->GetTotal(total.data());
  return total;
}

void ExpectSameLuminance(vtkEnvironment* environment, vtkLightSet* lights)
{
  const double expected = vtkEnvironment::GetLuminance(GetTotal(environment).data());
  EXPECT_NEAR(vtkEnvironment::GetLuminance(GetTotal(lights).data()), expected, 1e-11 * expected);
}

double GetLuminanceSum(vtkEnvironment* environment, const int region[4])
{
  double sum = 0.0;
  for (int y = region[1]; y < region[3]; ++y)
  {
    for (int x = region[0]; x < region[2]; ++x)
    {
      double rgb[3];
      environment->GetPixel(x, y, rgb);
      sum += vtkEnvironment::GetLuminance(rgb) * environment->GetTexelSolidAngle(y);
    }
  }
  return sum;
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
  double d[3];
  lights->GetDirection(0, d);
  EXPECT_DOUBLE_EQ(d[1], 0.6);
  EXPECT_DOUBLE_EQ(d[2], 0.8);
  EXPECT_EQ(lights->GetSolidAngle(0), 0.5);
  int region[4];
  ASSERT_TRUE(lights->GetRegion(0, region));
  EXPECT_EQ(region[3], 4);
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
  EXPECT_EQ(GetTotal(lights), (Color{ 2.0, 4.0, 6.0 }));
  lights->GetIrradiance(2, d); // outside: zeros
  EXPECT_EQ(d[0], 0.0);
  lights->RemoveAllLights();
  EXPECT_EQ(lights->GetNumberOfLights(), 0);
}

//------------------------------------------------------------------------------
TEST(LightSet, PolyDataRoundTrip)
{
  vtkNew<vtkLightSet> lights;
  for (int k = 0; k < 5; ++k)
  {
    const double direction[3] = { 1.0, k - 2.0, 0.5 * k };
    const double irradiance[3] = { 0.1 * k, 1.0, 2.0 };
    ASSERT_TRUE(lights->AddLight(direction, irradiance, 0.01 * k, 3.0 * k));
  }
  const auto geometry = vtkSmartPointer<vtkPolyData>::Take(lights->NewPolyData());
  EXPECT_EQ(geometry->GetNumberOfVerts(), 5);
  vtkNew<vtkLightSet> copy;
  ErrorCatcher errors(copy);
  ASSERT_TRUE(copy->SetPolyData(geometry));
  ASSERT_EQ(copy->GetNumberOfLights(), 5);
  for (int k = 0; k < 5; ++k)
  {
    double a[3];
    double b[3];
    lights->GetDirection(k, a);
    copy->GetDirection(k, b);
    EXPECT_NEAR(vtkMath::Distance2BetweenPoints(a, b), 0.0, 1e-30);
    lights->GetIrradiance(k, a);
    copy->GetIrradiance(k, b);
    EXPECT_EQ(vtkMath::Distance2BetweenPoints(a, b), 0.0);
    EXPECT_EQ(copy->GetSolidAngle(k), 0.01 * k);
    EXPECT_EQ(copy->GetConcentration(k), 3.0 * k);
  }
  // Bad geometry changes nothing.
  vtkNew<vtkPolyData> empty;
  EXPECT_FALSE(copy->SetPolyData(empty));
  EXPECT_FALSE(copy->SetPolyData(nullptr));
  geometry->GetPointData()->GetArray("Irradiance")->SetComponent(3, 1, -1.0);
  EXPECT_FALSE(copy->SetPolyData(geometry));
  EXPECT_EQ(errors.Take(), 3);
  EXPECT_EQ(copy->GetNumberOfLights(), 5);
}

//------------------------------------------------------------------------------
TEST(Generators, RefuseBadArguments)
{
  vtkNew<vtkMedianCutLightSetGenerator> medianCut;
  vtkNew<vtkImportanceLightSetGenerator> importance;
  vtkNew<vtkEnvironment> empty;
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 8, 4);
  for (vtkLightSetGenerator* generator : { static_cast<vtkLightSetGenerator*>(medianCut),
         static_cast<vtkLightSetGenerator*>(importance) })
  {
    vtkNew<vtkLightSet> lights;
    ASSERT_TRUE(generator->Generate(environment, 4, lights));
    ErrorCatcher errors(generator);
    EXPECT_FALSE(generator->Generate(nullptr, 4, lights));
    EXPECT_FALSE(generator->Generate(empty, 4, lights));
    EXPECT_FALSE(generator->Generate(environment, 4, nullptr));
    EXPECT_FALSE(generator->Generate(environment, 0, lights));
    EXPECT_FALSE(generator->Generate(environment, -4, lights));
    EXPECT_FALSE(
      generator->Generate(environment, 2 * vtkLightSetGenerator::MaximumNumberOfLights, lights));
    EXPECT_EQ(errors.Take(), 6);
    EXPECT_EQ(lights->GetNumberOfLights(), 4);
  }
  vtkNew<vtkLightSet> lights;
  ErrorCatcher errors(medianCut);
  EXPECT_FALSE(medianCut->Generate(environment, 100, lights));
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(errors.GetText().find("power of two"), std::string::npos);
  EXPECT_TRUE(importance->Generate(environment, 100, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 100);
}

//------------------------------------------------------------------------------
TEST(Generators, KeepTheEnergy)
{
  vtkNew<vtkMedianCutLightSetGenerator> medianCut;
  vtkNew<vtkImportanceLightSetGenerator> importance;
  vtkNew<vtkLightSet> lights;
  const int sizes[][2] = { { 1, 1 }, { 1, 7 }, { 9, 1 }, { 33, 17 }, { 128, 64 } };
  for (const auto& size : sizes)
  {
    vtkNew<vtkEnvironment> environment;
    SetRandom(environment, size[0], size[1]);
    const Color total = GetTotal(environment);
    for (int count : { 1, 16, 256 })
    {
      ASSERT_TRUE(medianCut->Generate(environment, count, lights));
      EXPECT_LE(lights->GetNumberOfLights(), count);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(GetTotal(lights)[c], total[c], 1e-11 * total[c]);
      }
      ASSERT_TRUE(importance->Generate(environment, count, lights));
      EXPECT_EQ(lights->GetNumberOfLights(), count);
      ExpectSameLuminance(environment, lights);
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
  double center[3];
  environment->GetTexelDirection(5, 11, center);
  vtkNew<vtkLightSet> lights;

  vtkNew<vtkMedianCutLightSetGenerator> medianCut;
  ASSERT_TRUE(medianCut->Generate(environment, 64, lights));
  ASSERT_EQ(lights->GetNumberOfLights(), 1);
  double d[3];
  lights->GetDirection(0, d);
  EXPECT_LT(vtkMath::Distance2BetweenPoints(d, center), 1e-28);
  double e[3];
  lights->GetIrradiance(0, e);
  EXPECT_NEAR(e[0], 3.0 * environment->GetTexelSolidAngle(11), 1e-15);
  EXPECT_NEAR(e[2], 1.0 * environment->GetTexelSolidAngle(11), 1e-15);

  vtkNew<vtkImportanceLightSetGenerator> importance;
  ASSERT_TRUE(importance->Generate(environment, 50, lights));
  ASSERT_EQ(lights->GetNumberOfLights(), 50);
  ExpectSameLuminance(environment, lights);
  double solidAngle = 0.0;
  for (int k = 0; k < 50; ++k)
  {
    double u;
    double v;
    lights->GetDirection(k, d);
    EXPECT_NEAR(vtkMath::Norm(d), 1.0, 1e-14);
    vtkEnvironment::GetCoordinates(d, u, v);
    EXPECT_EQ(static_cast<int>(u * width), 5);
    EXPECT_EQ(static_cast<int>(v * height), 11);
    solidAngle += lights->GetSolidAngle(k);
  }
  EXPECT_NEAR(solidAngle, environment->GetTexelSolidAngle(11), 1e-14);
}

//------------------------------------------------------------------------------
TEST(Generators, BlackGivesNoLights)
{
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetPixels(8, 4, std::vector<float>(96, 0.0f)));
  vtkNew<vtkMedianCutLightSetGenerator> medianCut;
  vtkNew<vtkImportanceLightSetGenerator> importance;
  vtkNew<vtkLightSet> lights;
  EXPECT_TRUE(medianCut->Generate(environment, 64, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 0);
  EXPECT_TRUE(importance->Generate(environment, 64, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 0);
}

//------------------------------------------------------------------------------
TEST(MedianCut, RegionsTileTheMap)
{
  const int width = 161;
  const int height = 79;
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, width, height);
  vtkNew<vtkMedianCutLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  for (int count : { 1, 2, 64, 1024, 4096 })
  {
    ASSERT_TRUE(generator->Generate(environment, count, lights));
    std::vector<int> cover(std::size_t(width) * height, 0);
    double solidAngle = 0.0;
    for (int k = 0; k < lights->GetNumberOfLights(); ++k)
    {
      int r[4];
      ASSERT_TRUE(lights->GetRegion(k, r));
      ASSERT_TRUE(r[0] >= 0 && r[1] >= 0 && r[2] <= width && r[3] <= height);
      for (int y = r[1]; y < r[3]; ++y)
      {
        for (int x = r[0]; x < r[2]; ++x)
        {
          ++cover[std::size_t(y) * width + x];
        }
      }
      solidAngle += lights->GetSolidAngle(k);
    }
    EXPECT_EQ(std::count(cover.begin(), cover.end(), 1), width * height) << count;
    EXPECT_NEAR(solidAngle, 4.0 * Pi, 1e-11);
  }
  // No brightest texel, more lights asked for than there are texels: one each.
  ASSERT_TRUE(environment->SetPixels(128, 64, std::vector<float>(3 * 128 * 64, 1.0f)));
  ASSERT_TRUE(generator->Generate(environment, 1 << 17, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 8192);
  // But large texels are areas.
  ASSERT_TRUE(environment->SetPixels(8, 4, std::vector<float>(96, 1.0f)));
  ASSERT_TRUE(generator->Generate(environment, 64, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 64);
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
  vtkNew<vtkMedianCutLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 64, lights));
  ASSERT_EQ(lights->GetNumberOfLights(), 64);
  const double share = vtkEnvironment::GetLuminance(GetTotal(environment).data()) / 64;
  for (int k = 0; k < 64; ++k)
  {
    int region[4];
    ASSERT_TRUE(lights->GetRegion(k, region));
    EXPECT_NEAR(GetLuminanceSum(environment, region), share, 0.06 * share);
  }
}

//------------------------------------------------------------------------------
TEST(MedianCut, PolarRegionsAreCutInLatitude)
{
  // Constant map, 8 regions: halves, quarters in x (pi x pi -> pi/2 x pi), then each
  // quarter is higher than wide: cut in y at the equator.
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetPixels(128, 64, std::vector<float>(128 * 64 * 3, 1.0f)));
  vtkNew<vtkMedianCutLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 8, lights));
  std::set<std::array<int, 4>> regions;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    std::array<int, 4> region;
    ASSERT_TRUE(lights->GetRegion(k, region.data()));
    regions.insert(region);
    // A cell's centroid by symmetry: in the middle of its azimuths.
    double d[3];
    lights->GetDirection(k, d);
    double u;
    double v;
    vtkEnvironment::GetCoordinates(d, u, v);
    EXPECT_NEAR(u, 0.5 * (region[0] + region[2]) / 128, 1e-12);
    // On directions: the octant's centroid has latitude atan(1/sqrt 2), not 45 degrees.
    EXPECT_NEAR(std::abs(v - 0.5) * Pi, std::atan(std::sqrt(0.5)), 2e-3);
  }
  std::set<std::array<int, 4>> expected;
  for (int x = 0; x < 128; x += 32)
  {
    expected.insert({ x, 0, x + 32, 32 });
    expected.insert({ x, 32, x + 32, 64 });
  }
  EXPECT_EQ(regions, expected);

  // Octants are pi/2 x pi/2, but narrower by the cosine of 45 degrees: cut in y, where the sine of
  // the latitude is nearest to 1/2 (10 rows of 2.8 degrees: 0.471; 11 rows: 0.514).
  ASSERT_TRUE(generator->Generate(environment, 16, lights));
  ASSERT_EQ(lights->GetNumberOfLights(), 16);
  std::set<std::pair<int, int>> rows;
  for (int k = 0; k < 16; ++k)
  {
    int region[4];
    ASSERT_TRUE(lights->GetRegion(k, region));
    EXPECT_EQ(region[2] - region[0], 32);
    rows.insert({ region[1], region[3] });
  }
  EXPECT_EQ(rows, (std::set<std::pair<int, int>>{ { 0, 21 }, { 21, 32 }, { 32, 43 }, { 43, 64 } }));
}

//------------------------------------------------------------------------------
TEST(Importance, SeedsRepeat)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 64, 32);
  const auto run = [&](unsigned int seed)
  {
    vtkNew<vtkImportanceLightSetGenerator> generator;
    generator->SetSeed(seed);
    vtkNew<vtkLightSet> lights;
    EXPECT_TRUE(generator->Generate(environment, 32, lights));
    std::vector<Color> directions(32);
    for (int k = 0; k < 32; ++k)
    {
      lights->GetDirection(k, directions[std::size_t(k)].data());
    }
    return directions;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
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
  vtkNew<vtkImportanceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 1, lights));
  const double shift = 1791095845.0 / 4294967296.0;
  const double jitter = 4282876139.0 / 4294967296.0;
  double d[3];
  lights->GetDirection(0, d);
  double u;
  double v;
  vtkEnvironment::GetCoordinates(d, u, v);
  EXPECT_NEAR(u, 0.5 + 0.5 * (shift - 0.25) / 0.75, 1e-12);
  EXPECT_NEAR(d[1], 2.0 * jitter - 1.0, 1e-12);
}

//------------------------------------------------------------------------------
TEST(Importance, Unbiased)
{
  // First moments of every channel, over many seeds, against the sum over texels. Texels are
  // constant over their area, so their moment is the integral of the direction over it.
  const int width = 24;
  const int height = 12;
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, width, height, 9);
  double expected[9] = {};
  for (int y = 0; y < height; ++y)
  {
    const double a = Pi * (static_cast<double>(y) / height - 0.5);
    const double b = Pi * (static_cast<double>(y + 1) / height - 0.5);
    const double horizontal = 0.5 * (b - a) + 0.25 * (std::sin(2.0 * b) - std::sin(2.0 * a));
    const double vertical =
      2.0 * Pi / width * 0.5 * (std::sin(b) * std::sin(b) - std::sin(a) * std::sin(a));
    for (int x = 0; x < width; ++x)
    {
      const double p = 2.0 * Pi * (static_cast<double>(x) / width - 0.5);
      const double q = 2.0 * Pi * (static_cast<double>(x + 1) / width - 0.5);
      const double moment[3] = { horizontal * (std::sin(q) - std::sin(p)), vertical,
        horizontal * (std::cos(p) - std::cos(q)) };
      double rgb[3];
      environment->GetPixel(x, y, rgb);
      for (int k = 0; k < 9; ++k)
      {
        expected[k] += rgb[k / 3] * moment[k % 3];
      }
    }
  }
  const int runs = 1500;
  double sum[9] = {};
  double squares[9] = {};
  vtkNew<vtkImportanceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  for (int run = 0; run < runs; ++run)
  {
    generator->SetSeed(static_cast<unsigned int>(100 + run));
    ASSERT_TRUE(generator->Generate(environment, 16, lights));
    double estimate[9] = {};
    for (int j = 0; j < lights->GetNumberOfLights(); ++j)
    {
      double d[3];
      double e[3];
      lights->GetDirection(j, d);
      lights->GetIrradiance(j, e);
      for (int k = 0; k < 9; ++k)
      {
        estimate[k] += e[k / 3] * d[k % 3];
      }
    }
    for (int k = 0; k < 9; ++k)
    {
      sum[k] += estimate[k];
      squares[k] += estimate[k] * estimate[k];
    }
  }
  for (int k = 0; k < 9; ++k)
  {
    const double mean = sum[k] / runs;
    const double error = std::sqrt((squares[k] / runs - mean * mean) / runs);
    EXPECT_NEAR(mean, expected[k], 5.0 * error) << "moment " << k;
    EXPECT_GT(error, 0.0);
  }
}
