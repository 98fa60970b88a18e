// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a camera sees of polygonal surfaces, for plans: unit normals and unit directions towards the
 * camera, in proportion to the pixels that they cover.
 *
 * Rays are traced through points that lie evenly in the part of the picture that the surfaces'
 * bounds cover. Normals are on the camera's side, as shaders turn them.
 */

#ifndef VisibleSurface_h
#define VisibleSurface_h

#include "vtkDoubleArray.h"
#include "vtkNew.h"

#include <glm/glm.hpp>

#include <vector>

class vtkActor;
class vtkCamera;
class vtkMatrix4x4;
class vtkPolyData;
class vtkRenderer;

namespace measuredbrdf
{
/// Ready for vtkRadiancePlanner::SetPairs. No pair where hardly anything is in view.
struct VisibleSurface
{
  vtkNew<vtkDoubleArray> Normals;
  vtkNew<vtkDoubleArray> Views;

  /// toFrame: a rotation of the world, into the frame that pairs are wanted in. aspect: the
  /// picture's width divided by its height.
  VisibleSurface(const std::vector<vtkPolyData*>& surfaces, vtkMatrix4x4* toWorld,
    vtkCamera* camera, double aspect, const glm::dmat3& toFrame);

  /// What the renderer's camera sees of an actor's surfaces, in the frame of the renderer's
  /// environment: the world, turned by EnvironmentUp and EnvironmentRight.
  VisibleSurface(const std::vector<vtkPolyData*>& surfaces, vtkRenderer* renderer, vtkActor* actor);

  bool IsEmpty() const { return this->Normals->GetNumberOfTuples() == 0; }
};
} // namespace measuredbrdf

#endif
