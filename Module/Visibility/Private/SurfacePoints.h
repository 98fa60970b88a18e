// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The faces of a surface as rays meet them, and where rays leave its points: normals, and origins
 * beside edges.
 */

#ifndef SurfacePoints_h
#define SurfacePoints_h

#include "vtkCellArray.h"
#include "vtkPolyData.h"
#include "vtkType.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// Corners of a polygon's triangles, three each, as points of the surface. Quads are cut where both
/// halves face the same way; other polygons, and quads where no cut does so, as VTK triangulates
/// them.
void TriangulatePolygon(
  vtkPolyData* surface, vtkIdType count, const vtkIdType* corners, std::vector<vtkIdType>& result);

enum class Faces
{
  Polygons, // and each triangle of strips
  Triangles // that rays meet; polygons need not be flat
};

/// visit(corners, count, cell) of each face of polygons and strips; cells count as vtkPolyData
/// counts them. Returns how many have fewer than three corners, or corners that are no points of
/// the surface: these are left out.
template <typename Visit>
vtkIdType ForEachFace(vtkPolyData* surface, Faces faces, const Visit& visit)
{
  vtkIdType skipped = 0;
  std::vector<vtkIdType> triangles;
  const vtkIdType points = surface->GetNumberOfPoints();
  vtkIdType cell = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    for (vtkIdType k = 0; cells && k < cells->GetNumberOfCells(); ++k, ++cell)
    {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      cells->GetCellAtId(k, count, ids);
      if (count < 3 ||
          std::any_of(ids, ids + count, [points](vtkIdType id) { return id < 0 || id >= points; }))
      {
        ++skipped;
      }
      else if (cells == surface->GetStrips())
      {
        for (vtkIdType n = 2; n < count; ++n)
        {
          const std::array<vtkIdType, 3> turned = { ids[n - 2], ids[n - 1 + n % 2],
            ids[n - n % 2] };
          visit(turned.data(), 3, cell);
        }
      }
      else if (count == 3 || faces == Faces::Polygons)
      {
        visit(ids, count, cell);
      }
      else
      {
        TriangulatePolygon(surface, count, ids, triangles);
        for (std::size_t n = 0; n + 2 < triangles.size(); n += 3)
        {
          visit(&triangles[n], 3, cell);
        }
      }
    }
  }
  return skipped;
}

struct Face
{
  glm::dvec3 Area = glm::dvec3(0.0); // normal times twice the area
  glm::dvec3 Middle = glm::dvec3(0.0);
};

/// Of a polygon of any shape, by Newell's normal.
Face MakeFace(vtkPolyData* surface, const vtkIdType* ids, vtkIdType count);

struct SurfaceVertex
{
  glm::dvec3 Normal = glm::dvec3(0.0);     // unit; zero: the point is of no polygon
  glm::dvec3 Origin = glm::dvec3(0.0);     // on one of its triangles, close to the point
  glm::dvec3 FaceNormal = glm::dvec3(0.0); // of that triangle, on the side of Normal
};

/// One for each point of polygons and strips. Normals are the data's point normals, if they have
/// three components; else the polygons' mean by area.
std::vector<SurfaceVertex> FindSurfacePoints(vtkPolyData* surface);

/// The version of the form of visibility arrays. It stands before their surface's key.
inline constexpr const char* SurfaceKeyVersion = "4:";

/// What tells the points, point normals and cells of a surface from others, whatever the types of
/// its arrays of indices: 32 hexadecimal digits.
std::string GetSurfaceKey(vtkPolyData* surface);
} // namespace measuredbrdf

#endif
