// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What shading with hidden skies (HiddenSky.h) needs of a material and its light. Private to the
 * rendering room.
 */

#ifndef OcclusionLight_h
#define OcclusionLight_h

#include "EnvironmentPanels.h"
#include "OcclusionBounce.h"
#include "OcclusionLobes.h"
#include "SkyHarmonics.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <memory>
#include <vector>

class vtkBRDF;
class vtkEnvironment;
class vtkRadianceIntegrator;

namespace measuredbrdf
{
class HiddenSky;

struct OcclusionLight
{
  /// withBounce: whether what is hidden reflects.
  OcclusionLight(vtkBRDF* brdf, vtkEnvironment* environment, vtkRadianceIntegrator* integrator,
    bool withBounce = false);

  /// More lamps are not tested: they shine through.
  static constexpr std::size_t MaximumLamps = 16;

  OcclusionLobes Lobes;
  sky::Colors Light;                 // without lamps and panels, in the environment's frame
  std::vector<glm::dvec3> Lamps;     // directions in the environment's frame
  std::vector<glm::dvec3> LampLight; // irradiance of lamps that E(n) and the table hold; else empty
  std::vector<EnvironmentPanels::Panel> Panels;
  bool HasLobe = true;  // whether there is more than the Lambert part, which IsSplit leaves out
  bool IsSplit = false; // whether the integrator tells Lambert part, lobe and lamps apart
  std::shared_ptr<const OcclusionBounce> Bounce; // null: what is hidden is black

  /// Light for a surface whose axes the matrix turns into the environment's, of which the first
  /// lamps are tested. Others stay in it where E(n) holds them.
  sky::Colors GetLight(const glm::dmat3& toEnvironment, std::size_t tested = MaximumLamps) const;

  /// What a point hides, seen from a unit direction in the surface's axes: irradiance, and the
  /// share of the lobe's light. Lamps' own lobes apart. C++ twin of what OcclusionShader writes.
  struct Hidden
  {
    glm::dvec3 Irradiance, Lobe;
  };
  Hidden GetHidden(
    const HiddenSky& sky, const glm::dvec3& view, const glm::dmat3& toEnvironment) const;
};

/// Half of the width of an even strip that has the panel's variance, in radians.
double GetPanelRadius(const EnvironmentPanels::Panel& panel);

/// Irradiance as a quadratic form of (n, 1), for a channel; by columns.
glm::mat4 GetIrradianceForm(const sky::Colors& light, int channel);
} // namespace measuredbrdf

#endif
