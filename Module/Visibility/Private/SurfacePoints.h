// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where rays leave the points of a surface: normals, and origins beside edges. Private to the
 * module.
 */

#ifndef SurfacePoints_h
#define SurfacePoints_h

#include "vtkType.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

class vtkPolyData;

namespace measuredbrdf
{
struct SurfaceVertex
{
  glm::dvec3 Normal = glm::dvec3(0.0);     // unit; zero: the point is of no polygon
  glm::dvec3 Origin = glm::dvec3(0.0);     // on one of its triangles, close to the point
  glm::dvec3 FaceNormal = glm::dvec3(0.0); // of that triangle, on the side of Normal
};

/// One for each point of polygons and strips. Normals are the data's point normals, if they have
/// three components; else the polygons' mean by area.
std::vector<SurfaceVertex> FindSurfacePoints(vtkPolyData* surface);

/// The least cosine between a polygon and the normals of its points, whichever way these point; the
/// polygons where it is less make up a hundredth of the area. 1 where there is none.
double GetLeastCosine(vtkPolyData* surface, const std::vector<glm::dvec3>& normals);

/// The version of the form of visibility arrays. It stands before their surface's key.
inline constexpr const char* SurfaceKeyVersion = "4:";

/// What tells the points, point normals and cells of a surface from others, whatever the types of
/// its arrays of indices: 32 hexadecimal digits.
std::string GetSurfaceKey(vtkPolyData* surface);
} // namespace measuredbrdf

#endif
