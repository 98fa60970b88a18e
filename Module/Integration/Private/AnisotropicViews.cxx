// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnisotropicViews.h"

#include "HalfTurn.h"
#include "HalfVector.h" // for Pi
#include "LobeQuadrature.h"
#include "LobeViews.h"
#include "ParallelFor.h"
#include "vtkBRDF.h"

#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int ViewCells = 256; // of a view's quadrature
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
  return this->Means[static_cast<std::size_t>(azimuth * Angles + angle)];
}

AnisotropicViews::AnisotropicViews(vtkBRDF* brdf, const std::atomic<bool>& abort)
  : Periods(IsSameAfterHalfATurn(brdf) ? 2 : 1)
  , Means(static_cast<std::size_t>(Angles * Azimuths))
{
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(this->Means.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end && !abort; ++k)
      {
        const int index = static_cast<int>(k);
        this->Means[static_cast<std::size_t>(k)] = LobeMeans(LobeQuadrature(
          brdf, GetView(GetAngle(index % Angles), this->GetAzimuth(index / Angles)), ViewCells));
      }
    });
}
} // namespace measuredbrdf
