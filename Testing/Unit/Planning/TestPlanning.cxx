// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Plans: whether they keep what they promise, and when they are made.
#include "AnisotropicWarp.h"
#include "ErrorCatcher.h"
#include "NumberText.h"
#include "RandomLight.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDistributionBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOcclusionPredictor.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadianceMethods.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkSumBRDF.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTracedScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
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
    const auto exact = NewExactSum(brdf, environment);
    exact->SetInLanes(true); // single precision is enough
    const auto reference = pairs.Integrate(exact);
    double lastCost = 0.0;
    for (const double tolerance : { 0.05, 0.02 })
    {
      const auto planner = NewPlanner(brdf, environment, tolerance);
      ASSERT_TRUE(planner->Update());
      const int choice = planner->GetChoice();
      const double predicted = planner->GetPredictedError(choice);
      const double actual = GetRelativeError(pairs.Integrate(TakeChoice(planner)), reference);
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
  testing::Values("blue-fabric", "gold-paint", "delrin"),
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
  vtkNew<vtkEnvironment> environments[2]; // without and with a sun
  for (const bool sun : { false, true })
  {
    std::vector<float> pixels(3 * 256 * 128);
    for (std::size_t k = 0; k < pixels.size(); ++k)
    {
      const std::size_t x = k / 3 % 256;
      const std::size_t y = k / 3 / 256;
      const bool isPanel = x >= 100 && x < 140 && y >= 70 && y < 95;
      pixels[k] = sun && x == 60 && y == 100 ? 2e4f : isPanel ? 8.0f : 0.2f;
    }
    environments[sun]->SetPixels(256, 128, pixels);
  }
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
         Case{ false, 10000.0, 0.02, little, "filtered, 64 samples" },
         Case{ false, 10000.0, 0.012, little, "filtered, 256 samples" } })
  {
    const auto planner =
      NewPlanner(NewPhong(rung.Exponent), environments[rung.Sun], rung.Tolerance);
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
  const vtkIdType seen = planner->GetTextureBytes(planner->GetChoice());
  EXPECT_LT(seen, everywhere);
  EXPECT_TRUE(planner->GetMeetsTolerance());
  EXPECT_LE(
    GetRelativeError(wall.Integrate(TakeChoice(planner)), wall.IntegrateExactly(brdf, environment)),
    0.02);

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
  EXPECT_TRUE(Contains(errors.GetText(), "from 16 to 16384")) << errors.GetText();
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

//------------------------------------------------------------------------------
// The list of methods: what each says of itself, copies, and methods of a program's own.
namespace
{
/// What a Lambert material of albedo 0.5 reflects of white light; half of that in one step.
class WhiteMethod : public vtkRadianceIntegrator
{
public:
  static WhiteMethod* New();
  vtkTypeMacro(WhiteMethod, vtkRadianceIntegrator);
  std::string GetMethodName() override { return this->Name; }
  std::vector<Size> GetSizes() override
  {
    const auto set = [this](int value)
    {
      this->Steps = value;
      this->Modified();
    };
    return { { "steps", 1, 4, this->Steps, set } };
  }
  std::vector<std::vector<int>> GetCandidateSizes(bool) override { return { { 1 }, { 2 } }; }
  double EstimateCost() override { return 0.1 * this->Steps; }
  std::string Name = "white";
  bool Works = true;

protected:
  void CopyProperties(vtkRadianceIntegrator* source) override
  {
    this->Superclass::CopyProperties(source);
    auto* white = static_cast<WhiteMethod*>(source);
    this->Name = white->Name;
    this->Works = white->Works;
  }
  bool Begin() override
  {
    if (!this->Works)
    {
      vtkErrorMacro("Prepare: out of white.");
    }
    return this->Works;
  }
  void IntegratePair(const double[3], const double[3], const double[3], double radiance[3]) override
  {
    for (int c = 0; c < 3; ++c)
    {
      radiance[c] += this->Steps > 1 ? 0.5 : 0.25;
    }
  }
  int Steps = 1;
};
vtkStandardNewMacro(WhiteMethod);

/// In the list while it lives.
class Registered
{
public:
  explicit Registered(vtkRadianceIntegrator* method)
    : Method(method)
    , Done(vtkRadianceMethods::Register(method))
  {
  }
  ~Registered() { vtkRadianceMethods::Unregister(this->Method); }
  vtkRadianceIntegrator* Method;
  bool Done;
};

std::map<std::string, std::string> GetProperties(vtkObject* object)
{
  std::ostringstream text;
  object->Print(text);
  std::istringstream lines(text.str());
  std::map<std::string, std::string> properties;
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos)
    {
      properties[line.substr(line.find_first_not_of(' '), colon - line.find_first_not_of(' '))] =
        line.substr(colon + 2);
    }
  }
  return properties;
}

// Every property but what belongs to the object, its inputs and its last run.
void ExpectCopied(vtkRadianceIntegrator* changed, const std::set<std::string>& results)
{
  const auto copy = vtkSmartPointer<vtkRadianceIntegrator>::Take(changed->NewCopy());
  const auto fresh = vtkSmartPointer<vtkRadianceIntegrator>::Take(changed->NewInstance());
  const auto set = GetProperties(changed);
  const auto copied = GetProperties(copy);
  const auto defaults = GetProperties(fresh);
  const std::set<std::string> others = { "Debug", "Modified Time", "Reference Count",
    "Registered Events", "BRDF", "Environment", "Abort" };
  int compared = 0;
  for (const auto& [name, value] : set)
  {
    if (others.count(name) > 0 || results.count(name) > 0)
    {
      continue;
    }
    ++compared;
    EXPECT_NE(value, defaults.at(name)) << name << " is not set by this test";
    EXPECT_EQ(value, copied.at(name)) << name << " is not copied";
  }
  EXPECT_GT(compared, 0);
}

vtkSmartPointer<vtkRadiancePlanner> NewPlanner()
{
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(0.5, 0.5, 0.5);
  vtkNew<vtkEnvironment> white;
  white->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 1.0f));
  auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
  planner->SetBRDF(brdf);
  planner->SetEnvironment(white);
  planner->SetErrorTolerance(0.05);
  return planner;
}
}

//------------------------------------------------------------------------------
TEST(RadianceMethods, SayWhatTheyAre)
{
  EXPECT_EQ(vtkRadianceMethods::GetNames(), "table, hybrid, light-set, filtered or reference");
  for (const auto& method : vtkRadianceMethods::GetMethods())
  {
    const std::string name = method->GetMethodName();
    EXPECT_TRUE(vtkRadianceMethods::IsBuiltIn(name));
    EXPECT_NE(method->GetMethodDescription(), "") << name;
    const auto made =
      vtkSmartPointer<vtkRadianceIntegrator>::Take(vtkRadianceMethods::NewIntegrator(name));
    ASSERT_TRUE(made);
    EXPECT_STREQ(made->GetClassName(), method->GetClassName());
    EXPECT_NE(made.Get(), method.Get());
    // The ends of each range are taken as they are; what lies outside changes nothing.
    std::vector<int> values;
    for (const auto& size : made->GetSizes())
    {
      values.push_back(size.Value);
    }
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      const auto size = made->GetSizes()[k];
      std::vector<int> other = values;
      for (const int end : { size.Least, size.Largest })
      {
        other[k] = end;
        EXPECT_TRUE(made->SetSizes(other)) << name << " " << size.Name;
        EXPECT_EQ(made->GetSizes()[k].Value, end) << name << " " << size.Name;
      }
      ErrorCatcher errors(made);
      for (const int wrong : { size.Least - 1, size.Largest + 1 })
      {
        other[k] = wrong;
        EXPECT_FALSE(made->SetSizes(other)) << name << " " << size.Name;
        EXPECT_EQ(made->GetSizes()[k].Value, size.Largest);
      }
      EXPECT_EQ(errors.Take(), 2);
      made->SetSizes(values);
    }
    ErrorCatcher errors(made);
    values.push_back(1);
    EXPECT_FALSE(made->SetSizes(values)) << name;
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_GT(made->EstimateCost(), 0.0) << name;
  }
  EXPECT_EQ(vtkRadianceMethods::NewIntegrator("none"), nullptr);
}

//------------------------------------------------------------------------------
TEST(RadianceMethods, CopiesHaveEveryProperty)
{
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetNumberOfRows(21);
  table->SetNumberOfViewAngles(5);
  table->SetNumberOfAzimuths(6);
  table->SetNumberOfViewAzimuths(7);
  table->SetNumberOfMaps(3);
  table->SetNumberOfMapRows(33);
  table->SetNumberOfNodes(40);
  table->QuickOn();
  ExpectCopied(table, {});

  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  hybrid->SetNumberOfRows(21);
  hybrid->SetNumberOfViewAngles(5);
  hybrid->SetNumberOfAzimuths(6);
  hybrid->SetNumberOfMaps(3);
  hybrid->SetMaximumNumberOfLights(7);
  hybrid->SetLightAngle(0.33);
  hybrid->QuickOn();
  ExpectCopied(hybrid, { "Lights" });
  vtkNew<vtkFilteredRadianceIntegrator> filtered;
  filtered->SetNumberOfSamples(5);
  ExpectCopied(filtered, { "Extracted lights" });
  vtkNew<vtkLightSetRadianceIntegrator> lights;
  lights->SetGenerator(vtkNew<vtkLightSetGenerator>());
  lights->SetNumberOfLights(32);
  lights->SetLightSet(vtkNew<vtkLightSet>());
  lights->SoftLightsOn();
  lights->UnrolledOn();
  ExpectCopied(lights, { "CurrentLightSet" });
}

//------------------------------------------------------------------------------
TEST(RadianceMethods, RegisterRefuses)
{
  vtkNew<WhiteMethod> method;
  vtkObject::GlobalWarningDisplayOff();
  EXPECT_FALSE(vtkRadianceMethods::Register(nullptr));
  for (const char* name : { "table", "Two words", "", "caf\xc3\xa9" })
  {
    method->Name = name;
    EXPECT_FALSE(vtkRadianceMethods::Register(method)) << name;
  }
  method->Name = "white";
  EXPECT_TRUE(vtkRadianceMethods::Register(method));
  EXPECT_FALSE(vtkRadianceMethods::Register(method));
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_FALSE(vtkRadianceMethods::IsBuiltIn("white"));
  EXPECT_NE(vtkRadianceMethods::GetNames().find("white"), std::string::npos);
  EXPECT_TRUE(vtkRadianceMethods::Unregister(method));
  EXPECT_FALSE(vtkRadianceMethods::Unregister(method));
  EXPECT_EQ(vtkRadianceMethods::NewIntegrator("white"), nullptr);
}

//------------------------------------------------------------------------------
// Of a program's own method, sizes that are too coarse are tried and passed over.
TEST(RadianceMethods, PlannersTryThem)
{
  const auto planner = NewPlanner();
  ASSERT_TRUE(planner->Update());
  EXPECT_EQ(planner->GetMethodName(planner->GetChoice()), "table");
  vtkNew<WhiteMethod> method;
  const Registered registered(method);
  ASSERT_TRUE(registered.Done);
  planner->SetErrorTolerance(0.04); // a change: it plans again
  ASSERT_TRUE(planner->Update());
  ASSERT_EQ(planner->GetNumberOfCandidates(), 2);
  EXPECT_EQ(planner->GetDescription(0), "1 steps");
  EXPECT_NEAR(planner->GetPredictedError(0), 0.5, 0.03);
  EXPECT_EQ(planner->GetPredictedCost(0), 0.1);
  EXPECT_EQ(planner->GetDescription(1), "2 steps");
  EXPECT_NEAR(planner->GetPredictedError(1), 0.0, 0.02);
  ASSERT_EQ(planner->GetChoice(), 1);
  EXPECT_EQ(planner->GetMethodName(1), "white");
  const auto made = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
  EXPECT_TRUE(WhiteMethod::SafeDownCast(made));
}

//------------------------------------------------------------------------------
TEST(RadianceMethods, WhatFailsIsLeftOutWithAWarning)
{
  const auto planner = NewPlanner();
  vtkNew<WhiteMethod> method;
  method->Works = false;
  const Registered registered(method);
  std::string said;
  vtkNew<vtkCallbackCommand> listen;
  listen->SetClientData(&said);
  listen->SetCallback([](vtkObject*, unsigned long, void* data, void* text)
    { *static_cast<std::string*>(data) += static_cast<const char*>(text); });
  planner->AddObserver(vtkCommand::WarningEvent, listen);
  ASSERT_TRUE(planner->Update());
  EXPECT_EQ(planner->GetMethodName(planner->GetChoice()), "table");
  EXPECT_NE(said.find("white, 1 steps"), std::string::npos) << said;
  EXPECT_NE(said.find("out of white"), std::string::npos) << said;
}

//------------------------------------------------------------------------------
// Maps may be in any unit: a factor on the light is a factor on what every method shows.
namespace
{
// A bright matte base, and gloss.
vtkSmartPointer<vtkSumBRDF> NewCoat(double exponent)
{
  vtkNew<vtkLambertBRDF> base;
  base->SetAlbedo(0.8, 0.4, 0.2);
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetSpecular(0.1, 0.1, 0.1);
  gloss->SetExponent(exponent);
  auto coat = vtkSmartPointer<vtkSumBRDF>::New();
  coat->AddTerm(base);
  coat->AddTerm(gloss);
  return coat;
}

vtkSmartPointer<vtkSumBRDF> NewBrushedCoat()
{
  vtkNew<vtkLambertBRDF> base;
  base->SetAlbedo(0.8, 0.4, 0.2);
  auto coat = vtkSmartPointer<vtkSumBRDF>::New();
  coat->AddTerm(base);
  coat->AddTerm(NewBrushedMetal(0.15, 0.4));
  return coat;
}

std::vector<glm::dvec3> Times(std::vector<glm::dvec3> radiance, double factor)
{
  for (glm::dvec3& rgb : radiance)
  {
    rgb *= factor;
  }
  return radiance;
}

// A method with the first sizes that a planner would try; null where it is not for the material.
vtkSmartPointer<vtkRadianceIntegrator> NewMethod(
  vtkRadianceIntegrator* method, vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto copy = vtkSmartPointer<vtkRadianceIntegrator>::Take(method->NewCopy());
  copy->SetBRDF(brdf);
  copy->SetEnvironment(environment);
  const auto sizes = copy->GetCandidateSizes(true);
  const bool isReference = copy->GetSizes().empty(); // adaptive, exact
  if (!isReference && (sizes.empty() || !copy->SetSizes(sizes.front())))
  {
    return nullptr;
  }
  return copy;
}
}

//------------------------------------------------------------------------------
TEST(LightUnits, ScaleEveryMethodsRadiance)
{
  const auto sky = NewSmallEnvironment(false);
  SpherePairs pairs;
  pairs.AddRandom(60);
  const std::vector<vtkSmartPointer<vtkBRDF>> materials = { NewCoat(300.0), NewBrushedCoat() };
  int tried = 0;
  for (const auto& material : materials)
  {
    for (const auto& method : vtkRadianceMethods::GetMethods())
    {
      const auto integrator = NewMethod(method, material, sky);
      if (!integrator)
      {
        continue;
      }
      const auto expected = pairs.Integrate(integrator);
      vtkBRDFShaderInputs inputs;
      integrator->GetShaderInputs(inputs);
      for (const double unit : LightUnits)
      {
        if (unit < 1.0 && !material->IsIsotropic())
        {
          continue; // its tables take most of the time
        }
        const auto light = NewScaledLight(sky, unit);
        const auto scaled = NewMethod(method, material, light);
        const auto found = Times(pairs.Integrate(scaled), 1.0 / unit);
        EXPECT_LT(GetRelativeError(found, expected), 1e-6)
          << method->GetMethodName() << ", times " << unit;
        vtkBRDFShaderInputs others;
        scaled->GetShaderInputs(others);
        EXPECT_EQ(others.Description, inputs.Description);
        EXPECT_EQ(others.GetShaderKey(), inputs.GetShaderKey()) << method->GetMethodName();
        EXPECT_EQ(others.GetTextureBytes(), inputs.GetTextureBytes()) << method->GetMethodName();
        EXPECT_EQ(others.QuantizationError, inputs.QuantizationError) << method->GetMethodName();
        ++tried;
      }
    }
  }
  EXPECT_GE(tried, 13);
}

//------------------------------------------------------------------------------
// Light of one radiance from everywhere, however faint or strong; and a sun in a dim sky: what
// faces away from it keeps its digits.
TEST(LightUnits, ReachFromFaintToStrong)
{
  vtkNew<vtkLambertBRDF> matte;
  matte->SetAlbedo(0.8, 0.4, 0.2);
  SpherePairs pairs;
  pairs.AddRandom(20);
  for (const float radiance : { 1e-20f, 1e-9f, 1e-7f, 2e4f, 3e4f, 1e12f })
  {
    const auto constant = NewConstantEnvironment(64, 32, radiance);
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(matte);
    planner->SetEnvironment(constant);
    ASSERT_TRUE(planner->Update());
    const auto chosen = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
    for (const glm::dvec3& rgb : pairs.Integrate(chosen))
    {
      const glm::dvec3 share = rgb / static_cast<double>(radiance);
      EXPECT_NEAR(share.x, 0.8, 0.004) << radiance;
      EXPECT_NEAR(share.y, 0.4, 0.004) << radiance;
      EXPECT_NEAR(share.z, 0.2, 0.004) << radiance;
    }
  }
  vtkNew<vtkEnvironment> sunny;
  std::vector<float> pixels(3 * 256 * 128, 1.0f);
  std::fill_n(pixels.begin() + 3 * (256 * 100 + 60), 3, 4e6f);
  sunny->SetPixels(256, 128, pixels);
  double sun[3];
  sunny->GetTexelDirection(60, 100, sun);
  SpherePairs away;
  for (const double sine : { 0.0, 0.2, -0.3 })
  {
    const glm::dvec3 back = -glm::dvec3(sun[0], sun[1], sun[2]);
    const glm::dvec3 side = glm::normalize(glm::cross(back, glm::dvec3(1.0, 0.0, 0.0)));
    away.Add(glm::normalize(back + sine * side), back);
  }
  const auto exact = away.IntegrateExactly(matte, sunny);
  for (const double unit : LightUnits)
  {
    const auto light = NewScaledLight(sunny, unit);
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(matte);
    planner->SetEnvironment(light);
    ASSERT_TRUE(planner->Update());
    const auto chosen = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
    const auto found = Times(away.Integrate(chosen), 1.0 / unit);
    EXPECT_LT(GetRelativeError(found, exact), 0.01) << unit << ": " << planner->GetPlan();
  }
}

//------------------------------------------------------------------------------
// What leaving occlusion out costs: predicted from few points, against many and closed forms.
namespace
{
vtkSmartPointer<vtkPolyData> MakeTorus()
{
  vtkNew<vtkParametricTorus> torus;
  torus->SetCrossSectionRadius(0.7);
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(torus);
  source->Update();
  return source->GetOutput();
}

class OcclusionPredictor : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Sky->SetToProceduralSky();
    this->Predictor->SetScene(this->Scene);
    this->Predictor->SetBRDF(this->White);
    this->Predictor->SetEnvironment(this->Sky);
  }

  vtkNew<vtkTracedScene> Scene;
  vtkNew<vtkLambertBRDF> White;
  vtkNew<vtkEnvironment> Sky;
  vtkNew<vtkOcclusionPredictor> Predictor;
};

// From its own events, as from another thread: the last prediction stays.
TEST_F(OcclusionPredictor, Aborts)
{
  const auto torus = MakeTorus();
  this->Scene->AddSurface(torus);
  ASSERT_TRUE(this->Predictor->Update());
  const double error = this->Predictor->GetError();
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkOcclusionPredictor*>(caller)->SetAbort(true); });
  this->Predictor->AddObserver(vtkCommand::ProgressEvent, stop);
  this->Predictor->SetNumberOfPoints(5000);
  ErrorCatcher errors(this->Predictor);
  EXPECT_FALSE(this->Predictor->Update());
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_EQ(this->Predictor->GetError(), error);
  EXPECT_FALSE(this->Predictor->Update()); // until it is false again
  this->Predictor->RemoveAllObservers();
  this->Predictor->SetAbort(false);
  EXPECT_TRUE(this->Predictor->Update());
  EXPECT_NE(this->Predictor->GetError(), error);
}

// A half sphere under a white sky: half of the light is hidden from its inside, which cameras see
// half as much of as of its outside. So the error is 0.25 of 1.25.
TEST_F(OcclusionPredictor, ABowl)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(120);
  sphere->SetPhiResolution(60);
  sphere->SetStartPhi(90.0);
  sphere->Update();
  vtkNew<vtkPolyData> bowl;
  bowl->ShallowCopy(sphere->GetOutput());
  bowl->GetPointData()->SetNormals(nullptr);
  this->Scene->AddSurface(bowl);
  this->Sky->SetPixels(64, 32, std::vector<float>(3 * 64 * 32, 1.0f));
  ASSERT_TRUE(this->Predictor->Update());
  EXPECT_NEAR(this->Predictor->GetError(), 0.2, 0.03);
  EXPECT_LT(this->Predictor->GetUncertainty(), 0.05);
}

// The default's prediction and uncertainty, against 20 times as many points.
TEST_F(OcclusionPredictor, FewPointsForetellMany)
{
  const vtkSmartPointer<vtkPolyData> torus = MakeTorus();
  this->Scene->AddSurface(torus);
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetExponent(50.0);
  vtkNew<vtkEnvironment> hall;
  hall->SetToProceduralHall();
  for (const bool isGloss : { false, true })
  {
    vtkNew<vtkOcclusionPredictor> predictor;
    predictor->SetScene(this->Scene);
    predictor->SetBRDF(isGloss ? static_cast<vtkBRDF*>(gloss) : this->White);
    predictor->SetEnvironment(isGloss ? hall : this->Sky);
    ASSERT_TRUE(predictor->Update());
    const double error = predictor->GetError();
    const double uncertainty = predictor->GetUncertainty();
    predictor->SetNumberOfPoints(8000);
    ASSERT_TRUE(predictor->Update());
    EXPECT_LT(std::abs(std::log(error / predictor->GetError())), std::log(1.5));
    EXPECT_LT(std::abs(error - predictor->GetError()), 2.0 * uncertainty);
    EXPECT_LT(predictor->GetUncertainty(), uncertainty);
  }
}

TEST_F(OcclusionPredictor, Decision)
{
  EXPECT_FALSE(vtkOcclusionPredictor::IsWorthModeling(0.009, 0.015, 0.02));
  EXPECT_TRUE(vtkOcclusionPredictor::IsWorthModeling(0.021, 0.0, 0.02));
  EXPECT_TRUE(vtkOcclusionPredictor::IsWorthModeling(0.014, 0.015, 0.02)); // 0.0132 is left
  EXPECT_FALSE(vtkOcclusionPredictor::IsWorthModeling(0.009, 0.05, 0.02)); // a bad plan
  EXPECT_TRUE(vtkOcclusionPredictor::IsWorthModeling(0.011, 0.05, 0.02));
  EXPECT_EQ(vtkOcclusionPredictor::FormatText(0.0921, 0.0104),
    "unoccluded light: 9.2 % on this surface (+- 1 %)");
}

TEST_F(OcclusionPredictor, NothingToSee)
{
  vtkNew<vtkPolyData> nothing;
  this->Scene->AddSurface(nothing);
  this->Predictor->SetScene(nullptr);
  {
    ErrorCatcher errors(this->Predictor);
    EXPECT_FALSE(this->Predictor->Update());
    EXPECT_EQ(errors.Take(), 1);
  }
  this->Predictor->SetScene(this->Scene);
  ASSERT_TRUE(this->Predictor->Update());
  EXPECT_EQ(this->Predictor->GetError(), 0.0);
}
} // namespace
