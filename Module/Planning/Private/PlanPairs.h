// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The (normal, view) pairs on which a planner compares its candidates. Private to the module.
 */

#ifndef PlanPairs_h
#define PlanPairs_h

#include "ExtractedEmitters.h"
#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// How many candidates are compared on.
constexpr int PairsToCompare = 512;

struct PlanPairs
{
  vtkSmartPointer<vtkDoubleArray> Normals; // unit vectors
  vtkSmartPointer<vtkDoubleArray> Views;   // as many unit vectors
  std::vector<double> Weights;             // of the pairs; none: 1 each
  std::vector<std::size_t> Points;         // that they lie about; none: each its own
  std::vector<double> Cameras; // three components each, whose pictures count; none: all is one
  std::vector<double> Ratios;  // what they have of a cheap method's error (PictureSums::GetRatios)
};

/// Arrays without tuples.
PlanPairs MakeEmptyPairs();

/// Cameras around a sphere, whose pictures count for plans for all views: the directions towards a
/// cube's faces and corners, three components each.
std::vector<double> GetPictureCameras();

/// So many normals as a sphere shows them to a distant camera, uniform over its disc, but many of
/// them near the rim, where radiance is steep, and half of them where its mirror directions see one
/// of the lamps, the more the closer, down to less than any lobe's width. Weights make up for both.
/// view: from the object to the camera; 0, 0, 0: from everywhere.
PlanPairs DrawSpherePairs(
  int count, const double view[3], const std::vector<ExtractedEmitters::Light>& lamps = {});

/// Turned by a rotation, whose columns follow each other.
void Turn(const double columns[9], PlanPairs& pairs);
} // namespace measuredbrdf

#endif
