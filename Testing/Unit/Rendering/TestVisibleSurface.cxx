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

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace
{
using measuredbrdf::VisibleSurface;

std::vector<glm::dvec3> Get(vtkDoubleArray* array)
{
  std::vector<glm::dvec3> directions(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t k = 0; k < directions.size(); ++k)
  {
    array->GetTuple(static_cast<vtkIdType>(k), &directions[k].x);
  }
  return directions;
}

glm::dvec3 GetMean(const std::vector<glm::dvec3>& directions)
{
  return std::accumulate(directions.begin(), directions.end(), glm::dvec3(0.0)) /
         static_cast<double>(directions.size());
}

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

  VisibleSurface See(const std::vector<vtkPolyData*>& surfaces, const double* frame = Identity)
  {
    return VisibleSurface(surfaces, this->Matrix, this->Camera, 2.0, frame);
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
  const VisibleSurface seen = this->See({ this->Sphere->GetOutput() });
  const std::vector<glm::dvec3> normals = Get(seen.Normals);
  const std::vector<glm::dvec3> views = Get(seen.Views);
  EXPECT_NEAR(static_cast<double>(normals.size()), 0.25 * Pi * 16384.0, 200.0);
  ASSERT_EQ(views.size(), normals.size());
  for (std::size_t k = 0; k < normals.size(); ++k)
  {
    EXPECT_NEAR(glm::length(normals[k]), 1.0, 1e-6);
    EXPECT_NEAR(glm::distance(views[k], glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-9);
    EXPECT_GE(normals[k].z, 0.0);
  }
  // The cosine's mean is 2/3.
  EXPECT_LT(glm::distance(GetMean(normals), glm::dvec3(0.0, 0.0, 2.0 / 3.0)), 0.02);
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
  const VisibleSurface seen = this->See({ cone->GetOutput() });
  ASSERT_FALSE(seen.IsEmpty());
  for (const glm::dvec3& n : Get(seen.Normals))
  {
    EXPECT_NEAR(n.z, 0.5 / std::sqrt(1.25), 0.01);
  }
}

//------------------------------------------------------------------------------
// Two equal plates that face the camera, one at twice the distance: pixels fall by its square. What
// hides behind the nearer one does not count.
TEST_F(Visible, WhatIsNearCountsForMore)
{
  this->Camera->ParallelProjectionOff();
  this->Camera->SetViewAngle(30.0);
  std::vector<vtkPolyData*> surfaces;
  vtkNew<vtkPlaneSource> plates[3];
  for (int k = 0; k < 3; ++k)
  {
    plates[k]->SetOrigin(-0.25, -0.25, 0.0);
    plates[k]->SetPoint1(0.25, -0.25, 0.0);
    plates[k]->SetPoint2(-0.25, 0.25, 0.0);
    plates[k]->SetCenter(k == 0 ? -0.5 : 1.0, 0.0, k == 0 ? 3.0 : 1.0);
    plates[k]->Update();
    surfaces.push_back(plates[k]->GetOutput());
  }
  plates[2]->SetCenter(-1.5, 0.0, -1.0); // seen through the middle of the first
  plates[2]->Update();
  const std::vector<glm::dvec3> views = Get(this->See(surfaces).Views);
  ASSERT_FALSE(views.empty());
  const auto near =
    std::count_if(views.begin(), views.end(), [](const glm::dvec3& view) { return view.x > 0.0; });
  EXPECT_NEAR(static_cast<double>(near) / static_cast<double>(views.size()), 0.8, 0.01);
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
  const VisibleSurface seen = this->See({ plane->GetOutput() });
  ASSERT_FALSE(seen.IsEmpty());
  for (const glm::dvec3& n : Get(seen.Normals))
  {
    EXPECT_NEAR(glm::distance(n, glm::dvec3(std::sqrt(0.75), 0.0, 0.5)), 0.0, 1e-6);
  }

  // A slanted one, stretched along x, faces further away from x.
  vtkNew<vtkPlaneSource> slanted;
  slanted->SetNormal(0.6, 0.0, 0.8);
  slanted->Update();
  vtkNew<vtkMatrix4x4> stretched;
  stretched->SetElement(0, 0, 2.0);
  const VisibleSurface wide({ slanted->GetOutput() }, stretched, this->Camera, 2.0, Identity);
  ASSERT_FALSE(wide.IsEmpty());
  const glm::dvec3 expected = glm::normalize(glm::dvec3(0.3, 0.0, 0.8));
  EXPECT_NEAR(glm::distance(Get(wide.Normals)[0], expected), 0.0, 1e-6);

  // Into another frame: z becomes x.
  const double frame[9] = { 0, 0, 1, 1, 0, 0, 0, 1, 0 };
  const VisibleSurface turned = this->See({ plane->GetOutput() }, frame);
  EXPECT_NEAR(
    glm::distance(Get(turned.Normals)[0], glm::dvec3(0.5, std::sqrt(0.75), 0.0)), 0.0, 1e-6);
  EXPECT_NEAR(glm::distance(Get(turned.Views)[0], glm::dvec3(1.0, 0.0, 0.0)), 0.0, 1e-9);
}

//------------------------------------------------------------------------------
TEST_F(Visible, OnlyWhatIsInThePictureCounts)
{
  // Half of the sphere right of the picture's left edge.
  this->Camera->SetPosition(2.0, 0.0, 5.0);
  this->Camera->SetFocalPoint(2.0, 0.0, 0.0);
  const VisibleSurface half = this->See({ this->Sphere->GetOutput() });
  ASSERT_FALSE(half.IsEmpty());
  for (const glm::dvec3& n : Get(half.Normals))
  {
    EXPECT_GE(n.x, -0.05);
  }
  this->Camera->SetPosition(9.0, 0.0, 5.0);
  this->Camera->SetFocalPoint(9.0, 0.0, 0.0);
  EXPECT_TRUE(this->See({ this->Sphere->GetOutput() }).IsEmpty());
  vtkNew<vtkPolyData> nothing;
  EXPECT_TRUE(this->See({ nothing }).IsEmpty());
}

//------------------------------------------------------------------------------
// A room shows the sides that face away.
TEST_F(Visible, RoomsAreSeenFromInside)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  this->Camera->ParallelProjectionOff();
  this->Camera->SetPosition(0.0, 0.0, 0.1);
  const VisibleSurface seen = this->See({ cube->GetOutput() });
  const std::vector<glm::dvec3> normals = Get(seen.Normals);
  const std::vector<glm::dvec3> views = Get(seen.Views);
  EXPECT_EQ(normals.size(), 16384u);
  for (std::size_t k = 0; k < normals.size(); ++k)
  {
    EXPECT_GT(glm::dot(normals[k], views[k]), 0.0);
  }
}

//------------------------------------------------------------------------------
// Half spheres: as strips, without normals; and two of them as blocks.
TEST_F(Visible, StripsAndBlocksAreAlike)
{
  vtkNew<vtkSphereSource> halves[2];
  for (int k = 0; k < 2; ++k)
  {
    halves[k]->SetThetaResolution(30);
    halves[k]->SetPhiResolution(60);
    halves[k]->SetStartTheta(180.0 * k);
    halves[k]->SetEndTheta(180.0 * k + 180.0);
    halves[k]->Update();
  }
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(halves[0]->GetOutputPort());
  stripper->Update();
  vtkNew<vtkPolyData> bare;
  bare->ShallowCopy(stripper->GetOutput());
  bare->GetPointData()->SetNormals(nullptr);                   // the triangles' own
  const glm::dvec3 expected(0.0, 4.0 / (3.0 * Pi), 2.0 / 3.0); // of half a disc
  for (vtkPolyData* half : { halves[0]->GetOutput(), stripper->GetOutput(), bare.Get() })
  {
    EXPECT_LT(glm::distance(GetMean(Get(this->See({ half }).Normals)), expected), 0.03);
  }
  const VisibleSurface both = this->See({ halves[0]->GetOutput(), halves[1]->GetOutput() });
  EXPECT_NEAR(GetMean(Get(both.Normals)).y, 0.0, 0.03);
}
