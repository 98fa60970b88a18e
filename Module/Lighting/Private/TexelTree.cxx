// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelTree.h"

#include "HalfVector.h" // for Pi
#include "SRGB.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr double MostRest = 10.0;

// The sum of w |d - m|^2 over directions d of weights w with mean m, from the sums of w d and w.
double GetVariance(const glm::dvec4& moments)
{
  const glm::dvec3 sum(moments);
  return moments.w > 0.0 ? std::max(moments.w - glm::dot(sum, sum) / moments.w, 0.0) : 0.0;
}

// variance: of a square; rest: of its quarters together.
double GetRest(double variance, double rest)
{
  const double removed = std::max(variance - rest, 0.0);
  return rest < MostRest * removed ? rest / removed : rest > 0.0 ? MostRest : 0.0;
}

glm::dvec3 GetMean(const glm::dvec4& moments)
{
  const glm::dvec3 sum(moments);
  const double length = glm::length(sum);
  return length > 0.0 ? sum / length : glm::dvec3(0.0, 1.0, 0.0);
}
}

TexelTree::TexelTree(vtkEnvironment* environment)
  : Environment(vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot()))
  , Directions(environment->GetWidth(), environment->GetHeight())
{
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    this->SolidAngles.push_back(environment->GetTexelSolidAngle(y));
  }
  this->Levels.push_back({ environment->GetWidth(), environment->GetHeight(), {} });
  std::vector<glm::dvec4> moments; // of the level that was made last
  while (this->Levels.back().Width > 1 || this->Levels.back().Height > 1)
  {
    this->AddLevel(moments);
  }
}

void TexelTree::AddLevel(std::vector<glm::dvec4>& moments)
{
  const int below = this->GetNumberOfLevels() - 1;
  const int fineWidth = this->GetWidth(below);
  const int fineHeight = this->GetHeight(below);
  Level level{ (fineWidth + 1) / 2, (fineHeight + 1) / 2, {} };
  const auto width = static_cast<std::size_t>(level.Width);
  level.Sums.resize(width * static_cast<std::size_t>(level.Height));
  std::vector<glm::dvec4> coarse(level.Sums.size());
  const auto sumRows = [&](vtkIdType first, vtkIdType last)
  {
    for (vtkIdType k = first * level.Width; k < last * level.Width; ++k)
    {
      const int x = static_cast<int>(k % level.Width);
      const int y = static_cast<int>(k / level.Width);
      glm::dvec3 irradiance(0.0);
      glm::dvec4 moment(0.0);
      double rest = 0.0;
      for (int fineY = 2 * y; fineY < std::min(2 * y + 2, fineHeight); ++fineY)
      {
        for (int fineX = 2 * x; fineX < std::min(2 * x + 2, fineWidth); ++fineX)
        {
          const Light light = this->Get(below, fineX, fineY);
          irradiance += light.Irradiance;
          if (below == 0)
          {
            moment += GetLuminance(light.Irradiance) * glm::dvec4(light.Direction, 1.0);
            continue;
          }
          const glm::dvec4& fine =
            moments[static_cast<std::size_t>(fineY) * static_cast<std::size_t>(fineWidth) +
                    static_cast<std::size_t>(fineX)];
          moment += fine;
          rest += GetVariance(fine);
        }
      }
      const double variance = GetVariance(moment);
      Sum& sum = level.Sums[static_cast<std::size_t>(k)];
      sum.Irradiance = irradiance;
      sum.Direction = GetMean(moment);
      sum.Rest = static_cast<float>(GetRest(variance, rest));
      coarse[static_cast<std::size_t>(k)] = moment;
    }
  };
  vtkSMPTools::For(0, level.Height, sumRows);
  this->Levels.push_back(std::move(level));
  moments = std::move(coarse);
}

double TexelTree::GetLargestRadius(int level) const
{
  return std::ldexp(std::hypot(Pi / this->GetWidth(0), 0.5 * Pi / this->GetHeight(0)), level);
}

glm::dvec3 TexelTree::GetMiddle(int level, int x, int y, double& radius) const
{
  const double u = std::min(std::ldexp(x + 0.5, level) / this->GetWidth(0), 1.0);
  const double v = std::min(std::ldexp(y + 0.5, level) / this->GetHeight(0), 1.0);
  glm::dvec3 middle;
  vtkEnvironment::GetDirection(u, v, &middle.x);
  radius = std::ldexp(std::hypot(Pi / this->GetWidth(0) * std::hypot(middle.x, middle.z),
                        0.5 * Pi / this->GetHeight(0)),
    level);
  return middle;
}

TexelTree::Light TexelTree::Get(int level, int x, int y) const
{
  const Level& found = this->Levels[static_cast<std::size_t>(level)];
  if (x >= found.Width || y >= found.Height)
  {
    return { glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0), 0.0 };
  }
  if (level == 0)
  {
    glm::dvec3 radiance;
    this->Environment->GetPixel(x, y, &radiance.x);
    return { radiance * this->SolidAngles[static_cast<std::size_t>(y)], this->Directions.Get(x, y),
      0.0 };
  }
  const Sum& sum = found.Sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(found.Width) +
                              static_cast<std::size_t>(x)];
  return { sum.Irradiance, sum.Direction, sum.Rest };
}
} // namespace measuredbrdf
