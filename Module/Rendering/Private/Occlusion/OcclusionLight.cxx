// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionLight.h"

#include "EnvironmentPrecomputation.h"
#include "HalfVector.h" // for Pi
#include "HorizonCode.h"
#include "LobeViews.h"
#include "LocalFrame.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
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
constexpr int Cells = 512; // of a view's quadrature
constexpr int Steps = 30;  // of Newton's method, at most
constexpr double Enough = 1e-4;

// Of the view that a lobe is for.
double GetViewAngle(std::size_t k)
{
  return std::acos(MinimumViewCosine) * static_cast<double>(k) / (OcclusionViews - 1);
}

// In the plane of the view: across is away from it.
glm::dvec2 Project(const glm::dvec3& d) { return { -d.x, d.z }; }

glm::dvec2 Limit(const glm::dvec2& p, double most)
{
  const double length = glm::length(p);
  return length > most ? p * (most / length) : p;
}

// cos(theta) exp(p . d - |p|): its integral, mean direction, and covariance.
struct Moments
{
  double Integral = 0.0;
  glm::dvec2 Mean = glm::dvec2(0.0);
  glm::dmat2 Covariance = glm::dmat2(0.0);

  Moments(const LobeQuadrature& quadrature, const glm::dvec2& p)
  {
    const double kappa = glm::length(p);
    for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
    {
      const glm::dvec2 d = Project(cell.Direction);
      const double part = cell.Cosine * std::exp(glm::dot(p, d) - kappa);
      this->Integral += part;
      this->Mean += part * d;
      this->Covariance += part * glm::outerProduct(d, d);
    }
    const double all = std::max(this->Integral, 1e-30);
    this->Mean /= all;
    this->Covariance = this->Covariance / all - glm::outerProduct(this->Mean, this->Mean);
  }
};

// The p that has this mean direction, from another on: Newton's method, whose steps are no longer
// than p allows.
glm::dvec2 Fit(const LobeQuadrature& quadrature, const glm::dvec2& mean, glm::dvec2 p)
{
  for (int k = 0; k < Steps; ++k)
  {
    const Moments moments(quadrature, p);
    const glm::dmat2 regular = moments.Covariance + glm::dmat2(1e-6);
    const glm::dvec2 step =
      Limit(glm::inverse(regular) * (mean - moments.Mean), 0.5 * (1.0 + glm::length(p)));
    p = Limit(p + step, HorizonCode::LargestKappa);
    if (glm::length(step) < Enough)
    {
      break;
    }
  }
  return p;
}

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
        colors[middle + m][c] = scale * a.real();
        if (m > 0)
        {
          colors[middle - m][c] = -scale * a.imag();
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

// The mean of directional albedos, views weighted by their cosine and solid angle.
glm::dvec3 GetAlbedo(const OcclusionLobes& lobes)
{
  glm::dvec3 sum(0.0);
  double all = 0.0;
  for (std::size_t k = 0; k < lobes.size(); ++k)
  {
    const double weight = std::sin(2.0 * GetViewAngle(k));
    sum += weight * (Pi * lobes[k].Lambert + lobes[k].Albedo);
    all += weight;
  }
  return glm::clamp(sum / all, 0.0, 1.0);
}
}

OcclusionLobes FindOcclusionLobes(vtkBRDF* brdf, bool withFloor)
{
  OcclusionLobes lobes;
  brdf->Prepare();
  glm::dvec2 p(0.0, 2.0);
  for (std::size_t k = 0; k < lobes.size(); ++k)
  {
    const double theta = GetViewAngle(k);
    const LobeQuadrature quadrature(brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), Cells);
    const LobeMeans means(quadrature);
    const glm::dvec3 floor = withFloor ? glm::dvec3(0.0) : means.Floor;
    glm::dvec2 mean(0.0);
    double all = 0.0;
    for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
    {
      const double energy = LobeQuadrature::GetEnergy(cell, floor);
      all += energy;
      mean += energy * Project(cell.Direction);
    }
    p = all > 0.0 ? Fit(quadrature, mean / all, p) : p;
    OcclusionLobe& lobe = lobes[k];
    lobe.Across = p.x;
    lobe.Along = p.y;
    lobe.Integral = Moments(quadrature, p).Integral;
    lobe.Delta = means.Delta;
    lobe.Lambert = floor;
    lobe.Albedo = means.Amplitude + Pi * (means.Floor - floor);
  }
  return lobes;
}

OcclusionLight::OcclusionLight(
  vtkBRDF* brdf, vtkEnvironment* environment, vtkRadianceIntegrator* integrator, bool withBounce)
{
  auto* hybrid = vtkHybridRadianceIntegrator::SafeDownCast(integrator);
  this->IsSplit =
    brdf->IsIsotropic() && (hybrid || vtkTableRadianceIntegrator::SafeDownCast(integrator));
  this->Lobes = FindOcclusionLobes(brdf, !this->IsSplit);
  this->HasLobe = std::any_of(this->Lobes.begin(), this->Lobes.end(),
    [](const OcclusionLobe& lobe)
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
    this->Bounce = std::make_unique<OcclusionBounce>(
      OcclusionBounce{ GetAlbedo(this->Lobes), MakeLight(environment, {}) });
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

double GetPanelRadius(const EnvironmentPanels::Panel& panel)
{
  return std::sqrt(3.0 / panel.Concentration);
}
} // namespace measuredbrdf
