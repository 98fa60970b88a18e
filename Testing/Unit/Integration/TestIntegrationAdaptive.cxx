// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The adaptive sum against the sum over the points of a fine grid.

#include "AdaptiveSum.h"
#include "AnisotropicWarp.h"
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "SharedData.h"
#include "SpherePairs.h"
#include "TexelTree.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkEnvironmentReader.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>

using namespace measuredbrdf;

namespace
{
vtkNew<vtkAdaptiveRadianceIntegrator> NewAdaptive(vtkBRDF* brdf, vtkEnvironment* environment)
{
  vtkNew<vtkAdaptiveRadianceIntegrator> adaptive;
  adaptive->SetBRDF(brdf);
  adaptive->SetEnvironment(environment);
  return adaptive;
}

// Relative to the exact sum, over the channels: the largest of all pairs.
double GetLargestError(
  const std::vector<glm::dvec3>& radiance, const std::vector<glm::dvec3>& exact)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k)
  {
    const glm::dvec3 d = glm::abs(radiance[k] - exact[k]);
    largest = std::max(largest, (d.x + d.y + d.z) / (exact[k].x + exact[k].y + exact[k].z));
  }
  return largest;
}

vtkNew<vtkAshikhminShirleyBRDF> NewGloss(double nu, double nv)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetDiffuse(0.02, 0.01, 0.03);
  brdf->SetExponents(nu, nv);
  return brdf;
}
}

//------------------------------------------------------------------------------
TEST(TexelTree, EachLevelHoldsAllLight)
{
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb;
  for (int k = 0; k < 3 * 133 * 67; ++k) // no powers of two
  {
    rgb.push_back(static_cast<float>(k % 7) + (k % 101 == 0 ? 500.0f : 0.0f));
  }
  ASSERT_TRUE(environment->SetPixels(133, 67, rgb));
  glm::dvec3 total;
  environment->GetTotal(&total.x);
  const TexelTree tree(environment);
  EXPECT_EQ(tree.GetHighestLevel(), 8); // 133, 67, 34, 17, 9, 5, 3, 2, 1
  EXPECT_EQ(tree.GetLowestLevel(), -8); // 67 * 256 rows: the first beyond 16384
  for (int level = -2; level <= tree.GetHighestLevel(); ++level)
  {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < tree.GetHeight(level); ++y)
    {
      for (int x = 0; x < tree.GetWidth(level); ++x)
      {
        const TexelTree::Light light = tree.Get(level, x, y);
        sum += light.Irradiance;
        EXPECT_NEAR(glm::length(light.Direction), 1.0, 1e-6);
        EXPECT_TRUE(light.Rest >= 0.0 && light.Rest <= 10.0) << light.Rest;
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(sum[c], total[c], 1e-4 * total[c]) << level;
    }
  }
  EXPECT_EQ(tree.Get(0, 133, 0).Irradiance, glm::dvec3(0.0));
}

//------------------------------------------------------------------------------
TEST(TexelTree, QuartersAreTheSquaresBelow)
{
  vtkNew<vtkEnvironment> environment;
  std::mt19937 engine(7);
  std::vector<float> rgb;
  for (int k = 0; k < 3 * 37 * 19; ++k) // odd: squares cross the map's edge
  {
    rgb.push_back(static_cast<float>(engine() * 0x1p-32));
  }
  ASSERT_TRUE(environment->SetPixels(37, 19, rgb));
  const TexelTree tree(environment);
  for (int level = tree.GetLowestLevel() + 1; level <= tree.GetHighestLevel(); ++level)
  {
    const int step = level < -1 ? 5 << -level : 1; // parts are many
    for (int y = 0; y < tree.GetHeight(level); y += step)
    {
      for (int x = 0; x < tree.GetWidth(level); x += step)
      {
        float directions[3][4], irradiances[3][4];
        float* const d[3] = { directions[0], directions[1], directions[2] };
        float* const i[3] = { irradiances[0], irradiances[1], irradiances[2] };
        tree.GetQuarters(level, x, y, d, i);
        for (int k = 0; k < 4; ++k)
        {
          const TexelTree::Light light = tree.Get(level - 1, 2 * x + k % 2, 2 * y + k / 2);
          for (int c = 0; c < 3; ++c)
          {
            EXPECT_NEAR(directions[c][k], light.Direction[c], 1e-6) << level;
            EXPECT_NEAR(irradiances[c][k], light.Irradiance[c], 2e-6 * light.Irradiance[c])
              << level << " " << x << " " << y << " " << k;
          }
        }
        if (level > 0)
        {
          EXPECT_EQ(tree.GetRest(level, x, y), static_cast<float>(tree.Get(level, x, y).Rest));
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(TexelTree, KnowsWhatQuartersLeave)
{
  // Under constant light a third; little where two lamps are in two quarters, much where they are
  // in one.
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb(3 * 256 * 128, 1.0f);
  environment->SetPixels(256, 128, rgb);
  EXPECT_NEAR(TexelTree(environment).Get(4, 3, 4).Rest, 1.0 / 3.0, 0.01);
  EXPECT_NEAR(TexelTree(environment).Get(1, 24, 32).Rest, 1.0 / 3.0, 0.01);
  const auto light = [&](std::initializer_list<int> texels)
  {
    std::fill(rgb.begin(), rgb.end(), 0.0f);
    for (const int texel : texels)
    {
      rgb[3 * static_cast<std::size_t>(texel)] = 1.0f;
    }
    environment->SetPixels(256, 128, rgb);
    return TexelTree(environment).Get(4, 5, 4).Rest;
  };
  EXPECT_LT(light({ 66 * 256 + 82, 76 * 256 + 92 }), 0.1);
  EXPECT_EQ(light({ 66 * 256 + 82, 69 * 256 + 85 }), 10.0);
}

//------------------------------------------------------------------------------
TEST(TexelTree, PartsAreInterpolated)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  const TexelTree tree(environment);
  for (const int level : { -1, -3, tree.GetLowestLevel() })
  {
    const int width = tree.GetWidth(level);
    const int height = tree.GetHeight(level);
    EXPECT_EQ(width, 256 << -level);
    for (int k = 0; k < 50; ++k)
    {
      const int x = (k * 7919) % width;
      const int y = (k * 104729) % height;
      glm::dvec3 direction, radiance;
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, &direction.x);
      environment->GetRadiance(&direction.x, &radiance.x);
      const TexelTree::Light part = tree.Get(level, x, y);
      EXPECT_LT(glm::distance(part.Direction, direction), 1e-14);
      const double solidAngle =
        2.0 * Pi / width * Pi / height * std::hypot(direction.x, direction.z);
      EXPECT_LT(
        glm::distance(part.Irradiance, radiance * solidAngle), 1e-5 * glm::length(part.Irradiance));
    }
  }
}

//------------------------------------------------------------------------------
TEST(AdaptiveIntegrator, ConvergesWithItsTolerance)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  ShrinkEnvironment(environment, 128, 64);
  const auto sum = NewExactSum(nullptr, NewUpsampled(environment, 8, 8));
  SpherePairs pairs;
  pairs.AddRandom(10);
  for (const double exponent : { 5.0, 3000.0 })
  {
    const auto brdf = NewGloss(exponent, exponent);
    const auto adaptive = NewAdaptive(brdf, environment);
    sum->SetBRDF(brdf);
    const std::vector<glm::dvec3> exact = pairs.Integrate(sum);
    for (const double tolerance : { 1e-2, 1e-3, 1e-4 })
    {
      adaptive->SetTolerance(tolerance);
      const double error = GetLargestError(pairs.Integrate(adaptive), exact);
      std::printf("exponent %g, tolerance %g: %.4f %%\n", exponent, tolerance, 100.0 * error);
      EXPECT_LT(error, 6.0 * tolerance);
    }
  }
}

//------------------------------------------------------------------------------
// Every pixel, not the mean of them.
TEST(AdaptiveIntegrator, KeepsItsToleranceAtEachPair)
{
  SpherePairs pairs;
  pairs.AddRandom(4);
  for (const bool hall : { false, true })
  {
    vtkNew<vtkEnvironment> environment;
    hall ? environment->SetToProceduralHall() : environment->SetToProceduralSky();
    environment->SetRotationY(77.0);
    const auto sum = NewExactSum(nullptr, NewUpsampled(environment, 4, 4));
    for (const auto& [nu, nv] :
      { std::pair(10.0, 10.0), { 300.0, 300.0 }, { 3000.0, 3000.0 }, { 30.0, 3000.0 } })
    {
      const auto brdf = NewGloss(nu, nv);
      const auto adaptive = NewAdaptive(brdf, environment);
      sum->SetBRDF(brdf);
      const double error = GetLargestError(pairs.Integrate(adaptive), pairs.Integrate(sum));
      std::printf(
        "%s, exponents %g and %g: %.4f %%\n", hall ? "hall" : "sky", nu, nv, 100.0 * error);
      EXPECT_LT(error, 3e-3) << nu << " " << nv;
    }
  }
}

//------------------------------------------------------------------------------
// A lamp of one texel and a lobe that no middle of a square meets.
TEST(AdaptiveIntegrator, MissesNothingNarrow)
{
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb(3 * 128 * 64, 0.01f);
  for (int c = 0; c < 3; ++c)
  {
    rgb[3 * (50 * 128 + 33) + c] = 1e4f;
  }
  environment->SetPixels(128, 64, rgb);
  const auto brdf = NewGloss(1e4, 1e4);
  glm::dvec3 lamp;
  environment->GetTexelDirection(33, 50, &lamp.x);
  const glm::dvec3 normal = glm::normalize(lamp + glm::dvec3(0.2, 0.1, 1.0));
  SpherePairs pairs; // mirrored onto the lamp, and beside it
  for (const double offset : { 0.0, 0.002, 0.01, 0.1 })
  {
    pairs.Add(normal, glm::normalize(glm::reflect(-lamp, normal) + glm::dvec3(offset, 0.0, 0.0)));
  }
  EXPECT_LT(GetLargestError(pairs.Integrate(NewAdaptive(brdf, environment)),
              pairs.IntegrateExactly(brdf, NewUpsampled(environment, 16, 16))),
    3e-3);
}

//------------------------------------------------------------------------------
// Hard panels, and a lobe whose peaks lie between the squares' points: agreement by chance.
TEST(AdaptiveIntegrator, IsNotMisledByChance)
{
  SpherePairs pairs;
  pairs.AddRandom(150);
  for (const std::string material : { "satin_purple", "irid_flake_paint2" })
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(SharedData + "/materials/rgl/" + material + "_rgb.bsdf");
    vtkNew<vtkEnvironmentReader> environment;
    environment->SetFileName(SharedData + "/environments/studio.exr");
    if (!std::ifstream(reader->GetFileName()).good())
    {
      GTEST_SKIP() << "no measured data at " << SharedData;
    }
    ASSERT_TRUE(reader->Read() && environment->Read());
    const auto adaptive = NewAdaptive(reader->GetBRDF(), environment->GetEnvironment());
    const std::vector<glm::dvec3> radiance = pairs.Integrate(adaptive);
    adaptive->SetTolerance(1e-4);
    const double error = GetLargestError(radiance, pairs.Integrate(adaptive));
    std::printf("%s: %.4f %%\n", material.c_str(), 100.0 * error);
    EXPECT_LT(error, 3e-3);
  }
}

//------------------------------------------------------------------------------
// No lobe of a material is higher than the table of its peaks says.
TEST(ReflectionGuide, KnowsPeaks)
{
  for (const double exponent : { 10.0, 300.0 })
  {
    const auto brdf = NewGloss(exponent, exponent);
    const ReflectionGuide guide(brdf);
    for (const double theta : { 0.1, 0.7, 1.2 })
    {
      const glm::dvec3 o(
        std::sin(theta) * std::cos(0.9), std::sin(theta) * std::sin(0.9), std::cos(theta));
      const ReflectionGuide::Peaks peaks = guide.GetPeaks(o);
      double solidAngle = 0.0;
      for (const double aside : { 0.0, 0.1, 0.3 })
      {
        const glm::dvec3 mirror(-o.x, -o.y, o.z);
        const glm::dvec3 i = glm::normalize(mirror + glm::dvec3(-aside * o.y, aside * o.x, aside));
        const double radius = std::max(0.05, glm::distance(i, mirror));
        glm::dvec3 f;
        brdf->Evaluate(&mirror.x, &o.x, &f.x);
        const double peak = f.x + f.y + f.z;
        EXPECT_GT(peaks.Get(i, radius, solidAngle), 0.7 * peak) << theta << " " << aside;
        EXPECT_LT(peaks.Get(i, radius, solidAngle), 10.0 * peak) << theta << " " << aside;
        EXPECT_GT(solidAngle, 0.0);
      }
    }
  }
}

//------------------------------------------------------------------------------
// A material that evaluates many lights at once, and one that does not.
TEST(AdaptiveIntegrator, ThreadsChangeNothing)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  SpherePairs pairs;
  pairs.AddRandom(100);
  vtkNew<vtkAdaptiveWarpBRDF> warp;
  ASSERT_EQ(warp->SetTables(MakeAnisotropicTables(NewGloss(300.0, 300.0), { 16, 1, 1, 65 })), "");
  ASSERT_TRUE(warp->IsIsotropic());
  const auto gloss = NewGloss(300.0, 300.0);
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(warp), static_cast<vtkBRDF*>(gloss) })
  {
    const auto adaptive = NewAdaptive(brdf, environment);
    EXPECT_EQ(adaptive->GetNumberOfEvaluations(), 0);
    const std::vector<glm::dvec3> several = pairs.Integrate(adaptive);
    const vtkTypeInt64 evaluations = adaptive->GetNumberOfEvaluations();
    EXPECT_GT(evaluations, 100 * 200);
    EXPECT_LT(evaluations, 100 * 50000);
    vtkSMPTools::Initialize(1);
    EXPECT_EQ(pairs.Integrate(adaptive), several);
    vtkSMPTools::Initialize();
    EXPECT_EQ(adaptive->GetNumberOfEvaluations(), 2 * evaluations);
  }
}

//------------------------------------------------------------------------------
// Its answer is asked for about every 50 ms.
TEST(AdaptiveIntegrator, StopsSoon)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralHall();
  SpherePairs pairs;
  pairs.AddRandom(20000);
  const auto adaptive = NewAdaptive(NewGloss(3000.0, 3000.0), environment);
  adaptive->SetTolerance(1e-4);
  ASSERT_TRUE(adaptive->Prepare());
  using Clock = std::chrono::steady_clock;
  struct State
  {
    Clock::time_point Last = Clock::now();
    double Longest = 0.0; // s between two questions
    int Questions = 0;
  } state;
  vtkNew<vtkCallbackCommand> ask;
  ask->SetClientData(&state);
  ask->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto* s = static_cast<State*>(data);
      const Clock::time_point now = Clock::now();
      s->Longest = std::max(s->Longest, std::chrono::duration<double>(now - s->Last).count());
      s->Last = now;
      static_cast<vtkAdaptiveRadianceIntegrator*>(caller)->SetAbort(++s->Questions == 12);
    });
  adaptive->AddObserver(vtkCommand::ProgressEvent, ask);
  ErrorCatcher errors(adaptive);
  vtkNew<vtkDoubleArray> radiance;
  state.Last = Clock::now();
  EXPECT_FALSE(adaptive->Integrate(pairs.Normals, pairs.Views, radiance));
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_EQ(state.Questions, 12); // it stops at once
  std::printf("longest time between two questions: %.3f s\n", state.Longest);
  EXPECT_LT(state.Longest, 1.0); // 0.1 s, on machines with other work to do
}
