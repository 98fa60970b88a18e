// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeSampler.h"

#include "HalfVector.h"
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr int Polars = 128; // cells over theta_h, denser towards the normal
constexpr int Azimuths = 64;
constexpr int RetroDraws = 256; // that tell how much lies about the view

constexpr int NumberOfCells = Polars * Azimuths;

// The cells' middles, azimuth by azimuth, which are the same for all samplers.
const std::vector<glm::dvec3>& GetMiddles()
{
  static const auto& known = *new std::vector<glm::dvec3>( // threads may use it until the very end
    []()
    {
      std::vector<glm::dvec3> middles;
      for (int cell = 0; cell < NumberOfCells; ++cell)
      {
        const double theta = UnitToThetaH((cell % Polars + 0.5) / Polars);
        const double phi = 2.0 * Pi * (cell / Polars + 0.5) / Azimuths;
        const double s = std::sin(theta);
        middles.emplace_back(s * std::cos(phi), s * std::sin(phi), std::cos(theta));
      }
      return middles;
    }());
  return known;
}

double GetSum(vtkBRDF* brdf, const glm::dvec3& i, const glm::dvec3& o)
{
  glm::dvec3 f;
  brdf->Evaluate(&i.x, &o.x, &f.x);
  return f.x + f.y + f.z;
}
}

LobeSampler::LobeSampler(vtkBRDF* brdf, const glm::dvec3& o, double floor)
  : View(o)
  , Retro(o)
{
  std::vector<double> weights(NumberOfCells, 0.0); // densities per solid angle of half vectors
  for (int cell = 0; cell < NumberOfCells; ++cell)
  {
    const glm::dvec3& h = GetMiddles()[cell];
    const glm::dvec3 i = ReflectAbout(o, h);
    weights[cell] =
      i.z > 0.0 ? GetSum(brdf, i, o) * i.z * 4.0 * std::max(glm::dot(o, h), 0.0) : 0.0;
  }
  this->Cells.emplace(weights, Polars, Azimuths, 1.0);
  this->Limit = floor * this->Cells->GetTotal();
  if (this->Limit > 0.0)
  {
    for (int cell = 0; cell < NumberOfCells; ++cell)
    {
      weights[cell] *= this->GetSharpShare(
        weights[cell] / (4.0 * std::max(glm::dot(o, GetMiddles()[cell]), 1e-9)));
    }
    this->Cells.emplace(weights, Polars, Azimuths, 1.0);
  }

  // A lobe about the view is missed where it is far above what its cell's center shows.
  const auto evaluate = [this, brdf, &o](const glm::dvec3& i)
  {
    const double value = GetSum(brdf, i, o) * std::max(i.z, 0.0);
    return value * this->GetSharpShare(value);
  };
  const double total = this->Cells->GetTotal();
  const auto getDensity = [this, total](const glm::dvec3& i)
  { return std::max(total * this->GetCellDensity(i) / 3.0, i.z / Pi); };
  if (this->Retro.IsMissed(evaluate, getDensity))
  {
    double missed = 0.0;
    for (int k = 0; k < RetroDraws; ++k)
    {
      const glm::dvec3 i = this->Retro.Sample(
        { (k + 0.5) / RetroDraws, RadicalInverse(static_cast<unsigned int>(k), 2) });
      const double rest = evaluate(i) - total * this->GetCellDensity(i);
      missed += std::max(rest, 0.0) / (RetroDraws * this->Retro.GetDensity(i));
    }
    this->RetroShare = missed / (missed + total);
  }
}

// In 1/sr, where any is drawn from the cells.
double LobeSampler::GetCellDensity(const glm::dvec3& i) const
{
  return this->Cells->GetTotal() > 0.0 ? this->Cells->Pdf(i, this->View) : 0.0;
}

glm::dvec3 LobeSampler::Sample(const glm::dvec2& u, double& density) const
{
  const double share = this->RetroShare;
  glm::dvec3 i;
  if (u.x < share)
  {
    i = this->Retro.Sample({ u.x / share, u.y });
  }
  else
  {
    this->Cells->Sample(this->View, (u.x - share) / (1.0 - share), u.y, i);
  }
  density = share * this->Retro.GetDensity(i) + (1.0 - share) * this->GetCellDensity(i);
  return i;
}
} // namespace measuredbrdf
