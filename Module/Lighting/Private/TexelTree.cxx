// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelTree.h"

#include "HalfVector.h" // for Pi
#include "ParallelFor.h"
#include "SRGB.h"
#include "TexelChanges.h"

#include <glm/gtc/type_ptr.hpp>

#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr double MostRest = 10.0;
constexpr int LeastParts = 16384; // of the finest level, from pole to pole

// The sum of w |d - m|^2 over directions d of weights w with mean m, from the sums of w d and w.
double GetTexelVariance(const glm::dvec4& moments)
{
  const glm::dvec3 sum(moments);
  return moments.w > 0.0 ? std::max(moments.w - glm::dot(sum, sum) / moments.w, 0.0) : 0.0;
}

// variance: of a square; rest: of its quarters together.
double GetShareLeft(double variance, double rest)
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

// Sizes of a level from those of texels: rounded up.
int GetSize(int texels, int level)
{
  return level < 0 ? texels << -level : (texels + (1 << level) - 1) >> level;
}
}

TexelTree::TexelTree(vtkEnvironment* environment)
  : Environment(vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot()))
  , Radius(std::hypot(Pi / environment->GetWidth(), 0.5 * Pi / environment->GetHeight()))
{
  while (GetSize(environment->GetHeight(), this->Lowest) <= LeastParts)
  {
    --this->Lowest;
  }
  for (int level = this->Lowest; level <= 0; ++level)
  {
    this->AddLevel(level);
  }
  this->AverageTexels();
  std::vector<glm::dvec4> moments; // of the level that was made last
  while (this->Levels.back().Width > 1 || this->Levels.back().Height > 1)
  {
    this->AddLevel(this->GetHighestLevel() + 1);
    this->SumQuarters(this->Levels.back(), moments);
  }
}

void TexelTree::AddLevel(int level)
{
  const int texelsAcross = this->Environment->GetWidth();
  const int texelsUp = this->Environment->GetHeight();
  const int width = GetSize(texelsAcross, level);
  const int height = GetSize(texelsUp, level);
  const double scale = std::ldexp(1.0, level);
  const double across = texelsAcross / scale;
  const double up = texelsUp / scale;
  // dphi (cos theta0 - cos theta1) as a product, but for the cosine of the latitude.
  this->Levels.push_back({ width, height, scale, TexelDirections(width, height, across, up),
    2.0 * Pi / across * 2.0 * std::sin(Pi / (2.0 * up)), {} });
}

// Linear interpolation takes an eighth of a texel's mean from each neighbor.
void TexelTree::AverageTexels()
{
  const int width = this->GetWidth(0);
  const int height = this->GetHeight(0);
  const float* pixels = this->Environment->GetPixels().data();
  this->Texels.assign(static_cast<std::size_t>(width) * height, glm::vec3(0.0f));
  ParallelForEach(
    height,
    [&](int y)
    {
      for (int step = -1; step <= 1; ++step)
      {
        const std::size_t row =
          static_cast<std::size_t>(std::clamp(y + step, 0, height - 1)) * width;
        const auto get = [&](int x) { return glm::make_vec3(pixels + 3 * (row + x)); };
        const float share = step == 0 ? 0.75f : 0.125f;
        for (int x = 0; x < width; ++x)
        {
          this->Texels[static_cast<std::size_t>(y) * width + x] +=
            share * (0.75f * get(x) +
                      0.125f * (get(x > 0 ? x - 1 : width - 1) + get(x + 1 < width ? x + 1 : 0)));
        }
      }
    },
    nullptr, 0);
}

// moments: of the level below (none: of texels), then of this one.
void TexelTree::SumQuarters(Level& level, std::vector<glm::dvec4>& moments)
{
  const int below = this->GetHighestLevel() - 1;
  const int fineWidth = this->GetWidth(below);
  const int fineHeight = this->GetHeight(below);
  const glm::dvec2 texel(2.0 * Pi / this->GetWidth(0), Pi / this->GetHeight(0));
  const auto getMoment = [&](const Light& light, int x, int y)
  {
    if (below > 0)
    {
      return moments[static_cast<std::size_t>(y) * fineWidth + x];
    }
    // Directions within a texel spread about its middle: the mean is shorter than 1.
    const glm::dvec2 extent = texel * glm::dvec2(this->At(0).Middles.Rows[y].x, 1.0);
    return GetLuminance(light.Irradiance) *
           glm::dvec4((1.0 - glm::dot(extent, extent) / 24.0) * light.Direction, 1.0);
  };
  std::vector<glm::dvec4> coarse(static_cast<std::size_t>(level.Width) * level.Height);
  const int blocks = (level.Width + 1) / 2;
  level.Blocks.resize(static_cast<std::size_t>(blocks) * ((level.Height + 1) / 2));
  const auto sumRow = [&](int y)
  {
    for (int x = 0; x < level.Width; ++x)
    {
      glm::dvec3 irradiance(0.0);
      glm::dvec4 moment(0.0);
      double rest = 0.0;
      for (int fineY = 2 * y; fineY < std::min(2 * y + 2, fineHeight); ++fineY)
      {
        for (int fineX = 2 * x; fineX < std::min(2 * x + 2, fineWidth); ++fineX)
        {
          const Light light = this->Get(below, fineX, fineY);
          const glm::dvec4 fine = getMoment(light, fineX, fineY);
          irradiance += light.Irradiance;
          moment += fine;
          rest += GetTexelVariance(fine);
        }
      }
      const glm::vec3 direction(GetMean(moment));
      Block& block = level.Blocks[static_cast<std::size_t>(y / 2) * blocks + x / 2];
      const int at = 2 * (y % 2) + x % 2;
      for (int c = 0; c < 3; ++c)
      {
        block.Irradiances[c][at] = static_cast<float>(irradiance[c]);
        block.Directions[c][at] = direction[c];
      }
      block.Rests[at] = static_cast<float>(GetShareLeft(GetTexelVariance(moment), rest));
      coarse[static_cast<std::size_t>(y) * level.Width + x] = moment;
    }
  };
  ParallelForEach(level.Height, sumRow, nullptr, 0);
  moments = std::move(coarse);
}

glm::dvec3 TexelTree::GetMiddle(int level, int x, int y, double& radius) const
{
  const Level& at = this->At(level);
  const double across = Pi / this->GetWidth(0) * at.Middles.Rows[y].x;
  const double up = 0.5 * Pi / this->GetHeight(0);
  radius = at.Scale * std::sqrt(across * across + up * up);
  return at.Middles.Get(x, y);
}

TexelTree::Light TexelTree::Get(int level, int x, int y) const
{
  const Level& at = this->At(level);
  if (x >= at.Width || y >= at.Height)
  {
    return { glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0), 0.0 };
  }
  if (level > 0)
  {
    const Block& block = this->GetBlock(level, x, y);
    const int k = 2 * (y % 2) + x % 2;
    const auto get = [k](const float(&of)[3][4])
    { return glm::dvec3(of[0][k], of[1][k], of[2][k]); };
    return { get(block.Irradiances), get(block.Directions), block.Rests[k] };
  }
  const glm::dvec3 radiance =
    level == 0
      ? glm::dvec3(this->Texels[static_cast<std::size_t>(y) * at.Width + x])
      : TexelChanges().Interpolate(this->Environment, (x + 0.5) / at.Width, (y + 0.5) / at.Height);
  return { radiance * at.StripArea * at.Middles.Rows[y].x, at.Middles.Get(x, y), SmoothRest };
}

void TexelTree::GetQuarters(
  int level, int x, int y, float* const directions[3], float* const irradiances[3]) const
{
  const int below = level - 1;
  if (below > 0)
  {
    const Block& block = this->GetBlock(below, 2 * x, 2 * y);
    for (int c = 0; c < 3; ++c)
    {
      std::copy_n(block.Directions[c], 4, directions[c]);
      std::copy_n(block.Irradiances[c], 4, irradiances[c]);
    }
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    const Light light = this->Get(below, 2 * x + k % 2, 2 * y + k / 2);
    for (int c = 0; c < 3; ++c)
    {
      directions[c][k] = static_cast<float>(light.Direction[c]);
      irradiances[c][k] = static_cast<float>(light.Irradiance[c]);
    }
  }
}
} // namespace measuredbrdf
