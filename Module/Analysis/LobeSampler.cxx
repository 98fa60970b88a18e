// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeSampler.h"

#include "HalfVector.h"
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
}

glm::dvec3 LobeSampler::Sample(const glm::dvec2& u, double& density) const
{
  std::size_t polar = 0, azimuth = 0;
  double ru = 0.0, rv = 0.0;
  this->Cells.Invert(u.x, u.y, polar, azimuth, ru, rv);
  const int p = static_cast<int>(polar);
  const glm::dvec3 h = GetHalfVector(GetCosine(p) + (GetCosine(p + 1) - GetCosine(p)) * ru,
    (static_cast<double>(azimuth) + rv) / Azimuths);
  density = this->Cells.GetProbability(polar, azimuth) /
            (GetSolidAngle(p) * 4.0 * std::max(glm::dot(this->View, h), 1e-9));
  return ReflectAbout(this->View, h);
}
} // namespace measuredbrdf
