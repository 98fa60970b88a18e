// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces leave out triangles that face away, and look as with them.
#include "FacingDrawing.h"
#include "FacingTriangles.h"
#include "OcclusionTools.h"
#include "RenderFixture.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkMatrix4x4.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
constexpr int Triangles = 10400;

class CountingMapper : public vtkMeasuredBRDFMapper
{
public:
  static CountingMapper* New();
  vtkTypeMacro(CountingMapper, vtkMeasuredBRDFMapper);
  double GetTriangles() { return this->Primitives[PrimitiveTris].IBO->IndexCount / 3.0; }
};
vtkStandardNewMacro(CountingMapper);

// A ball with a waist, which hides a part of its sky.
vtkSmartPointer<vtkPolyData> MakeWaist(double endPhi = 180.0)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.7);
  ball->SetThetaResolution(80);
  ball->SetPhiResolution(67);
  ball->SetEndPhi(endPhi);
  ball->Update();
  vtkSmartPointer<vtkPolyData> surface = ball->GetOutput();
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    double p[3];
    surface->GetPoint(k, p);
    const double waist = 1.0 - 0.5 * std::exp(-40.0 * p[2] * p[2]);
    surface->GetPoints()->SetPoint(k, waist * p[0], waist * p[1], p[2]);
  }
  return surface;
}
}

class FacingTest : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("sky"));
    MakeSmall(this->Integrator.Get());
    this->Mapper->SetBRDF(this->BRDF);
    this->Mapper->SetEnvironment(this->Environment);
    this->Mapper->SetIntegrator(this->Integrator);
    this->Mapper->SetOcclusionModeToOn();
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Nothing->SetOrigin(0.0, 0.0, -100.0);
    this->Nothing->SetNormal(0.0, 0.0, 1.0);
    this->Mapper->SetInputData(MakeWaist());
  }

  /// The largest difference from the same picture with all triangles, relative to its brightest
  /// pixel; a plane that cuts nothing off keeps them.
  double Compare()
  {
    const FloatImage drawn = this->RenderLinear();
    this->Drawn = this->Mapper->GetTriangles();
    this->Mapper->AddClippingPlane(this->Nothing);
    const FloatImage all = this->RenderLinear();
    EXPECT_GE(this->Mapper->GetTriangles(), Triangles);
    this->Mapper->RemoveClippingPlane(this->Nothing);
    double difference = 0.0;
    double brightest = 0.0;
    for (std::size_t k = 0; k < all.RGBA.size(); ++k)
    {
      if (k % 4 != 3)
      {
        difference = std::max<double>(difference, std::abs(drawn.RGBA[k] - all.RGBA[k]));
        brightest = std::max<double>(brightest, all.RGBA[k]);
      }
    }
    EXPECT_GT(brightest, 0.01);
    return difference / brightest;
  }

  double Drawn = 0.0; // triangles
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkLambertBRDF> BRDF;
  vtkNew<vtkHybridRadianceIntegrator> Integrator;
  vtkNew<CountingMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkPlane> Nothing;
};

// Pictures stay as they are from any side, in both projections, of actors that are turned and
// scaled unevenly; about half of the triangles are drawn.
TEST_F(FacingTest, PicturesStayAsTheyAre)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  for (int view = 0; view < 8; ++view)
  {
    camera->SetParallelProjection(view % 2);
    this->Actor->SetOrientation(20.0 * view, 0.0, 10.0);
    this->Actor->SetScale(view < 4 ? 1.0 : 1.2, 0.8, 1.0);
    EXPECT_LT(this->Compare(), 1e-6) << "view " << view;
    EXPECT_GT(this->Drawn, 0.3 * Triangles) << "view " << view;
    EXPECT_LT(this->Drawn, 0.6 * Triangles) << "view " << view;
    camera->Azimuth(50.0);
    camera->Elevation(8.0);
  }
}

// Whoever looks into the surface sees its inside: from within, through the near plane, or where a
// part is missing.
TEST_F(FacingTest, InsidesThatAreSeenAreDrawn)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  EXPECT_LT(this->Compare(), 1e-6);
  EXPECT_LT(this->Drawn, 0.6 * Triangles);
  camera->SetClippingRange(4.9, 20.0);
  this->RenderLinear();
  EXPECT_GE(this->Mapper->GetTriangles(), Triangles);
  camera->SetClippingRange(0.1, 20.0);
  camera->ParallelProjectionOff();
  camera->SetPosition(0.0, 0.0, 0.3);
  this->RenderLinear();
  EXPECT_GE(this->Mapper->GetTriangles(), Triangles);
  camera->SetPosition(0.0, 0.0, 5.0);
  this->RenderLinear();
  EXPECT_LT(this->Mapper->GetTriangles(), 0.6 * Triangles);
  this->Mapper->SetInputData(MakeWaist(150.0));
  this->RenderLinear();
  EXPECT_GT(this->Mapper->GetTriangles(), 0.9 * Triangles);
}

// All triangles are back where others need them, and where nothing says that the surface is closed.
TEST_F(FacingTest, OthersHaveAllTriangles)
{
  const auto count = [this]()
  {
    this->RenderLinear();
    return this->Mapper->GetTriangles();
  };
  EXPECT_LT(count(), 0.6 * Triangles);
  this->Mapper->SetOcclusionModeToOff();
  EXPECT_GE(count(), Triangles);
  this->Mapper->SetOcclusionModeToOn();
  EXPECT_LT(count(), 0.6 * Triangles);
  this->Actor->GetProperty()->SetOpacity(0.5);
  EXPECT_GE(count(), Triangles);
  this->Actor->GetProperty()->SetOpacity(1.0);
  EXPECT_LT(count(), 0.6 * Triangles);
  this->Actor->GetProperty()->EdgeVisibilityOn();
  EXPECT_GE(count(), Triangles);
  this->Actor->GetProperty()->EdgeVisibilityOff();
  EXPECT_LT(count(), 0.6 * Triangles);
  // Another surface, of as many triangles.
  vtkSmartPointer<vtkPolyData> changed = MakeWaist();
  changed->GetPoints()->SetPoint(5, 0.0, 0.0, 0.6);
  this->Mapper->SetInputData(changed);
  EXPECT_LT(this->Compare(), 1e-6);
  EXPECT_LT(this->Drawn, 0.6 * Triangles);
}

TEST(FacingTriangles, TheEyeOfAProjection)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(1.0, 2.0, 7.0);
  camera->SetFocalPoint(0.5, 0.0, 1.0);
  camera->SetClippingRange(0.5, 30.0);
  for (const bool parallel : { false, true })
  {
    camera->SetParallelProjection(parallel);
    vtkMatrix4x4* matrix = camera->GetCompositeProjectionTransformMatrix(1.5, -1.0, 1.0);
    glm::dmat4 toClip;
    for (int k = 0; k < 16; ++k)
    {
      toClip[k % 4][k / 4] = matrix->GetElement(k / 4, k % 4);
    }
    const glm::dvec4 eye = measuredbrdf::FindEye(toClip);
    const glm::dvec3 towards(0.5, 2.0, 6.0);
    const glm::dvec4 expected =
      parallel ? glm::dvec4(glm::normalize(towards), 0.0) : glm::dvec4(1.0, 2.0, 7.0, 1.0);
    EXPECT_LT(glm::length(eye - expected), 1e-9) << parallel;
  }
}
