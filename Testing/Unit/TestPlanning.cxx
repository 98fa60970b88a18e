// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Plans: whether they keep what they promise, and when they are made.

#include "ErrorCatcher.h"
#include "SpherePairs.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFGPUForm.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSetIntegrator.h"
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
    ShrinkEnvironment(environment, 64, 32);
    SpherePairs pairs; // many: one highlight is a third of a gloss's error over 1000 of them
    pairs.AddRandom(3000, 11);
    const auto reference = pairs.IntegrateExactly(brdf, environment);
    double lastCost = 0.0;
    vtkIdType lastBytes = 0;
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
      // Never less for more accuracy.
      EXPECT_GE(planner->GetPredictedMilliseconds(choice), lastCost);
      EXPECT_GE(planner->GetTextureBytes(choice), lastBytes);
      lastCost = planner->GetPredictedMilliseconds(choice);
      lastBytes = planner->GetTextureBytes(choice);
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
    EXPECT_GE(planner->GetPredictedError(k), planner->GetPredictedError(planner->GetChoice()));
  }
}

//------------------------------------------------------------------------------
TEST(Planner, AnisotropicMaterialsGetLightSets)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(5.0, 20.0);
  const auto planner = NewPlanner(brushed, NewSmallEnvironment(false), 0.2);
  ASSERT_TRUE(planner->Update());
  std::printf("%s\n", planner->GetPlan().c_str());
  EXPECT_EQ(planner->GetMethod(planner->GetChoice()), vtkRadiancePlanner::LIGHT_SET);
  EXPECT_TRUE(vtkLightSetIntegrator::SafeDownCast(TakeChoice(planner)));
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    EXPECT_EQ(planner->GetMethodName(k), "light-set");
  }
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
    vtkBRDFGPUForm form;
    ASSERT_TRUE(TakeChoice(planner)->GetGPUForm(form));
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
  planner->SetViewDirection(0.0, 0.0, 1.0);
  expectNew("the view", true);
  expectNew("nothing", false);
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
  planner->SetMaximumTextureBytes(8 << 20); // to be quick
  int events = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&events);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  planner->AddObserver(vtkCommand::ProgressEvent, counter);
  ASSERT_TRUE(planner->Update());
  EXPECT_EQ(events, planner->GetNumberOfCandidates());
  int methods[5] = { 0, 0, 0, 0, 0 };
  double lastOrder = 0.0;
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    std::printf("%-9s %-45s error %.4f, %6.1f ms, %9lld bytes, set up %.0f ms\n",
      planner->GetMethodName(k).c_str(), planner->GetDescription(k).c_str(),
      planner->GetPredictedError(k), planner->GetPredictedMilliseconds(k),
      static_cast<long long>(planner->GetTextureBytes(k)), planner->GetSetUpMilliseconds(k));
    ++methods[planner->GetMethod(k)];
    EXPECT_GT(planner->GetTextureBytes(k), 0);
    EXPECT_TRUE(std::isfinite(planner->GetPredictedError(k)));
    // A megabyte counts as 10 ns a pixel.
    const double order = planner->GetPredictedMilliseconds(k) /
                           (1e-6 * static_cast<double>(planner->GetNumberOfPixels())) +
                         1e-5 * static_cast<double>(planner->GetTextureBytes(k));
    EXPECT_GE(order, lastOrder);
    lastOrder = order;
    auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator(k));
    ASSERT_TRUE(integrator);
    EXPECT_EQ(integrator->GetBRDF(), brdf.Get());
    EXPECT_EQ(integrator->GetEnvironment(), environment.Get());
  }
  for (const int count : methods)
  {
    EXPECT_GT(count, 0);
  }
  EXPECT_EQ(planner->GetDescription(planner->GetChoice()), description); // chooses the same
}

//------------------------------------------------------------------------------
TEST(Planner, IndicesWordsAndPrint)
{
  const auto planner = NewPlanner(NewPhong(3.0), NewConstantEnvironment(32, 16, 1.0f), 0.05);
  ASSERT_TRUE(planner->Update());
  for (const int index : { -1, planner->GetNumberOfCandidates(), 1000, -1000 })
  {
    EXPECT_EQ(planner->NewIntegrator(index), nullptr);
    EXPECT_EQ(planner->GetMethod(index), -1);
    EXPECT_EQ(planner->GetMethodName(index), "");
    EXPECT_EQ(planner->GetDescription(index), "");
    EXPECT_EQ(planner->GetPredictedError(index), 0.0);
    EXPECT_EQ(planner->GetPredictedMilliseconds(index), 0.0);
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
         "MaximumTextureBytes: 100663296", "NumberOfPixels: 196350", "Plan: table, 17 rows" })
  {
    EXPECT_TRUE(Contains(text.str(), part)) << part;
  }
}
