// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkSurfaceVisibilityFilter where methods of occlusion tend to break: slits, contacts, occluders
// that move. Closed forms throughout.
#include "HiddenSky.h"
#include "TraceSurface.h"
#include "vtkSurfaceVisibilityFilter.h"

#include "vtkCellArray.h"
#include "vtkCubeSource.h"
#include "vtkFloatArray.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace
{
using measuredbrdf::HiddenSky;
using Point = std::array<double, 3>;

double GetHidden(vtkPolyData* traced, vtkIdType point, const std::string& suffix = "")
{
  const auto get = [traced, suffix](const std::string& name)
  {
    return vtkUnsignedCharArray::SafeDownCast(
      traced->GetPointData()->GetArray((name + suffix).c_str()));
  };
  HiddenSky::Code code;
  std::copy_n(get(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName())
                ->GetPointer(point * HiddenSky::SectorBytes),
    HiddenSky::SectorBytes, code.begin());
  std::copy_n(get(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName())
                ->GetPointer(point * HiddenSky::TransferBytes),
    HiddenSky::TransferBytes, code.begin() + HiddenSky::SectorBytes);
  return HiddenSky(code).GetHiddenCosine();
}

// Triangles about some points of a plane z = 0, so that each has its own place.
vtkSmartPointer<vtkPolyData> MakeFloor(const std::vector<Point>& places, double size)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const Point& p : places)
  {
    const vtkIdType first = points->InsertNextPoint(p.data());
    points->InsertNextPoint(p[0] + size, p[1], p[2]);
    points->InsertNextPoint(p[0], p[1] + size, p[2]);
    const vtkIdType ids[3] = { first, first + 1, first + 2 };
    triangles->InsertNextCell(3, ids);
    for (int k = 0; k < 3; ++k)
    {
      normals->InsertNextTuple3(0.0, 0.0, 1.0);
    }
  }
  auto floor = vtkSmartPointer<vtkPolyData>::New();
  floor->SetPoints(points);
  floor->SetPolys(triangles);
  floor->GetPointData()->SetNormals(normals);
  return floor;
}

vtkSmartPointer<vtkPolyData> MakeWall(double x, double length, double height)
{
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(x, -length, 0.0);
  wall->SetPoint1(x, length, 0.0);
  wall->SetPoint2(x, -length, height);
  wall->Update();
  return wall->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeBall(double z)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(0.0, 0.0, z);
  source->SetRadius(1.0);
  source->SetThetaResolution(120);
  source->SetPhiResolution(80);
  source->Update();
  return source->GetOutput();
}

// The bottom of a slit as deep as wide sees 1 / sqrt(5) of the irradiance, however narrow.
TEST(OcclusionStability, SlitsOfAnyWidth)
{
  for (const double width : { 1.0, 0.1, 0.01, 0.001 })
  {
    vtkNew<vtkSurfaceVisibilityFilter> filter;
    filter->SetNumberOfRays(512);
    filter->AddOccluder(MakeWall(-0.5 * width, 20.0, width));
    filter->AddOccluder(MakeWall(0.5 * width, 20.0, width));
    vtkPolyData* traced = Trace(filter, MakeFloor({ { 0.0, 0.0, 0.0 } }, 0.02 * width));
    EXPECT_NEAR(1.0 - GetHidden(traced, 0), 1.0 / std::sqrt(5.0), 0.02) << width;
  }
}

// A unit sphere that lies on the plane hides (1 + d^2)^(-3/2) at a distance d from where they
// touch.
TEST(OcclusionStability, ContactsAreDarkToTheLastPoint)
{
  const std::vector<double> distances = { 0.02, 0.1, 0.3, 1.0, 3.0 };
  std::vector<Point> places;
  for (const double d : distances)
  {
    places.push_back({ d, 0.0, 0.0 });
  }
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetNumberOfRays(512);
  filter->AddOccluder(MakeBall(1.0));
  vtkPolyData* traced = Trace(filter, MakeFloor(places, 1e-3));
  for (std::size_t k = 0; k < distances.size(); ++k)
  {
    const double hidden = std::pow(1.0 + distances[k] * distances[k], -1.5);
    EXPECT_NEAR(GetHidden(traced, static_cast<vtkIdType>(3 * k)), hidden, 0.02) << distances[k];
  }
}

// A sphere above a plane hides 1 / z^2 of the irradiance below it, wherever it was before.
TEST(OcclusionStability, OccludersMayMove)
{
  const auto floor = MakeFloor({ { 0.0, 0.0, 0.0 } }, 1e-3);
  vtkNew<vtkPolyData> sphere;
  sphere->DeepCopy(MakeBall(2.0));
  vtkNew<vtkMatrix4x4> place;
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetNumberOfRays(512);
  filter->AddOccluder(sphere, place);
  EXPECT_NEAR(GetHidden(Trace(filter, floor), 0), 1.0 / 4.0, 0.02);
  for (vtkIdType k = 0; k < sphere->GetNumberOfPoints(); ++k)
  {
    double p[3];
    sphere->GetPoint(k, p);
    sphere->GetPoints()->SetPoint(k, p[0], p[1], p[2] + 1.0);
  }
  sphere->GetPoints()->Modified();
  EXPECT_NEAR(GetHidden(Trace(filter, floor), 0), 1.0 / 9.0, 0.02);
  EXPECT_EQ(filter->GetNumberOfTraces(), 2);
  place->SetElement(2, 3, -1.5);
  EXPECT_NEAR(GetHidden(Trace(filter, floor), 0), 1.0 / 2.25, 0.02);
  EXPECT_EQ(filter->GetNumberOfTraces(), 3);
  EXPECT_NEAR(GetHidden(Trace(filter, floor), 0), 1.0 / 2.25, 0.02);
  EXPECT_EQ(filter->GetNumberOfTraces(), 3);
}

// A floor that goes on below a wall: points beyond the wall see nothing, but the triangles that
// stick out are to be as bright at the wall's foot as they are there, half.
TEST(OcclusionStability, PointsInsideOtherBodiesDarkenNothing)
{
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-1.95, -1.95, 0.0);
  floor->SetPoint1(2.05, -1.95, 0.0); // points at -0.05 and 0.05, the wall at 0
  floor->SetPoint2(-1.95, 2.05, 0.0);
  floor->SetResolution(40, 40);
  vtkNew<vtkCubeSource> wall;
  wall->SetBounds(0.0, 200.0, -200.0, 200.0, -1.0, 200.0);
  wall->Update();
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetNumberOfRays(512);
  filter->AddOccluder(wall->GetOutput());
  floor->Update();
  vtkPolyData* traced = Trace(filter, floor->GetOutput());
  for (const double x : { -0.05, 0.05 })
  {
    double foot[3] = { x, 0.05, 0.0 };
    EXPECT_NEAR(GetHidden(traced, traced->FindPoint(foot)), 0.5, 0.03) << x;
  }
  double inside[3] = { 1.05, 0.05, 0.0 };
  EXPECT_GT(GetHidden(traced, traced->FindPoint(inside)), 0.98);
}

// Two sheets that almost touch: the sides between them are dark, the others see all.
TEST(OcclusionStability, SheetsOnOneAnother)
{
  for (const double gap : { 0.1, 1e-3 })
  {
    vtkNew<vtkSurfaceVisibilityFilter> filter;
    filter->BothSidesOn();
    vtkNew<vtkPlaneSource> above;
    above->SetOrigin(-50.0, -50.0, gap);
    above->SetPoint1(50.0, -50.0, gap);
    above->SetPoint2(-50.0, 50.0, gap);
    above->Update();
    filter->AddOccluder(above->GetOutput());
    vtkPolyData* traced = Trace(filter, MakeFloor({ { 0.0, 0.0, 0.0 } }, 1.0));
    EXPECT_GT(GetHidden(traced, 0), 0.98) << gap;
    EXPECT_LT(GetHidden(traced, 0, "Back"), 0.01) << gap;
  }
}
}

// Polygons without points, or with points that the surface lacks, are none: nothing is read.
TEST(OcclusionStability, PolygonsThatAreNoneChangeNothing)
{
  const auto floor = MakeFloor({ { 0.0, 0.0, 0.0 }, { 3.0, 0.0, 0.0 } }, 1.0);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  const double before = GetHidden(Trace(filter, floor), 0);
  const vtkIdType wrong[3] = { 0, 1, 1000000 };
  vtkNew<vtkCellArray> polygons;
  polygons->DeepCopy(floor->GetPolys());
  polygons->InsertNextCell(0, wrong);
  polygons->InsertNextCell(3, wrong);
  floor->SetPolys(polygons);
  EXPECT_EQ(GetHidden(Trace(filter, floor), 0), before);
}
