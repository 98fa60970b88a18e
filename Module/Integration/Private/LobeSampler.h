// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reflections of one view drawn by f cos(theta_i) itself, tabulated over the half vector: whatever
 * the material, weights hardly vary. A lobe about the view that falls between the half vectors has
 * draws of its own.
 */

#ifndef LobeSampler_h
#define LobeSampler_h

#include "HalfVectorSampler.h"
#include "RetroLobe.h"

#include <glm/glm.hpp>

#include <optional>

class vtkBRDF;

namespace measuredbrdf
{
class LobeSampler
{
public:
  /// Of a prepared BRDF and unit o above the horizon. With a floor (a density in 1/sr), draws are
  /// of the sharp part alone.
  LobeSampler(vtkBRDF* brdf, const glm::dvec3& o, double floor = 0.0);

  /// Sum of the channels of f cos(theta_i) where its density in its own integral is the floor.
  double GetLimit() const { return this->Limit; }

  /// Share of f cos(theta_i), given as the sum of its channels, that is sharp: the power heuristic
  /// (exponent 2) of its density and the floor (Veach, Guibas 1995).
  static double GetSharpShare(double value, double limit)
  {
    const double broad = limit * limit;
    return broad > 0.0 ? value * value / (value * value + broad) : 1.0;
  }

  /// Whether nothing is reflected: then nothing can be drawn.
  bool IsBlack() const { return !(this->Cells->GetTotal() > 0.0) && !(this->RetroShare > 0.0); }

  /// Unit i and its density in 1/sr from two uniform numbers. Below the horizon, which only the
  /// rim's cells cross, it weighs nothing.
  glm::dvec3 Sample(const glm::dvec2& u, double& density) const;

private:
  double GetCellDensity(const glm::dvec3& i) const;
  double GetSharpShare(double value) const { return GetSharpShare(value, this->Limit); }

  glm::dvec3 View;
  double Limit = 0.0;
  std::optional<HalfVectorSampler> Cells;
  RetroLobe Retro;
  double RetroShare = 0.0; // of the draws
};
} // namespace measuredbrdf

#endif
