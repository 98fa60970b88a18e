// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkSurfaceVisibilityFilter: what it finds, keeps, and survives; slits, contacts and occluders
// that move, where methods of occlusion tend to break.
#include "ErrorCatcher.h"
#include "SurfacePoints.h"
#include "TraceSurface.h"
#include "vtkSurfaceVisibilityFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCubeSource.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <vector>

namespace
{
// VTK 9.6 has no form that takes three numbers.
vtkIdType FindOrigin(vtkPolyData* surface)
{
  double origin[3] = { 0.0, 0.0, 0.0 };
  return surface->FindPoint(origin);
}

using measuredbrdf::HorizonCode;

vtkSmartPointer<vtkPolyData> MakeSphere(double radius, double z, int resolution = 24)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetCenter(0.0, 0.0, z);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(2 * resolution / 3);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakePlane(double half, double z, int resolution)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-half, -half, z);
  source->SetPoint1(half, -half, z);
  source->SetPoint2(-half, half, z);
  source->SetResolution(resolution, resolution);
  source->Update();
  return source->GetOutput();
}

double GetHidden(vtkPolyData* surface, vtkIdType point, const std::string& suffix = "")
{
  return HorizonCode::GetHiddenCosine(GetCode(surface, point, suffix));
}

// Triangles about some points of a plane z = 0, so that each has its own place.
vtkSmartPointer<vtkPolyData> MakeFloor(const std::vector<glm::dvec3>& places, double size)
{
  std::vector<glm::dvec3> points;
  std::vector<std::vector<vtkIdType>> triangles;
  for (const glm::dvec3& p : places)
  {
    const auto first = static_cast<vtkIdType>(points.size());
    points.insert(points.end(), { p, p + glm::dvec3(size, 0, 0), p + glm::dvec3(0, size, 0) });
    triangles.push_back({ first, first + 1, first + 2 });
  }
  return MakeSurface(points, triangles);
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

bool AreEqual(vtkPolyData* a, vtkPolyData* b)
{
  const char* const names[] = { vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName(),
    vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() };
  return std::all_of(std::begin(names), std::end(names),
    [&](const char* name)
    {
      vtkUnsignedCharArray* x = GetBytes(a, name);
      vtkUnsignedCharArray* y = GetBytes(b, name);
      return x && y && x->GetNumberOfValues() == y->GetNumberOfValues() &&
             std::memcmp(x->GetPointer(0), y->GetPointer(0),
               static_cast<std::size_t>(x->GetNumberOfValues())) == 0;
    });
}

TEST(SurfaceVisibility, MaximumDistanceForgetsWhatIsFar)
{
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->AddOccluder(MakeSphere(1.0, 2.0));
  filter->SetMaximumDistance(0.9);
  vtkPolyData* output = Trace(filter, MakePlane(2.0, 0.0, 4));
  EXPECT_EQ(GetHidden(output, FindOrigin(output)), 0.0);
}

TEST(SurfaceVisibility, TheOtherSideHasItsOwnSky)
{
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->BothSidesOn();
  filter->AddOccluder(MakePlane(1000.0, -0.1, 1));
  vtkPolyData* output = Trace(filter, MakePlane(2.0, 0.0, 4));
  EXPECT_LT(GetHidden(output, 12), 0.01);
  EXPECT_GT(GetHidden(output, 12, "Back"), 0.95);
}

// Where two walls meet each hides half of what the other could see, to the last point.
TEST(SurfaceVisibility, EdgesBelongToTheirOwnSide)
{
  // A floor and a wall, two squares each; their points on the common edge are different ones.
  const auto corner = MakeSurface(
    { { 0, 0, 0 }, { 50, 0, 0 }, { 50, 50, 0 }, { 0, 50, 0 }, { 50, 100, 0 }, { 0, 100, 0 },
      { 0, 0, 0 }, { 0, 50, 0 }, { 0, 50, 50 }, { 0, 0, 50 }, { 0, 100, 0 }, { 0, 100, 50 } },
    { { 0, 1, 2, 3 }, { 3, 2, 4, 5 }, { 6, 7, 8, 9 }, { 7, 10, 11, 8 } });
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  vtkPolyData* output = Trace(filter, corner);
  EXPECT_NEAR(GetHidden(output, 3), 0.5, 0.05);
  EXPECT_NEAR(GetHidden(output, 7), 0.5, 0.05);
  EXPECT_LT(GetHidden(output, 2), 0.25);
}

TEST(SurfaceVisibility, ThreadsAndRepetitionChangeNothing)
{
  const auto sphere = MakeSphere(1.0, 0.5);
  vtkNew<vtkSurfaceVisibilityFilter> a;
  vtkNew<vtkSurfaceVisibilityFilter> b;
  a->AddOccluder(MakePlane(3.0, 0.0, 1));
  b->AddOccluder(MakePlane(3.0, 0.0, 1));
  vtkPolyData* first = Trace(a, sphere);
  vtkPolyData* second = nullptr;
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1 }, [&]() { second = Trace(b, sphere); });
  EXPECT_TRUE(AreEqual(first, second));
}

TEST(SurfaceVisibility, WhatIsKnownIsNotTracedAgain)
{
  const auto sphere = MakeSphere(1.0, 0.5);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  Trace(filter, sphere);
  EXPECT_EQ(filter->GetNumberOfTraces(), 1);
  vtkNew<vtkFloatArray> scalars;
  scalars->SetNumberOfValues(sphere->GetNumberOfPoints());
  scalars->Fill(1.0);
  sphere->GetPointData()->SetScalars(scalars);
  vtkPolyData* output = Trace(filter, sphere);
  EXPECT_EQ(filter->GetNumberOfTraces(), 1);
  EXPECT_TRUE(GetBytes(output, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
  EXPECT_EQ(output->GetPointData()->GetScalars(), scalars);
  sphere->GetPoints()->SetPoint(3, 0.0, 0.0, 3.0);
  sphere->GetPoints()->Modified();
  sphere->Modified();
  Trace(filter, sphere);
  EXPECT_EQ(filter->GetNumberOfTraces(), 2);
  filter->SetNumberOfRays(256);
  Trace(filter, sphere);
  EXPECT_EQ(filter->GetNumberOfTraces(), 3);
}

TEST(SurfaceVisibility, ArraysSurviveFiles)
{
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->AddOccluder(MakePlane(3.0, 0.0, 1));
  vtkPolyData* output = Trace(filter, MakeSphere(1.0, 0.5));
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(output);
  writer->WriteToOutputStringOn();
  ASSERT_TRUE(writer->Write());
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(writer->GetOutputString());
  reader->Update();
  EXPECT_TRUE(AreEqual(output, reader->GetOutput()));
  const char* const name = vtkSurfaceVisibilityFilter::GetKeyArrayName();
  auto* before = vtkStringArray::SafeDownCast(output->GetFieldData()->GetAbstractArray(name));
  auto* after =
    vtkStringArray::SafeDownCast(reader->GetOutput()->GetFieldData()->GetAbstractArray(name));
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->GetValue(0), after->GetValue(0));
}

TEST(SurfaceVisibility, KeysSeePointsNormalsAndCells)
{
  const auto plane = MakePlane(1.0, 0.0, 2);
  const std::string key = measuredbrdf::GetSurfaceKey(plane);
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(plane);
  EXPECT_EQ(measuredbrdf::GetSurfaceKey(copy), key);
  copy->GetPoints()->SetPoint(4, 0.0, 0.0, 1e-3);
  EXPECT_NE(measuredbrdf::GetSurfaceKey(copy), key);
  copy->DeepCopy(plane);
  const vtkIdType turned[4] = { 3, 4, 1, 0 };
  copy->GetPolys()->ReplaceCellAtId(0, 4, turned);
  EXPECT_NE(measuredbrdf::GetSurfaceKey(copy), key);
  copy->DeepCopy(plane);
  copy->GetPointData()->GetNormals()->SetTuple3(0, 0.0, 0.6, 0.8);
  EXPECT_NE(measuredbrdf::GetSurfaceKey(copy), key);
}

// Quads of a saddle are not flat: rays that began at their corners' mean would begin below the
// triangles that rays meet.
TEST(SurfaceVisibility, TwistedQuadsAreLeftFromTheirTriangles)
{
  const auto saddle = MakePlane(1.0, 0.0, 8);
  saddle->GetPointData()->SetNormals(nullptr);
  for (vtkIdType k = 0; k < saddle->GetNumberOfPoints(); ++k)
  {
    double p[3];
    saddle->GetPoint(k, p);
    saddle->GetPoints()->SetPoint(k, p[0], p[1], p[0] * p[1]);
  }
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->BothSidesOn();
  vtkPolyData* output = Trace(filter, saddle);
  for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
  {
    EXPECT_LT(GetHidden(output, k), 0.35) << k;
    EXPECT_LT(GetHidden(output, k, "Back"), 0.35) << k;
  }
}

TEST(SurfaceVisibility, BlocksHideOneAnother)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(1, MakePlane(2.0, 0.0, 4));
  blocks->SetBlock(0, MakeSphere(1.0, 2.0));
  blocks->SetBlock(2, nested);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputDataObject(blocks);
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  auto* inner = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(2));
  ASSERT_TRUE(inner);
  auto* plane = vtkPolyData::SafeDownCast(inner->GetBlock(1));
  ASSERT_TRUE(plane);
  EXPECT_NEAR(GetHidden(plane, FindOrigin(plane)), 0.25, 0.04);
  EXPECT_FALSE(vtkPolyData::SafeDownCast(nested->GetBlock(1))
                 ->GetPointData()
                 ->HasArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
}

void ExpectAllOpen(vtkPolyData* input)
{
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  vtkPolyData* output = Trace(filter, input);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->GetNumberOfPoints(), input->GetNumberOfPoints());
  for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
  {
    EXPECT_LT(GetHidden(output, k), 0.02);
  }
}

TEST(SurfaceVisibility, TakesOddSurfaces)
{
  vtkNew<vtkPolyData> empty;
  ExpectAllOpen(empty);
  const std::vector<glm::dvec3> points = { { 0, 0, 0 }, { 1, 0, 0 },
    { std::numeric_limits<double>::quiet_NaN(), 0, 0 }, { 0, 1, 0 } };
  ExpectAllOpen(MakeSurface(points, {})); // points of no polygon
  // Twice the same triangle, one without area, one without a place.
  ExpectAllOpen(MakeSurface(points, { { 0, 1, 3 }, { 0, 0, 1 }, { 0, 2, 3 }, { 1, 0, 3 } }));
  // Far away in large steps, and small.
  ExpectAllOpen(MakeSphere(1e6, 1e8));
  ExpectAllOpen(MakeSphere(1e-6, 0.0));
}

class NoMemoryForCopies : public vtkPolyData
{
public:
  static NoMemoryForCopies* New();
  vtkTypeMacro(NoMemoryForCopies, vtkPolyData);
  void ShallowCopy(vtkDataObject*) override { throw std::bad_alloc(); }
};
vtkStandardNewMacro(NoMemoryForCopies);

TEST(SurfaceVisibility, NoMemoryForCopiesIsAnError)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<NoMemoryForCopies> block;
  blocks->SetBlock(0, block);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  ErrorCatcher errors(filter);
  ErrorCatcher executive(filter->GetExecutive());
  filter->SetInputDataObject(blocks);
  filter->Update();
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(errors.GetText().find("std::bad_alloc"), std::string::npos) << errors.GetText();
}

TEST(SurfaceVisibility, CanBeStopped)
{
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  filter->AddObserver(vtkCommand::ProgressEvent, stop);
  vtkPolyData* output = Trace(filter, MakePlane(1.0, 0.0, 80));
  EXPECT_FALSE(
    output->GetPointData()->HasArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
  filter->RemoveAllObservers();
  filter->SetAbortExecute(0);
  filter->Modified();
  output = Trace(filter, MakePlane(1.0, 0.0, 80));
  EXPECT_TRUE(
    output->GetPointData()->HasArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
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
  std::vector<glm::dvec3> places;
  for (const double d : distances)
  {
    places.emplace_back(d, 0.0, 0.0);
  }
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetNumberOfRays(512);
  filter->AddOccluder(MakeSphere(1.0, 1.0, 120));
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
  sphere->DeepCopy(MakeSphere(1.0, 2.0, 120));
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
}
