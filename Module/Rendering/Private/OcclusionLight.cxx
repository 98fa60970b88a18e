// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionLight.h"

#include "EnvironmentPrecomputation.h"
#include "HiddenSky.h"
#include "LobeMeans.h"
#include "LobeQuadrature.h"
#include "LocalFrame.h"
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
constexpr double Pi = 3.14159265358979323846;
constexpr int Cells = 512; // of a view's quadrature
const double LastView = std::acos(MinimumViewCosine);

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
}

OcclusionLobes::OcclusionLobes(vtkBRDF* brdf, bool withFloor)
{
  brdf->Prepare();
  for (std::size_t k = 0; k < Views; ++k)
  {
    const double theta = LastView * static_cast<double>(k) / (Views - 1);
    const LobeQuadrature quadrature(brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), Cells);
    const LobeMeans means(quadrature);
    const glm::dvec3 floor = withFloor ? glm::dvec3(0.0) : means.Floor;
    glm::dvec3 axis(0.0);
    for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
    {
      const double energy = LobeQuadrature::GetEnergy(cell, floor);
      axis += cell.Direction * (withFloor ? energy : energy * energy / cell.SolidAngle);
    }
    const double length = glm::length(axis);
    axis = length > 0.0 ? axis / length : glm::dvec3(0.0, 0.0, 1.0);
    double energy = 0.0;
    double along = 0.0;
    for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
    {
      const double part = LobeQuadrature::GetEnergy(cell, floor);
      energy += part;
      along += part * glm::dot(cell.Direction, axis);
    }
    // Concentration of the von Mises-Fisher lobe with this mean cosine (Banerjee et al. 2005).
    const double mean = energy > 0.0 ? std::clamp(along / energy, 0.0, 0.9999) : 0.0;
    const double s = std::hypot(axis.x, axis.z);
    Lobe& lobe = this->Lobes[k];
    lobe.Cosine = s > 0.0 ? axis.z / s : 1.0;
    lobe.Sine = s > 0.0 ? -axis.x / s : 0.0;
    lobe.Kappa = std::min(mean * (3.0 - mean * mean) / (1.0 - mean * mean),
      static_cast<double>(HiddenSky::LargestKappa));
    lobe.Lambert = floor;
    lobe.Albedo = means.Amplitude + Pi * (means.Floor - floor);
  }
}

OcclusionLobes::Lobe OcclusionLobes::Get(double cosine) const
{
  const double theta = std::acos(std::clamp(cosine, MinimumViewCosine, 1.0));
  const double at = theta / LastView * (Views - 1);
  const auto low = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(Views - 2));
  const double t = at - static_cast<double>(low);
  const Lobe& a = this->Lobes[low];
  const Lobe& b = this->Lobes[low + 1];
  return { a.Cosine + t * (b.Cosine - a.Cosine), a.Sine + t * (b.Sine - a.Sine),
    a.Kappa + t * (b.Kappa - a.Kappa), glm::mix(a.Lambert, b.Lambert, t),
    glm::mix(a.Albedo, b.Albedo, t) };
}

OcclusionLight::OcclusionLight(
  vtkBRDF* brdf, vtkEnvironment* environment, vtkRadianceIntegrator* integrator, bool withBounce)
{
  auto* hybrid = vtkHybridRadianceIntegrator::SafeDownCast(integrator);
  this->IsSplit =
    brdf->IsIsotropic() && (hybrid || vtkTableRadianceIntegrator::SafeDownCast(integrator) ||
                             vtkFactoredRadianceIntegrator::SafeDownCast(integrator));
  this->Lobes = OcclusionLobes(brdf, !this->IsSplit);
  EnvironmentPrecomputation::Rest rest;
  if (hybrid && this->IsSplit)
  {
    const auto lamps = environment->GetParts().GetLamps(environment,
      vtkMath::RadiansFromDegrees(hybrid->GetLightAngle()), hybrid->GetMaximumNumberOfLights(),
      []() { return true; });
    const auto count = static_cast<int>(lamps->Lights.size());
    if (!vtkHybridRadianceIntegrator::AreWindowed(brdf, count))
    {
      rest = lamps->Rest; // else E(n) holds what the lamps' Lambert part reflects
    }
    for (const ExtractedEmitters::Light& lamp : lamps->Lights)
    {
      this->Lamps.push_back(lamp.Direction);
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
