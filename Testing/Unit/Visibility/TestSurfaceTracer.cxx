// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays against surfaces: closed forms, and all triangles one by one.
#include "SurfaceTracer.h"
#include "TraceSurface.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRegularPolygonSource.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"

#include <glm/gtc/type_ptr.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{
using measuredbrdf::SurfaceTracer;

constexpr double Far = std::numeric_limits<double>::infinity();

vtkSmartPointer<vtkPolyData> MakeFineSphere(int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

glm::dvec3 Draw(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const double x = normal(random);
  const double y = normal(random);
  const double z = normal(random);
  return glm::normalize(glm::dvec3(x, y, z));
}

// In a cloud of triangles: the nearest hit of each ray is that of all triangles tested one by one
// (Moeller, Trumbore 1997).
TEST(SurfaceTracer, FindsTheNearestTriangle)
{
  std::mt19937 random(7);
  const glm::dvec3 middle(100.0, -30.0, 5.0);
  std::vector<glm::dvec3> points;
  std::vector<std::vector<vtkIdType>> triangles;
  for (vtkIdType k = 0; k < 3000; ++k)
  {
    const glm::dvec3 place = middle + 0.8 * Draw(random);
    for (int c = 0; c < 3; ++c)
    {
      points.push_back(place + 0.08 * Draw(random));
    }
    triangles.push_back({ 3 * k, 3 * k + 1, 3 * k + 2 });
  }
  SurfaceTracer tracer;
  tracer.AddSurface(MakeSurface(points, triangles));
  tracer.Build();
  const auto findNearest = [&](const glm::dvec3& origin, const glm::dvec3& d, double& nearest)
  {
    vtkIdType found = -1;
    nearest = Far;
    for (std::size_t k = 0; k < triangles.size(); ++k)
    {
      const glm::dvec3 one = points[3 * k + 1] - points[3 * k];
      const glm::dvec3 other = points[3 * k + 2] - points[3 * k];
      const glm::dvec3 across = glm::cross(d, other);
      const glm::dvec3 from = origin - points[3 * k];
      const glm::dvec3 turned = glm::cross(from, one);
      const double scale = 1.0 / glm::dot(one, across);
      const double u = scale * glm::dot(from, across);
      const double v = scale * glm::dot(d, turned);
      const double t = scale * glm::dot(other, turned);
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < nearest)
      {
        nearest = t;
        found = static_cast<vtkIdType>(k);
      }
    }
    return found;
  };
  int hits = 0;
  int different = 0;
  for (int k = 0; k < 4000; ++k)
  {
    const glm::dvec3 origin = middle + (k % 2 == 0 ? 2.0 : 0.5) * Draw(random);
    const glm::dvec3 direction = Draw(random);
    double t = 0.0;
    const vtkIdType expected = findNearest(origin, direction, t);
    const auto hit = tracer.Intersect(origin, direction, Far);
    EXPECT_EQ(tracer.IsOccluded(origin, direction, Far), hit.has_value());
    hits += hit ? 1 : 0;
    const bool isSame = hit ? hit->Cell == expected : expected < 0;
    different += isSame ? 0 : 1;
    if (hit && isSame)
    {
      EXPECT_NEAR(hit->T, t, 1e-5);
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LE(different, 2); // rays within rounding of an edge
}

// From inside a closed surface no ray escapes, not through edges and corners either.
TEST(SurfaceTracer, IsWatertight)
{
  const vtkSmartPointer<vtkPolyData> sphere = MakeFineSphere(40);
  SurfaceTracer tracer;
  tracer.AddSurface(sphere);
  tracer.Build();
  std::mt19937 random(3);
  const glm::dvec3 inside(0.1, 0.2, -0.05);
  int escaped = 0;
  for (int k = 0; k < 50000; ++k)
  {
    escaped += tracer.IsOccluded(inside, Draw(random), Far) ? 0 : 1;
  }
  for (vtkIdType k = 0; k < sphere->GetNumberOfPoints(); ++k)
  {
    for (const double share : { 0.0, 0.5, 1.0 / 3.0 })
    {
      glm::dvec3 p;
      glm::dvec3 q;
      sphere->GetPoint(k, &p.x);
      sphere->GetPoint((k + 1) % sphere->GetNumberOfPoints(), &q.x);
      const glm::dvec3 d = glm::mix(p, q, share) - inside;
      escaped += tracer.IsOccluded(inside, d, Far) ? 0 : 1;
    }
  }
  EXPECT_EQ(escaped, 0);
}

// A surface's points do not hide it from itself; what is below the surface is hidden.
TEST(SurfaceTracer, PointsOfASphereSeeOut)
{
  for (const double size : { 1e-30, 1e-3, 1.0, 1e6, 1e30 })
  {
    for (const double away : { 0.0, 1e4 })
    {
      const double matrix[16] = { size, 0, 0, away * size, 0, size, 0, 0, 0, 0, size, -away * size,
        0, 0, 0, 1 };
      const vtkSmartPointer<vtkPolyData> sphere = MakeFineSphere(60);
      SurfaceTracer tracer;
      tracer.AddSurface(sphere, matrix);
      tracer.Build();
      std::mt19937 random(5);
      const glm::dvec3 middle(away * size, 0.0, -away * size);
      int wrong = 0;
      for (int k = 0; k < 4000; ++k)
      {
        const glm::dvec3 from = middle + 3.0 * size * Draw(random);
        const glm::dvec3 to = middle - from + 0.5 * size * Draw(random);
        const auto hit = tracer.Intersect(from, to, Far);
        ASSERT_TRUE(hit) << size;
        const glm::dvec3 point = from + hit->T * to;
        EXPECT_NEAR(glm::length(point - middle) / size, 1.0, 0.01);
        const glm::dvec3 direction = Draw(random);
        const double cosine = glm::dot(direction, hit->Normal);
        const glm::dvec3 origin = point + std::copysign(tracer.GetOffset(), cosine) * hit->Normal;
        const bool hidden = tracer.IsOccluded(origin, direction, Far);
        wrong += std::abs(cosine) > 1e-3 && hidden != (cosine < 0.0) ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0) << "size " << size << ", " << away << " sizes away";
    }
  }
}

// What a hit says: surface, cell, corners, weights, normal, t in lengths of the direction.
TEST(SurfaceTracer, DescribesTheHit)
{
  // A pentagon and two quads, the second one concave, after a vertex and a line.
  const std::vector<glm::dvec3> points = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 1, 3, 0 },
    { 0, 2, 0 }, { 5, 0, 0 }, { 7, 0, 0 }, { 5.5, 0.5, 0 }, { 5, 2, 0 } };
  const vtkSmartPointer<vtkPolyData> surface =
    MakeSurface(points, { { 0, 1, 2, 3, 4 }, { 5, 6, 7, 8 } });
  const vtkIdType ids[2] = { 0, 5 };
  vtkNew<vtkCellArray> verts;
  verts->InsertNextCell(1, ids);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(2, ids);
  surface->SetVerts(verts);
  surface->SetLines(lines);
  vtkNew<vtkPlaneSource> other;
  other->Update();
  SurfaceTracer tracer;
  EXPECT_EQ(tracer.AddSurface(other->GetOutput()), 0); // 1 x 1 about the origin
  const double mirror[16] = { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 10, 0, 0, 0, 1 };
  EXPECT_EQ(tracer.AddSurface(surface, mirror), 1);
  tracer.Build();
  EXPECT_EQ(tracer.GetNumberOfTriangles(), 2 + 3 + 2);
  EXPECT_EQ(tracer.GetNumberOfSkippedTriangles(), 0);
  double bounds[6];
  ASSERT_TRUE(tracer.GetBounds(bounds));
  EXPECT_NEAR(bounds[0], -7.0, 1e-6);
  EXPECT_NEAR(bounds[1], 0.5, 1e-6);
  EXPECT_NEAR(bounds[5], 10.0, 1e-6);

  const glm::dvec3 down(0.0, 0.0, -2.0);
  const auto trace = [&](double x, double y) {
    return tracer.Intersect({ x, y, 14.0 }, down, Far);
  };
  auto hit = trace(-1.0, 2.9); // the pentagon's tip
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->Surface, 1);
  EXPECT_EQ(hit->Cell, 2);
  EXPECT_NEAR(hit->T, 2.0, 1e-6);
  EXPECT_NEAR(hit->Normal[2], -1.0, 1e-12); // mirrored
  glm::dvec3 position(0.0);
  for (int c = 0; c < 3; ++c)
  {
    position += hit->Barycentrics[c] * points[hit->Points[c]];
  }
  EXPECT_NEAR(position.x, 1.0, 1e-6); // of the surface itself
  EXPECT_NEAR(position.y, 2.9, 1e-6);
  hit = trace(-6.5, 0.1);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->Cell, 3);
  EXPECT_FALSE(trace(-6.0, 1.0)) << "the concave quad's notch";
  hit = trace(0.2, 0.1);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->Surface, 0);
  EXPECT_EQ(hit->Cell, 0);
  EXPECT_NEAR(hit->Normal[2], 1.0, 1e-12);
  EXPECT_NEAR(hit->T, 7.0, 1e-6);
  EXPECT_TRUE(tracer.IsOccluded({ 0.2, 0.1, 14.0 }, down, 7.1));
  EXPECT_FALSE(tracer.IsOccluded({ 0.2, 0.1, 14.0 }, down, 6.9));
}

// Strips count as their triangles do.
TEST(SurfaceTracer, ReadsStrips)
{
  vtkNew<vtkStripper> stripper;
  const vtkSmartPointer<vtkPolyData> sphere = MakeFineSphere(12);
  stripper->SetInputData(sphere);
  stripper->Update();
  SurfaceTracer tracer;
  tracer.AddSurface(stripper->GetOutput());
  tracer.Build();
  EXPECT_GT(stripper->GetOutput()->GetNumberOfStrips(), 0);
  EXPECT_EQ(tracer.GetNumberOfTriangles(), sphere->GetNumberOfPolys());
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k)
  {
    const glm::dvec3 from = 2.0 * Draw(random);
    const glm::dvec3 to = -from;
    const auto hit = tracer.Intersect(from, to, Far);
    ASSERT_TRUE(hit);
    EXPECT_LT(glm::dot(to, hit->Normal), 0.0) << "all face outwards";
  }
}

// Nothing, points alone, NaN, no area: no crash, and all of it is counted.
TEST(SurfaceTracer, SkipsWhatCannotHide)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const glm::dvec3 origin(0.2, 0.2, 1.0);
  const glm::dvec3 down(0.0, 0.0, -1.0);
  vtkNew<vtkPolyData> nothing;
  SurfaceTracer empty;
  EXPECT_EQ(empty.AddSurface(nullptr), -1);
  EXPECT_EQ(empty.AddSurface(nothing), 0);
  empty.Build();
  double bounds[6];
  EXPECT_FALSE(empty.GetBounds(bounds));
  EXPECT_FALSE(empty.IsOccluded(origin, down, Far));

  const vtkSmartPointer<vtkPolyData> odd =
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { nan, 0, 0 }, { 0, Far, 1 }, { 2, 0, 0 },
                  { 1e300, 0, 0 } },
      { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 4, 2 }, { 0, 1, 5 }, { 0, 0, 1 }, { 0, 1 } });
  SurfaceTracer tracer;
  tracer.AddSurface(odd);
  tracer.Build();
  EXPECT_EQ(tracer.GetNumberOfTriangles(), 1);
  EXPECT_EQ(tracer.GetNumberOfSkippedTriangles(), 5);
  EXPECT_TRUE(tracer.IsOccluded(origin, down, Far));
  const glm::dvec3 bad(nan, 0.0, -1.0);
  EXPECT_FALSE(tracer.IsOccluded(bad, down, Far));
  EXPECT_FALSE(tracer.IsOccluded(origin, bad, Far));
  EXPECT_FALSE(tracer.IsOccluded(origin, glm::dvec3(0.0), Far));
  EXPECT_FALSE(tracer.IsOccluded(origin, down, nan));
}

// Many triangles in one place, and nested ones: no recursion, no endless depth.
TEST(SurfaceTracer, TakesPilesAndNests)
{
  std::vector<glm::dvec3> points;
  std::vector<std::vector<vtkIdType>> triangles;
  for (vtkIdType k = 0; k < 3000; ++k)
  {
    const double size = k < 1500 ? 1.0 : std::pow(1.02, -static_cast<double>(k - 1500));
    for (const glm::dvec3& corner :
      { glm::dvec3(0, 0, 0), glm::dvec3(size, 0, 0), glm::dvec3(0, size, 0) })
    {
      points.push_back(corner);
    }
    triangles.push_back({ 3 * k, 3 * k + 1, 3 * k + 2 });
  }
  SurfaceTracer tracer;
  tracer.AddSurface(MakeSurface(points, triangles));
  tracer.Build();
  const glm::dvec3 down(0.0, 0.0, -1.0);
  EXPECT_TRUE(tracer.IsOccluded({ 0.2, 0.2, 1.0 }, down, Far));
  EXPECT_FALSE(tracer.IsOccluded({ 0.6, 0.6, 1.0 }, down, Far));
}

} // namespace
