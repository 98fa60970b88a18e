// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeSampler.h"

#include "HalfVector.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
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
constexpr int TableViews = 48;

glm::dvec3 GetHalfVector(double cosine, double azimuth)
{
  const double s = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  return glm::dvec3(s * std::cos(2.0 * Pi * azimuth), s * std::sin(2.0 * Pi * azimuth), cosine);
}

// The cells, azimuth by azimuth, which are the same for all samplers.
struct Grid
{
  Grid()
  {
    for (int k = 0; k <= Polars; ++k)
    {
      this->Cosines[k] = std::cos(UnitToThetaH(static_cast<double>(k) / Polars));
    }
    for (int azimuth = 0; azimuth < Azimuths; ++azimuth)
    {
      for (int polar = 0; polar < Polars; ++polar)
      {
        this->Middles[azimuth * Polars + polar] =
          GetHalfVector(std::cos(UnitToThetaH((polar + 0.5) / Polars)), (azimuth + 0.5) / Azimuths);
      }
    }
  }
  double Cosines[Polars + 1]; // of the boundaries
  glm::dvec3 Middles[NumberOfCells];
};

const Grid& GetGrid()
{
  static const Grid& grid = *new Grid; // threads may use it until the very end
  return grid;
}

double GetCosine(int boundary) { return GetGrid().Cosines[boundary]; }

double GetSolidAngle(int polar)
{
  return (GetCosine(polar) - GetCosine(polar + 1)) * 2.0 * Pi / Azimuths;
}

double GetSum(vtkBRDF* brdf, const glm::dvec3& i, const glm::dvec3& o)
{
  glm::dvec3 f;
  brdf->Evaluate(&i.x, &o.x, &f.x);
  return f.x + f.y + f.z;
}

// Tabulated views are denser towards the horizon, where f changes fast.
double GetTableTheta(int view)
{
  const double rest = 1.0 - (view + 0.5) / TableViews;
  return 0.5 * Pi * (1.0 - rest * rest);
}
}

LobeTable::LobeTable(vtkBRDF* brdf)
  : Values(static_cast<std::size_t>(TableViews * NumberOfCells), 0.0f)
{
  measuredbrdf::ParallelFor(0, TableViews, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType view = begin; view < end; ++view)
      {
        const double theta = GetTableTheta(static_cast<int>(view));
        const glm::dvec3 o(std::sin(theta), 0.0, std::cos(theta));
        float* values = &this->Values[static_cast<std::size_t>(view * NumberOfCells)];
        for (int cell = 0; cell < NumberOfCells; ++cell)
        {
          const glm::dvec3 i = ReflectAbout(o, GetGrid().Middles[cell]);
          values[cell] = i.z > 0.0 ? static_cast<float>(GetSum(brdf, i, o)) : 0.0f;
        }
      }
    });
}

void LobeTable::Read(const glm::dvec3& o, std::vector<double>& f) const
{
  const double theta = std::atan2(o.x, o.z);
  const double at = TableViews * (1.0 - std::sqrt(std::max(1.0 - theta / (0.5 * Pi), 0.0))) - 0.5;
  const int low = std::clamp(static_cast<int>(std::floor(at)), 0, TableViews - 1);
  const int high = std::clamp(static_cast<int>(std::floor(at)) + 1, 0, TableViews - 1);
  const float* first = &this->Values[static_cast<std::size_t>(low * NumberOfCells)];
  const float* second = &this->Values[static_cast<std::size_t>(high * NumberOfCells)];
  for (std::size_t cell = 0; cell < static_cast<std::size_t>(NumberOfCells); ++cell)
  {
    f[cell] = std::max(first[cell], second[cell]);
  }
}

LobeSampler::LobeSampler(vtkBRDF* brdf, const glm::dvec3& o, const LobeTable* table, double floor)
  : View(o)
  , Retro(o)
{
  std::vector<double> masses(static_cast<std::size_t>(NumberOfCells), 0.0);
  if (table)
  {
    table->Read(o, masses);
  }
  for (int cell = 0; cell < NumberOfCells; ++cell)
  {
    double& mass = masses[static_cast<std::size_t>(cell)];
    const glm::dvec3& h = GetGrid().Middles[cell];
    const glm::dvec3 i = ReflectAbout(o, h);
    const double f = !(i.z > 0.0) ? 0.0 : table ? mass : GetSum(brdf, i, o);
    mass = f * i.z * 4.0 * std::max(glm::dot(o, h), 0.0) * GetSolidAngle(cell % Polars);
  }
  this->Cells = Distribution2D(masses, Polars, Azimuths);
  this->Limit = floor * this->Cells.GetTotal();
  if (this->Limit > 0.0)
  {
    for (int cell = 0; cell < NumberOfCells; ++cell)
    {
      double& mass = masses[static_cast<std::size_t>(cell)];
      mass *=
        this->GetSharpShare(mass / (4.0 * std::max(glm::dot(o, GetGrid().Middles[cell]), 1e-9) *
                                     GetSolidAngle(cell % Polars)));
    }
    this->Cells = Distribution2D(masses, Polars, Azimuths);
  }

  // A lobe about the view is missed where it is far above what its cell's center shows.
  const auto evaluate = [this, brdf, &o](const glm::dvec3& i)
  {
    const double value = GetSum(brdf, i, o) * std::max(i.z, 0.0);
    return value * this->GetSharpShare(value);
  };
  const double total = this->Cells.GetTotal();
  const auto getDensity = [this, total](const glm::dvec3& i)
  { return std::max(total * this->GetCellDensity(HalfVector(i, this->View)) / 3.0, i.z / Pi); };
  if (this->Retro.IsMissed(evaluate, getDensity))
  {
    double missed = 0.0;
    for (int k = 0; k < RetroDraws; ++k)
    {
      const glm::dvec3 i = this->Retro.Sample(
        { (k + 0.5) / RetroDraws, RadicalInverse(static_cast<unsigned int>(k), 2) });
      const double rest = evaluate(i) - total * this->GetCellDensity(HalfVector(i, o));
      missed += std::max(rest, 0.0) / (RetroDraws * this->Retro.GetDensity(i));
    }
    this->RetroShare = missed / (missed + total);
  }
}

// Density of i for a half vector drawn from the cells, in 1/sr.
double LobeSampler::GetCellDensity(const glm::dvec3& h) const
{
  const double theta = std::atan2(std::hypot(h.x, h.y), h.z);
  const int polar = std::min(static_cast<int>(ThetaHToUnit(theta) * Polars), Polars - 1);
  const double azimuth = Wrap01(std::atan2(h.y, h.x) / (2.0 * Pi));
  return this->Cells.IsZero()
           ? 0.0
           : this->Cells.GetProbability(static_cast<std::size_t>(polar),
               static_cast<std::size_t>(
                 std::min(static_cast<int>(azimuth * Azimuths), Azimuths - 1))) /
               (GetSolidAngle(polar) * 4.0 * std::max(glm::dot(this->View, h), 1e-9));
}

glm::dvec3 LobeSampler::Sample(const glm::dvec2& u, double& density) const
{
  const double share = this->RetroShare;
  glm::dvec3 h, i;
  if (u.x < share)
  {
    i = this->Retro.Sample({ u.x / share, u.y });
    h = HalfVector(i, this->View);
  }
  else
  {
    std::size_t polar = 0, azimuth = 0;
    double ru = 0.0, rv = 0.0;
    this->Cells.Invert((u.x - share) / (1.0 - share), u.y, polar, azimuth, ru, rv);
    const int p = static_cast<int>(polar);
    h = GetHalfVector(GetCosine(p) + (GetCosine(p + 1) - GetCosine(p)) * ru,
      (static_cast<double>(azimuth) + rv) / Azimuths);
    i = ReflectAbout(this->View, h);
    if (!(share > 0.0))
    {
      density = this->Cells.GetProbability(polar, azimuth) /
                (GetSolidAngle(p) * 4.0 * std::max(glm::dot(this->View, h), 1e-9));
      return i;
    }
  }
  density = share * this->Retro.GetDensity(i) + (1.0 - share) * this->GetCellDensity(h);
  return i;
}
} // namespace measuredbrdf
