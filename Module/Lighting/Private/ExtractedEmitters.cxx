// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExtractedEmitters.h"

#include "HalfVector.h" // for Pi
#include "SRGB.h"
#include "vtkEnvironment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_set>
#include <utility>

namespace measuredbrdf
{
namespace
{
// A light holds so many times what texels hold in the mean: in a small environment many hold a
// large share without being lights.
constexpr double Contrast = 32.0;
constexpr double Glare = 0.01; // of a lamp's luminance: may lie twice as far
constexpr double LeastGroupAngle = ToRadians(0.1);
constexpr std::size_t Spare = 4; // so many times the wanted lights may be merged into them

// A texel's light: luminance of radiance times solid angle.
struct Bright
{
  double Luminance;
  int Index;
  glm::dvec3 Direction = glm::dvec3(0.0);
};

bool IsBrighter(const Bright& a, const Bright& b)
{
  return std::make_pair(a.Luminance, a.Index) > std::make_pair(b.Luminance, b.Index);
}

struct Lamp
{
  std::vector<Bright> Texels;          // the brightest first
  glm::dvec3 Moment = glm::dvec3(0.0); // directions by luminance
  double Luminance = 0.0;

  void Add(const Bright& texel)
  {
    this->Texels.push_back(texel);
    this->Moment += texel.Luminance * texel.Direction;
    this->Luminance += texel.Luminance;
  }
};

// Lamps become one where all of both lies within the angle of the common mean; within twice the
// angle, where the second is but the first's glare. The brightest texel of a lamp may lie at its
// edge. Lamps come by their brightest texels.
void Merge(std::vector<Lamp>& lamps, double angle)
{
  for (std::size_t a = 0; a < lamps.size(); ++a)
  {
    for (std::size_t b = a + 1; b < lamps.size(); ++b)
    {
      Lamp& into = lamps[a];
      const Lamp& from = lamps[b];
      const bool isGlare = from.Luminance < Glare * into.Luminance;
      const glm::dvec3 mean = glm::normalize(into.Moment + from.Moment);
      const auto near = [&](const Bright& texel)
      { return glm::distance(texel.Direction, mean) <= (isGlare ? 2.0 : 1.0) * angle; };
      if (std::all_of(into.Texels.begin(), into.Texels.end(), near) &&
          std::all_of(from.Texels.begin(), from.Texels.end(), near))
      {
        into.Texels.insert(into.Texels.end(), from.Texels.begin(), from.Texels.end());
        std::sort(into.Texels.begin(), into.Texels.end(), IsBrighter);
        into.Moment += from.Moment;
        into.Luminance += from.Luminance;
        lamps.erase(lamps.begin() + static_cast<std::ptrdiff_t>(b));
        b = a; // all others again
      }
    }
  }
}

// The texels above a share of all luminance, at least: no texel of a small map counts that is but a
// little brighter. The brightest first.
std::vector<Bright> FindBrightest(vtkEnvironment* environment, double share)
{
  const std::vector<float>& pixels = environment->GetPixels();
  const int width = environment->GetWidth();
  glm::dvec3 all;
  environment->GetTotal(&all.x);
  const double texels = static_cast<double>(pixels.size() / 3);
  const double least = GetLuminance(all) * std::max(share, Contrast / texels);
  std::vector<Bright> brightest;
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < width; ++x)
    {
      const int texel = y * width + x;
      const double luminance = solidAngle * GetLuminance(&pixels[3 * std::size_t(texel)]);
      if (luminance > least)
      {
        brightest.push_back({ luminance, texel });
        environment->GetTexelDirection(x, y, &brightest.back().Direction.x);
      }
    }
  }
  std::sort(brightest.begin(), brightest.end(), IsBrighter);
  return brightest;
}

// The lamps of the brightest texels, `maximum` at most: each has one texel, or those within an
// angle of its brightest one. Returns whether all texels found a lamp.
bool FindBrightestLamps(
  const std::vector<Bright>& brightest, std::size_t maximum, double angle, std::vector<Lamp>& lamps)
{
  lamps.clear();
  bool all = true;
  for (const Bright& texel : brightest)
  {
    const auto near = [&](const Lamp& lamp)
    { return glm::distance(texel.Direction, lamp.Texels.front().Direction) <= angle; };
    const auto found = angle > 0.0 ? std::find_if(lamps.begin(), lamps.end(), near) : lamps.end();
    if (found != lamps.end())
    {
      found->Add(texel);
    }
    else if (lamps.size() < (angle > 0.0 ? Spare * maximum : maximum))
    {
      lamps.emplace_back().Add(texel);
    }
    else
    {
      all = false;
    }
  }
  if (angle > 0.0)
  {
    Merge(lamps, angle);
  }
  if (lamps.size() > maximum)
  {
    std::stable_sort(lamps.begin(), lamps.end(),
      [](const Lamp& first, const Lamp& second) { return first.Luminance > second.Luminance; });
    lamps.resize(maximum);
    all = false;
  }
  return all;
}

// Mean radiance of a texel's neighbors that are no lights; 0 where all are.
glm::dvec3 GetMeanAround(
  vtkEnvironment* environment, int texel, const std::unordered_set<int>& lights)
{
  const int width = environment->GetWidth();
  const int last = environment->GetHeight() - 1;
  glm::dvec4 sum(0.0);
  for (int k = 0; k < 9; ++k)
  {
    const int x = (texel % width + k % 3 - 1 + width) % width;
    const int y = std::clamp(texel / width + k / 3 - 1, 0, last);
    if (lights.count(y * width + x) == 0)
    {
      glm::dvec3 radiance;
      environment->GetPixel(x, y, &radiance.x);
      sum += glm::dvec4(radiance, 1.0);
    }
  }
  return glm::dvec3(sum) / std::max(sum.w, 1.0);
}

// Variance along each axis of what one texel shows between its neighbors' centers: a triangle of
// half width d has d^2 / 6 (docs/methods/lamps.md).
double GetTexelSpread(vtkEnvironment* environment, const glm::dvec3& direction)
{
  const double row = Pi / environment->GetHeight();
  const double column = 2.0 * Pi / environment->GetWidth() * std::hypot(direction.x, direction.z);
  return 0.5 * (row * row + column * column) / 6.0;
}

// All of them as one. fallback: its direction where they are dark.
ExtractedEmitters::Part Add(
  const std::vector<ExtractedEmitters::Part>& parts, const glm::dvec3& fallback)
{
  ExtractedEmitters::Part sum{ glm::dvec3(0.0), glm::dvec3(0.0), 0.0 };
  double light = 0.0;
  for (const ExtractedEmitters::Part& part : parts)
  {
    const double luminance = GetLuminance(part.Irradiance);
    light += luminance;
    sum.Direction += luminance * part.Direction;
    sum.Irradiance += part.Irradiance;
    sum.Spread += luminance * part.Spread;
  }
  const double length = glm::length(sum.Direction);
  if (light > 0.0)
  {
    const double mean = length / light;
    sum.Spread = sum.Spread / light + 0.5 * std::max(1.0 - mean * mean, 0.0);
  }
  sum.Direction = length > 0.0 ? sum.Direction / length : fallback;
  return sum;
}

// MostParts of them: what lies within an angle is one, which grows until they are so few.
std::vector<ExtractedEmitters::Part> Group(const std::vector<ExtractedEmitters::Part>& parts)
{
  std::vector<ExtractedEmitters::Part> groups = parts;
  for (double angle = LeastGroupAngle; groups.size() > ExtractedEmitters::MostParts; angle *= 2.0)
  {
    std::vector<std::vector<ExtractedEmitters::Part>> members;
    for (const ExtractedEmitters::Part& part : parts)
    {
      const auto found = std::find_if(members.begin(), members.end(),
        [&](const auto& group)
        { return glm::distance(group.front().Direction, part.Direction) <= angle; });
      if (found != members.end())
      {
        found->push_back(part);
      }
      else
      {
        members.push_back({ part });
      }
    }
    groups.clear();
    for (const auto& group : members)
    {
      groups.push_back(Add(group, group.front().Direction));
    }
  }
  return groups;
}
}

ExtractedEmitters::ExtractedEmitters(
  vtkEnvironment* environment, double share, int maximum, double angle)
{
  environment = environment->GetSubdivided();
  if (share >= 1.0 || maximum <= 0)
  {
    return;
  }
  std::vector<Lamp> lamps;
  while (!FindBrightestLamps(
           FindBrightest(environment, share), static_cast<std::size_t>(maximum), angle, lamps) &&
         angle > 0.0 && share < DefaultShare)
  {
    share *= 2.0;
  }
  std::unordered_set<int> lights; // their texels
  for (const Lamp& lamp : lamps)
  {
    for (const Bright& texel : lamp.Texels)
    {
      lights.insert(texel.Index);
    }
  }
  for (const Lamp& lamp : lamps)
  {
    std::vector<Part> parts;
    for (const Bright& texel : lamp.Texels)
    {
      // What is left is what its neighbors that are no lights show.
      const int y = texel.Index / environment->GetWidth();
      glm::dvec3 value;
      environment->GetPixel(texel.Index % environment->GetWidth(), y, &value.x);
      const glm::dvec3 kept = glm::min(value, GetMeanAround(environment, texel.Index, lights));
      const glm::dvec3 irradiance = (value - kept) * environment->GetTexelSolidAngle(y);
      this->Rest.Texels.push_back({ static_cast<std::size_t>(texel.Index), kept });
      parts.push_back(
        { texel.Direction, irradiance, GetTexelSpread(environment, texel.Direction) });
    }
    this->Lights.push_back({ Add(parts, glm::normalize(lamp.Moment)), Group(parts) });
  }
  std::sort(this->Rest.Texels.begin(), this->Rest.Texels.end());
}
} // namespace measuredbrdf
