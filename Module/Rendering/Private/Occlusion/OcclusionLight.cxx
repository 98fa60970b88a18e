// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionLight.h"

#include "EnvironmentPrecomputation.h"
#include "HalfVector.h" // for Pi
#include "HiddenSky.h"
#include "LampWindow.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkFactoredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
// The real harmonics of an environment in its own axes. EnvironmentHarmonics' frame has the
// environment's (z, x, y) as its axes.
sky::Colors MakeLight(vtkEnvironment* environment, const EnvironmentPrecomputation::Rest& rest)
{
  const auto harmonics =
    environment->GetParts().GetHarmonics(environment, rest, sky::Degree, []() { return true; });
  sky::Colors colors;
  for (int l = 0; l <= sky::Degree; ++l)
  {
    for (int m = 0; m <= l; ++m)
    {
      for (int c = 0; c < 3; ++c)
      {
        // a_lm is the integral of L times the conjugate of Y_lm.
        const std::complex<double> a = harmonics->Get(c, l, m);
        const auto middle = static_cast<std::size_t>(l * (l + 1));
        const double scale = m == 0 ? 1.0 : std::sqrt(2.0);
        colors[middle + static_cast<std::size_t>(m)][c] = scale * a.real();
        if (m > 0)
        {
          colors[middle - static_cast<std::size_t>(m)][c] = -scale * a.imag();
        }
      }
    }
  }
  // Columns: what the environment's x, y and z are there.
  const glm::dmat3 axes({ 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 });
  return sky::Rotate(colors, axes);
}

// Less the harmonics of a von Mises-Fisher lobe: its bands follow the recurrence of modified
// spherical Bessel functions.
void Subtract(const EnvironmentPanels::Panel& panel, sky::Colors& light)
{
  const double k = panel.Concentration;
  double bands[sky::Degree + 1] = { 1.0, 1.0 / std::tanh(k) - 1.0 / k };
  for (int l = 1; l < sky::Degree; ++l)
  {
    bands[l + 1] = bands[l - 1] - (2 * l + 1) / k * bands[l];
  }
  const sky::Values values = sky::Evaluate(panel.Direction);
  for (int l = 0; l <= sky::Degree; ++l)
  {
    for (int j = l * l; j < (l + 1) * (l + 1); ++j)
    {
      const auto at = static_cast<std::size_t>(j);
      light[at] -= panel.Irradiance * (bands[l] * values[at]);
    }
  }
}
}

OcclusionLight::OcclusionLight(
  vtkBRDF* brdf, vtkEnvironment* environment, vtkRadianceIntegrator* integrator, bool withBounce)
{
  auto* hybrid = vtkHybridRadianceIntegrator::SafeDownCast(integrator);
  this->IsSplit =
    brdf->IsIsotropic() && (hybrid || vtkTableRadianceIntegrator::SafeDownCast(integrator) ||
                             vtkFactoredRadianceIntegrator::SafeDownCast(integrator));
  this->Lobes = OcclusionLobes(brdf, !this->IsSplit);
  this->HasLobe = std::any_of(this->Lobes.GetLobes().begin(), this->Lobes.GetLobes().end(),
    [](const OcclusionLobes::Lobe& lobe)
    { return glm::any(glm::greaterThan(lobe.Albedo, glm::dvec3(0.0))); }); // LobeMeans rounds to 0
  EnvironmentPrecomputation::Rest rest;
  if (hybrid && this->IsSplit)
  {
    const auto lamps = environment->GetParts().GetLamps(environment,
      vtkMath::RadiansFromDegrees(hybrid->GetLightAngle()), hybrid->GetMaximumNumberOfLights(),
      []() { return true; });
    const auto count = static_cast<int>(lamps->Lights.size());
    rest = lamps->Rest;
    const bool inIrradiance = vtkHybridRadianceIntegrator::AreWindowed(brdf, count);
    for (const ExtractedEmitters::Light& lamp : lamps->Lights)
    {
      this->Lamps.push_back(lamp.Direction);
      if (inIrradiance)
      {
        this->LampLight.push_back(lamp.Irradiance);
      }
    }
  }
  this->Light = MakeLight(environment, rest);
  if (withBounce)
  {
    static_assert(OcclusionBounce::Views == OcclusionLobes::Views, "the same views");
    std::vector<glm::dvec3> lambert;
    std::vector<glm::dvec3> albedos;
    for (const OcclusionLobes::Lobe& lobe : this->Lobes.GetLobes())
    {
      lambert.push_back(lobe.Lambert);
      albedos.push_back(lobe.Albedo);
    }
    this->Bounce = std::make_shared<OcclusionBounce>(lambert, albedos, MakeLight(environment, {}));
  }
  const auto panels = environment->GetParts().GetPanels(environment, rest, []() { return true; });
  for (std::size_t k = 0; panels && k < panels->GetPanels().size(); ++k)
  {
    this->Panels.push_back(panels->GetPanels()[k]);
    Subtract(this->Panels.back(), this->Light);
  }
}

sky::Colors OcclusionLight::GetLight(const glm::dmat3& toEnvironment, std::size_t tested) const
{
  sky::Colors light = this->Light;
  for (std::size_t k = tested; k < this->LampLight.size(); ++k)
  {
    const sky::Values values = sky::Evaluate(this->Lamps[k]);
    for (std::size_t j = 0; j < sky::Harmonics; ++j)
    {
      light[j] += values[j] * this->LampLight[k];
    }
  }
  return sky::Rotate(light, toEnvironment);
}

OcclusionLight::Hidden OcclusionLight::GetHidden(
  const HiddenSky& sky, const glm::dvec3& view, const glm::dmat3& toEnvironment) const
{
  const glm::dvec3 n = sky.GetNormal();
  const OcclusionLobes::Lobe lobe = this->Lobes.Get(glm::dot(n, view));
  const glm::dvec3 slope = lobe.GetSlope(n, view);
  const double kappa = glm::length(slope);
  const sky::Colors light = this->GetLight(toEnvironment);
  const glm::dvec3 irradiance = sky::GetIrradiance(light, n);
  Hidden hidden = { sky.GetHiddenIrradiance(light), glm::dvec3(0.0) };
  const glm::dvec3 share =
    sky.GetHiddenLight(sky.GetHiddenShare(slope), kappa, hidden.Irradiance, irradiance);
  // Radiance in the lobe: of the rest, then of panels, and of what the table has of lamps.
  glm::dvec3 all = glm::max(irradiance, glm::dvec3(1e-30)) / Pi;
  glm::dvec3 lost = share * all;
  for (const EnvironmentPanels::Panel& panel : this->Panels)
  {
    const glm::dvec3 d = glm::transpose(toEnvironment) * panel.Direction;
    const double radius = GetPanelRadius(panel);
    const double z = glm::dot(d, n);
    const double rise = std::max(z + radius, 0.0);
    const double cosine = z > radius ? z : rise * rise / (4.0 * radius);
    const double part = sky.GetHiddenPanel(d, radius);
    hidden.Irradiance += part * cosine * panel.Irradiance;
    // The mean of exp(slope . d) over a concentrated von Mises-Fisher lobe.
    const double both = std::max(glm::length(slope + panel.Concentration * d), 1e-3);
    const double mean = panel.Concentration / both * std::exp(both - panel.Concentration - kappa);
    const glm::dvec3 inLobe = panel.Irradiance * (cosine * mean / lobe.Integral);
    // The middle of both lobes' product.
    const double up = (glm::dot(slope, n) + panel.Concentration * z) / both - z;
    all += inLobe;
    // One standard deviation of the product, for lobes may be sharper than kappa says.
    lost += sky.GetHiddenPanel(d, radius, std::sqrt(1.0 / both), up) * inLobe;
  }
  const LampWindow window;
  const glm::dvec3 axis = lobe.GetAxis(n, view);
  for (std::size_t k = 0; k < std::min(this->LampLight.size(), MaximumLamps); ++k)
  {
    const glm::dvec3 d = glm::transpose(toEnvironment) * this->Lamps[k];
    const double part = 1.0 - sky.GetVisibleLamp(d);
    hidden.Irradiance += part * std::max(glm::dot(d, n), 0.0) * this->LampLight[k];
    const glm::dvec3 inTable =
      (1.0 - window.GetWeight(d, axis)) * lobe.GetShine(n, slope, d) * this->LampLight[k];
    all += inTable;
    lost += part * inTable;
  }
  hidden.Lobe = lost / all;
  return hidden;
}

double GetPanelRadius(const EnvironmentPanels::Panel& panel)
{
  return std::sqrt(3.0 / panel.Concentration);
}

glm::mat4 GetIrradianceForm(const sky::Colors& light, int channel)
{
  const auto a = [&](int j) { return light[static_cast<std::size_t>(j)][channel]; };
  // The polynomials of sky::Evaluate up to degree 2, times what each degree makes of irradiance.
  const double c0 = Pi * 0.282094791773878140;
  const double c1 = 2.0 * Pi / 3.0 * 0.488602511902919920;
  const double c2 = Pi / 4.0 * 1.092548430592079200;
  const double c20 = Pi / 4.0 * 0.946174695757560080;
  const double c22 = Pi / 4.0 * 0.546274215296039590;
  glm::dmat4 form(0.0);
  form[0][0] = c22 * a(8);
  form[1][1] = -c22 * a(8);
  form[2][2] = c20 * a(6);
  form[3][3] = c0 * a(0) - c20 / 3.0 * a(6);
  form[0][1] = form[1][0] = c22 * a(4);
  form[1][2] = form[2][1] = -0.5 * c2 * a(5);
  form[0][2] = form[2][0] = -0.5 * c2 * a(7);
  form[1][3] = form[3][1] = -0.5 * c1 * a(1);
  form[2][3] = form[3][2] = 0.5 * c1 * a(2);
  form[0][3] = form[3][0] = -0.5 * c1 * a(3);
  return glm::mat4(form);
}
} // namespace measuredbrdf
