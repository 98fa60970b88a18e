// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Maps may be in any unit: a factor on the light is a factor on what every method shows.

#include "BrushedMetal.h"
#include "ScaledLight.h"
#include "SpherePairs.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

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
  EXPECT_GE(tried, 3 * 10);
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
