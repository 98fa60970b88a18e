// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePoints.h"

#include "ContentHash.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace measuredbrdf
{
namespace
{
// From a point to the middle of one of its triangles: far enough not to begin on a wall that meets
// the surface there, near enough to count as the point.
constexpr double Inwards = 0.02;
constexpr vtkIdType Piece = 4096; // values that are hashed at a time

glm::dvec3 GetPoint(vtkPolyData* surface, vtkIdType id)
{
  glm::dvec3 p;
  surface->GetPoints()->GetPoint(id, &p.x);
  return p;
}

bool IsFinite(const glm::dvec3& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void HashArray(ContentHash& hash, vtkDataArray* array)
{
  std::vector<double> values;
  const vtkIdType count = array ? array->GetNumberOfTuples() : 0;
  for (vtkIdType tuple = 0; tuple < count; ++tuple)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      values.push_back(array->GetComponent(tuple, c));
    }
    if (tuple % Piece == Piece - 1 || tuple + 1 == count)
    {
      hash.AddValues(values);
      values.clear();
    }
  }
}
}

Face MakeFace(vtkPolyData* surface, const vtkIdType* ids, vtkIdType count)
{
  Face face;
  const glm::dvec3 first = GetPoint(surface, ids[0]); // large coordinates cancel
  glm::dvec3 before(0.0);
  for (vtkIdType k = 1; k < count; ++k)
  {
    const glm::dvec3 at = GetPoint(surface, ids[k]) - first;
    face.Area += glm::cross(before, at);
    face.Middle += at;
    before = at;
  }
  face.Middle = first + face.Middle / static_cast<double>(count);
  return face;
}

void TriangulatePolygon(
  vtkPolyData* surface, vtkIdType count, const vtkIdType* corners, std::vector<vtkIdType>& result)
{
  result.clear();
  if (count == 3)
  {
    result.assign(corners, corners + 3);
    return;
  }
  if (count == 4)
  {
    glm::dvec3 p[4];
    for (int k = 0; k < 4; ++k)
    {
      p[k] = GetPoint(surface, corners[k]);
    }
    for (int k = 0; k < 2; ++k) // the cut from k to k + 2
    {
      const glm::dvec3 cut = p[k + 2] - p[k];
      const glm::dvec3 one = glm::cross(p[k + 1] - p[k], cut);
      const glm::dvec3 other = glm::cross(cut, p[(k + 3) % 4] - p[k]);
      if (glm::dot(one, other) >= 0.0)
      {
        result = { corners[k], corners[k + 1], corners[k + 2], corners[k], corners[k + 2],
          corners[(k + 3) % 4] };
        return;
      }
    }
  }
  vtkNew<vtkPolygon> polygon;
  polygon->GetPoints()->SetDataTypeToDouble();
  polygon->GetPoints()->SetNumberOfPoints(count);
  polygon->GetPointIds()->SetNumberOfIds(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const glm::dvec3 position = GetPoint(surface, corners[k]);
    polygon->GetPoints()->SetPoint(k, &position.x);
    polygon->GetPointIds()->SetId(k, corners[k]);
  }
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  vtkCell* cell = polygon;
  if (cell->Triangulate(0, ids, points) && ids->GetNumberOfIds() % 3 == 0)
  {
    result.assign(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds());
  }
  if (result.empty()) // a polygon that crosses itself, or has no plane
  {
    for (vtkIdType k = 2; k < count; ++k)
    {
      result.insert(result.end(), { corners[0], corners[k - 1], corners[k] });
    }
  }
}

std::vector<SurfaceVertex> FindSurfacePoints(vtkPolyData* surface)
{
  std::vector<SurfaceVertex> points(static_cast<std::size_t>(surface->GetNumberOfPoints()));
  if (points.empty())
  {
    return points;
  }
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  const bool given = normals && normals->GetNumberOfComponents() == 3 &&
                     normals->GetNumberOfTuples() >= surface->GetNumberOfPoints();
  std::vector<char> used(points.size(), 0);
  ForEachFace(surface, Faces::Polygons,
    [&](const vtkIdType* ids, vtkIdType count, vtkIdType)
    {
      const Face face = MakeFace(surface, ids, count);
      for (vtkIdType k = 0; IsFinite(face.Area) && k < count; ++k)
      {
        points[ids[k]].Normal += face.Area;
        used[ids[k]] = 1;
      }
    });
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    glm::dvec3 normal = points[k].Normal;
    if (given)
    {
      glm::dvec3 own;
      normals->GetTuple(static_cast<vtkIdType>(k), &own.x);
      const double length = glm::length(own);
      normal = length > 0.0 && std::isfinite(length) ? own / length : normal;
    }
    const double length = glm::length(normal);
    const bool any = used[k] && length > 0.0 && std::isfinite(length);
    points[k].Normal = any ? normal / length : glm::dvec3(0.0);
    points[k].Origin = GetPoint(surface, static_cast<vtkIdType>(k));
    points[k].FaceNormal = points[k].Normal;
  }
  // The triangle that turns most towards the normal; of several, the largest.
  std::vector<double> best(points.size(), 0.0);
  ForEachFace(surface, Faces::Triangles,
    [&](const vtkIdType* ids, vtkIdType count, vtkIdType)
    {
      const Face face = MakeFace(surface, ids, count);
      const double area = glm::length(face.Area);
      for (vtkIdType k = 0; area > 0.0 && std::isfinite(area) && k < count; ++k)
      {
        SurfaceVertex& point = points[ids[k]];
        const double cosine = glm::dot(face.Area, point.Normal) / area;
        const double merit = cosine * cosine * cosine * cosine * std::sqrt(area);
        if (merit > best[ids[k]])
        {
          best[ids[k]] = merit;
          point.Origin = glm::mix(GetPoint(surface, ids[k]), face.Middle, Inwards);
          point.FaceNormal = face.Area / (cosine < 0.0 ? -area : area);
        }
      }
    });
  return points;
}

std::string GetSurfaceKey(vtkPolyData* surface)
{
  ContentHash hash;
  hash.AddValue<std::int64_t>(surface->GetNumberOfPoints());
  HashArray(hash, surface->GetPoints() ? surface->GetPoints()->GetData() : nullptr);
  HashArray(hash, surface->GetPointData()->GetNormals());
  std::vector<std::int64_t> ids;
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    const vtkIdType number = cells ? cells->GetNumberOfCells() : 0;
    hash.AddValue<std::int64_t>(number);
    for (vtkIdType cell = 0; cell < number; ++cell)
    {
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      cells->GetCellAtId(cell, count, corners);
      ids.push_back(count);
      ids.insert(ids.end(), corners, corners + count);
      if (static_cast<vtkIdType>(ids.size()) >= Piece || cell + 1 == number)
      {
        hash.AddValues(ids);
        ids.clear();
      }
    }
  }
  return hash.GetText();
}
} // namespace measuredbrdf
