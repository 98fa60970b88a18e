// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A fixed set of samples of the sharp part of an isotropic BRDF's reflection, tabulated by the
 * view's polar angle and interpolated linearly in between: a shader reads them instead of sampling
 * any kind of material (GLSL twin: shaders/vtkBRDFEnvironmentFiltered.glsl). Private to the module.
 */

#ifndef ReflectionSamples_h
#define ReflectionSamples_h

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
  static constexpr int NumberOfViews = 128;

  /**
   * Density of f cos in its own integral, in 1/sr, at which half of it is sharp. Lights replace a
   * broad part well, as f hardly varies between them; samples alone miss small panels there.
   * Lambert's peak, 1/pi, lies below. Of 0.5, 0.7, 1, 2, 3 and 10, 1 was the best compromise
   * between studios with small panels and smooth skies.
   */
  static constexpr double Floor = 1.0;

  struct Sample
  {
    glm::vec3 Direction; // to the light, where the view's azimuth is 0; not unit in between
    float Level;         // 1/2 log2 of the share of the sphere that it stands for
    glm::vec3 Weight;    // sharp part of f cos / (N pdf), RGB
    float Limit;         // of the view: sum of the channels of f cos at Floor
  };

  /**
   * count samples (a Fibonacci lattice, the first ones spread evenly, too) of the sharp part of f
   * cos (LobeSampler). brdf is isotropic and prepared. Views are tabulated in parallel; a raised
   * abort leaves the rest black.
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
  Sample Interpolate(double coordinate, int k) const;

  /// Share of f cos (RGB) that the samples have (LobeSampler).
  static double GetSharpShare(const glm::dvec3& f, double limit);

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
