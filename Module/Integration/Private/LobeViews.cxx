// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeViews.h"

#include "HalfTurn.h"
#include "HalfVector.h" // for Pi
#include "LobeQuadrature.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int ViewCells = 512; // of a view's quadrature
constexpr int QuickViewCells = 128;

constexpr double KnotPower = 1.5;   // 1: evenly spaced
constexpr double FastestAxis = 1.5; // times the view's angle; mirror directions: 1
}

double LobeViews::GetLastAngle() { return std::acos(MinimumViewCosine); }

double LobeViews::GetAngle(int index, int count)
{
  const double t = 1.0 - static_cast<double>(index) / (count - 1);
  return GetLastAngle() * (1.0 - t * t);
}

double LobeViews::GetPosition(double angle)
{
  return (NumberOfViews - 1) * (1.0 - std::sqrt(std::max(1.0 - angle / GetLastAngle(), 0.0)));
}

double LobeViews::GetKnotAngle(int k, int count)
{
  const double t = 1.0 - static_cast<double>(k) / (count - 1);
  return GetLastAngle() * (1.0 - std::pow(t, KnotPower));
}

double LobeViews::GetKnotPosition(double angle, int count)
{
  const double t = std::clamp(1.0 - angle / GetLastAngle(), 0.0, 1.0);
  return (count - 1) * (1.0 - std::pow(t, 1.0 / KnotPower));
}

const std::atomic<bool> LobeViews::Never{ false };

LobeViews::LobeViews(vtkBRDF* brdf, const std::atomic<bool>& abort, bool quick)
  : Views(NumberOfViews)
{
  measuredbrdf::ParallelForEach(
    NumberOfViews,
    [&](int k)
    {
      const double theta = GetAngle(k);
      const LobeQuadrature quadrature(brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)),
        quick ? QuickViewCells : ViewCells);
      View& view = this->Views[k];
      view.Means = LobeMeans(quadrature);
      for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
      {
        view.Cells.push_back(
          { LobeQuadrature::GetEnergy(cell, view.Means.Floor), cell.SolidAngle });
      }
    },
    &abort);
  this->LimitAxes();
}

// To the middle between the least function above and the largest below that are never steeper.
void LobeViews::LimitAxes()
{
  std::vector<double> limited;
  for (int k = 0; k < NumberOfViews; ++k)
  {
    double above = HUGE_VAL;
    double below = -HUGE_VAL;
    for (int other = 0; other < NumberOfViews; ++other)
    {
      const double delta = this->Views[other].Means.Delta;
      const double reach = FastestAxis * std::abs(GetAngle(k) - GetAngle(other));
      above = std::min(above, delta + reach);
      below = std::max(below, delta - reach);
    }
    const double farthest = FastestAxis * GetAngle(k); // seen along the normal it is the normal
    limited.push_back(std::clamp(0.5 * (above + below), -farthest, farthest));
  }
  for (std::size_t k = 0; k < limited.size(); ++k)
  {
    this->Views[k].Means.Delta = limited[k];
  }
}

double LobeViews::GetAxis(double theta) const
{
  const double exact = GetPosition(theta);
  const int low = std::min(static_cast<int>(exact), NumberOfViews - 2);
  const double below = this->Views[low].Means.Delta;
  const double above = this->Views[static_cast<std::size_t>(low) + 1].Means.Delta;
  return below + (exact - low) * (above - below);
}

double LobeViews::GetSharpShare(double solidAngle, double farthest) const
{
  double largest = 0.0;
  for (int k = 0; k < NumberOfViews && GetAngle(k) <= farthest; ++k)
  {
    const View& view = this->Views[k];
    double energy = 0.0;
    for (const Cell& cell : view.Cells)
    {
      energy += cell.Energy;
    }
    double above = 0.0;
    for (const Cell& cell : view.Cells)
    {
      above += std::max(cell.Energy - energy / solidAngle * cell.SolidAngle, 0.0);
    }
    if (!view.Cells.empty() && view.Means.Albedo > 0.0)
    {
      largest = std::max(largest, above / view.Means.Albedo);
    }
  }
  return largest;
}

namespace
{
constexpr int AnisotropicViewCells = 256; // of a view's quadrature
}

glm::dvec3 AnisotropicViews::GetView(double theta, double phi)
{
  const double s = std::sin(theta);
  return glm::dvec3(s * std::cos(phi), s * std::sin(phi), std::cos(theta));
}

double AnisotropicViews::GetAngle(int index) { return LobeViews::GetAngle(index, Angles); }

double AnisotropicViews::GetAzimuth(int index, int count) const
{
  return 2.0 * Pi * index / (this->Periods * count);
}

const LobeMeans& AnisotropicViews::Get(int angle, int azimuth) const
{
  return this->Means[azimuth * Angles + angle];
}

AnisotropicViews::AnisotropicViews(vtkBRDF* brdf, const std::atomic<bool>& abort)
  : Periods(IsSameAfterHalfATurn(brdf) ? 2 : 1)
  , Means(static_cast<std::size_t>(Angles * Azimuths))
{
  measuredbrdf::ParallelForEach(
    this->Means.size(),
    [&](std::size_t k)
    {
      const int index = static_cast<int>(k);
      this->Means[k] = LobeMeans(LobeQuadrature(brdf,
        GetView(GetAngle(index % Angles), this->GetAzimuth(index / Angles)), AnisotropicViewCells));
    },
    &abort);
}
} // namespace measuredbrdf
