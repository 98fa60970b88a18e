// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a camera sees of a surface, as plans for a view want it, against areas worked out by hand.

#include "VisibleSurface.h"

#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkCubeSource.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using measuredbrdf::VisibleSurface;

constexpr double Pi = 3.14159265358979323846;
const double Identity[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };

class Visible : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Sphere->SetThetaResolution(60);
    this->Sphere->SetPhiResolution(60);
    this->Sphere->Update();
    this->Camera->SetPosition(0.0, 0.0, 5.0);
    this->Camera->SetFocalPoint(0.0, 0.0, 0.0);
    this->Camera->SetViewUp(0.0, 1.0, 0.0);
    this->Camera->SetClippingRange(0.1, 100.0);
    this->Camera->ParallelProjectionOn();
    this->Camera->SetParallelScale(1.0);
  }

  VisibleSurface See(
    vtkPolyData* surface, int width = 400, int height = 200, const double* frame = Identity)
  {
    return VisibleSurface({ surface }, this->Matrix, this->Camera, width, height, frame);
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkCamera> Camera;
  vtkNew<vtkMatrix4x4> Matrix;
};
}

//------------------------------------------------------------------------------
// Seen in parallel, pairs are uniform over the disc.
TEST_F(Visible, SpheresCoverTheirDiscs)
{
  const VisibleSurface seen = this->See(this->Sphere->GetOutput());
  ASSERT_EQ(seen.GetNormals().size(), 4096u);
  ASSERT_EQ(seen.GetViews().size(), 4096u);
  double mean = 0.0;
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < 4096; ++k)
  {
    const glm::dvec3& n = seen.GetNormals()[k];
    EXPECT_NEAR(glm::length(n), 1.0, 1e-12);
    EXPECT_EQ(seen.GetViews()[k], glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_GE(n.z, 0.0);
    mean += n.z / 4096.0;
    sum += n / 4096.0;
  }
  // The cosine's mean is 2/3.
  EXPECT_NEAR(mean, 2.0 / 3.0, 0.02);
  EXPECT_NEAR(sum.x, 0.0, 0.03);
  EXPECT_NEAR(sum.y, 0.0, 0.03);
}

//------------------------------------------------------------------------------
// A cone from its tip: the flank is seen, not the base.
TEST_F(Visible, ConesShowTheirFlank)
{
  vtkNew<vtkConeSource> cone;
  cone->SetDirection(0.0, 0.0, 1.0);
  cone->SetHeight(1.0);
  cone->SetRadius(0.5);
  cone->SetResolution(100);
  cone->Update();
  const VisibleSurface seen = this->See(cone->GetOutput());
  ASSERT_FALSE(seen.IsEmpty());
  for (const glm::dvec3& n : seen.GetNormals())
  {
    EXPECT_NEAR(n.z, 0.5 / std::sqrt(1.25), 0.01);
  }
}

//------------------------------------------------------------------------------
// Two equal plates that face the camera, one at twice the distance: pixels fall by its square.
TEST_F(Visible, WhatIsNearCountsForMore)
{
  this->Camera->ParallelProjectionOff();
  this->Camera->SetViewAngle(30.0);
  vtkNew<vtkPlaneSource> plates[2];
  for (int k = 0; k < 2; ++k)
  {
    plates[k]->SetOrigin(-0.05, -0.05, 0.0);
    plates[k]->SetPoint1(0.05, -0.05, 0.0);
    plates[k]->SetPoint2(-0.05, 0.05, 0.0);
    plates[k]->SetCenter(k == 0 ? -0.5 : 1.0, 0.0, k == 0 ? 3.0 : 1.0);
    plates[k]->Update();
  }
  const VisibleSurface seen({ plates[0]->GetOutput(), plates[1]->GetOutput() }, this->Matrix,
    this->Camera, 400, 200, Identity);
  ASSERT_EQ(seen.GetViews().size(), 4096u);
  double near = 0.0;
  for (const glm::dvec3& view : seen.GetViews())
  {
    near += view.x > 0.0 ? 1.0 / 4096.0 : 0.0;
  }
  EXPECT_NEAR(near, 0.8, 0.01);
}

//------------------------------------------------------------------------------
// Scaled unevenly and turned: normals by the inverse transpose.
TEST_F(Visible, ActorsAreTransformed)
{
  vtkNew<vtkPlaneSource> plane; // 1 x 1, normal +z
  plane->Update();
  vtkNew<vtkTransform> transform;
  transform->RotateY(60.0);
  transform->Scale(0.5, 0.25, 7.0);
  this->Matrix->DeepCopy(transform->GetMatrix());
  const VisibleSurface seen = this->See(plane->GetOutput());
  ASSERT_FALSE(seen.IsEmpty());
  for (const glm::dvec3& n : seen.GetNormals())
  {
    EXPECT_NEAR(glm::distance(n, glm::dvec3(std::sqrt(0.75), 0.0, 0.5)), 0.0, 1e-9);
  }

  // A slanted one, stretched along x, faces further away from x.
  vtkNew<vtkPlaneSource> slanted;
  slanted->SetNormal(0.6, 0.0, 0.8);
  slanted->Update();
  vtkNew<vtkMatrix4x4> stretched;
  stretched->SetElement(0, 0, 2.0);
  const VisibleSurface wide({ slanted->GetOutput() }, stretched, this->Camera, 400, 200, Identity);
  ASSERT_FALSE(wide.IsEmpty());
  const glm::dvec3 expected = glm::normalize(glm::dvec3(0.3, 0.0, 0.8));
  EXPECT_NEAR(glm::distance(wide.GetNormals()[0], expected), 0.0, 1e-6);

  // Into another frame: z becomes x.
  const double frame[9] = { 0, 0, 1, 1, 0, 0, 0, 1, 0 };
  const VisibleSurface turned = this->See(plane->GetOutput(), 400, 200, frame);
  EXPECT_NEAR(
    glm::distance(turned.GetNormals()[0], glm::dvec3(0.5, std::sqrt(0.75), 0.0)), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(turned.GetViews()[0], glm::dvec3(1.0, 0.0, 0.0)), 0.0, 1e-9);
}

//------------------------------------------------------------------------------
TEST_F(Visible, OnlyWhatIsInThePictureCounts)
{
  // Half of the sphere right of the picture's left edge.
  this->Camera->SetPosition(2.0, 0.0, 5.0);
  this->Camera->SetFocalPoint(2.0, 0.0, 0.0);
  const VisibleSurface half = this->See(this->Sphere->GetOutput());
  EXPECT_NEAR(static_cast<double>(half.GetNormals().size()), 2048.0, 100.0);
  for (const glm::dvec3& n : half.GetNormals())
  {
    EXPECT_GE(n.x, -0.05);
  }
  this->Camera->SetPosition(9.0, 0.0, 5.0);
  this->Camera->SetFocalPoint(9.0, 0.0, 0.0);
  EXPECT_TRUE(this->See(this->Sphere->GetOutput()).IsEmpty());
  vtkNew<vtkPolyData> nothing;
  EXPECT_TRUE(this->See(nothing).IsEmpty());
}

//------------------------------------------------------------------------------
// A room shows the sides that face away.
TEST_F(Visible, RoomsAreSeenFromInside)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  this->Camera->ParallelProjectionOff();
  this->Camera->SetPosition(0.0, 0.0, 0.1);
  const VisibleSurface seen = this->See(cube->GetOutput());
  ASSERT_FALSE(seen.IsEmpty());
  for (std::size_t k = 0; k < seen.GetNormals().size(); ++k)
  {
    EXPECT_GT(glm::dot(seen.GetNormals()[k], seen.GetViews()[k]), 0.0);
  }
}

//------------------------------------------------------------------------------
// Half spheres: as strips, without normals, of many polygons; and two of them as blocks.
TEST_F(Visible, StripsAndLargeMeshesAreAlike)
{
  const auto getMean = [](const VisibleSurface& seen)
  {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& n : seen.GetNormals())
    {
      sum += n;
    }
    return sum / static_cast<double>(seen.GetNormals().size());
  };
  vtkNew<vtkSphereSource> halves[2];
  for (int k = 0; k < 2; ++k)
  {
    halves[k]->SetThetaResolution(100);
    halves[k]->SetPhiResolution(200);
    halves[k]->SetStartTheta(180.0 * k);
    halves[k]->SetEndTheta(180.0 * k + 180.0);
    halves[k]->Update();
  }
  const glm::dvec3 expected(0.0, 4.0 / (3.0 * Pi), 2.0 / 3.0); // of half a disc
  const auto expectHalf = [&](vtkPolyData* surface)
  { EXPECT_LT(glm::distance(getMean(this->See(surface)), expected), 0.03); };
  expectHalf(halves[0]->GetOutput());
  halves[0]->SetThetaResolution(30);
  halves[0]->SetPhiResolution(60);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(halves[0]->GetOutputPort());
  stripper->Update();
  expectHalf(stripper->GetOutput());
  stripper->GetOutput()->GetPointData()->SetNormals(nullptr); // the triangles' own
  expectHalf(stripper->GetOutput());
  const VisibleSurface both({ halves[0]->GetOutput(), halves[1]->GetOutput() }, this->Matrix,
    this->Camera, 400, 200, Identity);
  EXPECT_NEAR(getMean(both).y, 0.0, 0.03);
}
