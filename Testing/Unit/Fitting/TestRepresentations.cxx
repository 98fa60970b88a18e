// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The advisor: basis or fit, against materials whose answer is known and the figures of the rule.

#include "ErrorCatcher.h"

#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkRepresentationAdvisor.h"
#include "vtkSumBRDF.h"

#include <cmath>

#include <gtest/gtest.h>

namespace
{
vtkSmartPointer<vtkSumBRDF> MakeGlossy(double exponent)
{
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.1, 0.1, 0.1);
  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetExponent(exponent);
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(lambert);
  sum->AddTerm(phong);
  return sum;
}

/// 64 median-cut lights of the hall.
vtkLightSet* GetLights()
{
  static vtkNew<vtkLightSet> lights;
  if (lights->GetNumberOfLights() == 0)
  {
    vtkNew<vtkEnvironment> hall;
    hall->SetToProceduralHall();
    vtkNew<vtkMedianCutLightSetGenerator> generator;
    EXPECT_TRUE(generator->Generate(hall, 64, lights));
  }
  return lights;
}

/// mean |x - r| / mean r over a sphere under those lights.
double GetImageError(vtkBRDF* reference, vtkBRDF* other)
{
  vtkLightSet* lights = GetLights();
  vtkNew<vtkDoubleArray> normals, views;
  normals->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  for (int k = 0; k < 200; ++k)
  {
    const double r = 0.99 * std::sqrt((k + 0.5) / 200.0);
    normals->InsertNextTuple3(r * std::cos(2.4 * k), r * std::sin(2.4 * k), std::sqrt(1.0 - r * r));
    views->InsertNextTuple3(0.0, 0.0, 1.0);
  }
  const auto draw = [&](vtkBRDF* brdf)
  {
    brdf->Prepare();
    vtkNew<vtkLightSetRadianceIntegrator> integrator;
    integrator->SetBRDF(brdf);
    integrator->SetLightSet(lights);
    auto radiance = vtkSmartPointer<vtkDoubleArray>::New();
    EXPECT_TRUE(integrator->Integrate(normals, views, radiance));
    return radiance;
  };
  const auto x = draw(other);
  const auto r = draw(reference);
  double difference = 0.0;
  double total = 0.0;
  for (vtkIdType k = 0; k < r->GetNumberOfValues(); ++k)
  {
    difference += std::abs(x->GetValue(k) - r->GetValue(k));
    total += r->GetValue(k);
  }
  return difference / total;
}
}

TEST(RepresentationAdvisor, BroadLobesGoIntoABasisAndSharpOnesDoNot)
{
  // Residuals of zonal order 6 on 9 to 57 degrees fall with the exponent; measured once: 0.021,
  // 0.063, 0.19, 0.41 for n = 5, 20, 100, 300.
  vtkNew<vtkRepresentationAdvisor> advisor;
  double before = 0.0;
  for (const double exponent : { 5.0, 20.0, 100.0, 300.0 })
  {
    advisor->SetInput(MakeGlossy(exponent));
    ASSERT_TRUE(advisor->Update());
    EXPECT_GT(advisor->GetInZoneResidual(), before) << exponent;
    before = advisor->GetInZoneResidual();
    EXPECT_EQ(advisor->GetRecommendation(),
      exponent < 50.0 ? vtkRepresentationAdvisor::BASIS : vtkRepresentationAdvisor::FIT)
      << advisor->GetReason();
    EXPECT_NE(advisor->GetReason().find("residual"), std::string::npos);
    EXPECT_GE(advisor->GetNegativeMass(), 0.0);
    EXPECT_GE(advisor->GetOvershoot(), 0.0);
  }
  EXPECT_GT(before, 0.3);
}

// Shares stay shares where probes miss the lobe altogether.
TEST(RepresentationAdvisor, NegativeMassOfTheSharpestLobe)
{
  vtkNew<vtkBlinnPhongBRDF> mirror;
  mirror->SetExponent(1e5);
  vtkNew<vtkRepresentationAdvisor> advisor;
  advisor->SetInput(mirror);
  ASSERT_TRUE(advisor->Update());
  EXPECT_EQ(advisor->GetRecommendation(), vtkRepresentationAdvisor::FIT);
  EXPECT_GT(advisor->GetNegativeMass(), 0.1);
  EXPECT_LE(advisor->GetNegativeMass(), 1.0);
  EXPECT_GT(advisor->GetOvershoot(), 0.1);
  EXPECT_LE(advisor->GetOvershoot(), 1.0);
}

TEST(RepresentationAdvisor, LambertIsExactInAnyBasis)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkRepresentationAdvisor> advisor;
  advisor->SetInput(lambert);
  advisor->SetOrder(2);
  ASSERT_TRUE(advisor->Update());
  EXPECT_EQ(advisor->GetRecommendation(), vtkRepresentationAdvisor::BASIS);
  EXPECT_LT(advisor->GetInZoneResidual(), 1e-3);
  EXPECT_EQ(advisor->GetNegativeMass(), 0.0);
  EXPECT_LT(advisor->GetOvershoot(), 1e-3);
}

TEST(RepresentationAdvisor, LimitsDecide)
{
  vtkNew<vtkRepresentationAdvisor> advisor;
  advisor->SetInput(MakeGlossy(20.0));
  advisor->SetMaximumResidual(0.01);
  ASSERT_TRUE(advisor->Update());
  EXPECT_EQ(advisor->GetRecommendation(), vtkRepresentationAdvisor::FIT);
  advisor->SetMaximumResidual(1.0);
  ASSERT_TRUE(advisor->Update());
  EXPECT_EQ(advisor->GetRecommendation(), vtkRepresentationAdvisor::BASIS);
}

TEST(RepresentationAdvisor, RepresentsInABasisOrAsADBRDF)
{
  vtkNew<vtkRepresentationAdvisor> advisor;
  advisor->SetInput(MakeGlossy(10.0));
  ASSERT_TRUE(advisor->Represent());
  const vtkSmartPointer<vtkBasisBRDF> basis = vtkBasisBRDF::SafeDownCast(advisor->GetOutput());
  ASSERT_TRUE(basis);
  EXPECT_EQ(basis->GetBasis(), vtkBasisBRDF::SPHERICAL_HARMONICS);
  EXPECT_EQ(basis->GetNumberOfFunctions(), 49);
  EXPECT_LT(GetImageError(advisor->GetInput(), basis), 0.02);

  advisor->SetInput(MakeGlossy(300.0));
  ASSERT_TRUE(advisor->Represent());
  EXPECT_FALSE(vtkBasisBRDF::SafeDownCast(advisor->GetOutput()));
  EXPECT_LT(GetImageError(advisor->GetInput(), advisor->GetOutput()), 0.08);

  // What is in a basis stays.
  advisor->SetInput(basis);
  ASSERT_TRUE(advisor->Represent());
  EXPECT_EQ(advisor->GetOutput(), basis);
}

TEST(RepresentationAdvisor, RefusesWithoutInputAndBadOptions)
{
  vtkNew<vtkRepresentationAdvisor> advisor;
  ErrorCatcher errors(advisor);
  EXPECT_FALSE(advisor->Update());
  EXPECT_FALSE(advisor->Represent());
  advisor->SetInput(MakeGlossy(5.0));
  for (const int order : { 0, -1, 100 })
  {
    advisor->SetOrder(order);
    EXPECT_NE(errors.GetText().find(std::to_string(order)), std::string::npos) << errors.GetText();
  }
  advisor->SetOrder(4);
  advisor->SetZone(57.0, 9.0);
  EXPECT_NE(errors.GetText().find("57"), std::string::npos) << errors.GetText();
  EXPECT_EQ(errors.Take(), 6);
  EXPECT_FALSE(advisor->GetOutput());
}

TEST(RepresentationAdvisor, CanBeStopped)
{
  vtkNew<vtkRepresentationAdvisor> advisor;
  advisor->SetInput(MakeGlossy(300.0));
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkRepresentationAdvisor*>(caller)->AbortOn(); });
  advisor->AddObserver(vtkCommand::ProgressEvent, stop);
  ErrorCatcher errors(advisor);
  EXPECT_FALSE(advisor->Represent());
  EXPECT_FALSE(advisor->GetOutput());
  EXPECT_EQ(errors.Take(), 0);
}
