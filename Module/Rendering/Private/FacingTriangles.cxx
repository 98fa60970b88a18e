// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FacingTriangles.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
// What rounds to edge-on is drawn: parts of the surface's size.
constexpr double Margin = 1e-5;
const glm::dvec4 AllViewers(0.0, 0.0, 0.0, 0.0);

// Of a triangle, positive on the normals' side.
glm::dvec4 MakePlane(const glm::dvec3 points[3], const glm::dvec3 normals[3])
{
  const glm::dvec3 across = glm::cross(points[1] - points[0], points[2] - points[0]);
  const double size = glm::length(across);
  if (!(size > 0.0))
  {
    return AllViewers;
  }
  const glm::dvec3 n = across / size;
  const double sides[3] = { glm::dot(n, normals[0]), glm::dot(n, normals[1]),
    glm::dot(n, normals[2]) };
  const auto [least, most] = std::minmax_element(sides, sides + 3);
  if (!(*least > 0.0) && !(*most < 0.0))
  {
    return AllViewers;
  }
  return glm::dvec4(n, -glm::dot(n, points[0])) * (*least > 0.0 ? 1.0 : -1.0);
}
}

FacingTriangles::FacingTriangles(vtkPolyData* surface, const std::vector<glm::dvec3>& normals)
{
  vtkCellArray* polygons = surface->GetPolys();
  if (polygons->IsHomogeneous() != 3 || surface->GetNumberOfStrips() > 0)
  {
    return;
  }
  this->Size = surface->GetLength();
  const auto count = static_cast<std::size_t>(polygons->GetNumberOfCells());
  this->Corners.reserve(3 * count);
  this->Planes.reserve(count);
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType cell = 0; cell < polygons->GetNumberOfCells(); ++cell)
  {
    polygons->GetCellAtId(cell, size, ids);
    glm::dvec3 points[3];
    glm::dvec3 sides[3];
    for (int k = 0; k < 3; ++k)
    {
      surface->GetPoint(ids[k], &points[k].x);
      sides[k] = normals[static_cast<std::size_t>(ids[k])];
      this->Corners.push_back(static_cast<unsigned int>(ids[k]));
    }
    this->Planes.emplace_back(MakePlane(points, sides));
  }
}

void FacingTriangles::Find(const glm::dvec4& eye, std::vector<unsigned int>& corners) const
{
  const auto place = static_cast<glm::vec4>(eye);
  const double reach = eye.w != 0.0 ? glm::length(glm::dvec3(eye)) + this->Size : 1.0;
  const auto least = static_cast<float>(-Margin * reach);
  corners.resize(this->Corners.size());
  std::size_t used = 0;
  for (std::size_t k = 0; k < this->Planes.size(); ++k)
  {
    // Written whether it counts or not: no branch.
    std::copy_n(&this->Corners[3 * k], 3, &corners[used]);
    used += glm::dot(this->Planes[k], place) < least ? 0 : 3;
  }
  corners.resize(used);
}

glm::dvec4 FindEye(const glm::dmat4& toClip)
{
  const glm::dmat4 rows = glm::transpose(toClip);
  // Orthogonal to the rows of x, y and w: minors of the matrix that they make.
  glm::dvec4 eye(0.0);
  for (int c = 0; c < 4; ++c)
  {
    glm::dmat3 minor(0.0);
    for (int k = 0, column = 0; k < 4; ++k)
    {
      if (k != c)
      {
        minor[column++] = { rows[0][k], rows[1][k], rows[3][k] };
      }
    }
    eye[c] = (c % 2 == 0 ? 1.0 : -1.0) * glm::determinant(minor);
  }
  eye *= glm::dot(rows[2], eye) > 0.0 ? -1.0 : 1.0; // towards the viewer depths fall
  const double length = glm::length(glm::dvec3(eye));
  return std::abs(eye.w) > 1e-12 * length ? eye / eye.w : eye / length;
}

bool IsBeyondNearPlane(const glm::dmat4& toClip, const double bounds[6])
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec4 clip = toClip * glm::dvec4(bounds[corner & 1], bounds[2 + (corner >> 1 & 1)],
                                       bounds[4 + (corner >> 2 & 1)], 1.0);
    if (!(clip.w > 0.0 && clip.z > -clip.w))
    {
      return false;
    }
  }
  return true;
}
} // namespace measuredbrdf
