// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionLobes.h"

#include "HalfVector.h" // for Pi
#include "HiddenSky.h"
#include "LobeMeans.h"
#include "LobeQuadrature.h"
#include "LocalFrame.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int Cells = 512; // of a view's quadrature
constexpr int Steps = 30;  // of Newton's method, at most
constexpr double Enough = 1e-4;
const double LastView = std::acos(MinimumViewCosine);

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
    p = Limit(p + step, HiddenSky::LargestKappa);
    if (glm::length(step) < Enough)
    {
      break;
    }
  }
  return p;
}
}

OcclusionLobes::OcclusionLobes(vtkBRDF* brdf, bool withFloor)
{
  brdf->Prepare();
  glm::dvec2 p(0.0, 2.0);
  for (std::size_t k = 0; k < Views; ++k)
  {
    const double theta = LastView * static_cast<double>(k) / (Views - 1);
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
    Lobe& lobe = this->Lobes[k];
    lobe.Across = p.x;
    lobe.Along = p.y;
    lobe.Integral = Moments(quadrature, p).Integral;
    lobe.Delta = means.Delta;
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
  return { glm::mix(a.Across, b.Across, t), glm::mix(a.Along, b.Along, t),
    glm::mix(a.Integral, b.Integral, t), glm::mix(a.Delta, b.Delta, t),
    glm::mix(a.Lambert, b.Lambert, t), glm::mix(a.Albedo, b.Albedo, t) };
}

glm::dvec3 OcclusionLobes::Lobe::GetSlope(const glm::dvec3& normal, const glm::dvec3& view) const
{
  const glm::dvec3 rest = view - glm::dot(normal, view) * normal;
  return this->Along * normal - this->Across / std::max(glm::length(rest), 1e-6) * rest;
}

glm::dvec3 OcclusionLobes::Lobe::GetAxis(const glm::dvec3& normal, const glm::dvec3& view) const
{
  const glm::dvec3 rest = view - glm::dot(normal, view) * normal;
  return std::cos(this->Delta) * normal -
         std::sin(this->Delta) / std::max(glm::length(rest), 1e-6) * rest;
}

double OcclusionLobes::Lobe::GetShine(
  const glm::dvec3& normal, const glm::dvec3& slope, const glm::dvec3& lamp) const
{
  return std::max(glm::dot(lamp, normal), 0.0) *
         std::exp(glm::dot(slope, lamp) - glm::length(slope)) / this->Integral;
}
} // namespace measuredbrdf
