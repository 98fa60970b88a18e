// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What vtkTracedScene holds: surfaces, a tracer and normals.
 */

#ifndef vtkTracedSurfaces_h
#define vtkTracedSurfaces_h

#include "SurfaceTracer.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <vector>

namespace measuredbrdf
{
/// A point of a surface as a viewer sees it. Unit normals are on the viewer's side.
struct SurfacePoint
{
  glm::dvec3 Position = glm::dvec3(0.0);
  glm::dvec3 Normal = glm::dvec3(0.0);
  glm::dvec3 Facet = glm::dvec3(0.0);
  int Surface = -1;
  vtkIdType Cell = 0;
  glm::dvec3 View = glm::dvec3(0.0); // towards the viewer
};
} // namespace measuredbrdf

class vtkTracedSurfaces
{
public:
  /// What the ray meets first, or false.
  bool Cast(
    const glm::dvec3& origin, const glm::dvec3& direction, measuredbrdf::SurfacePoint& point) const;

  /// The same for a ray that leaves a point of a surface.
  bool CastFrom(const measuredbrdf::SurfacePoint& from, const glm::dvec3& direction,
    measuredbrdf::SurfacePoint& point) const
  {
    return this->Cast(this->Leave(from), direction, point);
  }

  /// vtkTracedScene::DrawVisiblePoints'.
  std::vector<measuredbrdf::SurfacePoint> DrawPoints(
    vtkIdType count, const glm::dvec3& viewDirection) const;

  /// Whether the scene hides the sky in this direction.
  bool IsHidden(const measuredbrdf::SurfacePoint& from, const glm::dvec3& direction) const;

private:
  friend class vtkTracedScene;

  struct Surface
  {
    vtkSmartPointer<vtkPolyData> Mesh; // a shallow copy: arrays are shared with the user's
    std::array<double, 16> Matrix;
    std::vector<glm::vec3> Normals; // of points, world; empty: facets'
  };

  // Just above the surface, on the viewer's side: directions below the facet meet it.
  glm::dvec3 Leave(const measuredbrdf::SurfacePoint& from) const;
  void TakeNormals(Surface& surface) const;

  std::vector<Surface> Surfaces;
  double Points = 0.0; // of all meshes
  double Cells = 0.0;
  std::unique_ptr<measuredbrdf::SurfaceTracer> Tracer; // null: to be built
};

#endif
