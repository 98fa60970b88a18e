// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What lights add to one normal of vtkBasisRadianceIntegrator's maps. Private to the module.
 */

#ifndef LightSplatter_h
#define LightSplatter_h

#include "LocalFrame.h"
#include "RadialFunctions.h"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <vector>

namespace measuredbrdf
{
struct MapLight
{
  glm::dvec3 Direction;
  glm::dvec3 Irradiance;
};

/// Per order 6 rows (cosine RGB, sine RGB) over the incident nodes with a mirrored one before and a
/// repeated one after.
class LightSplatter
{
public:
  explicit LightSplatter(int orders);

  /// Forget what was gathered, and add these lights for the normal frame[2].
  void Gather(const std::vector<MapLight>& lights, const Frame& frame);

  /// E of a radial function: cosine RGB, sine RGB.
  Eigen::Matrix<float, 6, 1> Contract(const Radial& radial) const;

private:
  void Add(double x, double y, double z, const glm::dvec3& irradiance);

  Eigen::VectorXf Values;
  Eigen::MatrixXf Sums;
  int Orders;
};
} // namespace measuredbrdf

#endif
