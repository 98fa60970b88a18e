// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the shaders of OcclusionShader.h should find at a point, in C++.
 */

#ifndef OcclusionReference_h
#define OcclusionReference_h

#include "HorizonLight.h"
#include "Lamps.h"
#include "OcclusionLight.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

/// A material's lobe at a point: between the two nearest views, turned to the surface's axes.
struct ReferenceLobe
{
  measuredbrdf::OcclusionLobe Lobe;
  glm::dvec3 Slope;
  glm::dvec3 Axis; // about which a table has the lobe: unit

  ReferenceLobe(
    const measuredbrdf::OcclusionLobes& lobes, const glm::dvec3& normal, const glm::dvec3& view)
  {
    const double cosine = glm::dot(normal, view);
    const double last = std::acos(measuredbrdf::MinimumViewCosine);
    const double at = std::acos(std::clamp(cosine, measuredbrdf::MinimumViewCosine, 1.0)) / last *
                      (measuredbrdf::OcclusionViews - 1);
    const auto low = std::min(static_cast<std::size_t>(at), measuredbrdf::OcclusionViews - 2);
    const double t = at - static_cast<double>(low);
    const measuredbrdf::OcclusionLobe& a = lobes[low];
    const measuredbrdf::OcclusionLobe& b = lobes[low + 1];
    this->Lobe = { glm::mix(a.Across, b.Across, t), glm::mix(a.Along, b.Along, t),
      glm::mix(a.Integral, b.Integral, t), glm::mix(a.Delta, b.Delta, t),
      glm::mix(a.Lambert, b.Lambert, t), glm::mix(a.Albedo, b.Albedo, t) };
    glm::dvec3 across = view - cosine * normal;
    across /= std::max(glm::length(across), 1e-6);
    this->Slope = this->Lobe.Along * normal - this->Lobe.Across * across;
    this->Axis = std::cos(this->Lobe.Delta) * normal - std::sin(this->Lobe.Delta) * across;
  }
};

/// What a point hides: irradiance, and the share of the lobe's light. Lamps' own lobes apart.
struct ReferenceHidden
{
  glm::dvec3 Irradiance, Lobe;
};

/// Seen from a unit direction in the surface's axes.
inline ReferenceHidden GetReferenceHidden(const measuredbrdf::OcclusionLight& material,
  const measuredbrdf::HorizonLight& sky, const glm::dvec3& view, const glm::dmat3& toEnvironment)
{
  using measuredbrdf::Pi;
  const glm::dvec3 n = sky.GetNormal();
  const ReferenceLobe seen(material.Lobes, n, view);
  const double kappa = glm::length(seen.Slope);
  const measuredbrdf::sky::Colors light = material.GetLight(toEnvironment);
  const glm::dvec3 irradiance = measuredbrdf::sky::GetIrradiance(light, n);
  ReferenceHidden hidden = { sky.GetHiddenIrradiance(light), glm::dvec3(0.0) };
  const glm::dvec3 share =
    sky.GetHiddenLight(sky.GetHiddenShare(seen.Slope), kappa, hidden.Irradiance, irradiance);
  // Radiance in the lobe: of the rest, then of panels, and of what the table has of lamps.
  glm::dvec3 all = glm::max(irradiance, glm::dvec3(1e-30)) / Pi;
  glm::dvec3 lost = share * all;
  for (const measuredbrdf::EnvironmentPanels::Panel& panel : material.Panels)
  {
    const glm::dvec3 d = glm::transpose(toEnvironment) * panel.Direction;
    const double radius = measuredbrdf::GetPanelRadius(panel);
    const double z = glm::dot(d, n);
    const double rise = std::max(z + radius, 0.0);
    const double cosine = z > radius ? z : rise * rise / (4.0 * radius);
    hidden.Irradiance += sky.GetHiddenPanel(d, radius) * cosine * panel.Irradiance;
    // The mean of exp(slope . d) over a concentrated von Mises-Fisher lobe.
    const double both = std::max(glm::length(seen.Slope + panel.Concentration * d), 1e-3);
    const double mean = panel.Concentration / both * std::exp(both - panel.Concentration - kappa);
    const glm::dvec3 inLobe = panel.Irradiance * (cosine * mean / seen.Lobe.Integral);
    // The middle of both lobes' product, and one of its standard deviations.
    const double up = (glm::dot(seen.Slope, n) + panel.Concentration * z) / both - z;
    all += inLobe;
    lost += sky.GetHiddenPanel(d, radius, std::sqrt(1.0 / both), up) * inLobe;
  }
  const measuredbrdf::LampWindow window;
  for (std::size_t k = 0;
       k < std::min(material.LampLight.size(), measuredbrdf::OcclusionLight::MaximumLamps); ++k)
  {
    const glm::dvec3 d = glm::transpose(toEnvironment) * material.Lamps[k];
    const double part = 1.0 - sky.GetVisibleLamp(d);
    const double cosine = std::max(glm::dot(d, n), 0.0);
    hidden.Irradiance += part * cosine * material.LampLight[k];
    const double shine = cosine * std::exp(glm::dot(seen.Slope, d) - kappa) / seen.Lobe.Integral;
    const glm::dvec3 inTable =
      (1.0 - window.GetWeight(d, seen.Axis)) * shine * material.LampLight[k];
    all += inTable;
    lost += part * inTable;
  }
  hidden.Lobe = lost / all;
  return hidden;
}

/// What a point adds that reflects what comes back from what it hides.
inline glm::dvec3 GetReferenceBounce(const measuredbrdf::OcclusionLight& material,
  const measuredbrdf::HorizonLight& sky, const measuredbrdf::BouncedLight& bounced,
  const glm::dvec3& view, const glm::dmat3& toEnvironment)
{
  const ReferenceLobe seen(material.Lobes, sky.GetNormal(), view);
  const double share = sky.GetHiddenShare(seen.Slope);
  const glm::dvec3 irradiance =
    material.Bounce->Albedo *
    bounced.GetIrradiance(measuredbrdf::sky::Rotate(material.Bounce->Light, toEnvironment));
  const double hidden = std::max(sky.GetHiddenCosine(), 1e-3);
  return irradiance *
         (seen.Lobe.Lambert + seen.Lobe.Albedo * (share / (measuredbrdf::Pi * hidden)));
}

#endif
