// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What leaving occlusion out costs: predicted from few points, against many and closed forms.
#include "ErrorCatcher.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkOcclusionPredictor.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkTracedScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(this->White), static_cast<vtkBRDF*>(gloss) })
  {
    for (vtkEnvironment* environment : { this->Sky.Get(), hall.Get() })
    {
      vtkNew<vtkOcclusionPredictor> predictor;
      predictor->SetScene(this->Scene);
      predictor->SetBRDF(brdf);
      predictor->SetEnvironment(environment);
      ASSERT_TRUE(predictor->Update());
      const double error = predictor->GetError();
      const double uncertainty = predictor->GetUncertainty();
      predictor->SetNumberOfPoints(8000);
      ASSERT_TRUE(predictor->Update());
      std::printf("%.4f +- %.4f, many points %.4f\n", error, uncertainty, predictor->GetError());
      EXPECT_LT(std::abs(std::log(error / predictor->GetError())), std::log(1.5));
      EXPECT_LT(std::abs(error - predictor->GetError()), 2.0 * uncertainty);
      EXPECT_LT(predictor->GetUncertainty(), uncertainty);
    }
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
