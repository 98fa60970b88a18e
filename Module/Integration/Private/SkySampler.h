// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Directions drawn by an environment's radiance as it is between the texels. Private to the module.
 */

#ifndef SkySampler_h
#define SkySampler_h

#include "Distribution.h"

#include <glm/glm.hpp>

class vtkEnvironment;

namespace measuredbrdf
{
class SkySampler
{
public:
  /// World directions; the environment must stay, and its rotation is taken as it is now.
  explicit SkySampler(vtkEnvironment* environment);

  /// Whether there is no light at all: then nothing can be drawn.
  bool IsBlack() const { return this->Texels.IsZero(); }

  /// Unit direction from two uniform numbers.
  glm::dvec3 Sample(const glm::dvec2& u) const;

  /// Its density in 1/sr, and the radiance from there.
  double GetDensity(const glm::dvec3& direction) const;
  glm::dvec3 GetRadiance(const glm::dvec3& direction) const;

private:
  vtkEnvironment* Environment;
  glm::dmat3 ToEnvironment;
  std::size_t Width;
  std::size_t Height;
  Distribution2D Texels;
};
} // namespace measuredbrdf

#endif
