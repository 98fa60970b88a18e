// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a camera sees of polygonal surfaces: normals and views in proportion to the pixels that
 * they cover.
 *
 * Nothing is drawn: triangles are weighed by their projected areas. What hides behind other parts
 * counts too, so that coverage is an upper bound; sides that face away count only where nearly all
 * do (a room seen from inside). Of more than 4096 polygons every so many-th stands for its
 * neighbors, whichever surface they belong to.
 */

#ifndef VisibleSurface_h
#define VisibleSurface_h

#include <glm/glm.hpp>

#include <vector>

class vtkActor;
class vtkCamera;
class vtkDataArray;
class vtkMatrix4x4;
class vtkPolyData;
class vtkRenderer;

namespace measuredbrdf
{
class VisibleSurface
{
public:
  /// No pair where hardly anything is in view. toFrame: rows of a rotation of the world, into the
  /// frame that pairs are wanted in. width, height: of the picture in pixels.
  VisibleSurface(const std::vector<vtkPolyData*>& surfaces, vtkMatrix4x4* toWorld,
    vtkCamera* camera, int width, int height, const double toFrame[9]);

  /// What the renderer's camera sees of an actor's surfaces, in the frame of the renderer's
  /// environment: the world, turned by EnvironmentUp and EnvironmentRight.
  static VisibleSurface InView(
    const std::vector<vtkPolyData*>& surfaces, vtkRenderer* renderer, vtkActor* actor);

  bool IsEmpty() const { return this->Normals.empty(); }

  ///@{
  /// Unit normals and unit directions towards the camera, as many of each.
  const std::vector<glm::dvec3>& GetNormals() const { return this->Normals; }
  const std::vector<glm::dvec3>& GetViews() const { return this->Views; }
  ///@}

  /// The same as arrays of 3 components, ready for vtkRadiancePlanner::SetPairs.
  void CopyTo(vtkDataArray* normals, vtkDataArray* views) const;

private:
  std::vector<glm::dvec3> Normals;
  std::vector<glm::dvec3> Views;
};
} // namespace measuredbrdf

#endif
