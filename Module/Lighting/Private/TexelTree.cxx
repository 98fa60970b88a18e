// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelTree.h"

#include "HalfVector.h" // for Pi
#include "ParallelFor.h"
#include "SRGB.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
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
}

TexelTree::TexelTree(vtkEnvironment* environment)
  : Environment(vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot()))
{
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  int times = 1;
  do
  {
    this->Parts.emplace_back(times * width, times * height);
    // dphi (cos theta0 - cos theta1) as a product, but for the cosine of the latitude.
    this->StripAreas.push_back(
      2.0 * Pi / (times * width) * 2.0 * std::sin(Pi / (2.0 * (times * height))));
    times *= 2;
  } while (times * height <= 2 * LeastParts);
  this->Levels.push_back({ width, height, {} });
  this->AverageTexels();
  std::vector<glm::dvec4> moments; // of the level that was made last
  while (this->Levels.back().Width > 1 || this->Levels.back().Height > 1)
  {
    this->AddLevel(moments);
    this->AddMiddles();
  }
  this->Radius = std::hypot(Pi / width, 0.5 * Pi / height);
  for (int level = this->GetLowestLevel(); level <= this->GetHighestLevel(); ++level)
  {
    this->Scales.push_back(std::ldexp(1.0, level));
  }
}

// The outer squares of a level may be cut off by the map's edge.
void TexelTree::AddMiddles()
{
  const int level = this->GetHighestLevel();
  TexelDirections middles(0, 0);
  for (int x = 0; x < this->GetWidth(level); ++x)
  {
    glm::dvec3 d;
    vtkEnvironment::GetDirection(
      std::min(std::ldexp(x + 0.5, level) / this->GetWidth(0), 1.0), 0.5, &d.x);
    middles.Columns.emplace_back(d.x, d.z);
  }
  for (int y = 0; y < this->GetHeight(level); ++y)
  {
    glm::dvec3 d;
    vtkEnvironment::GetDirection(
      0.5, std::min(std::ldexp(y + 0.5, level) / this->GetHeight(0), 1.0), &d.x);
    middles.Rows.emplace_back(d.x, d.y);
  }
  this->Above.push_back(std::move(middles));
}

// Linear interpolation takes an eighth of a texel's mean from each neighbor.
void TexelTree::AverageTexels()
{
  const int width = this->GetWidth(0);
  const int height = this->GetHeight(0);
  const std::vector<float>& pixels = this->Environment->GetPixels();
  const auto get = [&](int x, int y)
  { return glm::make_vec3(&pixels[3 * (static_cast<std::size_t>(y) * width + x)]); };
  this->Texels.resize(pixels.size() / 3);
  ParallelForEach(
    height,
    [&](int y)
    {
      std::vector<glm::vec3> row;
      for (int x = 0; x < width; ++x)
      {
        row.push_back(0.75f * get(x, y) +
                      0.125f * (get(x, std::max(y - 1, 0)) + get(x, std::min(y + 1, height - 1))));
      }
      for (int x = 0; x < width; ++x)
      {
        this->Texels[static_cast<std::size_t>(y) * width + x] =
          0.75f * row[x] +
          0.125f * (row[x > 0 ? x - 1 : width - 1] + row[x + 1 < width ? x + 1 : 0]);
      }
    },
    nullptr, 0);
}

void TexelTree::AddLevel(std::vector<glm::dvec4>& moments)
{
  const int below = this->GetHighestLevel();
  const int fineWidth = this->GetWidth(below);
  const int fineHeight = this->GetHeight(below);
  Level level{ (fineWidth + 1) / 2, (fineHeight + 1) / 2, {} };
  const auto width = static_cast<std::size_t>(level.Width);
  std::vector<glm::dvec4> coarse(width * static_cast<std::size_t>(level.Height));
  Block black = {};
  std::fill_n(black.Directions[1], 4, 1.0f);
  level.Blocks.assign((width + 1) / 2 * static_cast<std::size_t>((level.Height + 1) / 2), black);
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
          irradiance += light.Irradiance;
          const glm::dvec4 fine =
            below > 0
              ? moments[static_cast<std::size_t>(fineY) * static_cast<std::size_t>(fineWidth) +
                        static_cast<std::size_t>(fineX)]
              : this->GetTexelMoment(light, fineY);
          moment += fine;
          rest += GetTexelVariance(fine);
        }
      }
      const double variance = GetTexelVariance(moment);
      const glm::dvec3 direction = GetMean(moment);
      Block& block = level.Blocks[static_cast<std::size_t>(y / 2) * ((width + 1) / 2) +
                                  static_cast<std::size_t>(x / 2)];
      const int at = 2 * (y % 2) + x % 2;
      for (int c = 0; c < 3; ++c)
      {
        block.Irradiances[c][at] = static_cast<float>(irradiance[c]);
        block.Directions[c][at] = static_cast<float>(direction[c]);
      }
      block.Rests[at] = static_cast<float>(GetShareLeft(variance, rest));
      coarse[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = moment;
    }
  };
  ParallelForEach(level.Height, sumRow, nullptr, 0);
  this->Levels.push_back(std::move(level));
  moments = std::move(coarse);
}

// Directions within a texel spread about its middle: the mean is shorter than 1.
glm::dvec4 TexelTree::GetTexelMoment(const Light& light, int y) const
{
  const double across =
    2.0 * Pi / this->GetWidth(0) * this->Parts[0].Rows[static_cast<std::size_t>(y)].x;
  const double up = Pi / this->GetHeight(0);
  const double variance = (across * across + up * up) / 12.0;
  return GetLuminance(light.Irradiance) * glm::dvec4((1.0 - 0.5 * variance) * light.Direction, 1.0);
}

int TexelTree::GetWidth(int level) const
{
  return level < 0 ? this->GetWidth(0) << -level
                   : this->Levels[static_cast<std::size_t>(level)].Width;
}

int TexelTree::GetHeight(int level) const
{
  return level < 0 ? this->GetHeight(0) << -level
                   : this->Levels[static_cast<std::size_t>(level)].Height;
}

glm::dvec3 TexelTree::GetMiddle(int level, int x, int y, double& radius) const
{
  const TexelDirections& directions = level > 0 ? this->Above[static_cast<std::size_t>(level - 1)]
                                                : this->Parts[static_cast<std::size_t>(-level)];
  const double across = Pi / this->GetWidth(0) * directions.Rows[static_cast<std::size_t>(y)].x;
  const double up = 0.5 * Pi / this->GetHeight(0);
  radius = this->GetScale(level) * std::sqrt(across * across + up * up);
  return directions.Get(x, y);
}

// Of a square of level 0 or less.
double TexelTree::GetSolidAngle(int level, int y) const
{
  const auto part = static_cast<std::size_t>(-level);
  return this->StripAreas[part] * this->Parts[part].Rows[static_cast<std::size_t>(y)].x;
}

// At the middle of a part, as InterpolateTexels gives it: that is an odd number of half parts from
// the texels' centers.
glm::dvec3 TexelTree::GetPartRadiance(int part, int x, int y) const
{
  const int width = this->GetWidth(0);
  const int last = this->GetHeight(0) - 1;
  const int halves = 2 << part; // of a texel
  const int column = 2 * x + 1 - (1 << part);
  const int row = std::clamp(2 * y + 1 - (1 << part), 0, last * halves);
  const int left = column < 0 ? width - 1 : column >> (part + 1);
  const int right = left + 1 < width ? left + 1 : 0;
  const int upper = row >> (part + 1);
  const int lower = std::min(upper + 1, last);
  const double scale = 0.5 * this->GetScale(-part);
  const double across = scale * (column & (halves - 1));
  const double down = scale * (row & (halves - 1));
  const float* pixels = this->Environment->GetPixels().data();
  const auto get = [&](int i, int j)
  { return glm::dvec3(glm::make_vec3(pixels + 3 * (static_cast<std::ptrdiff_t>(j) * width + i))); };
  const glm::dvec3 first = get(left, upper), second = get(right, upper), third = get(left, lower),
                   fourth = get(right, lower);
  const glm::dvec3 above = first + across * (second - first);
  const glm::dvec3 below = third + across * (fourth - third);
  return above + down * (below - above);
}

TexelTree::Light TexelTree::Get(int level, int x, int y) const
{
  const int width = this->GetWidth(level);
  const int height = this->GetHeight(level);
  if (x >= width || y >= height)
  {
    return { glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0), 0.0 };
  }
  const std::size_t texel =
    static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  if (level > 0)
  {
    const Block& block =
      this->Levels[static_cast<std::size_t>(level)].Blocks[this->GetBlock(level, x, y)];
    const int at = 2 * (y % 2) + x % 2;
    return { glm::dvec3(
               block.Irradiances[0][at], block.Irradiances[1][at], block.Irradiances[2][at]),
      glm::dvec3(block.Directions[0][at], block.Directions[1][at], block.Directions[2][at]),
      block.Rests[at] };
  }
  const glm::dvec3 radiance =
    level == 0 ? glm::dvec3(this->Texels[texel]) : this->GetPartRadiance(-level, x, y);
  return { radiance * this->GetSolidAngle(level, y),
    this->Parts[static_cast<std::size_t>(-level)].Get(x, y), SmoothRest };
}

void TexelTree::Prefetch(int level, int x, int y) const
{
#ifdef __GNUC__
  if (level > 1)
  {
    const Block* block = &this->Levels[static_cast<std::size_t>(level - 1)]
                            .Blocks[this->GetBlock(level - 1, 2 * x, 2 * y)];
    __builtin_prefetch(block);
    __builtin_prefetch(&block->Irradiances[1]);
  }
#else
  static_cast<void>(level + x + y);
#endif
}

void TexelTree::GetQuarters(
  int level, int x, int y, float* const directions[3], float* const irradiances[3]) const
{
  const int below = level - 1;
  if (below > 0)
  {
    const Block& block =
      this->Levels[static_cast<std::size_t>(below)].Blocks[this->GetBlock(below, 2 * x, 2 * y)];
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
