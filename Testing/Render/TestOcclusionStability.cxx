// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Drawing with vtkSurfaceVisibilityFilter's arrays where it tends to break: levels of detail
// and arrays of anything.
#include "RenderFixture.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLODActor.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkQuadricLODActor.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{
// A square in front of the camera, beside a sphere that hides a part of its sky.
vtkSmartPointer<vtkPolyData> MakeTraced(int resolution)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.9, -0.9, 0.0);
  plane->SetPoint1(0.9, -0.9, 0.0);
  plane->SetPoint2(-0.9, 0.9, 0.0);
  plane->SetResolution(resolution, resolution);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(1.2, 1.2, 0.5);
  sphere->SetRadius(0.8);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  sphere->Update();
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->AddOccluder(sphere->GetOutput());
  filter->SetInputConnection(triangles->GetOutputPort());
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

double Compare(const FloatImage& a, const FloatImage& b)
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < a.RGBA.size(); ++k)
  {
    if (k % 4 != 3)
    {
      difference += std::abs(a.RGBA[k] - b.RGBA[k]);
      sum += b.RGBA[k];
    }
  }
  return difference / sum;
}
}

class OcclusionStability : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("sky"));
    this->BRDF->SetSpecular(0.5, 0.5, 0.5);
    this->BRDF->SetExponent(40.0);
    this->Integrator->SetNumberOfRows(17);
    this->Integrator->SetNumberOfViewAngles(6);
    this->Integrator->SetNumberOfAzimuths(4);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->SetUpMapper(this->Mapper);
    this->Warned->SetClientData(&this->Warnings);
    this->Warned->SetCallback([](vtkObject*, unsigned long, void* texts, void* text)
      { static_cast<std::vector<std::string>*>(texts)->emplace_back(static_cast<char*>(text)); });
    this->Mapper->AddObserver(vtkCommand::WarningEvent, this->Warned);
  }

  void SetUpMapper(vtkMeasuredBRDFMapper* mapper)
  {
    mapper->SetBRDF(this->BRDF);
    mapper->SetEnvironment(this->Environment);
    mapper->SetIntegrator(this->Integrator);
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkBlinnPhongBRDF> BRDF;
  vtkNew<vtkHybridRadianceIntegrator> Integrator;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkCallbackCommand> Warned;
  std::vector<std::string> Warnings;
};

// Levels that VTK's actors make themselves are drawn by stock mappers from decimated points. What
// shows the surface itself keeps its arrays, whatever was drawn between.
TEST_F(OcclusionStability, ActorsWithLevelsKeepTheSurfacesArrays)
{
  if (this->IsWithoutDisplay())
  {
    GTEST_SKIP() << "VTK's interactors need a display";
  }
  const auto surface = MakeTraced(12);
  this->Mapper->SetInputData(surface);
  const FloatImage alone = this->RenderLinear();
  this->Mapper->SetOcclusionModeToOff();
  const FloatImage off = this->RenderLinear();
  EXPECT_GT(Compare(off, alone), 0.03);
  this->Mapper->SetOcclusionModeToAuto();
  this->Renderer->RemoveActor(this->Actor);
  vtkNew<vtkRenderWindowInteractor> interactor; // vtkQuadricLODActor needs one
  interactor->SetRenderWindow(this->Window);
  vtkNew<vtkLODActor> levels;
  levels->SetMapper(this->Mapper);
  vtkNew<vtkQuadricLODActor> quadric;
  quadric->SetMapper(this->Mapper);
  for (vtkActor* actor : { static_cast<vtkActor*>(levels), static_cast<vtkActor*>(quadric) })
  {
    this->Renderer->AddActor(actor);
    for (int round = 0; round < 2; ++round)
    {
      for (const double rate : { 1e6, 1e6, 1e-4 }) // frames a second: coarse, coarse, fine
      {
        this->Window->SetDesiredUpdateRate(rate);
        const FloatImage drawn = this->RenderLinear();
        for (const float value : drawn.RGBA)
        {
          ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << actor->GetClassName();
        }
        if (rate < 1.0)
        {
          EXPECT_LT(Compare(drawn, alone), 1e-6) << actor->GetClassName();
        }
      }
    }
    this->Renderer->RemoveActor(actor);
  }
  EXPECT_TRUE(this->Warnings.empty());
}

// Bytes of anything: no pixel is negative, not finite or brighter than without occlusion.
TEST_F(OcclusionStability, AnyBytesGiveAPicture)
{
  std::mt19937 generator(5);
  vtkNew<vtkPolyData> surface;
  surface->DeepCopy(MakeTraced(12));
  this->Mapper->SetInputData(surface);
  this->Mapper->SetOcclusionModeToOff();
  const FloatImage off = this->RenderLinear();
  this->Mapper->SetOcclusionModeToAuto();
  for (int k = 0; k < 3; ++k)
  {
    for (const char* name : { vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName(),
           vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() })
    {
      auto* bytes = vtkUnsignedCharArray::SafeDownCast(surface->GetPointData()->GetArray(name));
      for (vtkIdType v = 0; v < bytes->GetNumberOfValues(); ++v)
      {
        bytes->SetValue(v, k == 0 ? 255 : static_cast<unsigned char>(generator() % 256));
      }
      bytes->Modified();
    }
    surface->Modified();
    const FloatImage drawn = this->RenderEncoded();
    for (const float value : drawn.RGBA)
    {
      ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << k;
    }
    EXPECT_TRUE(this->Warnings.empty());
  }
}
