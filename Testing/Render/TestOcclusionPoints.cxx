// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What rests while the light does is kept for each point (OcclusionVertexCache): the picture is
// that of shaders that make it for each vertex, whatever moves, and it is made no more often than
// it has to be.
#include "OcclusionVertexCache.h"
#include "RenderFixture.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkOutputWindow.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkStringOutputWindow.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using measuredbrdf::OcclusionLight;
using measuredbrdf::OcclusionVertexCache;

namespace
{
constexpr double Step = 1.0 / 255.0; // of display values; edges are kept in steps of 1 / 4094

// A bowl that is open upwards from so many degrees on; its normals point inside.
vtkSmartPointer<vtkPolyData> MakeOpenSphere(
  double start, bool bothSides = true, bool bounce = false, double x = 0.0)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetCenter(x, 0.0, 0.0);
  bowl->SetRadius(0.9);
  bowl->SetThetaResolution(48);
  bowl->SetPhiResolution(24);
  bowl->SetStartPhi(start);
  vtkNew<vtkReverseSense> reversed;
  reversed->SetInputConnection(bowl->GetOutputPort());
  reversed->ReverseNormalsOn();
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetBothSides(bothSides);
  filter->SetBounce(bounce);
  filter->SetInputConnection(reversed->GetOutputPort());
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

// The largest difference of display values; infinite where one is no number.
double GetLargestStep(const FloatImage& a, const FloatImage& b)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < a.RGBA.size(); ++k)
  {
    const double difference = std::min(a.RGBA[k], 1.0f) - std::min(b.RGBA[k], 1.0f);
    largest = std::isfinite(a.RGBA[k]) ? std::max(largest, std::abs(difference)) : HUGE_VAL;
  }
  return largest;
}

vtkSmartPointer<vtkEnvironment> MakeEnvironment(const char* name)
{
  return vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(name));
}
}

class OcclusionPointsTest : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment = MakeEnvironment("sky");
    this->BRDF->SetSpecular(0.3, 0.3, 0.3);
    this->BRDF->SetExponent(30.0);
    this->Integrator->SetNumberOfRows(17);
    this->Integrator->SetNumberOfViewAngles(6);
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 3.0, 4.0);
    this->Renderer->GetActiveCamera()->SetViewUp(0.0, 1.0, 0.0);
    this->Renderer->AddActor(this->Actor);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->RotateX(-60.0);
    this->Mapper->SetBRDF(this->BRDF);
    this->Mapper->SetEnvironment(this->Environment);
    this->Mapper->SetIntegrator(this->Integrator);
    this->Mapper->SetInputData(MakeOpenSphere(60.0, false));
    OcclusionVertexCache::SetLeastPoints(1);
  }

  void TearDown() override
  {
    OcclusionVertexCache::SetLeastPoints(OcclusionVertexCache::DefaultLeastPoints);
  }

  // How often points were made in it.
  std::size_t Count(const std::function<void()>& frames)
  {
    const std::size_t before = OcclusionVertexCache::GetMadeCount();
    frames();
    return OcclusionVertexCache::GetMadeCount() - before;
  }

  // The next picture against that without anything kept.
  double CompareNext()
  {
    const std::size_t before = OcclusionVertexCache::GetAddedCount();
    const FloatImage kept = this->RenderEncoded();
    EXPECT_GT(OcclusionVertexCache::GetAddedCount(), before); // so it was drawn with what is kept
    OcclusionVertexCache::SetLeastPoints(1000000);
    EXPECT_EQ(this->Count([this]() { this->Plain = this->RenderEncoded(); }), 0u);
    OcclusionVertexCache::SetLeastPoints(1);
    return GetLargestStep(kept, this->Plain);
  }

  FloatImage Plain;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkBlinnPhongBRDF> BRDF;
  vtkNew<vtkHybridRadianceIntegrator> Integrator;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

// Lamps, panels, a matte surface, one lobe for all.
TEST_F(OcclusionPointsTest, PicturesAreTheSame)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkFilteredRadianceIntegrator> filtered;
  const auto hall = MakeEnvironment("hall");
  EXPECT_FALSE(OcclusionLight(this->BRDF, this->Environment, this->Integrator).Lamps.empty());
  EXPECT_FALSE(OcclusionLight(this->BRDF, hall, this->Integrator).Panels.empty());
  EXPECT_TRUE(OcclusionLight(this->BRDF, hall, this->Integrator).HasLobe);
  EXPECT_FALSE(OcclusionLight(lambert, hall, this->Integrator).HasLobe);
  for (vtkEnvironment* environment : { this->Environment.Get(), hall.Get() })
  {
    this->Mapper->SetEnvironment(environment);
    for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(this->BRDF), static_cast<vtkBRDF*>(lambert) })
    {
      this->Mapper->SetBRDF(brdf);
      EXPECT_LT(this->CompareNext(), Step);
      this->Mapper->SetOcclusionModeToOff();
      EXPECT_GT(
        GetLargestStep(this->RenderEncoded(), this->Plain), 10.0 * Step); // so it hides something
      this->Mapper->SetOcclusionModeToArrays();
    }
  }
  this->Mapper->SetIntegrator(filtered);
  EXPECT_LT(this->CompareNext(), Step);
}

// With more than two lamps the table holds a part of them, which goes with what is kept of lamps.
TEST_F(OcclusionPointsTest, LampsInTablesAreTheSame)
{
  vtkNew<vtkEnvironment> lamps;
  std::vector<float> pixels(3 * 128 * 64, 0.02f);
  for (int k = 0; k < 3; ++k)
  {
    std::fill_n(pixels.begin() + 3 * (128 * (12 + 4 * k) + 20 + 40 * k), 3, 1000.0f);
  }
  lamps->SetPixels(128, 64, pixels);
  this->BRDF->SetExponent(5.0);
  this->Mapper->SetEnvironment(lamps);
  const OcclusionLight light(this->BRDF, lamps, this->Integrator);
  ASSERT_EQ(light.LampLight.size(), 3u);
  EXPECT_TRUE(light.Panels.empty());
  EXPECT_LT(this->CompareNext(), Step);
  this->Mapper->SetOcclusionModeToOff();
  EXPECT_GT(GetLargestStep(this->RenderEncoded(), this->Plain), 10.0 * Step);
}

// The camera and another material of the same light leave it as it is.
TEST_F(OcclusionPointsTest, ItIsMadeOnceWhileTheLightRests)
{
  EXPECT_EQ(this->Count([this]() { this->RenderEncoded(); }), 1u);
  vtkNew<vtkBlinnPhongBRDF> other;
  other->SetExponent(10.0);
  EXPECT_EQ(this->Count(
              [&]()
              {
                this->RenderEncoded();
                this->Renderer->GetActiveCamera()->Azimuth(40.0);
                this->RenderEncoded();
                this->Mapper->SetBRDF(other);
                this->RenderEncoded();
                this->Mapper->SetBRDF(this->BRDF);
                this->RenderEncoded();
              }),
    0u);
  EXPECT_LT(this->CompareNext(), Step);
  this->Renderer->GetActiveCamera()->ParallelProjectionOff();
  this->Renderer->GetActiveCamera()->SetViewAngle(24.0);
  EXPECT_LT(this->CompareNext(), Step);
}

// It is made anew in each frame in which the light turns, and no more once it rests.
TEST_F(OcclusionPointsTest, LightMayTurnAndRestAgain)
{
  this->RenderEncoded();
  const FloatImage first = this->RenderEncoded();
  for (int frame = 1; frame < 4; ++frame)
  {
    this->Environment->SetRotationY(40.0 * frame);
    EXPECT_EQ(this->Count([this]() { this->RenderEncoded(); }), 1u);
    EXPECT_LT(this->CompareNext(), Step);
    EXPECT_GT(GetLargestStep(first, this->Plain), 5.0 * Step);
  }
  this->RenderEncoded();
  EXPECT_EQ(this->Count([this]() { this->RenderEncoded(); }), 0u);
  this->Renderer->SetEnvironmentUp(0.0, 0.0, 1.0);
  this->Renderer->SetEnvironmentRight(1.0, 0.0, 0.0);
  EXPECT_LT(this->CompareNext(), Step);
  const FloatImage before = this->Plain;
  this->Actor->RotateX(70.0);
  EXPECT_LT(this->CompareNext(), Step);
  EXPECT_GT(GetLargestStep(before, this->Plain), 5.0 * Step);
  this->Actor->SetScale(-1.0, 1.0, 1.0);
  EXPECT_LT(this->CompareNext(), Step);
}

// Another map, another surface with as many points, other arrays.
TEST_F(OcclusionPointsTest, WhatChangesIsSeen)
{
  this->RenderEncoded();
  const auto hall = MakeEnvironment("hall");
  this->Mapper->SetEnvironment(hall);
  EXPECT_LT(this->CompareNext(), Step);
  FloatImage before = this->Plain;
  this->Mapper->SetInputData(MakeOpenSphere(110.0, false));
  EXPECT_LT(this->CompareNext(), Step);
  EXPECT_GT(GetLargestStep(before, this->Plain), 5.0 * Step);
  vtkNew<vtkPolyData> surface;
  surface->DeepCopy(MakeOpenSphere(60.0, false));
  this->Mapper->SetInputData(surface);
  EXPECT_LT(this->CompareNext(), Step);
  before = this->Plain;
  vtkDataArray* hidden =
    surface->GetPointData()->GetArray(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName());
  for (vtkIdType k = 0; k < hidden->GetNumberOfTuples(); ++k)
  {
    hidden->SetComponent(k, 0, 127.0); // less than it hides
  }
  hidden->Modified();
  EXPECT_LT(this->CompareNext(), Step);
  EXPECT_GT(GetLargestStep(before, this->Plain), 5.0 * Step);
}

// Both sides, what bounces, edges, and a translucent surface.
TEST_F(OcclusionPointsTest, OtherWaysToDrawAreTheSame)
{
  this->Mapper->SetInputData(MakeOpenSphere(60.0));
  EXPECT_LT(this->CompareNext(), Step);
  this->Actor->GetProperty()->EdgeVisibilityOn();
  EXPECT_LT(this->CompareNext(), Step);
  this->Actor->GetProperty()->EdgeVisibilityOff();
  this->Actor->GetProperty()->SetOpacity(0.5);
  EXPECT_LT(this->CompareNext(), Step);
  this->Mapper->OcclusionBounceOn();
  this->Mapper->SetInputData(MakeOpenSphere(60.0, false, true));
  EXPECT_LT(this->CompareNext(), Step);
}

// Views that share a mapper, each with a light of its own: none takes what the other has made.
TEST_F(OcclusionPointsTest, ViewsKeepTheirOwn)
{
  vtkNew<vtkRenderer> second;
  second->SetAutomaticLightCreation(false);
  second->SetEnvironmentUp(0.0, 0.0, 1.0);
  second->SetEnvironmentRight(1.0, 0.0, 0.0);
  second->SetActiveCamera(this->Renderer->GetActiveCamera());
  second->AddActor(this->Actor);
  second->SetViewport(0.0, 0.0, 0.01, 0.01);
  this->Window->AddRenderer(second);
  EXPECT_EQ(this->Count([this]() { this->RenderEncoded(); }), 2u);
  EXPECT_EQ(this->Count(
              [this]()
              {
                this->RenderEncoded();
                this->Renderer->GetActiveCamera()->Azimuth(10.0);
                this->RenderEncoded();
              }),
    0u);
  EXPECT_LT(this->CompareNext(), Step);
  // The light of one turns.
  this->RenderEncoded();
  second->SetEnvironmentUp(0.0, -1.0, 0.0);
  EXPECT_EQ(this->Count([this]() { this->RenderEncoded(); }), 1u);
  EXPECT_LT(this->CompareNext(), Step);
  // Another window.
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(this->Actor);
  renderer->GetActiveCamera()->SetPosition(4.0, 1.0, -2.0);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(32, 32);
  window->AddRenderer(renderer);
  window->Render();
  EXPECT_LT(this->CompareNext(), Step);
}

// More lights than are kept at a time.
TEST_F(OcclusionPointsTest, OldOnesGo)
{
  std::vector<vtkSmartPointer<vtkActor>> actors;
  for (std::size_t k = 0; k < OcclusionVertexCache::MostStates + 2; ++k)
  {
    actors.push_back(vtkSmartPointer<vtkActor>::New());
    actors.back()->SetMapper(this->Mapper);
    actors.back()->SetScale(0.3);
    actors.back()->SetPosition(0.3 * static_cast<double>(k) - 0.8, 0.0, 0.0);
    actors.back()->RotateX(-20.0 * static_cast<double>(k));
    this->Renderer->AddActor(actors.back());
  }
  this->Renderer->RemoveActor(this->Actor);
  EXPECT_LT(this->CompareNext(), Step);
  EXPECT_LT(this->CompareNext(), Step);
}

// Blocks share buffers: with arrays and without, of two materials.
TEST_F(OcclusionPointsTest, BlocksAreTheSame)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.3);
  ball->SetCenter(0.0, 0.0, 0.9);
  ball->Update();
  blocks->SetBlock(0, ball->GetOutput()); // without
  blocks->SetBlock(1, MakeOpenSphere(60.0, false, false, -0.5));
  blocks->SetBlock(2, MakeOpenSphere(80.0, false, false, 0.5));
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkCompositeMeasuredBRDFMapper> composite;
  composite->SetInputDataObject(blocks);
  composite->SetBRDF(this->BRDF);
  composite->SetIntegrator(this->Integrator);
  composite->SetEnvironment(this->Environment);
  this->Actor->SetMapper(composite);
  this->Actor->SetScale(0.6);
  EXPECT_LT(this->CompareNext(), Step);
  this->Environment->SetRotationY(30.0);
  EXPECT_EQ(this->Count([this]() { this->RenderEncoded(); }), 1u);
  EXPECT_EQ(this->Count([this]() { this->RenderEncoded(); }), 0u);
  const FloatImage before = this->RenderEncoded();
  composite->SetOcclusionModeToOff();
  EXPECT_GT(GetLargestStep(before, this->RenderEncoded()), 10.0 * Step);
  composite->SetOcclusionModeToArrays();
  this->Environment->SetRotationY(90.0);
  EXPECT_LT(this->CompareNext(), Step);
  // Each of several materials would make it for the points of all.
  composite->SetBlockBRDF(3, lambert);
  EXPECT_EQ(this->Count([this]() { this->RenderEncoded(); }), 0u);
}

// Lights of the scene are not hidden, before and after those of a map.
TEST_F(OcclusionPointsTest, NothingIsKeptWithoutAMap)
{
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToHeadlight();
  this->Renderer->AddLight(lamp);
  const auto drawn = [this]()
  {
    const std::size_t before = OcclusionVertexCache::GetAddedCount();
    this->RenderEncoded();
    return OcclusionVertexCache::GetAddedCount() - before;
  };
  this->Mapper->SetEnvironment(nullptr);
  this->Mapper->SetIntegrator(nullptr);
  EXPECT_EQ(drawn(), 0u);
  this->Mapper->SetIntegrator(this->Integrator);
  this->Mapper->SetEnvironment(this->Environment);
  EXPECT_GT(drawn(), 0u);
  this->Mapper->SetEnvironment(nullptr);
  this->Mapper->SetIntegrator(nullptr);
  EXPECT_EQ(drawn(), 0u);
}

// Peeling first draws depths alone, with a program that reads nothing of the light.
TEST_F(OcclusionPointsTest, PeelingReportsNothing)
{
  vtkNew<vtkStringOutputWindow> messages;
  vtkOutputWindow::SetInstance(messages);
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetUseDepthPeeling(true);
    renderer->SetMaximumNumberOfPeels(4);
    renderer->AddActor(this->Actor);
    this->Actor->GetProperty()->SetOpacity(0.5);
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetAlphaBitPlanes(1);
    window->SetSize(32, 32);
    window->AddRenderer(renderer);
    const std::size_t before = OcclusionVertexCache::GetAddedCount();
    window->Render();
    window->Render();
    EXPECT_GT(OcclusionVertexCache::GetAddedCount(), before);
  } // and the window goes before the mapper
  EXPECT_LT(this->CompareNext(), Step);
  vtkOutputWindow::SetInstance(nullptr);
  EXPECT_EQ(messages->GetOutput(), "");
}
