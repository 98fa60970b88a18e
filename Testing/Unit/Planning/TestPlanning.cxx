// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Plans: whether they keep what they promise, and when they are made.

#include "AnisotropicWarp.h"
#include "BrushedMetal.h"
#include "ErrorCatcher.h"
#include "NumberText.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkDistributionBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkTableRadianceIntegrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{
vtkNew<vtkRadiancePlanner> NewPlanner(vtkBRDF* brdf, vtkEnvironment* environment, double tolerance)
{
  vtkNew<vtkRadiancePlanner> planner;
  planner->SetBRDF(brdf);
  planner->SetEnvironment(environment);
  planner->SetErrorTolerance(tolerance);
  return planner;
}

vtkNew<vtkBlinnPhongBRDF> NewPhong(double exponent)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetSpecular(0.4, 0.3, 0.2);
  brdf->SetExponent(exponent);
  return brdf;
}

vtkSmartPointer<vtkRadianceIntegrator> TakeChoice(vtkRadiancePlanner* planner)
{
  return vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
}

bool Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
} // namespace

//------------------------------------------------------------------------------
// The chosen integrator's error over pairs that the planner has not seen.
class PlannerPromise : public testing::TestWithParam<const char*>
{
};

TEST_P(PlannerPromise, IsKept)
{
  auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(GetParam()));
  ASSERT_TRUE(brdf);
  for (const bool hall : { false, true })
  {
    const auto environment = NewSmallEnvironment(hall);
    SpherePairs pairs; // many: one highlight is a third of a gloss's error over 1000 of them
    pairs.AddRandom(3000, 11);
    const auto reference = pairs.IntegrateExactly(brdf, environment);
    double lastCost = 0.0;
    for (const double tolerance : { 0.05, 0.02 })
    {
      const auto planner = NewPlanner(brdf, environment, tolerance);
      ASSERT_TRUE(planner->Update());
      const int choice = planner->GetChoice();
      const double predicted = planner->GetPredictedError(choice);
      const double actual = GetRelativeError(pairs.Integrate(TakeChoice(planner)), reference);
      std::printf("%s, %s, %g: actual %.4f; %s\n", GetParam(), hall ? "hall" : "sky", tolerance,
        actual, planner->GetPlan().c_str());
      EXPECT_TRUE(planner->GetMeetsTolerance());
      EXPECT_LE(predicted, tolerance);
      EXPECT_LE(actual, tolerance);
      EXPECT_LT(actual, 3.0 * predicted);
      EXPECT_GT(actual, predicted / 3.0);
      EXPECT_GE(planner->GetPredictedCost(choice), lastCost); // never less for more accuracy
      lastCost = planner->GetPredictedCost(choice);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Embedded, PlannerPromise,
  testing::Values("blue-fabric", "violet-rubber", "gold-paint", "delrin"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

//------------------------------------------------------------------------------
// A material for each rung, under a panel, and with a sun beside it.
TEST(Planner, ClimbsToEachRung)
{
  struct Case
  {
    bool Sun;
    double Exponent;
    double Tolerance;
    vtkIdType MaximumBytes;
    const char* Choice; // how it begins
  };
  constexpr vtkIdType enough = 24 << 20;
  constexpr vtkIdType little = 3500000; // for no table of 49 rows
  for (const Case& rung : { Case{ false, 30.0, 0.02, enough, "table, 17 rows" },
         Case{ false, 300.0, 0.02, enough, "table, 33 rows" },
         Case{ false, 1000.0, 0.02, enough, "table, 49 rows" },
         Case{ false, 10000.0, 0.02, enough, "table, 201 rows" },
         Case{ true, 300.0, 0.02, enough, "hybrid, 33 rows" },
         Case{ true, 1000.0, 0.02, enough, "hybrid, 65 rows" },
         Case{ true, 3000.0, 0.0155, enough, "hybrid, 81 rows" },
         Case{ true, 10000.0, 0.044, enough, "hybrid, 320 rows" },
         Case{ false, 10000.0, 0.05, little, "filtered, 16 samples" },
         Case{ false, 10000.0, 0.02, little, "filtered, 64 samples" },
         Case{ false, 10000.0, 0.012, little, "filtered, 256 samples" } })
  {
    std::vector<float> pixels(3 * 256 * 128, 0.2f);
    for (std::size_t k = 0; k < pixels.size(); ++k)
    {
      const std::size_t x = k / 3 % 256;
      const std::size_t y = k / 3 / 256;
      const bool isPanel = x >= 100 && x < 140 && y >= 70 && y < 95;
      pixels[k] = rung.Sun && x == 60 && y == 100 ? 2e4f : isPanel ? 8.0f : 0.2f;
    }
    vtkNew<vtkEnvironment> environment;
    environment->SetPixels(256, 128, pixels);
    const auto planner = NewPlanner(NewPhong(rung.Exponent), environment, rung.Tolerance);
    planner->SetMaximumTextureBytes(rung.MaximumBytes);
    ASSERT_TRUE(planner->Update());
    EXPECT_EQ(planner->GetPlan().rfind(rung.Choice, 0), 0u) << planner->GetPlan();
    EXPECT_TRUE(planner->GetMeetsTolerance()) << planner->GetPlan();
  }
}

//------------------------------------------------------------------------------
// A mirror under lamps: nothing is accurate to a thousandth.
TEST(Planner, SaysWhenItCannot)
{
  auto chrome = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("chrome"));
  const auto environment = NewSmallEnvironment(true);
  const auto planner = NewPlanner(chrome, environment, 1e-3);
  planner->SetMaximumTextureBytes(8 << 20); // to be quick
  ASSERT_TRUE(planner->Update());
  std::printf("%s\n", planner->GetPlan().c_str());
  EXPECT_FALSE(planner->GetMeetsTolerance());
  EXPECT_TRUE(Contains(planner->GetReason(), "most accurate")) << planner->GetReason();
  ASSERT_GT(planner->GetNumberOfCandidates(), 1);
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    EXPECT_GE(
      planner->GetPredictedError(k), 0.9 * planner->GetPredictedError(planner->GetChoice()));
  }
}

//------------------------------------------------------------------------------
// Where there is no room for a table, light sets serve.
TEST(Planner, AnisotropicMaterialsGetTablesOrLightSets)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(5.0, 20.0);
  const auto planner = NewPlanner(brushed, NewSmallEnvironment(false), 0.2);
  for (const char* method : { "table", "light-set" })
  {
    ASSERT_TRUE(planner->Update());
    std::printf("%s\n", planner->GetPlan().c_str());
    EXPECT_EQ(planner->GetMethodName(planner->GetChoice()), method);
    EXPECT_EQ(TakeChoice(planner)->GetMethodName(), method);
    EXPECT_TRUE(planner->GetMeetsTolerance());
    planner->SetMaximumTextureBytes(1 << 20);
  }
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    EXPECT_EQ(planner->GetMethodName(k), "light-set");
  }
}

//------------------------------------------------------------------------------
// A measured one, too, and its promise holds.
TEST(Planner, MeasuredAnisotropicMaterials)
{
  AnisotropicWarpSizes sizes;
  sizes.Parts = 2;
  sizes.Side = 33;
  vtkNew<vtkAdaptiveWarpBRDF> file;
  ASSERT_EQ(file->SetTables(MakeAnisotropicTables(NewBrushedMetal(0.3, 0.6), sizes)), "");
  const auto environment = NewSmallEnvironment(true);
  const auto planner = NewPlanner(file, environment, 0.03);
  ASSERT_TRUE(planner->Update());
  std::printf("%s\n", planner->GetPlan().c_str());
  EXPECT_TRUE(planner->GetMeetsTolerance());
  EXPECT_NE(planner->GetMethodName(planner->GetChoice()), "light-set");
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(file);
  reference->SetEnvironment(environment);
  SpherePairs pairs;
  pairs.AddRandom(200, 9);
  EXPECT_LT(
    GetRelativeError(pairs.Integrate(TakeChoice(planner)), pairs.Integrate(reference.Get())),
    1.25 * 0.03);
}

//------------------------------------------------------------------------------
// What is said of a plan's memory holds for what it uploads.
TEST(Planner, TextureMemory)
{
  const auto environment = NewSmallEnvironment(true);
  const auto brdf = NewPhong(60.0);
  const auto planner = NewPlanner(brdf, environment, 0.01);
  ASSERT_TRUE(planner->Update());
  EXPECT_GT(planner->GetTextureBytes(planner->GetChoice()), 1 << 20);
  for (const vtkIdType limit : { vtkIdType(6 << 20), vtkIdType(1 << 20) })
  {
    planner->SetMaximumTextureBytes(limit);
    ASSERT_TRUE(planner->Update());
    vtkBRDFShaderInputs form;
    ASSERT_TRUE(TakeChoice(planner)->GetShaderInputs(form));
    const vtkIdType said = planner->GetTextureBytes(planner->GetChoice());
    const vtkIdType used = static_cast<vtkIdType>(form.GetTextureBytes());
    std::printf("at most %lld bytes: said %lld, used %lld; %s\n", static_cast<long long>(limit),
      static_cast<long long>(said), static_cast<long long>(used), planner->GetPlan().c_str());
    EXPECT_LE(used, limit);
    EXPECT_LE(used, said);
    EXPECT_GE(used, said / 2);
    for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
    {
      EXPECT_LE(planner->GetTextureBytes(k), limit);
    }
  }
  // Less than any candidate needs: said so, and the last plan stays.
  ErrorCatcher errors(planner);
  const std::string plan = planner->GetPlan();
  planner->SetMaximumTextureBytes(1000);
  EXPECT_FALSE(planner->Update());
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_TRUE(Contains(errors.GetText(), "1000 bytes")) << errors.GetText();
  EXPECT_EQ(planner->GetPlan(), plan);
}

//------------------------------------------------------------------------------
// Where pixels evaluate the material, its own textures count.
TEST(Planner, TextureMemoryOfTheMaterial)
{
  vtkNew<vtkDistributionBRDF> brdf;
  vtkBRDFShaderInputs form;
  form.SoftLights = true;
  brdf->GetShaderInputs(form);
  ASSERT_GT(form.GetTextureBytes(), 1000u);
  const auto environment = NewSmallEnvironment(true);
  const auto planner = NewPlanner(brdf, environment, 0.05);
  planner->SetMaximumTextureBytes(2 << 20); // to be quick
  planner->EvaluateAllOn();
  ASSERT_TRUE(planner->Update());
  int lightSets = 0;
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    if (planner->GetMethodName(k) == "light-set")
    {
      ++lightSets;
      EXPECT_GE(planner->GetTextureBytes(k), static_cast<vtkIdType>(form.GetTextureBytes()));
    }
  }
  EXPECT_GT(lightSets, 0);
}

//------------------------------------------------------------------------------
TEST(Planner, PlansAgainExactlyWhenItMust)
{
  const auto brdf = NewPhong(3.0);
  const auto environment = NewSmallEnvironment(false);
  const auto planner = NewPlanner(brdf, environment, 0.05);
  EXPECT_EQ(planner->GetChoice(), -1);
  EXPECT_EQ(planner->GetPlan(), "no plan yet");
  EXPECT_EQ(planner->NewIntegrator(), nullptr);
  ASSERT_TRUE(planner->Update());
  const auto first = TakeChoice(planner);
  ASSERT_TRUE(first);
  auto last = first;
  const auto expectNew = [&](const char* what, bool isNew)
  {
    ASSERT_TRUE(planner->Update());
    const auto now = TakeChoice(planner);
    EXPECT_EQ(now != last, isNew) << what;
    last = now;
  };
  expectNew("nothing", false);
  environment->SetRotationY(50.0);
  expectNew("a rotation", false);
  environment->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 0.5f));
  expectNew("pixels", true);
  brdf->SetExponent(4.0);
  expectNew("a parameter", true);
  planner->SetErrorTolerance(0.03);
  expectNew("the tolerance", true);
  const auto other = NewPhong(5.0);
  planner->SetBRDF(other);
  expectNew("the material", true);
  const auto white = NewConstantEnvironment(32, 16, 1.0f);
  planner->SetEnvironment(white);
  expectNew("the environment", true);
  SpherePairs pairs;
  pairs.AddRandom(20);
  planner->SetPairs(pairs.Normals, pairs.Views);
  expectNew("what is seen", true);
  expectNew("nothing", false);
}

//------------------------------------------------------------------------------
// A wall that faces the camera needs less than a sphere, and keeps what is promised.
TEST(Planner, PlansForWhatIsSeen)
{
  const auto environment = NewSmallEnvironment(true);
  const auto brdf = NewPhong(60.0);
  const auto planner = NewPlanner(brdf, environment, 0.02);
  ASSERT_TRUE(planner->Update());
  const vtkIdType everywhere = planner->GetTextureBytes(planner->GetChoice());

  SpherePairs wall;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.1, -0.9, 0.3));
  for (int k = 0; k < 64; ++k)
  {
    const glm::dvec3 aside((k % 8 - 3.5) * 0.05, 0.0, (k / 8 - 3.5) * 0.05);
    wall.Add(normal, glm::normalize(normal + aside));
  }
  ASSERT_TRUE(planner->SetPairs(wall.Normals, wall.Views));
  ASSERT_TRUE(planner->Update());
  std::printf("%s\n", planner->GetPlan().c_str());
  const vtkIdType seen = planner->GetTextureBytes(planner->GetChoice());
  EXPECT_LT(seen, everywhere);
  EXPECT_TRUE(planner->GetMeetsTolerance());
  vtkNew<vtkExactRadianceIntegrator> exact;
  exact->SetBRDF(brdf);
  exact->SetEnvironment(environment);
  EXPECT_LE(
    GetRelativeError(wall.Integrate(TakeChoice(planner)), wall.Integrate(exact.Get())), 0.02);

  ASSERT_TRUE(planner->SetPairs(nullptr, nullptr));
  ASSERT_TRUE(planner->Update());
  EXPECT_EQ(planner->GetTextureBytes(planner->GetChoice()), everywhere);
}

//------------------------------------------------------------------------------
TEST(Planner, RefusesPairsThatDoNotFit)
{
  vtkNew<vtkRadiancePlanner> planner;
  ErrorCatcher errors(planner);
  SpherePairs pairs;
  pairs.AddRandom(32);
  ASSERT_TRUE(planner->SetPairs(pairs.Normals, pairs.Views));
  SpherePairs few;
  few.AddRandom(15);
  EXPECT_FALSE(planner->SetPairs(few.Normals, few.Views));
  EXPECT_TRUE(Contains(errors.GetText(), "from 16 to 4096")) << errors.GetText();
  EXPECT_FALSE(planner->SetPairs(pairs.Normals, few.Views));
  EXPECT_FALSE(planner->SetPairs(pairs.Normals, nullptr));
  SpherePairs broken;
  broken.AddRandom(32);
  broken.Normals->SetComponent(7, 1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(planner->SetPairs(broken.Normals, broken.Views));
  EXPECT_TRUE(Contains(errors.GetText(), "pair 7")) << errors.GetText();
}

//------------------------------------------------------------------------------
TEST(Planner, RefusesAndKeepsTheOldPlan)
{
  vtkNew<vtkRadiancePlanner> planner;
  ErrorCatcher errors(planner);
  EXPECT_FALSE(planner->Update());
  EXPECT_TRUE(Contains(errors.GetText(), "no BRDF"));
  const auto brdf = NewPhong(3.0);
  planner->SetBRDF(brdf);
  EXPECT_FALSE(planner->Update());
  EXPECT_TRUE(Contains(errors.GetText(), "no environment"));
  planner->SetEnvironment(vtkNew<vtkEnvironment>());
  EXPECT_FALSE(planner->Update());
  EXPECT_TRUE(Contains(errors.GetText(), "empty"));
  EXPECT_EQ(errors.Take(), 3);
  EXPECT_EQ(planner->GetChoice(), -1);

  const auto environment = NewSmallEnvironment(false);
  planner->SetEnvironment(environment);
  ASSERT_TRUE(planner->Update());
  const std::string plan = planner->GetPlan();
  const auto integrator = TakeChoice(planner);
  planner->SetBRDF(nullptr);
  EXPECT_FALSE(planner->Update());
  planner->SetBRDF(brdf);
  planner->SetEnvironment(nullptr);
  EXPECT_FALSE(planner->Update());
  EXPECT_EQ(errors.Take(), 2);
  EXPECT_EQ(planner->GetPlan(), plan);
  EXPECT_EQ(TakeChoice(planner), integrator);

  // Aborted, then again.
  planner->SetEnvironment(environment);
  brdf->SetExponent(4.0);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* self, unsigned long, void*, void*)
    { static_cast<vtkRadiancePlanner*>(self)->SetAbort(true); });
  const unsigned long tag = planner->AddObserver(vtkCommand::ProgressEvent, stop);
  EXPECT_FALSE(planner->Update());
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_TRUE(Contains(errors.GetText(), "aborted"));
  EXPECT_EQ(planner->GetPlan(), plan);
  planner->RemoveObserver(tag);
  EXPECT_TRUE(planner->Update());
  EXPECT_NE(TakeChoice(planner), integrator);
  EXPECT_EQ(errors.Take(), 0);
}

//------------------------------------------------------------------------------
TEST(Planner, BlackAndTinyEnvironments)
{
  const auto planner = NewPlanner(NewPhong(3.0), NewConstantEnvironment(16, 8, 0.0f), 0.02);
  ASSERT_TRUE(planner->Update());
  EXPECT_TRUE(planner->GetMeetsTolerance());
  EXPECT_EQ(planner->GetPredictedError(planner->GetChoice()), 0.0);
  for (const int height : { 1, 9 })
  {
    const auto tiny = NewConstantEnvironment(1, height, 1.0f);
    planner->SetEnvironment(tiny);
    ASSERT_TRUE(planner->Update());
    std::printf("1 x %d: %s\n", height, planner->GetPlan().c_str());
    EXPECT_GT(planner->GetPredictedError(planner->GetChoice()), 0.0);
    EXPECT_LT(planner->GetPredictedError(planner->GetChoice()), 0.2);
  }
}

//------------------------------------------------------------------------------
TEST(Planner, EvaluateAllListsEveryMethod)
{
  vtkNew<vtkLambertBRDF> brdf;
  const auto environment = NewConstantEnvironment(32, 16, 1.0f);
  const auto planner = NewPlanner(brdf, environment, 0.05);
  ASSERT_TRUE(planner->Update());
  EXPECT_EQ(planner->GetNumberOfCandidates(), 1);
  const std::string description = planner->GetDescription(0);
  planner->EvaluateAllOn();
  planner->SetMaximumTextureBytes(16 << 20); // to be quick
  int events = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&events);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  planner->AddObserver(vtkCommand::ProgressEvent, counter);
  ASSERT_TRUE(planner->Update());
  EXPECT_GE(events, planner->GetNumberOfCandidates()); // and some while it searches
  std::map<std::string, int> methods;
  double lastCost = 0.0;
  vtkIdType lastBytes = 0;
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    std::printf("%-9s %-45s error %.4f, cost %.3f, %9lld bytes, set up %.0f ms\n",
      planner->GetMethodName(k).c_str(), planner->GetDescription(k).c_str(),
      planner->GetPredictedError(k), planner->GetPredictedCost(k),
      static_cast<long long>(planner->GetTextureBytes(k)), planner->GetSetUpMilliseconds(k));
    ++methods[planner->GetMethodName(k)];
    EXPECT_GT(planner->GetTextureBytes(k), 0);
    EXPECT_TRUE(std::isfinite(planner->GetPredictedError(k)));
    // By cost, then by bytes, which each has with the material's textures.
    EXPECT_GE(planner->GetPredictedCost(k), lastCost);
    if (planner->GetPredictedCost(k) == lastCost)
    {
      EXPECT_GE(planner->GetTextureBytes(k), lastBytes);
    }
    lastCost = planner->GetPredictedCost(k);
    lastBytes = planner->GetTextureBytes(k);
    auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator(k));
    ASSERT_TRUE(integrator);
    EXPECT_EQ(integrator->GetBRDF(), brdf.Get());
    EXPECT_EQ(integrator->GetEnvironment(), environment.Get());
  }
  EXPECT_EQ(methods.size(), 3u); // all but the exact sum and hybrids, which want lamps
  EXPECT_EQ(planner->GetDescription(planner->GetChoice()), description); // chooses the same
}

//------------------------------------------------------------------------------
// What is cheap is tried first; costs count fetches and arithmetic, times a table's pixel.
TEST(Planner, CostsAreTimesATables)
{
  vtkNew<vtkLambertBRDF> brdf;
  const auto environment = NewConstantEnvironment(32, 16, 1.0f);
  const auto planner = NewPlanner(brdf, environment, 0.05);
  planner->SetMaximumTextureBytes(2 << 20); // to be quick
  planner->EvaluateAllOn();
  ASSERT_TRUE(planner->Update());
  EXPECT_EQ(planner->GetChoice(), 0); // anything will do
  EXPECT_EQ(planner->GetMethodName(0), "table");
  const auto cost = [&](const std::string& method)
  {
    int k = 0;
    while (k < planner->GetNumberOfCandidates() && planner->GetMethodName(k) != method)
    {
      ++k;
    }
    return planner->GetPredictedCost(k);
  };
  EXPECT_EQ(cost("table"), 1.0);
  EXPECT_NEAR(cost("filtered"), (55.0 + 16.0 * (28.0 + 20.0)) / 107.0, 1e-9);
  EXPECT_NEAR(cost("light-set"), (55.0 + 64.0 * 20.0) / 107.0, 1e-9);
}

//------------------------------------------------------------------------------
TEST(Planner, IndicesWordsAndPrint)
{
  const auto planner = NewPlanner(NewPhong(3.0), NewConstantEnvironment(32, 16, 1.0f), 0.05);
  ASSERT_TRUE(planner->Update());
  for (const int index : { -1, planner->GetNumberOfCandidates(), 1000, -1000 })
  {
    EXPECT_EQ(planner->NewIntegrator(index), nullptr);
    EXPECT_EQ(planner->GetMethodName(index), "");
    EXPECT_EQ(planner->GetDescription(index), "");
    EXPECT_EQ(planner->GetPredictedError(index), 0.0);
    EXPECT_EQ(planner->GetPredictedCost(index), 0.0);
    EXPECT_EQ(planner->GetTextureBytes(index), 0);
    EXPECT_EQ(planner->GetSetUpMilliseconds(index), 0.0);
  }
  const int choice = planner->GetChoice();
  EXPECT_GT(planner->GetSetUpMilliseconds(choice), 0.0);
  EXPECT_TRUE(vtkTableRadianceIntegrator::SafeDownCast(TakeChoice(planner)));
  EXPECT_TRUE(Contains(planner->GetPlan(), "table, ")) << planner->GetPlan();
  EXPECT_TRUE(Contains(planner->GetPlan(), planner->GetDescription(choice)));
  EXPECT_TRUE(Contains(planner->GetPlan(), planner->GetReason()));
  EXPECT_TRUE(Contains(planner->GetDescription(choice), "17 rows x 8 view angles x 8 azimuths"));

  planner->SetErrorTolerance(0.0);
  EXPECT_EQ(planner->GetErrorTolerance(), 1e-3);
  planner->SetErrorTolerance(7.0);
  EXPECT_EQ(planner->GetErrorTolerance(), 1.0);
  std::ostringstream text;
  planner->Print(text);
  for (const char* part : { "ErrorTolerance: 1\n", "EvaluateAll: Off",
         "MaximumTextureBytes: 25165824", "Plan: table, 17 rows" })
  {
    EXPECT_TRUE(Contains(text.str(), part)) << part;
  }
}
