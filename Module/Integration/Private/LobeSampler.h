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
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/// What samplers of many views of an isotropic BRDF may read instead of evaluating it: f over the
/// half vector, which hardly varies with the view, at a few views.
class LobeTable
{
public:
  /// Of a prepared BRDF.
  explicit LobeTable(vtkBRDF* brdf);

  /// Sum of f's channels in each cell, the largest of the views about o, whose y is 0.
  void Read(const glm::dvec3& o, std::vector<double>& f) const;

private:
  std::vector<float> Values; // view, cell
};

class LobeSampler
{
public:
  /**
   * Of a prepared BRDF and unit o above the horizon; with a table of it, where there is one. With a
   * floor (a density in 1/sr), draws are of the sharp part alone.
   */
  LobeSampler(
    vtkBRDF* brdf, const glm::dvec3& o, const LobeTable* table = nullptr, double floor = 0.0);

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
