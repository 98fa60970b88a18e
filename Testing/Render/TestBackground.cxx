// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the mapper shows while a plan is made on a thread.

#include "EventCounter.h"
#include "RenderFixture.h"

#include "../Unit/Support/AnisotropicWarp.h"
#include "../Unit/Support/GatedBRDF.h"
#include "../Unit/Support/SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkCommand.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkSphereSource.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace
{
class Background : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->Sky->SetToProceduralSky();
    this->BRDF->SetSpecular(0.4, 0.3, 0.2);
    this->BRDF->SetExponent(5.0);
    this->Measured->SetInputConnection(this->Sphere->GetOutputPort());
    this->Measured->SetBRDF(this->BRDF);
    this->Measured->SetEnvironment(this->Sky);
    this->Measured->SetErrorTolerance(0.05);
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
    this->AddHeadlight();
  }
  void TearDown() override { this->BRDF->Door->OpenUp(); }

  /// Through a mapper that knows nothing of what was before.
  FloatImage RenderAnew()
  {
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->SetInputConnection(this->Sphere->GetOutputPort());
    mapper->SetBRDF(this->Measured->GetBRDF());
    mapper->SetEnvironment(this->Measured->GetEnvironment());
    mapper->SetErrorTolerance(this->Measured->GetErrorTolerance());
    this->Actor->SetMapper(mapper);
    const FloatImage image = this->RenderEncoded();
    this->Actor->SetMapper(this->Measured);
    return image;
  }

  bool WaitUntilReady()
  {
    return WaitUntil([this]() { return this->Measured->GetPlanReady(); });
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkEnvironment> Sky;
  vtkNew<GatedBRDF> BRDF;
  vtkNew<vtkMeasuredBRDFMapper> Measured;
  vtkNew<vtkActor> Actor;
};
}

TEST_F(Background, OldPicturesUntilTheNewPlanIsMade)
{
  EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  this->Measured->SetPlanningModeToBackground();
  const FloatImage old = this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_EQ(old.RGBA, this->RenderAnew().RGBA);
  EXPECT_EQ(plans.Count, 1);

  this->BRDF->Door->Close();
  this->BRDF->SetExponent(50.0);
  this->BRDF->SetSpecular(0.1, 0.2, 0.9);
  this->Sky->SetPixels(2, 1, { 1.0f, 0.2f, 0.1f, 0.3f, 1.0f, 0.2f });
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_EQ(this->RenderEncoded().RGBA, old.RGBA);
    EXPECT_TRUE(this->Measured->GetPlanPending());
    EXPECT_FALSE(this->Measured->GetPlanReady());
  }
  EXPECT_EQ(plans.Count, 1);

  // The light that is shown still turns.
  this->Sky->SetRotationY(90.0);
  EXPECT_NE(this->RenderEncoded().RGBA, old.RGBA);
  this->Sky->SetRotationY(0.0);
  EXPECT_EQ(this->RenderEncoded().RGBA, old.RGBA);

  this->BRDF->Door->OpenUp();
  ASSERT_TRUE(this->WaitUntilReady());
  const FloatImage now = this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_EQ(plans.Count, 2);
  EXPECT_NE(now.RGBA, old.RGBA);
  EXPECT_EQ(now.RGBA, this->RenderAnew().RGBA);
}

// Also where the shader changes in between, and with it what the material needs of the data.
TEST_F(Background, AnotherKindOfMaterial)
{
  this->Measured->SetPlanningModeToBackground();
  const FloatImage old = this->RenderEncoded();
  const std::string plan = this->Measured->GetPlan();
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(3.0, 30.0);
  this->Measured->SetBRDF(brushed);
  this->Measured->GlobalWarningDisplayOff(); // of tangents
  EXPECT_EQ(this->RenderEncoded().RGBA, old.RGBA);
  EXPECT_EQ(this->Measured->GetPlan(), plan);
  ASSERT_TRUE(this->WaitUntilReady());
  const FloatImage now = this->RenderEncoded();
  EXPECT_EQ(now.RGBA, this->RenderAnew().RGBA);
  EXPECT_NE(this->Measured->GetPlan(), plan);
  this->Measured->GlobalWarningDisplayOn();
}

TEST_F(Background, FromTheStartWithASmallTable)
{
  vtkNew<vtkHybridRadianceIntegrator> small;
  EXPECT_TRUE(small->SetSizes({ 65, 8, 8 }));
  small->QuickOn();
  this->Measured->SetIntegrator(small);
  const FloatImage first = this->RenderEncoded();
  this->Measured->SetIntegrator(nullptr);
  this->Measured->SetPlanningModeToBackgroundFromStart();
  EXPECT_EQ(this->RenderEncoded().RGBA, first.RGBA);
  EXPECT_TRUE(this->Measured->GetPlanPending());
  EXPECT_EQ(this->Measured->GetPlan(), "");
  ASSERT_TRUE(this->WaitUntilReady());
  EXPECT_EQ(this->RenderEncoded().RGBA, this->RenderAnew().RGBA);
  EXPECT_NE(this->Measured->GetPlan(), "");
}

namespace
{
// Panels with hard edges in the dark, none of which is a lamp, in 256 x 128 texels.
void SetToPanels(vtkEnvironment* environment)
{
  const int corners[][4] = { { 10, 30, 60, 50 }, { 80, 110, 55, 75 }, { 140, 180, 20, 45 },
    { 200, 215, 40, 80 }, { 60, 75, 10, 30 }, { 150, 160, 85, 105 } };
  std::vector<float> pixels(3 * 256 * 128, 0.02f);
  for (const auto& panel : corners)
  {
    for (int y = panel[2]; y < panel[3]; ++y)
    {
      std::fill(&pixels[3 * (256 * y + panel[0])], &pixels[3 * (256 * y + panel[1])], 4.0f);
    }
  }
  environment->SetPixels(256, 128, pixels);
}

// Relative L1, as what stands in for plans is judged.
double GetErrorEverywhere(vtkRadianceIntegrator* integrator)
{
  SpherePairs pairs;
  pairs.AddRandom(300);
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(integrator->GetBRDF());
  reference->SetEnvironment(integrator->GetEnvironment());
  return GetRelativeError(pairs.Integrate(integrator), pairs.Integrate(reference));
}
}

// With 33 rows, chrome has 23 % error here.
TEST_F(Background, StandInsForMirrorLikeMaterialsUnderPanels)
{
  vtkNew<vtkEnvironment> panels;
  SetToPanels(panels);
  this->Measured->SetEnvironment(panels);
  this->Measured->SetPlanningModeToBackgroundFromStart();
  for (const char* name : { "nickel", "chrome" })
  {
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    this->Measured->SetBRDF(brdf);
    this->RenderEncoded();
    EXPECT_TRUE(this->Measured->GetPlanPending());
    vtkRadianceIntegrator* standIn = this->Measured->GetCurrentIntegrator();
    ASSERT_TRUE(standIn);
    const double error = GetErrorEverywhere(standIn);
    std::cout << name << ": error " << error << "\n";
    EXPECT_LT(error, 0.15) << name;
  }
}

// A material that shaders evaluate in a resampled form is drawn by a coarse one until the plan is
// made, and then as if nothing had stood in.
TEST_F(Background, ACoarseFormForShadersUntilThePlan)
{
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetReflectance(0.3, 0.2, 0.1);
  gloss->SetDiffuse(0.1, 0.2, 0.3);
  gloss->SetExponents(80.0, 80.0);
  vtkNew<vtkAdaptiveWarpBRDF> warp;
  ASSERT_EQ(warp->SetTables(MakeAnisotropicTables(gloss, { 16, 1, 1, 65 })), "");
  vtkNew<vtkEnvironment> lamp;
  SetToPanels(lamp);
  std::vector<float> pixels(lamp->GetPixels());
  std::fill_n(&pixels[3 * (256 * 40 + 120)], 3, 3e4f);
  lamp->SetPixels(256, 128, pixels);
  this->Measured->SetBRDF(warp);
  this->Measured->SetEnvironment(lamp);
  this->Measured->SetErrorTolerance(0.02);
  this->Measured->SetPlanningModeToBackgroundFromStart();
  const FloatImage first = this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  auto* standIn = vtkHybridRadianceIntegrator::SafeDownCast(this->Measured->GetCurrentIntegrator());
  ASSERT_TRUE(standIn);
  EXPECT_EQ(standIn->GetNumberOfLights(), 1);
  EXPECT_NE(standIn->GetBRDF(), warp.Get()); // but of the same values, which the error is against
  auto* table = vtkTabulatedBRDF::SafeDownCast(standIn->GetBRDF()->GetRenderable());
  ASSERT_TRUE(table);
  EXPECT_EQ(table->GetResamplingError(), 0.0); // which nobody measures
  const std::size_t cells = table->GetVolume().size();
  EXPECT_LT(cells, 3u * 40000u);
  const double error = GetErrorEverywhere(standIn);
  std::cout << "error under a lamp: " << error << "\n";
  EXPECT_LT(error, 0.1);

  ASSERT_TRUE(this->WaitUntilReady());
  const FloatImage planned = this->RenderEncoded();
  EXPECT_NE(planned.RGBA, first.RGBA);
  vtkRadianceIntegrator* current = this->Measured->GetCurrentIntegrator();
  auto* finer = vtkTabulatedBRDF::SafeDownCast(current->GetBRDF()->GetRenderable());
  ASSERT_TRUE(finer);
  EXPECT_GT(finer->GetVolume().size(), cells);
  EXPECT_GT(finer->GetResamplingError(), 0.0);
  // Objects that have no plan yet, planned for before they are drawn.
  vtkNew<vtkAdaptiveWarpBRDF> same;
  ASSERT_EQ(same->SetTables(MakeAnisotropicTables(gloss, { 16, 1, 1, 65 })), "");
  vtkNew<vtkEnvironment> sameLamp;
  sameLamp->SetPixels(256, 128, pixels);
  this->Measured->SetBRDF(same);
  this->Measured->SetEnvironment(sameLamp);
  this->Measured->SetPlanningModeToForeground();
  EXPECT_EQ(planned.RGBA, this->RenderEncoded().RGBA);
}

// The plan is for what the first picture shows, and for another view when that is asked for.
TEST_F(Background, PlansForTheView)
{
  EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 1);
  const std::string everywhere = this->Measured->GetPlan();
  camera->Azimuth(90.0);
  this->Measured->PlanForViewOn();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 2);
  const std::string here = this->Measured->GetPlan();
  EXPECT_NE(here, everywhere);
  camera->Azimuth(60.0);
  this->Sky->SetRotationY(90.0);
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 2) << "it follows no camera";
  EXPECT_EQ(this->Measured->GetPlan(), here);
  this->Measured->PlanForViewOn();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 3);
  EXPECT_NE(this->Measured->GetPlan(), here);
  this->Measured->PlanForViewOff();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 4);
  const auto cut = [](const std::string& plan) { return plan.substr(0, plan.find(", error")); };
  EXPECT_EQ(cut(this->Measured->GetPlan()), cut(everywhere));
  camera->SetFocalPoint(50.0, 0.0, 0.0); // out of view
  this->Measured->PlanForViewOn();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 4);
}
