// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which triangles of a closed surface may be seen from outside. Private to the rendering room.
 */

#ifndef FacingTriangles_h
#define FacingTriangles_h

#include "vtkType.h"

#include <glm/glm.hpp>

#include <vector>

class vtkPolyData;

namespace measuredbrdf
{
/**
 * Of a closed surface seen from outside, other triangles hide those that face away. Renderers on
 * the processor spend as much on such a triangle's points as on those of the others, as they shade
 * points before they know which way triangles face: so these are not handed to them.
 */
class FacingTriangles
{
public:
  FacingTriangles() = default;

  /// normals: of the side that is seen from outside, unit, one for each point. A triangle whose
  /// points' normals are of both of its sides faces all viewers. Empty if the surface has polygons
  /// of more corners, or strips.
  FacingTriangles(vtkPolyData* surface, const std::vector<glm::dvec3>& normals);

  bool IsEmpty() const { return this->Corners.empty(); }

  /// The ids of all corners, three of a triangle.
  const std::vector<unsigned int>& GetCorners() const { return this->Corners; }

  /// Those of triangles that face the eye: a place with w = 1, or with w = 0 the direction of a
  /// viewer who is infinitely far away. In the surface's order.
  void Find(const glm::dvec4& eye, std::vector<unsigned int>& corners) const;

private:
  std::vector<unsigned int> Corners;
  std::vector<glm::vec4> Planes; // unit, positive in front
  double Size = 0.0;             // of the surface
};

/// Where the viewer of a projection is, or with w = 0 the direction to him: the homogeneous point
/// that has no place in the picture. toClip: column vectors to OpenGL's clip coordinates.
glm::dvec4 FindEye(const glm::dmat4& toClip);

/// Whether a box (as vtkDataSet::GetBounds) lies wholly beyond the near plane, so that neither is
/// the viewer inside nor does the plane cut it open.
bool IsBeyondNearPlane(const glm::dmat4& toClip, const double bounds[6]);
} // namespace measuredbrdf

#endif
