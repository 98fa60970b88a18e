// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What holds for every method: bad inputs, aborts, frames, low views, black light, changed inputs.

#include "ErrorCatcher.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkCallbackCommand.h"
#include "vtkDistributionBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkTableRadianceIntegrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{
struct Method
{
  const char* Name;
  std::function<vtkSmartPointer<vtkRadianceIntegrator>()> New;
  std::vector<int> Sizes;      // small ones
  std::vector<int> OtherSizes; // the same with one of them changed
  bool IsIsotropic;            // takes no other materials
  double TurnTolerance = 1e-9;
  double Stretch = 1.0;        // of the material's lobe
  std::vector<int> Fine = {};  // sizes for
  double FurnaceError = 0.003; // this error; 0: not for sharp lobes
};

template <typename T>
vtkSmartPointer<vtkRadianceIntegrator> NewOf()
{
  return vtkSmartPointer<T>::New();
}

vtkSmartPointer<vtkRadianceIntegrator> NewFactoredTable()
{
  auto table = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
  table->SetNumberOfMaps(4);
  table->SetNumberOfMapRows(32);
  return table;
}

const Method Methods[] = {
  { "table", NewOf<vtkTableRadianceIntegrator>, { 17, 8, 8 }, { 17, 8, 10 }, false },
  { "anisotropic", NewOf<vtkTableRadianceIntegrator>, { 13, 4, 8, 4 }, { 13, 4, 8, 5 }, false, 1e-9,
    2.0 },
  { "factored", NewFactoredTable, { 17, 6, 8 }, { 17, 6, 10 }, true, 1e-9, 1.0, { 33, 12, 8 },
    0.01 },
  { "hybrid", NewOf<vtkHybridRadianceIntegrator>, { 32, 6, 8, 4 }, { 32, 6, 8, 2 }, true, 1e-9, 1.0,
    { 33, 12, 16, 0 }, 0.004 },
  // The map is read in floats.
  { "filtered", NewOf<vtkFilteredRadianceIntegrator>, { 32 }, { 2 }, true, 1e-5, 1.0, { 1024 },
    0.03 },
  { "lights", NewOf<vtkLightSetRadianceIntegrator>, { 16 }, { 8 }, false, 1e-9, 1.0, {}, 0.0 },
  { "adaptive", NewOf<vtkAdaptiveRadianceIntegrator>, {}, {}, false },
};

class EveryMethod : public testing::TestWithParam<Method>
{
protected:
  vtkSmartPointer<vtkRadianceIntegrator> Make(vtkBRDF* brdf, vtkEnvironment* environment) const
  {
    auto made = GetParam().New();
    EXPECT_TRUE(made->SetSizes(GetParam().Sizes));
    made->SetBRDF(brdf);
    made->SetEnvironment(environment);
    return made;
  }
};
} // namespace

//------------------------------------------------------------------------------
TEST_P(EveryMethod, RefusesAndKeepsGoing)
{
  const auto method = this->Make(nullptr, nullptr);
  ErrorCatcher errors(method);
  vtkBRDFShaderInputs inputs;
  inputs.Description = "mine";
  const auto expectProblem = [&](const char* problem)
  {
    EXPECT_FALSE(method->Prepare());
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_NE(errors.GetText().find(problem), std::string::npos) << errors.GetText();
    EXPECT_FALSE(method->GetShaderInputs(inputs));
    EXPECT_EQ(inputs.Description, "mine");
    errors.Take();
  };
  expectProblem("no BRDF");
  const auto brushed = NewCoating(10.0, GetParam().Stretch);
  brushed->SetExponents(10.0, 100.0);
  brushed->SetName("brushed steel");
  method->SetBRDF(brushed);
  expectProblem("no environment");
  method->SetEnvironment(vtkNew<vtkEnvironment>()); // empty
  expectProblem("");
  const auto environment = NewSmallEnvironment(true);
  method->SetEnvironment(environment);
  if (GetParam().IsIsotropic)
  {
    expectProblem("'brushed steel'");
    brushed->SetName("");
    expectProblem("isotropic");
    brushed->SetExponents(20.0, 20.0);
  }

  // Stopped where it asks, it says so, and works again.
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* self, unsigned long, void*, void*)
    { static_cast<vtkRadianceIntegrator*>(self)->SetAbort(true); });
  SpherePairs pairs;
  pairs.AddRandom(12);
  vtkNew<vtkDoubleArray> radiance;
  const unsigned long tag = method->AddObserver(vtkCommand::ProgressEvent, stop);
  EXPECT_FALSE(method->Integrate(pairs.Normals, pairs.Views, radiance));
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(errors.GetText().find("aborted"), std::string::npos) << errors.GetText();
  EXPECT_EQ(radiance->GetNumberOfTuples(), 0);
  method->RemoveObserver(tag);
  EXPECT_EQ(pairs.Integrate(method), pairs.Integrate(this->Make(brushed, environment)));
  EXPECT_EQ(errors.Take(), 0);
}

//------------------------------------------------------------------------------
TEST_P(EveryMethod, TurnsWithItsEnvironment)
{
  const auto environment = NewSmallEnvironment(true);
  const auto coat = NewCoating(50.0, GetParam().Stretch);
  SpherePairs pairs;
  pairs.AddRandom(30);
  ExpectTurnsWithItsEnvironment(this->Make(coat, environment), pairs, GetParam().TurnTolerance);
}

//------------------------------------------------------------------------------
// cos(theta_o) is at least 0.02, at any azimuth; below the horizon there is nothing.
TEST_P(EveryMethod, LowViewsAreLifted)
{
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.2, 1.0, -0.4));
  const glm::dvec3 u = glm::normalize(glm::cross(n, glm::dvec3(1.0, 0.0, 0.0)));
  SpherePairs pairs;
  for (const glm::dvec3& along : { u, glm::normalize(u + 2.0 * glm::cross(n, u)) })
  {
    for (const double cosine : { 0.02, 0.0199, 0.01, 1e-4, 1e-9, -1e-9, -0.3 })
    {
      pairs.Add(1e-200 * n, 1e200 * (std::sqrt(1.0 - cosine * cosine) * along + cosine * n));
    }
  }
  const auto radiance = pairs.Integrate(
    this->Make(NewCoating(50.0, GetParam().Stretch), NewConstantEnvironment(16, 8, 1.0f)));
  for (std::size_t k = 0; k < radiance.size(); ++k)
  {
    const double expected = k % 7 < 5 ? radiance[k / 7 * 7].y : 0.0;
    EXPECT_NEAR(radiance[k].y, expected, 1e-9 * expected) << k;
  }
  EXPECT_GT(radiance[0].y, 0.0);
}

//------------------------------------------------------------------------------
// The same radiance from everywhere, in maps of few and of many texels: the directional albedo, at
// views of tables and between them.
TEST_P(EveryMethod, WhiteFurnaceIsTheDirectionalAlbedo)
{
  if (GetParam().Stretch != 1.0 || GetParam().FurnaceError == 0.0)
  {
    GTEST_SKIP() << "AnisotropicTable has its own, and sums over points miss sharp lobes";
  }
  vtkNew<vtkLambertBRDF> matte;
  vtkNew<vtkDistributionBRDF> distribution;
  std::vector<vtkSmartPointer<vtkBRDF>> materials{ NewCoating(50.0, GetParam().Stretch).Get(),
    matte.Get(), distribution.Get() };
  for (const char* name : { "blue-fabric", "nickel" })
  {
    materials.push_back(vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name)));
  }
  for (vtkBRDF* brdf : materials)
  {
    const FurnacePairs pairs(brdf, 2.0, { 0.0, 17.0, 41.0, 63.0, 78.0, 85.0 });
    for (const int height : { 1, 64 })
    {
      if (height == 1 && brdf != materials.front())
      {
        continue; // what few texels change is the light
      }
      const auto method = this->Make(brdf, NewConstantEnvironment(2 * height, height, 2.0f));
      method->SetSizes(GetParam().Fine);
      EXPECT_LT(pairs.GetLargestError(method), GetParam().FurnaceError)
        << brdf->GetClassName() << " " << brdf->GetName() << ", " << height;
    }
  }
}

//------------------------------------------------------------------------------
TEST_P(EveryMethod, BlackAndTinyEnvironments)
{
  SpherePairs pairs;
  pairs.AddRandom(8);
  const auto coat = NewCoating(20.0, GetParam().Stretch);
  for (const glm::dvec3& rgb :
    pairs.Integrate(this->Make(coat, NewConstantEnvironment(16, 8, 0.0f))))
  {
    EXPECT_EQ(rgb, glm::dvec3(0.0));
  }
  const int sizes[][2] = { { 1, 1 }, { 1, 7 }, { 65, 1 } };
  for (const auto& size : sizes)
  {
    const auto environment = NewConstantEnvironment(size[0], size[1], 1.0f);
    const auto radiance = pairs.Integrate(this->Make(coat, environment)); // finite: checked there
    EXPECT_LT(GetRelativeError(radiance, pairs.IntegrateExactly(coat, environment)), 1.0);
  }
}

//------------------------------------------------------------------------------
// The material, its values, the light, and the sizes that were set last.
TEST_P(EveryMethod, FollowsItsInputs)
{
  const auto environment = NewSmallEnvironment(true);
  const auto coat = NewCoating(20.0, GetParam().Stretch);
  const auto method = this->Make(coat, environment);
  SpherePairs pairs;
  pairs.AddRandom(4);
  auto before = pairs.Integrate(method);
  const auto expectChanged = [&](const char* what)
  {
    const auto fresh = this->Make(method->GetBRDF(), environment);
    fresh->SetSizes(GetParam().OtherSizes);
    method->SetSizes(GetParam().OtherSizes);
    const auto now = pairs.Integrate(method);
    EXPECT_EQ(now, pairs.Integrate(fresh)) << what;
    EXPECT_NE(now, before) << what;
    before = now;
  };
  if (!GetParam().OtherSizes.empty())
  {
    expectChanged("sizes");
  }
  coat->SetDiffuse(0.1, 0.2, 0.3);
  expectChanged("values");
  std::vector<float> rgb(environment->GetPixels());
  std::reverse(rgb.begin(), rgb.end());
  ASSERT_TRUE(environment->SetPixels(128, 64, rgb));
  expectChanged("light");
  const auto other = NewCoating(5.0, GetParam().Stretch);
  method->SetBRDF(other);
  expectChanged("material");
}

//------------------------------------------------------------------------------
// What is prepared stays while nothing changes but the environment's rotation.
TEST_P(EveryMethod, IsPreparedOnce)
{
  const auto environment = NewSmallEnvironment(false);
  const auto method = this->Make(NewCoating(5.0, GetParam().Stretch), environment);
  ASSERT_TRUE(method->Prepare());
  int count = 0;
  vtkNew<vtkCallbackCommand> watch;
  watch->SetClientData(&count);
  watch->SetCallback(
    [](vtkObject*, unsigned long, void* number, void*) { ++*static_cast<int*>(number); });
  method->AddObserver(vtkCommand::ProgressEvent, watch);
  environment->SetRotationY(77.0);
  ASSERT_TRUE(method->Prepare());
  EXPECT_EQ(count, 0);
}

INSTANTIATE_TEST_SUITE_P(
  All, EveryMethod, testing::ValuesIn(Methods), [](const auto& info) { return info.param.Name; });
