// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The (normal, view) pairs on which a planner compares its candidates: those of a sphere from
 * everywhere, or of a picture.
 */

#ifndef PlanPairs_h
#define PlanPairs_h

#include "ExtractedEmitters.h"
#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <vector>

namespace measuredbrdf
{
struct PlanPairs
{
  vtkSmartPointer<vtkDoubleArray> Normals; // unit vectors
  vtkSmartPointer<vtkDoubleArray> Views;   // as many unit vectors
  std::vector<double> Weights;             // of the pairs; none: 1 each
  std::vector<glm::dvec3> Cameras;         // whose pictures count; none: all is one
  std::vector<double> Ratios; // what they have of a cheap method's error (GetPictureRatios)
};

/// Arrays without tuples.
PlanPairs MakeEmptyPairs();

/// Cameras around a sphere, whose pictures count for plans for all views: the directions towards a
/// cube's faces and corners.
std::vector<glm::dvec3> GetPictureCameras();

/// So many normals as a sphere shows them to distant cameras everywhere, uniform over its disc, but
/// many of them near the rim, where radiance is steep, and half of them where its mirror directions
/// see one of the lamps, the more the closer, down to less than any lobe's width. Weights make up
/// for both.
PlanPairs DrawSpherePairs(int count, const std::vector<ExtractedEmitters::Light>& lamps = {});

/// Turned by a rotation, whose columns follow each other.
void Turn(const double columns[9], PlanPairs& pairs);
} // namespace measuredbrdf

#endif
