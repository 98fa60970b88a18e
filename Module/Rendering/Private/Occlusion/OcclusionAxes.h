// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How a surface, the view and environments are turned against each other. Private to the rendering
 * room.
 */

#ifndef OcclusionAxes_h
#define OcclusionAxes_h

#include <glm/glm.hpp>

#include <vector>

class vtkActor;
class vtkEnvironment;
class vtkRenderer;

namespace measuredbrdf
{
struct OcclusionAxes
{
  OcclusionAxes(
    vtkRenderer* renderer, vtkActor* actor, const std::vector<vtkEnvironment*>& environments);

  glm::dmat3 ToModel; // of directions in view coordinates; it turns, stretches and mirrors
  // From the model's axes, each: the nearest orthogonal matrix, exact for turned, mirrored and
  // evenly scaled actors.
  std::vector<glm::dmat3> ToEnvironment;
};
} // namespace measuredbrdf

#endif
