// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceTracer.h"

#include "EmbreeScene.h"
#include "TriangleSet.h"
#include "TriangleTree.h"

#include <glm/gtc/type_ptr.hpp>

#include <cmath>

namespace measuredbrdf
{
//------------------------------------------------------------------------------
struct SurfaceTracer::Internals
{
  bool UsesEmbree = false;
  TriangleSet Triangles;
  TriangleTree Tree;
  EmbreeScene Embree;

  // Whether the ray is one at all.
  bool MakeRay(const double origin[3], const double direction[3], double tMin, double tMax,
    TriangleSet::Ray& ray) const
  {
    const double scale = this->Triangles.GetScale();
    ray = { (glm::make_vec3(origin) - this->Triangles.GetMiddle()) * scale,
      glm::make_vec3(direction) * scale, tMin, tMax };
    const double length = glm::dot(ray.Direction, ray.Direction);
    return std::isfinite(glm::dot(ray.Origin, ray.Origin)) && std::isfinite(length) &&
           length > 0.0 && tMin < tMax;
  }

  std::int64_t Trace(const TriangleSet::Ray& ray, bool any, double& t, glm::dvec3& weights) const
  {
    return this->UsesEmbree ? this->Embree.Trace(ray, any, t, weights)
                            : this->Tree.Trace(ray, any, t, weights);
  }
};

//------------------------------------------------------------------------------
SurfaceTracer::SurfaceTracer(Backend backend)
  : Data(std::make_unique<Internals>())
{
  this->Data->UsesEmbree = backend != Backend::Own && HasEmbree();
}

//------------------------------------------------------------------------------
SurfaceTracer::~SurfaceTracer() = default;

//------------------------------------------------------------------------------
bool SurfaceTracer::HasEmbree() { return EmbreeScene::IsAvailable(); }

//------------------------------------------------------------------------------
SurfaceTracer::Backend SurfaceTracer::GetBackend() const
{
  return this->Data->UsesEmbree ? Backend::Embree : Backend::Own;
}

//------------------------------------------------------------------------------
int SurfaceTracer::AddSurface(vtkPolyData* surface, const double* matrix16)
{
  return this->Data->Triangles.Add(surface, matrix16);
}

//------------------------------------------------------------------------------
void SurfaceTracer::Build()
{
  this->Data->Triangles.Finish();
  this->Data->UsesEmbree =
    this->Data->UsesEmbree && this->Data->Embree.Build(this->Data->Triangles);
  if (!this->Data->UsesEmbree)
  {
    this->Data->Tree.Build(this->Data->Triangles);
  }
}

//------------------------------------------------------------------------------
bool SurfaceTracer::IsOccluded(
  const double origin[3], const double direction[3], double tMin, double tMax) const
{
  TriangleSet::Ray ray;
  double t = 0.0;
  glm::dvec3 weights;
  return this->Data->MakeRay(origin, direction, tMin, tMax, ray) &&
         this->Data->Trace(ray, true, t, weights) >= 0;
}

//------------------------------------------------------------------------------
bool SurfaceTracer::Intersect(
  const double origin[3], const double direction[3], double tMin, double tMax, Hit& hit) const
{
  TriangleSet::Ray ray;
  glm::dvec3 weights;
  double t = 0.0;
  if (!this->Data->MakeRay(origin, direction, tMin, tMax, ray))
  {
    return false;
  }
  const std::int64_t found = this->Data->Trace(ray, false, t, weights);
  if (found < 0)
  {
    return false;
  }
  const TriangleSet& set = this->Data->Triangles;
  const TriangleSet::Triangle& triangle = set.GetTriangles()[static_cast<std::size_t>(found)];
  hit.T = t;
  hit.Surface = set.FindSurface(triangle.Corners[0]);
  const TriangleSet::Start& start = set.GetStart(hit.Surface);
  hit.Cell = static_cast<vtkIdType>(triangle.Cell - start.Cell);
  const glm::dvec3 a = set.GetPoint(triangle.Corners[0]);
  const glm::dvec3 normal = glm::normalize(
    glm::cross(set.GetPoint(triangle.Corners[1]) - a, set.GetPoint(triangle.Corners[2]) - a));
  for (int c = 0; c < 3; ++c)
  {
    hit.Points[c] = static_cast<vtkIdType>(triangle.Corners[c] - start.Point);
    hit.Barycentrics[c] = weights[c];
    hit.Normal[c] = normal[c];
  }
  return true;
}

//------------------------------------------------------------------------------
void SurfaceTracer::GetCorners(const Hit& hit, double corners[3][3]) const
{
  const TriangleSet& set = this->Data->Triangles;
  for (int k = 0; k < 3; ++k)
  {
    const std::uint32_t start = set.GetStart(hit.Surface).Point;
    const glm::dvec3 own = set.GetPoint(start + static_cast<std::uint32_t>(hit.Points[k]));
    for (int c = 0; c < 3; ++c)
    {
      corners[k][c] = set.GetMiddle()[c] + own[c] / set.GetScale();
    }
  }
}

//------------------------------------------------------------------------------
void SurfaceTracer::OffsetOrigin(
  const double point[3], const double normal[3], const double direction[3], double origin[3]) const
{
  const glm::dvec3 n = glm::make_vec3(normal);
  const double side = std::copysign(this->GetOffset(), glm::dot(n, glm::make_vec3(direction)));
  for (int c = 0; c < 3; ++c)
  {
    origin[c] = point[c] + side * n[c];
  }
}

//------------------------------------------------------------------------------
double SurfaceTracer::GetOffset() const { return this->Data->Triangles.GetOffset(); }

//------------------------------------------------------------------------------
vtkIdType SurfaceTracer::GetNumberOfTriangles() const
{
  return static_cast<vtkIdType>(this->Data->Triangles.GetTriangles().size());
}

//------------------------------------------------------------------------------
vtkIdType SurfaceTracer::GetNumberOfSkippedTriangles() const
{
  return this->Data->Triangles.GetNumberOfSkipped();
}

//------------------------------------------------------------------------------
std::size_t SurfaceTracer::GetBytes() const
{
  return this->Data->Triangles.GetBytes() +
         (this->Data->UsesEmbree ? this->Data->Embree.GetBytes() : this->Data->Tree.GetBytes());
}

//------------------------------------------------------------------------------
bool SurfaceTracer::GetBounds(double bounds[6]) const
{
  const TriangleSet& set = this->Data->Triangles;
  for (int c = 0; c < 3 && this->GetNumberOfTriangles() > 0; ++c)
  {
    bounds[2 * c] = set.GetMiddle()[c] + set.GetLow()[c] / set.GetScale();
    bounds[2 * c + 1] = set.GetMiddle()[c] + set.GetHigh()[c] / set.GetScale();
  }
  return this->GetNumberOfTriangles() > 0;
}
} // namespace measuredbrdf
