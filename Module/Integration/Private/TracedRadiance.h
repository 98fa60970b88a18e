// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Radiance that leaves a point of a scene, by samples of what arrives there (Kajiya 1986, "The
 * Rendering Equation"; Veach, Guibas 1995 for the mixture of densities). Private to the module.
 */

#ifndef TracedRadiance_h
#define TracedRadiance_h

#include "LocalFrame.h"
#include "SkySampler.h"
#include "vtkTracedSurfaces.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

class vtkBRDF;
class vtkEnvironment;

namespace measuredbrdf
{
class TracedRadiance
{
public:
  struct Settings
  {
    int Samples;
    int Bounces;
    std::uint32_t Seed;
  };

  /// materials: of each surface; all prepared.
  TracedRadiance(
    const vtkTracedSurfaces& scene, vtkEnvironment* environment, std::vector<vtkBRDF*> materials)
    : Scene(scene)
    , Sky(environment)
    , Environment(environment)
    , Materials(std::move(materials))
  {
  }

  /// Sums over samples; two independent halves, for the noise.
  struct Sums
  {
    std::array<glm::dvec3, 2> Open{ glm::dvec3(0.0), glm::dvec3(0.0) };    // if nothing were hidden
    std::array<glm::dvec3, 2> Visible{ glm::dvec3(0.0), glm::dvec3(0.0) }; // from the sky
    std::array<glm::dvec3, 2> Bounced{ glm::dvec3(0.0), glm::dvec3(0.0) }; // from what hides it
  };

  /// A point with a material, a frame about its shading normal and a unit view in it.
  struct Receiver
  {
    SurfacePoint Point;
    vtkBRDF* Material;
    Frame Local;
    glm::dvec3 View;
  };
  Receiver MakeReceiver(const SurfacePoint& point, vtkBRDF* material, const glm::dvec3& view,
    const glm::dvec3& tangent) const;

  /// By samples. index: of the point, which has samples of its own.
  Sums Sample(const Receiver& receiver, std::uint32_t index, const Settings& settings) const;

  /// By the centers of all texels (of vtkEnvironment::GetSubdivided).
  Sums SumTexels(const Receiver& receiver, std::uint32_t index, const Settings& settings) const;

private:
  struct Draw
  {
    glm::dvec3 Direction; // world
    glm::dvec3 Local;
  };
  enum Strategy
  {
    ByLight,
    ByMaterial,
    ByCosine
  };
  bool DrawDirection(
    const Receiver& receiver, Strategy strategy, const glm::dvec2& u, Draw& draw) const;
  double GetDensity(
    const Receiver& receiver, const Draw& draw, const std::array<double, 3>& shares) const;
  void Add(const Receiver& receiver, const Draw& draw, double weight, int bounces,
    std::uint64_t path, Sums& sums, std::size_t half) const;
  glm::dvec3 Follow(SurfacePoint point, glm::dvec3 view, int bounces, std::uint64_t path) const;

  const vtkTracedSurfaces& Scene;
  SkySampler Sky;
  vtkEnvironment* Environment;
  std::vector<vtkBRDF*> Materials;
};
} // namespace measuredbrdf

#endif
