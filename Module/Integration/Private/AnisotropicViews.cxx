// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnisotropicViews.h"

#include "HalfVector.h" // for Pi
#include "LobeQuadrature.h"
#include "LobeViews.h"
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"
#include "vtkSMPTools.h"

#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int Cells = 256;  // of a view's quadrature
constexpr int Probes = 128; // pairs that tell whether f repeats itself
constexpr double LargestDifference = 1e-4;

glm::dvec3 ToDirection(double z, double turn)
{
  const double s = std::sqrt(1.0 - z * z);
  return glm::dvec3(s * std::cos(2.0 * Pi * turn), s * std::sin(2.0 * Pi * turn), z);
}

// Brushed metal is the same after half a turn; cloth with a nap is not.
bool IsSameAfterHalfATurn(vtkBRDF* brdf)
{
  const glm::dvec3 turn(-1.0, -1.0, 1.0);
  double difference = 0.0;
  for (unsigned int k = 1; k <= Probes; ++k)
  {
    const glm::dvec3 o = ToDirection(RadicalInverse(k, 2), RadicalInverse(k, 3));
    glm::dvec3 i = ToDirection(RadicalInverse(k, 5), RadicalInverse(k, 7));
    if (k % 2 == 0) // about the mirror direction, where a lobe is
    {
      i = glm::normalize(glm::dvec3(-o.x, -o.y, o.z) + 0.3 * i);
    }
    const glm::dvec3 turnedI = i * turn, turnedO = o * turn;
    glm::dvec3 f, turned;
    brdf->Evaluate(&i.x, &o.x, &f.x);
    brdf->Evaluate(&turnedI.x, &turnedO.x, &turned.x);
    // Relative, so that a bright lobe does not hide what is dim.
    const glm::dvec3 d = glm::abs(f - turned);
    const double both = f.x + f.y + f.z + turned.x + turned.y + turned.z;
    difference += both > 0.0 ? (d.x + d.y + d.z) / both : 0.0;
  }
  return difference <= LargestDifference * Probes;
}
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
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Means.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end && !abort; ++k)
      {
        const int index = static_cast<int>(k);
        this->Means[static_cast<std::size_t>(k)] = LobeMeans(LobeQuadrature(
          brdf, GetView(GetAngle(index % Angles), this->GetAzimuth(index / Angles)), Cells));
      }
    });
}
} // namespace measuredbrdf
