// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Radiance with occlusion: closed forms of white light on white walls, and where tracers go wrong.
#include "ErrorCatcher.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkCubeSource.h"
#include "vtkDiskSource.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkTracedRadianceIntegrator.h"
#include "vtkTracedScene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace
{
using Triple = std::array<double, 3>;

/// A scene of white walls under a white sky: radiance is the share of the light that arrives.
struct WhiteScene
{
  vtkNew<vtkTracedScene> Scene;
  vtkNew<vtkLambertBRDF> White;
  vtkNew<vtkEnvironment> Sky;
  vtkNew<vtkTracedRadianceIntegrator> Integrator;

  explicit WhiteScene(double albedo = 1.0)
  {
    this->White->SetAlbedo(albedo, albedo, albedo);
    this->Sky->SetPixels(64, 32, std::vector<float>(3 * 64 * 32, 1.0f));
    this->Integrator->SetScene(this->Scene);
    this->Integrator->SetBRDF(this->White);
    this->Integrator->SetEnvironment(this->Sky);
  }

  /// Points with normals, seen along the normals.
  std::vector<double> Get(const std::vector<Triple>& points, const std::vector<Triple>& normals)
  {
    vtkNew<vtkPolyData> receivers;
    vtkNew<vtkPoints> positions;
    positions->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> views;
    views->SetNumberOfComponents(3);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      positions->InsertNextPoint(points[k].data());
      views->InsertNextTuple(normals[k].data());
    }
    receivers->SetPoints(positions);
    receivers->GetPointData()->SetNormals(views);
    vtkNew<vtkDoubleArray> radiance;
    EXPECT_TRUE(this->Integrator->Integrate(receivers, views, radiance));
    std::vector<double> values;
    for (vtkIdType k = 0; k < radiance->GetNumberOfTuples(); ++k)
    {
      values.push_back(radiance->GetComponent(k, 1));
    }
    return values;
  }
  double Get(const Triple& point, const Triple& normal)
  {
    return this->Get(std::vector<Triple>{ point }, std::vector<Triple>{ normal })[0];
  }
};

vtkSmartPointer<vtkPolyData> MakeQuad(const Triple& origin, const Triple& one, const Triple& two)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetPoint1(origin[0] + one[0], origin[1] + one[1], origin[2] + one[2]);
  plane->SetPoint2(origin[0] + two[0], origin[1] + two[1], origin[2] + two[2]);
  plane->Update();
  return plane->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeBowl(double lastPhi, int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(2 * resolution);
  source->SetPhiResolution(resolution);
  source->SetStartPhi(180.0 - lastPhi);
  source->SetEndPhi(180.0);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkNew<vtkPolyData> plain;
  plain->ShallowCopy(source->GetOutput());
  return plain.Get();
}

// All directions of view, or those down, from inside or outside.
void CastAll(vtkTracedScene* scene, double from, int count, vtkPolyData* hits, vtkDataArray* views,
  bool down = false)
{
  vtkNew<vtkDoubleArray> origins;
  vtkNew<vtkDoubleArray> directions;
  origins->SetNumberOfComponents(3);
  directions->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  views->SetNumberOfTuples(0);
  for (int k = 0; k < count; ++k)
  {
    const double z = down ? -(k + 0.5) / count : 1.0 - (2.0 * k + 1.0) / count;
    const double s = std::sqrt(1.0 - z * z);
    const double d[3] = { s * std::cos(2.4 * k), s * std::sin(2.4 * k), z };
    const double back[3] = { -d[0], -d[1], -d[2] };
    const double origin[3] = { from * d[0], from * d[1], from * d[2] };
    origins->InsertNextTuple(origin);
    directions->InsertNextTuple(from > 0.0 ? back : d);
    views->InsertNextTuple(from > 0.0 ? d : back);
  }
  ASSERT_TRUE(scene->CastRays(origins, directions, hits));
}

double GetMean(vtkDataArray* radiance)
{
  double sum = 0.0;
  for (vtkIdType k = 0; k < radiance->GetNumberOfTuples(); ++k)
  {
    sum += radiance->GetComponent(k, 1);
  }
  return sum / static_cast<double>(radiance->GetNumberOfTuples());
}

// A disc of radius r at height h above the point hides r^2 / (r^2 + h^2) of a white sky's light.
TEST(Traced, ADiscAbove)
{
  for (const double height : { 0.3, 1.0, 4.0 })
  {
    WhiteScene scene;
    vtkNew<vtkDiskSource> disc;
    disc->SetInnerRadius(0.0);
    disc->SetOuterRadius(1.0);
    disc->SetCircumferentialResolution(400);
    disc->Update();
    vtkNew<vtkMatrix4x4> up;
    up->SetElement(2, 3, height);
    scene.Scene->AddSurface(disc->GetOutput(), up);
    const double expected = 1.0 - 1.0 / (1.0 + height * height);
    scene.Integrator->SetNumberOfSamples(4096);
    EXPECT_NEAR(scene.Get({ 0, 0, 0 }, { 0, 0, 1 }), expected, 0.006);
  }
}

// At the bottom of a slit of width w and depth d: w / sqrt(w^2 + 4 d^2), however thin.
TEST(Traced, ThinSlits)
{
  for (const double width : { 1.0, 0.1, 1e-3 })
  {
    WhiteScene scene;
    const double depth = width;
    const double length = 2000.0 * width;
    for (const double x : { -0.5 * width, 0.5 * width })
    {
      scene.Scene->AddSurface(
        MakeQuad({ x, -0.5 * length, 0.0 }, { 0, length, 0 }, { 0, 0, depth }));
    }
    scene.Scene->AddSurface(MakeQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }));
    scene.Integrator->SetNumberOfSamples(4096);
    EXPECT_NEAR(scene.Get({ 0, 0, 0 }, { 0, 0, 1 }), 1.0 / std::sqrt(5.0), 0.006) << width;
  }
}

// Beside the foot of a high wall half of the light arrives, however near the point is.
TEST(Traced, Contacts)
{
  WhiteScene scene;
  scene.Scene->AddSurface(MakeQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }));
  scene.Scene->AddSurface(MakeQuad({ 0, -1, 0 }, { 0, 2, 0 }, { 0, 0, 1 }));
  scene.Integrator->SetNumberOfSamples(2048);
  for (const double distance : { 1e-3, 1e-4, 1e-5 })
  {
    EXPECT_NEAR(scene.Get({ distance, 0, 0 }, { 0, 0, 1 }), 0.5, 0.006) << distance;
    EXPECT_NEAR(scene.Get({ -distance, 0, 0 }, { 0, 0, 1 }), 0.5, 0.006) << distance;
  }
}

// A sheet hides from both sides, and not itself; a point's normal tells its side.
TEST(Traced, TwoSidedSheets)
{
  WhiteScene scene;
  scene.Scene->AddSurface(MakeQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }));
  EXPECT_NEAR(scene.Get({ 0.2, 0.1, 0 }, { 0, 0, 1 }), 1.0, 2e-3);
  EXPECT_NEAR(scene.Get({ 0.2, 0.1, 0 }, { 0, 0, -1 }), 1.0, 2e-3);
  scene.Scene->AddSurface(MakeQuad({ -100, -100, 0.1 }, { 200, 0, 0 }, { 0, 200, 0 }));
  EXPECT_NEAR(scene.Get({ 0.2, 0.1, 0 }, { 0, 0, 1 }), 0.0, 2e-3);
  EXPECT_NEAR(scene.Get({ 0.2, 0.1, 0 }, { 0, 0, -1 }), 1.0, 2e-3);
}

// On edges and corners, with the mean normal. Outer ones hide nothing above the horizon; of what is
// above an inner edge of two walls sin 45 degrees arrives, above a corner of three sqrt(3) / 4 (an
// octant).
TEST(Traced, PointsOnEdges)
{
  const double s = std::sqrt(0.5);
  const double c = std::sqrt(1.0 / 3.0);
  WhiteScene outer;
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  outer.Scene->AddSurface(cube->GetOutput());
  outer.Integrator->SetNumberOfSamples(2048);
  EXPECT_NEAR(outer.Get({ 0.5, 0.5, 0.1 }, { s, s, 0 }), 1.0, 2e-3);
  EXPECT_NEAR(outer.Get({ 0.5, 0.5, 0.5 }, { c, c, c }), 1.0, 2e-3);
  WhiteScene inner;
  inner.Scene->AddSurface(MakeQuad({ 0, 0, -50 }, { 100, 0, 0 }, { 0, 0, 100 }));
  inner.Scene->AddSurface(MakeQuad({ 0, 0, -50 }, { 0, 100, 0 }, { 0, 0, 100 }));
  inner.Integrator->SetNumberOfSamples(2048);
  EXPECT_NEAR(inner.Get({ 0, 0, 0.1 }, { s, s, 0 }), s, 0.01);
  inner.Scene->AddSurface(MakeQuad({ 0, 0, 0 }, { 100, 0, 0 }, { 0, 100, 0 }));
  EXPECT_NEAR(inner.Get({ 0, 0, 0 }, { c, c, c }), std::sqrt(3.0) / 4.0, 0.01);
}

// What bulges hides nothing of itself, whether its mesh is fine or coarse.
TEST(Traced, ConvexSurfacesHideNothing)
{
  for (const int resolution : { 8, 40 })
  {
    WhiteScene scene;
    scene.Scene->AddSurface(MakeBowl(180.0, resolution));
    vtkNew<vtkPolyData> hits;
    vtkNew<vtkDoubleArray> views;
    vtkNew<vtkDoubleArray> radiance;
    CastAll(scene.Scene, 3.0, 400, hits, views);
    ASSERT_TRUE(scene.Integrator->Integrate(hits, views, radiance));
    EXPECT_NEAR(GetMean(radiance), 1.0, 3e-3) << resolution;
  }
}

// A white bowl, half a sphere: of a point's sky half is bowl, wherever it is, so b bounces leave
// 2^-(b + 1) of the light out. With many it is a furnace: as bright as the sky.
TEST(Traced, BowlsAndFurnaces)
{
  WhiteScene scene;
  vtkSmartPointer<vtkPolyData> bowl = MakeBowl(90.0, 60);
  bowl->GetPointData()->SetNormals(nullptr);
  scene.Scene->AddSurface(bowl);
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkPolyData> hits;
  CastAll(scene.Scene, 0.0, 500, hits, views, true);
  for (const int bounces : { 0, 1, 2, 30 })
  {
    scene.Integrator->SetNumberOfBounces(bounces);
    vtkNew<vtkDoubleArray> radiance;
    ASSERT_TRUE(scene.Integrator->Integrate(hits, views, radiance));
    EXPECT_NEAR(GetMean(radiance), 1.0 - std::pow(0.5, bounces + 1), 0.004) << bounces;
    EXPECT_LT(scene.Integrator->GetNoise(), 0.05);
  }
}

// A closed cavity lets no light in, whatever the bounces.
TEST(Traced, ClosedCavitiesAreBlack)
{
  WhiteScene scene;
  scene.Scene->AddSurface(MakeBowl(180.0, 30));
  vtkNew<vtkPolyData> hits;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> radiance;
  CastAll(scene.Scene, 0.0, 200, hits, views);
  for (const int bounces : { 0, 20 })
  {
    scene.Integrator->SetNumberOfBounces(bounces);
    ASSERT_TRUE(scene.Integrator->Integrate(hits, views, radiance));
    EXPECT_LT(GetMean(radiance), 1e-4) << bounces;
  }
}

// A matrix is as good as points that are moved; mirroring and uneven scaling included.
TEST(Traced, ScaledAndMirroredActors)
{
  vtkNew<vtkParametricTorus> torus;
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(torus);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkNew<vtkMatrix4x4> matrix;
  const double elements[16] = { -2, 0.3, 0, 7, 0, 0.5, 0, -3, 0, 0.2, 4, 1, 0, 0, 0, 1 };
  matrix->DeepCopy(elements);
  vtkNew<vtkPolyData> moved;
  moved->DeepCopy(source->GetOutput());
  for (vtkIdType k = 0; k < moved->GetNumberOfPoints(); ++k)
  {
    double p[4] = { 0, 0, 0, 1 };
    moved->GetPoint(k, p);
    matrix->MultiplyPoint(p, p);
    moved->GetPoints()->SetPoint(k, p);
  }
  moved->GetPointData()->SetNormals(nullptr);
  vtkNew<vtkPolyData> plain;
  plain->ShallowCopy(source->GetOutput());
  plain->GetPointData()->SetNormals(nullptr);
  std::vector<std::vector<double>> results;
  for (const bool baked : { false, true })
  {
    WhiteScene scene;
    scene.Sky->SetToProceduralSky();
    scene.Scene->AddSurface(baked ? moved.Get() : plain.Get(), baked ? nullptr : matrix.Get());
    vtkNew<vtkPolyData> hits;
    vtkNew<vtkDoubleArray> views;
    vtkNew<vtkDoubleArray> radiance;
    const double everywhere[3] = { 0, 0, 0 };
    ASSERT_TRUE(scene.Scene->DrawVisiblePoints(100, everywhere, hits, views));
    ASSERT_EQ(hits->GetNumberOfPoints(), 100);
    ASSERT_TRUE(scene.Integrator->Integrate(hits, views, radiance));
    results.emplace_back();
    for (vtkIdType k = 0; k < 100; ++k)
    {
      results.back().push_back(radiance->GetComponent(k, 0));
    }
  }
  for (std::size_t k = 0; k < 100; ++k)
  {
    EXPECT_NEAR(results[0][k], results[1][k], 0.02 * results[1][k] + 1e-3) << k;
  }
}

// Samples and the sum over all texels; more samples, less noise.
TEST(Traced, WaysToTraceAgree)
{
  vtkNew<vtkParametricTorus> torus;
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(torus);
  source->Update();
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetSpecular(0.4, 0.4, 0.4);
  gloss->SetExponent(50.0);
  WhiteScene scene;
  scene.Sky->SetToProceduralHall();
  scene.Sky->SetRotationY(70.0);
  scene.Integrator->SetBRDF(gloss);
  scene.Scene->AddSurface(source->GetOutput());
  vtkNew<vtkPolyData> hits;
  vtkNew<vtkDoubleArray> views;
  const double everywhere[3] = { 0, 0, 0 };
  ASSERT_TRUE(scene.Scene->DrawVisiblePoints(60, everywhere, hits, views));
  const auto integrate = [&](int samples, bool reference)
  {
    scene.Integrator->SetNumberOfSamples(samples);
    scene.Integrator->SetUnoccludedReference(reference);
    vtkNew<vtkDoubleArray> radiance;
    EXPECT_TRUE(scene.Integrator->Integrate(hits, views, radiance));
    return GetMean(radiance);
  };
  const double few = integrate(256, true);
  const double noise = scene.Integrator->GetNoise();
  const double many = integrate(4096, true);
  EXPECT_LT(scene.Integrator->GetNoise(), 0.4 * noise);
  EXPECT_NEAR(few / many, 1.0, 0.01);
  EXPECT_NEAR(integrate(4096, false) / many, 1.0, 0.01);
}

// What bad input does, and that a run can be stopped.
TEST(Traced, Errors)
{
  WhiteScene scene;
  vtkNew<vtkPolyData> points;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> radiance;
  radiance->InsertNextValue(7.0);
  {
    const ErrorCatcher errors(scene.Integrator);
    EXPECT_FALSE(scene.Integrator->Integrate(nullptr, views, radiance));
    EXPECT_FALSE(scene.Integrator->Integrate(points, views, radiance)) << "no normals";
    scene.Integrator->SetBRDF(nullptr);
    EXPECT_FALSE(scene.Integrator->Integrate(points, views, radiance));
    scene.Integrator->SetBRDF(scene.White);
    EXPECT_EQ(radiance->GetNumberOfTuples(), 1);
  }
  {
    const ErrorCatcher errors(scene.Scene);
    vtkNew<vtkMatrix4x4> bad;
    bad->SetElement(3, 0, 1.0);
    EXPECT_EQ(scene.Scene->AddSurface(nullptr), -1);
    EXPECT_EQ(scene.Scene->AddSurface(points, bad), -1);
    bad->SetElement(3, 0, 0.0);
    bad->SetElement(0, 0, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(scene.Scene->AddSurface(points, bad), -1);
    EXPECT_FALSE(scene.Scene->CastRays(views, nullptr, points));
  }
  scene.Scene->AddSurface(MakeBowl(180.0, 20));
  vtkNew<vtkPolyData> hits;
  CastAll(scene.Scene, 3.0, 200, hits, views);
  double nan[3] = { std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0 };
  views->SetTuple(3, nan);
  ASSERT_TRUE(scene.Integrator->Integrate(hits, views, radiance));
  EXPECT_EQ(radiance->GetComponent(3, 0), 0.0);
  EXPECT_GT(radiance->GetComponent(4, 0), 0.5);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkTracedRadianceIntegrator*>(caller)->SetAbort(true); });
  scene.Integrator->AddObserver(vtkCommand::ProgressEvent, stop);
  const ErrorCatcher errors(scene.Integrator);
  EXPECT_FALSE(scene.Integrator->Integrate(hits, views, radiance));
}
} // namespace
