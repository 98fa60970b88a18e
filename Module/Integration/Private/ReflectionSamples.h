// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A fixed set of samples of an isotropic BRDF's reflection, tabulated by the view's polar angle and
 * interpolated linearly in between: a shader reads them instead of sampling any kind of material
 * (GLSL twin: shaders/vtkBRDFEnvironmentFiltered.glsl). Private to the module.
 */

#ifndef ReflectionSamples_h
#define ReflectionSamples_h

#include "Neighbors.h"

#include <glm/glm.hpp>

#include <atomic>
#include <cstddef>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class ReflectionSamples
{
public:
  /// Views that are tabulated, from the normal to MinimumViewCosine.
  static constexpr int NumberOfViews = 64;

  struct Sample
  {
    glm::vec3 Direction; // to the light, where the view's azimuth is 0; not unit in between
    float Level;         // 1/2 log2 of the share of the sphere that it stands for
    glm::vec3 Weight;    // f cos / (N pdf), RGB
  };

  /**
   * count samples (a Fibonacci lattice, the first ones spread evenly, too) distributed as f cos
   * (LobeSampler). Each view's weights are scaled to add up to its directional albedo. brdf is
   * isotropic and prepared. Views are tabulated in parallel; a raised abort leaves the rest black.
   */
  ReflectionSamples(vtkBRDF* brdf, int count, const std::atomic<bool>& abort);

  int GetNumberOfSamples() const { return this->Count; }

  /// Tabulated sample k of a view.
  const Sample& Get(int view, int k) const
  {
    return this->Samples[static_cast<std::size_t>(view) * static_cast<std::size_t>(this->Count) +
                         static_cast<std::size_t>(k)];
  }

  /// Sample k at a coordinate between views.
  Sample Interpolate(double coordinate, int k, const FilterWeights& filter) const;

  /// Where unit o falls between the tabulated views: in [0, NumberOfViews - 1].
  static double GetCoordinate(const glm::dvec3& o);

  /// Tabulated view, azimuth 0.
  static glm::dvec3 GetView(int view);

private:
  void Tabulate(vtkBRDF* brdf, const std::vector<glm::dvec2>& points, int view);

  int Count;
  std::vector<Sample> Samples;
};
} // namespace measuredbrdf

#endif
