// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FirstSquares.h"

#include "HalfVector.h" // for Pi

#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr int WidestBase = 16; // squares across the map to begin with
// The radius that a square may keep: that of the solid angle in which a draw is alone, times this,
// and this share of the distance to it.
constexpr double AloneTimes = 2.0; // lobes are as much narrower as the view is lower
constexpr float DistanceShare = 1.0f;
}

void FirstSquares::AddDraws(const ReflectionGuide& guide, const glm::dmat3& local,
  const glm::dvec3& view, std::size_t first, std::size_t step)
{
  guide.Draws(view, this->Draws);
  for (std::size_t k = first; k < this->Draws.size(); k += step)
  {
    const ReflectionGuide::Draw& draw = this->Draws[k];
    this->Near.push_back({ glm::vec3(draw.Direction * local), // transposed: the environment's frame
      static_cast<float>(AloneTimes * std::sqrt(draw.SolidAngle * view.z / Pi)) });
  }
}

const std::vector<FirstSquares::Square>& FirstSquares::Find(const TexelTree& texels)
{
  int base = 0;
  while (texels.GetWidth(base) > WidestBase)
  {
    ++base;
  }
  this->Squares.clear();
  for (int y = 0; y < texels.GetHeight(base); ++y)
  {
    for (int x = 0; x < texels.GetWidth(base); ++x)
    {
      this->Force(texels, base, x, y, 0);
    }
  }
  return this->Squares;
}

// Divides where a draw wants smaller squares about it. The draws that the larger square was divided
// for are in Near from the first one on.
void FirstSquares::Force(const TexelTree& texels, int level, int x, int y, std::size_t first)
{
  if (x >= texels.GetWidth(level) || y >= texels.GetHeight(level))
  {
    return;
  }
  const std::size_t last = this->Near.size();
  if (level > texels.GetLowestLevel())
  {
    double radius = 0.0;
    const glm::vec3 middle(texels.GetMiddle(level, x, y, radius));
    const auto r = static_cast<float>(radius);
    for (std::size_t k = first; k < last; ++k)
    {
      const Drawn drawn = this->Near[k];
      const glm::vec3 d = drawn.Direction - middle;
      // The same as r > drawn.Radius + DistanceShare * max(length(d) - r, 0).
      const float reach = (r - drawn.Radius) / DistanceShare;
      if (reach > 0.0f && glm::dot(d, d) < (reach + r) * (reach + r))
      {
        this->Near.push_back(drawn);
      }
    }
  }
  if (this->Near.size() == last)
  {
    this->Squares.push_back({ level, x, y });
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    this->Force(texels, level - 1, 2 * x + k % 2, 2 * y + k / 2, last);
  }
  this->Near.resize(last);
}
} // namespace measuredbrdf
