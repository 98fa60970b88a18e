// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReflectionGuide.h"

#include "ConcentricMap.h"
#include "HalfVector.h" // for Pi
#include "LobeSampler.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace measuredbrdf
{
namespace
{
constexpr std::uint32_t NumberOfDraws = 64;
constexpr int NumberOfViews = 256; // over theta_o

glm::dvec2 GetPoint(std::uint32_t k)
{
  return glm::dvec2((k + 0.5) / NumberOfDraws, RadicalInverse(k, 2));
}

double GetTheta(int view) { return 0.5 * Pi * (view + 0.5) / NumberOfViews; }

// Peaks: of every fourth view, over a square that the hemisphere fills by area.
constexpr int ViewsPerPeaks = 4;
constexpr int PeakSize = 64;
constexpr int PeakLevels = 6; // 64, 32, ..., 2
constexpr int PeakCellsOfView = 5460;
constexpr double PeakWidth = 2.50662827 / PeakSize; // of a first cell, in rad: of sqrt(2 Pi)

int GetLevelOffset(int level)
{
  int offset = 0;
  for (int k = 0; k < level; ++k)
  {
    offset += (PeakSize >> k) * (PeakSize >> k);
  }
  return offset;
}

// Within 1e-5 for 0 <= t <= 1: Abramowitz, Stegun 1964, 4.4.49.
double GetArcTangent(double t)
{
  const double s = t * t;
  return t * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));
}

// HemisphereToSquare to 1e-5, which sums call at each step, to [0,1]^2.
glm::dvec2 ToPeakSquare(const glm::dvec3& d)
{
  const double r = std::sqrt(std::max(1.0 - d.z, 0.0));
  const double ax = std::abs(d.x);
  const double ay = std::abs(d.y);
  const double largest = std::max(ax, ay);
  const double a = largest > 0.0 ? r * GetArcTangent(std::min(ax, ay) / largest) * 4.0 / Pi : 0.0;
  const glm::dvec2 p = ax > ay ? glm::dvec2(r, a) : glm::dvec2(a, r);
  return glm::dvec2(std::copysign(p.x, d.x), std::copysign(p.y, d.y)) * 0.5 + 0.5;
}
}

ReflectionGuide::ReflectionGuide(vtkBRDF* brdf)
  : BRDF(brdf)
{
  if (!brdf->IsIsotropic())
  {
    return;
  }
  const LobeTable table(brdf);
  std::vector<std::vector<Draw>> views(NumberOfViews);
  measuredbrdf::ParallelFor(0, NumberOfViews,
    [&](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType view = first; view < last; ++view)
      {
        const double theta = GetTheta(static_cast<int>(view));
        const LobeSampler sampler(brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), &table);
        for (std::uint32_t k = 0; k < NumberOfDraws && !sampler.IsBlack(); ++k)
        {
          double density = 0.0;
          const glm::dvec3 i = sampler.Sample(GetPoint(k), density);
          if (i.z > 0.0 && density > 0.0)
          {
            views[static_cast<std::size_t>(view)].push_back({ i, 1.0 / (NumberOfDraws * density) });
          }
        }
      }
    });
  this->Views = std::move(views);
  this->TabulatePeaks();
}

void ReflectionGuide::TabulatePeaks()
{
  constexpr int views = NumberOfViews / ViewsPerPeaks;
  this->PeakCells.resize(static_cast<std::size_t>(views) * PeakCellsOfView);
  measuredbrdf::ParallelFor(0, views,
    [&](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType view = first; view < last; ++view)
      {
        const double theta = 0.5 * Pi * (static_cast<double>(view) + 0.5) / views;
        const double o[3] = { std::sin(theta), 0.0, std::cos(theta) };
        float* fine = &this->PeakCells[static_cast<std::size_t>(view) * PeakCellsOfView];
        for (int k = 0; k < PeakSize * PeakSize; ++k)
        {
          const glm::dvec3 i = SquareToHemisphere(
            (glm::dvec2(k % PeakSize, k / PeakSize) + 0.5) * (2.0 / PeakSize) - 1.0);
          glm::dvec3 f;
          this->BRDF->Evaluate(&i.x, o, &f.x);
          fine[k] = static_cast<float>(f.x + f.y + f.z);
        }
        for (int level = 1; level < PeakLevels; ++level)
        {
          const int size = PeakSize >> level;
          float* coarse = fine + 4 * size * size;
          for (int k = 0; k < size * size; ++k)
          {
            const float* from = fine + 2 * (k / size) * 2 * size + 2 * (k % size);
            coarse[k] =
              std::max(std::max(from[0], from[1]), std::max(from[2 * size], from[2 * size + 1]));
          }
          fine = coarse;
        }
      }
    });
}

ReflectionGuide::Peaks ReflectionGuide::GetPeaks(const glm::dvec3& o) const
{
  Peaks peaks;
  if (!this->PeakCells.empty())
  {
    constexpr int views = NumberOfViews / ViewsPerPeaks;
    const int view = static_cast<int>(std::acos(std::min(o.z, 1.0)) / (0.5 * Pi) * views);
    peaks.Cells =
      &this->PeakCells[static_cast<std::size_t>(std::clamp(view, 0, views - 1)) * PeakCellsOfView];
    const double s = std::hypot(o.x, o.y);
    peaks.Azimuth = s > 0.0 ? glm::dvec2(o.x, o.y) / s : glm::dvec2(1.0, 0.0);
  }
  return peaks;
}

double ReflectionGuide::Peaks::Get(const glm::dvec3& i, double radius, double& solidAngle) const
{
  constexpr double cell = 2.0 * Pi / (PeakSize * PeakSize);
  solidAngle = cell;
  if (!this->Cells)
  {
    return 0.0;
  }
  // Two cells by two of a level whose cells are as wide as the radius, the nearest ones.
  int level = 0;
  for (double width = PeakWidth; level + 1 < PeakLevels && width < radius; width *= 2.0)
  {
    ++level;
  }
  const int size = PeakSize >> level;
  const glm::dvec2 uv = ToPeakSquare(glm::dvec3(this->Azimuth.x * i.x + this->Azimuth.y * i.y,
                          this->Azimuth.x * i.y - this->Azimuth.y * i.x, i.z)) *
                          static_cast<double>(size) -
                        0.5;
  const float* cells = this->Cells + GetLevelOffset(level);
  const int x = std::clamp(static_cast<int>(std::floor(uv.x)), 0, size - 2);
  const int y = std::clamp(static_cast<int>(std::floor(uv.y)), 0, size - 2);
  const float* from = cells + y * size + x;
  return std::max(std::max(from[0], from[1]), std::max(from[size], from[size + 1]));
}

void ReflectionGuide::Draws(const glm::dvec3& o, std::vector<Draw>& draws) const
{
  draws.clear();
  if (this->Views.empty())
  {
    for (std::uint32_t k = 0; k < NumberOfDraws; ++k)
    {
      const glm::dvec2 u = GetPoint(k);
      glm::dvec3 i;
      if (this->BRDF->Sample(&o.x, u.x, u.y, &i.x))
      {
        const double density = this->BRDF->Pdf(&i.x, &o.x);
        if (density > 0.0)
        {
          draws.push_back({ i, 1.0 / (NumberOfDraws * density) });
        }
      }
    }
    return;
  }
  const int view = static_cast<int>(std::acos(std::min(o.z, 1.0)) / (0.5 * Pi) * NumberOfViews);
  draws = this->Views[static_cast<std::size_t>(std::clamp(view, 0, NumberOfViews - 1))];
  const double s = std::hypot(o.x, o.y);
  if (s > 0.0)
  {
    for (Draw& draw : draws) // about the normal, to the view's azimuth
    {
      const glm::dvec3 d = draw.Direction;
      draw.Direction.x = (o.x * d.x - o.y * d.y) / s;
      draw.Direction.y = (o.y * d.x + o.x * d.y) / s;
    }
  }
}
} // namespace measuredbrdf
