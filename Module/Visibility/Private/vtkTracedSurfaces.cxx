// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTracedSurfaces.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr double Far = std::numeric_limits<double>::infinity();

glm::dvec3 Toward(const glm::dvec3& normal, const glm::dvec3& side)
{
  return glm::dot(normal, side) < 0.0 ? -normal : normal;
}
} // namespace

//------------------------------------------------------------------------------
// By the inverse transposed matrix, up to a factor: its cofactors.
void vtkTracedSurfaces::TakeNormals(Surface& surface) const
{
  vtkDataArray* normals = surface.Mesh->GetPointData()->GetNormals();
  surface.Normals.clear();
  if (!normals || normals->GetNumberOfComponents() != 3 ||
      normals->GetNumberOfTuples() != surface.Mesh->GetNumberOfPoints())
  {
    return;
  }
  const std::array<double, 16>& m = surface.Matrix;
  const glm::dvec3 x(m[0], m[4], m[8]);
  const glm::dvec3 y(m[1], m[5], m[9]);
  const glm::dvec3 z(m[2], m[6], m[10]);
  const glm::dmat3 turn(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  const vtkIdType count = normals->GetNumberOfTuples();
  surface.Normals.resize(3 * static_cast<std::size_t>(count));
  for (vtkIdType k = 0; k < count; ++k)
  {
    glm::dvec3 n;
    normals->GetTuple(k, &n.x);
    n = turn * n;
    const double length = glm::length(n);
    for (int c = 0; c < 3; ++c)
    {
      surface.Normals[3 * static_cast<std::size_t>(k) + static_cast<std::size_t>(c)] =
        length > 0.0 && std::isfinite(length) ? static_cast<float>(n[c] / length) : 0.0f;
    }
  }
}

//------------------------------------------------------------------------------
bool vtkTracedSurfaces::Cast(
  const glm::dvec3& origin, const glm::dvec3& direction, measuredbrdf::SurfacePoint& point) const
{
  measuredbrdf::SurfaceTracer::Hit hit{};
  if (!this->Tracer->Intersect(&origin.x, &direction.x, 0.0, Far, hit))
  {
    return false;
  }
  double corners[3][3];
  this->Tracer->GetCorners(hit, corners);
  glm::dvec3 p[3];
  glm::dvec3 n[3];
  point.Facet = Toward(glm::dvec3(hit.Normal[0], hit.Normal[1], hit.Normal[2]), -direction);
  point.Position = glm::dvec3(0.0);
  point.Normal = glm::dvec3(0.0);
  point.Surface = hit.Surface;
  point.Cell = hit.Cell;
  const std::vector<float>& normals = this->Surfaces[static_cast<std::size_t>(hit.Surface)].Normals;
  for (int k = 0; k < 3; ++k)
  {
    p[k] = glm::dvec3(corners[k][0], corners[k][1], corners[k][2]);
    point.Position += hit.Barycentrics[k] * p[k];
    if (!normals.empty())
    {
      const float* normal = &normals[3 * static_cast<std::size_t>(hit.Points[k])];
      n[k] = Toward(glm::dvec3(normal[0], normal[1], normal[2]), point.Facet);
      point.Normal += hit.Barycentrics[k] * n[k];
    }
  }
  const double length = glm::length(point.Normal);
  if (!(length > 1e-6))
  {
    point.Normal = point.Facet;
    return true;
  }
  point.Normal /= length;
  // Hanika 2021: onto the planes through the corners, where these lie above.
  glm::dvec3 lift(0.0);
  for (int k = 0; k < 3; ++k)
  {
    lift -= hit.Barycentrics[k] * std::min(glm::dot(point.Position - p[k], n[k]), 0.0) * n[k];
  }
  point.Position += lift;
  return true;
}

//------------------------------------------------------------------------------
glm::dvec3 vtkTracedSurfaces::Leave(const measuredbrdf::SurfacePoint& from) const
{
  return from.Position + this->Tracer->GetOffset() * from.Facet;
}

//------------------------------------------------------------------------------
bool vtkTracedSurfaces::IsHidden(
  const measuredbrdf::SurfacePoint& from, const glm::dvec3& direction) const
{
  const glm::dvec3 origin = this->Leave(from);
  return this->Tracer->IsOccluded(&origin.x, &direction.x, 0.0, Far);
}
