// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where a view is reflected to: a few directions drawn from f cos(theta_i), so that sums over the
 * environment know where to look. Private to the module.
 */

#ifndef ReflectionGuide_h
#define ReflectionGuide_h

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class ReflectionGuide
{
public:
  /// Unit direction, and the solid angle in sr in which a draw is alone on average.
  struct Draw
  {
    glm::dvec3 Direction;
    double SolidAngle;
  };

  /// Of a prepared BRDF, which is used later on.
  explicit ReflectionGuide(vtkBRDF* brdf);

  /// Draws for unit o above the horizon, in its frame; draws is replaced.
  void Draws(const glm::dvec3& o, std::vector<Draw>& draws) const;

private:
  vtkSmartPointer<vtkBRDF> BRDF;
  std::vector<std::vector<Draw>> Views; // of an isotropic BRDF, their azimuth 0
};
} // namespace measuredbrdf

#endif
