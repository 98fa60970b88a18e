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

double GetCosine(int boundary)
{
  return std::cos(UnitToThetaH(static_cast<double>(boundary) / Polars));
}

double GetSolidAngle(int polar)
{
  return (GetCosine(polar) - GetCosine(polar + 1)) * 2.0 * Pi / Azimuths;
}

glm::dvec3 GetHalfVector(double cosine, double azimuth)
{
  const double s = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  return glm::dvec3(s * std::cos(2.0 * Pi * azimuth), s * std::sin(2.0 * Pi * azimuth), cosine);
}
}

LobeSampler::LobeSampler(vtkBRDF* brdf, const glm::dvec3& o)
  : View(o)
  , Retro(o)
{
  std::vector<double> masses(static_cast<std::size_t>(Polars * Azimuths), 0.0);
  for (int azimuth = 0; azimuth < Azimuths; ++azimuth)
  {
    for (int polar = 0; polar < Polars; ++polar)
    {
      const double theta = UnitToThetaH((polar + 0.5) / Polars);
      const glm::dvec3 h = GetHalfVector(std::cos(theta), (azimuth + 0.5) / Azimuths);
      const glm::dvec3 i = ReflectAbout(o, h);
      if (i.z > 0.0)
      {
        glm::dvec3 f;
        brdf->Evaluate(&i.x, &o.x, &f.x);
        masses[static_cast<std::size_t>(azimuth * Polars + polar)] =
          (f.x + f.y + f.z) * i.z * 4.0 * std::max(glm::dot(o, h), 0.0) * GetSolidAngle(polar);
      }
    }
  }
  this->Cells = Distribution2D(masses, Polars, Azimuths);

  // A lobe about the view is missed where it is far above what its cell's centre shows.
  const auto evaluate = [brdf, &o](const glm::dvec3& i)
  {
    glm::dvec3 f;
    brdf->Evaluate(&i.x, &o.x, &f.x);
    return (f.x + f.y + f.z) * std::max(i.z, 0.0);
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
