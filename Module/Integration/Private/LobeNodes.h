// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Nodes of an integral over an angle that are dense where a kernel has its energy.
 */

#ifndef LobeNodes_h
#define LobeNodes_h

#include <glm/glm.hpp>

#include <vector>

namespace measuredbrdf
{
struct LobeNode
{
  double Angle;
  double Weight;
};

/// Pairs of Gauss nodes in intervals of equal energy over [0, last], half of it spread evenly.
/// energy: angle and energy of each cell.
std::vector<LobeNode> MakeLobeNodes(
  const std::vector<glm::dvec2>& energy, double last, int resolution);
} // namespace measuredbrdf

#endif
