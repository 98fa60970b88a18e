// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reflections of one view drawn by f cos(theta_i) itself, tabulated over the half vector: whatever
 * the material, weights hardly vary. A lobe about the view that falls between the half vectors has
 * draws of its own. Private to the module.
 */

#ifndef LobeSampler_h
#define LobeSampler_h

#include "Distribution.h"
#include "RetroLobe.h"

#include <glm/glm.hpp>

class vtkBRDF;

namespace measuredbrdf
{
class LobeSampler
{
public:
  /// Of a prepared BRDF and unit o above the horizon.
  LobeSampler(vtkBRDF* brdf, const glm::dvec3& o);

  /// Whether nothing is reflected: then nothing can be drawn.
  bool IsBlack() const { return this->Cells.IsZero() && !(this->RetroShare > 0.0); }

  /// Unit i and its density in 1/sr from two uniform numbers. Below the horizon, which only the
  /// rim's cells cross, it weighs nothing.
  glm::dvec3 Sample(const glm::dvec2& u, double& density) const;

private:
  double GetCellDensity(const glm::dvec3& h) const;

  glm::dvec3 View;
  Distribution2D Cells;
  RetroLobe Retro;
  double RetroShare = 0.0; // of the draws
};
} // namespace measuredbrdf

#endif
