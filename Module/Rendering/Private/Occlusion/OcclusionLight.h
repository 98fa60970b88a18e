// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What shading with horizon codes (HorizonCode.h) needs of a material and its light.
 */

#ifndef OcclusionLight_h
#define OcclusionLight_h

#include "EnvironmentPanels.h"
#include "SkyHarmonics.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

class vtkBRDF;
class vtkEnvironment;
class vtkRadianceIntegrator;

namespace measuredbrdf
{
/**
 * A material's gloss, seen from one polar angle: the kernel f cos(theta), less what the integrator
 * reflects as a Lambert surface does, as cos(theta) exp(p . d). The von Mises-Fisher lobe is f, so
 * that the lobe ends at the horizon, as the kernel does. p is the one with the kernel's mean
 * direction, which is the most likely one of an exponential family.
 */
struct OcclusionLobe
{
  // p is (-Across, 0, Along) seen from (sin theta, 0, cos theta).
  double Across = 0.0;
  double Along = 1.0;
  double Integral = 1.0;                // of cos(theta) exp(p . d - |p|) over the hemisphere
  double Delta = 0.0;                   // to the axis of a table's lobe, as LobeMeans has it
  glm::dvec3 Lambert = glm::dvec3(0.0); // what is left out, in 1/sr
  glm::dvec3 Albedo = glm::dvec3(0.0);  // directional, of the lobe
};

/// Seen from polar angles that are evenly spaced, from the normal to acos(MinimumViewCosine).
constexpr std::size_t OcclusionViews = 16;
using OcclusionLobes = std::array<OcclusionLobe, OcclusionViews>;

/// withFloor: the Lambert part belongs to the lobe.
OcclusionLobes FindOcclusionLobes(vtkBRDF* brdf, bool withFloor);

/// What is hidden reflects: all that hides is taken to be of the material itself, and to reflect as
/// a Lambert surface with its albedo does.
struct OcclusionBounce
{
  glm::dvec3 Albedo; // hemispherical, at most 1
  sky::Colors Light; // all of it, lamps included, in the environment's frame
};

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
  std::unique_ptr<const OcclusionBounce> Bounce; // null: what is hidden is black

  /// Light for a surface whose axes the matrix turns into the environment's, of which the first
  /// lamps are tested. Others stay in it where E(n) holds them.
  sky::Colors GetLight(const glm::dmat3& toEnvironment, std::size_t tested = MaximumLamps) const;
};

/// Half of the width of an even strip that has the panel's variance, in radians.
double GetPanelRadius(const EnvironmentPanels::Panel& panel);
} // namespace measuredbrdf

#endif
