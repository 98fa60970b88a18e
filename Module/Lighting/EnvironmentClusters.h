// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An environment as a few thousand directions that between them hold every texel: blocks of texels,
 * small where there is much light. Each stands at its light's centroid, so that a smooth kernel
 * sees it wrong in second order only. Private to the module.
 */

#ifndef EnvironmentClusters_h
#define EnvironmentClusters_h

#include <glm/glm.hpp>

#include <vector>

class vtkEnvironment;

namespace measuredbrdf
{
struct EnvironmentCluster
{
  glm::dvec3 Direction;  // unit, environment frame
  glm::dvec3 Irradiance; // RGB: radiance times solid angle, summed
};

/**
 * About `count` clusters. The one with the largest second moment of its light about its centroid is
 * split first. Texels that are black are left out.
 */
std::vector<EnvironmentCluster> MakeEnvironmentClusters(vtkEnvironment* environment, int count);
} // namespace measuredbrdf

#endif
