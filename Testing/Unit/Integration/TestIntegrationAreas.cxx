// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Texels are no points, radiance is bilinear between them: maps of few texels light as the same map
// in many texels does, whatever integrates them.

#include "HalfVector.h" // for Pi
#include "SpherePairs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkTableRadianceIntegrator.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

using measuredbrdf::Pi;

namespace
{
struct Way
{
  std::string Name;
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
  double Tolerance; // what the way itself gets wrong, in maps of many texels, too
};

vtkSmartPointer<vtkRadianceIntegrator> NewLoop(vtkEnvironment* environment, int method)
{
  vtkNew<vtkLightSetGenerator> generator;
  generator->SetMethod(method);
  vtkNew<vtkLightSet> lights;
  EXPECT_TRUE(generator->Generate(environment, 1024, lights));
  auto loop = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  loop->SetLightSet(lights);
  return loop;
}

// Every way to integrate a material under an environment, or the quick ones.
std::vector<Way> GetWays(vtkBRDF* brdf, vtkEnvironment* environment, bool all = true)
{
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetNumberOfRows(33);
  table->SetNumberOfViewAngles(12);
  table->SetNumberOfAzimuths(16);
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  EXPECT_TRUE(hybrid->SetSizes({ 64, 12, 16, 8 }));
  vtkNew<vtkFilteredRadianceIntegrator> filtered;
  filtered->SetNumberOfSamples(256);
  std::vector<Way> ways;
  ways.push_back({ "exact", NewExactSum(brdf, environment).Get(), 1e-3 });
  ways.push_back({ "table", table.Get(), 0.01 });
  if (all)
  {
    ways.push_back({ "hybrid", hybrid.Get(), 0.02 });
    ways.push_back({ "filtered", filtered.Get(), 0.02 });
  }
  using Generator = vtkLightSetGenerator;
  ways.push_back({ "variance", NewLoop(environment, Generator::VARIANCE), 0.01 });
  ways.push_back({ "median cut", NewLoop(environment, Generator::MEDIAN_CUT), 0.02 });
  ways.push_back({ "importance", NewLoop(environment, Generator::IMPORTANCE), 0.03 });
  for (const Way& way : ways)
  {
    way.Integrator->SetBRDF(brdf);
    way.Integrator->SetEnvironment(environment);
  }
  if (!all)
  {
    return ways;
  }
  vtkNew<vtkRadiancePlanner> planner;
  planner->SetBRDF(brdf);
  planner->SetEnvironment(environment);
  planner->SetErrorTolerance(0.02);
  EXPECT_TRUE(planner->Update());
  ways.push_back(
    { "planned", vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator()), 0.02 });
  return ways;
}

std::vector<vtkSmartPointer<vtkBRDF>> GetMaterials()
{
  vtkNew<vtkLambertBRDF> matte;
  matte->SetAlbedo(0.6, 0.5, 0.4);
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetSpecular(0.4, 0.3, 0.2);
  gloss->SetExponent(60.0);
  return { matte.Get(), gloss.Get() };
}

} // namespace

//------------------------------------------------------------------------------
// Patches, and one bright texel, which is a large lamp and no point.
TEST(CoarseMaps, LightAsTheSameMapInManyTexelsDoes)
{
  std::mt19937 engine(4);
  SpherePairs pairs;
  pairs.AddRandom(40, 7);
  for (const bool lamp : { false, true })
  {
    const int width = lamp ? 8 : 4;
    const int height = lamp ? 4 : 3;
    std::vector<float> rgb(3 * std::size_t(width) * std::size_t(height), 0.05f);
    for (float& value : rgb)
    {
      value = lamp ? value : static_cast<float>(engine() * 0x1p-32);
    }
    for (std::size_t k = 0; lamp && k < 3; ++k)
    {
      rgb[3 * (2 * 8 + 3) + k] = 50.0f;
    }
    vtkNew<vtkEnvironment> coarse;
    ASSERT_TRUE(coarse->SetPixels(width, height, rgb));
    const auto sum = NewExactSum(nullptr, NewUpsampled(coarse, 512 / width, 256 / height));
    for (const auto& brdf : GetMaterials())
    {
      sum->SetBRDF(brdf);
      const auto expected = pairs.Integrate(sum);
      for (const Way& way : GetWays(brdf, coarse, brdf->IsA("vtkBlinnPhongBRDF")))
      {
        const double error = GetRelativeError(pairs.Integrate(way.Integrator), expected);
        std::printf("%s, %s, %s: relative L1 %.5f\n", lamp ? "lamp" : "patches",
          brdf->GetClassName(), way.Name.c_str(), error);
        EXPECT_LT(error, (lamp ? 2.0 : 1.5) * way.Tolerance) << way.Name;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(CoarseMaps, AreCutUpWithoutChangingTheirLight)
{
  std::mt19937 engine(5);
  for (const std::array<int, 2>& size : { std::array<int, 2>{ 1, 1 }, std::array<int, 2>{ 3, 8 },
         std::array<int, 2>{ 127, 64 }, std::array<int, 2>{ 1, 5000 } })
  {
    std::vector<float> rgb(3 * std::size_t(size[0]) * std::size_t(size[1]));
    for (float& value : rgb)
    {
      value = static_cast<float>(engine() * 0x1p-32);
    }
    vtkNew<vtkEnvironment> environment;
    ASSERT_TRUE(environment->SetPixels(size[0], size[1], rgb));
    vtkEnvironment* cut = environment->GetSubdivided();
    ASSERT_NE(cut, environment);
    EXPECT_EQ(cut->GetSubdivided(), cut);
    EXPECT_GE(cut->GetWidth(), 256);
    EXPECT_GE(cut->GetHeight(), 128);
    EXPECT_LE(cut->GetWidth() * cut->GetHeight(), 1 << 22);
    for (int k = 0; k < 200; ++k)
    {
      const int x = static_cast<int>(engine() % static_cast<unsigned int>(cut->GetWidth()));
      const int y = static_cast<int>(engine() % static_cast<unsigned int>(cut->GetHeight()));
      glm::dvec3 d, before, after;
      cut->GetTexelDirection(x, y, &d.x);
      environment->GetRadiance(&d.x, &before.x);
      cut->GetPixel(x, y, &after.x);
      EXPECT_LT(glm::distance(before, after), 1e-6);
    }
    glm::dvec3 before, after;
    environment->GetTotal(&before.x);
    cut->GetTotal(&after.x);
    EXPECT_LT(glm::distance(before, after), 1e-12 * glm::length(before));
    // What was made for one map is not taken for the next, nor lost by copies.
    const auto copy = vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot());
    EXPECT_EQ(copy->GetSubdivided(), cut);
    ASSERT_TRUE(environment->SetPixels(128, 64, std::vector<float>(3 * 128 * 64, 1.0f)));
    EXPECT_EQ(environment->GetSubdivided(), environment);
  }
}
