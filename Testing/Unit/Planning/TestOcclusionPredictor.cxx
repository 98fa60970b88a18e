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

// From its own events, as from another thread: the last prediction stays.
TEST(OcclusionPredictor, Aborts)
{
  const auto torus = MakeTorus();
  vtkNew<vtkTracedScene> scene;
  scene->AddSurface(torus);
  vtkNew<vtkLambertBRDF> brdf;
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkNew<vtkOcclusionPredictor> predictor;
  predictor->SetScene(scene);
  predictor->SetBRDF(brdf);
  predictor->SetEnvironment(sky);
  ASSERT_TRUE(predictor->Update());
  const double error = predictor->GetError();
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkOcclusionPredictor*>(caller)->SetAbort(true); });
  predictor->AddObserver(vtkCommand::ProgressEvent, stop);
  predictor->SetNumberOfPoints(5000);
  ErrorCatcher errors(predictor);
  EXPECT_FALSE(predictor->Update());
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_EQ(predictor->GetError(), error);
  EXPECT_FALSE(predictor->Update()); // until it is false again
  predictor->RemoveAllObservers();
  predictor->SetAbort(false);
  EXPECT_TRUE(predictor->Update());
  EXPECT_NE(predictor->GetError(), error);
}

// A half sphere under a white sky, seen from its opening: half of the light is hidden, so the
// error is 1 of what is left.
TEST(OcclusionPredictor, ABowl)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(120);
  sphere->SetPhiResolution(60);
  sphere->SetStartPhi(90.0);
  sphere->Update();
  vtkNew<vtkPolyData> bowl;
  bowl->ShallowCopy(sphere->GetOutput());
  bowl->GetPointData()->SetNormals(nullptr);
  vtkNew<vtkTracedScene> scene;
  scene->AddSurface(bowl);
  vtkNew<vtkLambertBRDF> white;
  vtkNew<vtkEnvironment> sky;
  sky->SetPixels(64, 32, std::vector<float>(3 * 64 * 32, 1.0f));
  vtkNew<vtkOcclusionPredictor> predictor;
  predictor->SetScene(scene);
  predictor->SetBRDF(white);
  predictor->SetEnvironment(sky);
  predictor->SetViewDirection(0.0, 0.0, 1.0);
  ASSERT_TRUE(predictor->Update());
  EXPECT_NEAR(predictor->GetError(), 1.0, 0.05);
  EXPECT_LT(predictor->GetUncertainty(), 0.1);
  predictor->SetViewDirection(0.0, 0.0, -1.0); // from below it bulges
  ASSERT_TRUE(predictor->Update());
  EXPECT_LT(predictor->GetError(), 0.01);
}

// The default's prediction and uncertainty, against 20 times as many points.
TEST(OcclusionPredictor, FewPointsForetellMany)
{
  const vtkSmartPointer<vtkPolyData> torus = MakeTorus();
  vtkNew<vtkTracedScene> scene;
  scene->AddSurface(torus);
  vtkNew<vtkLambertBRDF> white;
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetExponent(50.0);
  vtkNew<vtkEnvironment> sky;
  vtkNew<vtkEnvironment> hall;
  sky->SetToProceduralSky();
  hall->SetToProceduralHall();
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(white), static_cast<vtkBRDF*>(gloss) })
  {
    for (vtkEnvironment* environment : { sky.Get(), hall.Get() })
    {
      vtkNew<vtkOcclusionPredictor> predictor;
      predictor->SetScene(scene);
      predictor->SetBRDF(brdf);
      predictor->SetEnvironment(environment);
      predictor->SetMaximumNumberOfPoints(400);
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

TEST(OcclusionPredictor, Decision)
{
  EXPECT_FALSE(vtkOcclusionPredictor::IsWorthModeling(0.009, 0.015, 0.02));
  EXPECT_TRUE(vtkOcclusionPredictor::IsWorthModeling(0.021, 0.0, 0.02));
  EXPECT_TRUE(vtkOcclusionPredictor::IsWorthModeling(0.014, 0.015, 0.02)); // 0.0132 is left
  EXPECT_FALSE(vtkOcclusionPredictor::IsWorthModeling(0.009, 0.05, 0.02)); // a bad plan
  EXPECT_TRUE(vtkOcclusionPredictor::IsWorthModeling(0.011, 0.05, 0.02));
  EXPECT_EQ(vtkOcclusionPredictor::FormatText(0.0921, 0.0104),
    "unoccluded light: 9.2 % on this surface (+- 1 %)");
}

TEST(OcclusionPredictor, NothingToSee)
{
  vtkNew<vtkTracedScene> scene;
  vtkNew<vtkPolyData> nothing;
  scene->AddSurface(nothing);
  vtkNew<vtkLambertBRDF> white;
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkNew<vtkOcclusionPredictor> predictor;
  {
    ErrorCatcher errors(predictor);
    EXPECT_FALSE(predictor->Update());
    EXPECT_EQ(errors.Take(), 1);
  }
  predictor->SetScene(scene);
  predictor->SetBRDF(white);
  predictor->SetEnvironment(sky);
  ASSERT_TRUE(predictor->Update());
  EXPECT_EQ(predictor->GetError(), 0.0);
}
} // namespace
