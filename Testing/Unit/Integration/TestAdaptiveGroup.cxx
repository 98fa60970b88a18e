// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Four neighboring pairs that are integrated over the same squares, against each by itself.

#include "ErrorCatcher.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{
struct Fours : SpherePairs
{
  // Blocks of 2 x 2 pixels of a sphere seen along z, 500 pixels wide, scattered over it and
  // its rim.
  void AddOfSphere(int count)
  {
    for (int k = 0; k < count; ++k)
    {
      const double r = 0.993 * std::sqrt((k + 0.5) / count);
      const double angle = 2.399963229728653 * k; // a sunflower's
      for (int pixel = 0; pixel < 4; ++pixel)
      {
        const double x = r * std::cos(angle) + pixel % 2 / 250.0;
        const double y = r * std::sin(angle) + pixel / 2 / 250.0;
        this->Add({ x, y, std::sqrt(std::max(1.0 - x * x - y * y, 1e-3)) });
      }
    }
  }
  void Add(const glm::dvec3& normal) { this->SpherePairs::Add(normal, { 0.0, 0.0, 1.0 }); }
};

// Channels' absolute differences over their sum, or over 2 % of the mean sum.
std::vector<double> GetErrors(vtkDoubleArray* radiance, vtkDoubleArray* reference)
{
  double mean = 0.0;
  const vtkIdType count = reference->GetNumberOfTuples();
  for (vtkIdType k = 0; k < 3 * count; ++k)
  {
    mean += reference->GetValue(k) / static_cast<double>(count);
  }
  std::vector<double> errors;
  for (vtkIdType k = 0; k < count; ++k)
  {
    double difference = 0.0;
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      difference += std::abs(radiance->GetComponent(k, c) - reference->GetComponent(k, c));
      sum += reference->GetComponent(k, c);
    }
    errors.push_back(difference / std::max(sum, 0.02 * mean));
  }
  return errors;
}

double GetLargestError(vtkBRDF* brdf, vtkEnvironment* environment, Fours& fours, double tolerance)
{
  vtkNew<vtkAdaptiveRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  integrator->SetTolerance(tolerance);
  vtkNew<vtkDoubleArray> radiance, strict;
  EXPECT_TRUE(integrator->IntegrateNeighbors(fours.Normals, fours.Views, radiance));
  EXPECT_GT(integrator->GetNumberOfEvaluations(), 0);
  integrator->SetTolerance(1e-4);
  EXPECT_TRUE(integrator->Integrate(fours.Normals, fours.Views, strict));
  const std::vector<double> errors = GetErrors(radiance, strict);
  return *std::max_element(errors.begin(), errors.end());
}
}

//------------------------------------------------------------------------------
TEST(AdaptiveGroup, IsWithinItsTolerance)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  Fours fours;
  fours.AddOfSphere(40);
  vtkNew<vtkLambertBRDF> matte;
  EXPECT_LT(GetLargestError(matte, environment, fours, 0.0028), 0.003);
  for (const double exponent : { 100.0, 5000.0 })
  {
    vtkNew<vtkAshikhminShirleyBRDF> gloss;
    gloss->SetDiffuse(0.02, 0.01, 0.03);
    gloss->SetExponents(exponent, exponent);
    EXPECT_LT(GetLargestError(gloss, environment, fours, 0.002), 0.003) << exponent;
  }
}

//------------------------------------------------------------------------------
// Where four pairs have little in common, and where some face away.
TEST(AdaptiveGroup, DistantPairsAreSummedOneByOne)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetExponents(300.0, 300.0);
  Fours fours;
  fours.Add({ 0.0, 0.0, 1.0 });
  fours.Add({ 0.0, 0.05, 1.0 });
  fours.Add({ 0.0, 0.0, 1.0 });
  fours.Add({ 0.3, 0.0, -1.0 });
  vtkNew<vtkAdaptiveRadianceIntegrator> integrator;
  integrator->SetBRDF(gloss);
  integrator->SetEnvironment(environment);
  vtkNew<vtkDoubleArray> radiance, each;
  ASSERT_TRUE(integrator->IntegrateNeighbors(fours.Normals, fours.Views, radiance));
  const vtkTypeInt64 ofFour = integrator->GetNumberOfEvaluations();
  integrator->SetTolerance(0.7 * integrator->GetTolerance());
  ASSERT_TRUE(integrator->Integrate(fours.Normals, fours.Views, each));
  EXPECT_GT(integrator->GetNumberOfEvaluations() - ofFour, ofFour); // it sums equal pairs twice
  for (vtkIdType k = 0; k < 12; ++k)
  {
    EXPECT_EQ(radiance->GetValue(k), each->GetValue(k)) << k;
  }
  EXPECT_EQ(radiance->GetValue(9), 0.0); // it faces away
  EXPECT_GT(radiance->GetValue(0), 0.0);
}

//------------------------------------------------------------------------------
// Neighbors share their squares: other evaluations than of each by itself. And values that
// nothing can add up leave numbers.
TEST(AdaptiveGroup, SharesSquaresAndTakesAnything)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetExponents(300.0, 300.0);
  Fours fours;
  fours.AddOfSphere(2);
  vtkNew<vtkAdaptiveRadianceIntegrator> integrator;
  integrator->SetBRDF(gloss);
  integrator->SetEnvironment(environment);
  vtkNew<vtkDoubleArray> radiance, each;
  const double tolerance = integrator->GetTolerance();
  integrator->SetTolerance(0.7 * tolerance); // as pairs that are far apart would be summed
  ASSERT_TRUE(integrator->Integrate(fours.Normals, fours.Views, each));
  const vtkTypeInt64 alone = integrator->GetNumberOfEvaluations();
  integrator->SetTolerance(tolerance);
  ASSERT_TRUE(integrator->IntegrateNeighbors(fours.Normals, fours.Views, radiance));
  EXPECT_NE(integrator->GetNumberOfEvaluations(), 2 * alone);
  std::vector<float> bright(3 * 64 * 32, 1e30f);
  ASSERT_TRUE(environment->SetPixels(64, 32, bright));
  vtkNew<vtkTabulatedBRDF> table;
  const int dimensions[3] = { 4, 4, 4 };
  const std::vector<float> volume(3 * 64, 1e38f);
  table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, volume);
  integrator->SetBRDF(table);
  Fours one;
  one.AddOfSphere(1);
  ASSERT_TRUE(integrator->IntegrateNeighbors(one.Normals, one.Views, radiance));
  ASSERT_TRUE(integrator->Integrate(one.Normals, one.Views, each));
  for (vtkIdType k = 0; k < radiance->GetNumberOfValues(); ++k)
  {
    EXPECT_GE(radiance->GetValue(k), 0.0); // a number
    EXPECT_GE(each->GetValue(k), 0.0);
  }
  // What was prepared is of the material and the map that are set now.
  vtkNew<vtkAdaptiveRadianceIntegrator> fresh;
  fresh->SetBRDF(gloss);
  fresh->SetEnvironment(environment);
  environment->SetToProceduralSky();
  integrator->SetBRDF(gloss);
  ASSERT_TRUE(integrator->Integrate(fours.Normals, fours.Views, radiance));
  ASSERT_TRUE(fresh->Integrate(fours.Normals, fours.Views, each));
  for (vtkIdType k = 0; k < radiance->GetNumberOfValues(); ++k)
  {
    EXPECT_EQ(radiance->GetValue(k), each->GetValue(k));
  }
}

//------------------------------------------------------------------------------
TEST(AdaptiveGroup, TellsWhatItCannotTakeAndStops)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(300.0, 20.0);
  vtkNew<vtkAdaptiveRadianceIntegrator> integrator;
  integrator->SetBRDF(brushed);
  integrator->SetEnvironment(environment);
  ErrorCatcher errors(integrator);
  const auto expectError = [&](const std::string& part)
  {
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_NE(errors.GetText().find(part), std::string::npos) << errors.GetText();
  };
  Fours fours;
  fours.AddOfSphere(60);
  vtkNew<vtkDoubleArray> radiance;
  EXPECT_FALSE(integrator->IntegrateNeighbors(fours.Normals, fours.Views, radiance));
  expectError("anisotropic");
  vtkNew<vtkLambertBRDF> matte;
  integrator->SetBRDF(matte);
  EXPECT_FALSE(integrator->IntegrateNeighbors(fours.Normals, nullptr, radiance));
  expectError("are needed");
  Fours wrong;
  wrong.Add({ 0.0, 0.0, 1.0 });
  EXPECT_FALSE(integrator->IntegrateNeighbors(wrong.Normals, wrong.Views, radiance));
  expectError("multiple of 4");
  for (int k = 0; k < 3; ++k)
  {
    wrong.Add({ 0.0, 0.0, 0.0 });
  }
  EXPECT_FALSE(integrator->IntegrateNeighbors(wrong.Normals, wrong.Views, radiance));
  expectError("zero or not finite");
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAdaptiveRadianceIntegrator*>(caller)->SetAbort(true); });
  integrator->AddObserver(vtkCommand::ProgressEvent, stop);
  EXPECT_FALSE(integrator->IntegrateNeighbors(fours.Normals, fours.Views, radiance));
  expectError("aborted");
}
