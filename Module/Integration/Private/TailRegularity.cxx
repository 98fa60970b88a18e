// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TailRegularity.h"

#include "HalfVector.h"     // for Pi
#include "LowDiscrepancy.h" // for GoldenRatio
#include "vtkBRDF.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr int Views = 8;
constexpr int Directions = 24;
constexpr double Step = 3.75 * Pi / 180.0;    // half of a step of 13 view angles
constexpr double Nearest = 12.0 * Pi / 180.0; // to the mirror direction
constexpr double Farthest = 80.0 * Pi / 180.0;

// A direction given by its angle from the mirror direction of the view, and its azimuth about that.
glm::dvec3 GetDirection(double view, double angle, double azimuth)
{
  const double s = std::sin(view);
  const double c = std::cos(view);
  return std::sin(angle) *
           (std::cos(azimuth) * glm::dvec3(c, 0.0, s) + glm::dvec3(0.0, std::sin(azimuth), 0.0)) +
         std::cos(angle) * glm::dvec3(-s, 0.0, c);
}

double GetKernel(vtkBRDF* brdf, double view, const glm::dvec3& i)
{
  const glm::dvec3 o(std::sin(view), 0.0, std::cos(view));
  glm::dvec3 f;
  brdf->Evaluate(&i.x, &o.x, &f.x);
  const double sum = f.x + f.y + f.z;
  return std::isfinite(sum) ? sum * i.z : 0.0;
}
}

double GetTailIrregularity(vtkBRDF* brdf)
{
  brdf->Prepare();
  double difference = 0.0;
  double total = 0.0;
  for (int v = 0; v < Views; ++v)
  {
    const double view = Step * (1 + 2 * v);
    for (int k = 0; k < Directions; ++k)
    {
      const double t = (k + 0.5) / Directions; // equal solid angles
      const double angle =
        std::acos(std::cos(Nearest) + t * (std::cos(Farthest) - std::cos(Nearest)));
      const double azimuth = 2.0 * Pi * GoldenRatio * (k + 1 + v * Directions);
      const glm::dvec3 i = GetDirection(view, angle, azimuth);
      double mean = 0.0;
      bool isAbove = i.z > 0.0;
      for (const double side : { view - Step, view + Step })
      {
        for (const double turn : { azimuth, -azimuth })
        {
          const glm::dvec3 neighbor = GetDirection(side, angle, turn);
          isAbove = isAbove && neighbor.z > 0.0;
          mean += isAbove ? 0.25 * GetKernel(brdf, side, neighbor) : 0.0;
        }
      }
      if (isAbove)
      {
        const double kernel = GetKernel(brdf, view, i);
        difference += std::abs(kernel - mean);
        total += std::max(kernel, mean);
      }
    }
  }
  return total > 0.0 ? difference / total : 0.0;
}
} // namespace measuredbrdf
