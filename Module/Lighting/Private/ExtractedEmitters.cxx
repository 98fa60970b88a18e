// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExtractedEmitters.h"

#include "HalfVector.h" // for Pi
#include "SRGB.h"
#include "vtkEnvironment.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <unordered_map>
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
constexpr int Spare = 4; // so many times the wanted lights may be merged into them

struct Lamp
{
  std::vector<int> Texels;
  std::vector<glm::dvec3> Directions;
  glm::dvec3 Moment = glm::dvec3(0.0); // directions by luminance
  double Luminance = 0.0;

  void Add(int texel, const glm::dvec3& direction, double luminance)
  {
    this->Texels.push_back(texel);
    this->Directions.push_back(direction);
    this->Moment += luminance * direction;
    this->Luminance += luminance;
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
      const auto near = [&](const glm::dvec3& direction)
      { return glm::distance(direction, mean) <= (isGlare ? 2.0 : 1.0) * angle; };
      if (!std::all_of(into.Directions.begin(), into.Directions.end(), near) ||
          !std::all_of(from.Directions.begin(), from.Directions.end(), near))
      {
        continue;
      }
      into.Texels.insert(into.Texels.end(), from.Texels.begin(), from.Texels.end());
      into.Directions.insert(into.Directions.end(), from.Directions.begin(), from.Directions.end());
      into.Moment += from.Moment;
      into.Luminance += from.Luminance;
      lamps.erase(lamps.begin() + static_cast<std::ptrdiff_t>(b));
      b = a; // all others again
    }
  }
}

// Luminance of a share, at least: no texel of a small map counts that is but a little brighter.
double GetLeast(double total, double share, vtkEnvironment* environment)
{
  const double texels = static_cast<double>(environment->GetPixels().size() / 3);
  return total * std::max(share, Contrast / texels);
}

// The lamps of the brightest texels, `maximum` at most: each has one texel, or those within an
// angle of its brightest one. Returns whether all texels found a lamp.
bool FindBrightestLamps(vtkEnvironment* environment,
  const std::vector<std::pair<double, int>>& brightest, int maximum, double angle,
  std::vector<Lamp>& lamps)
{
  const int width = environment->GetWidth();
  bool all = true;
  for (const auto& texel : brightest)
  {
    glm::dvec3 direction;
    environment->GetTexelDirection(texel.second % width, texel.second / width, &direction.x);
    const auto near = [&](const Lamp& lamp)
    { return glm::distance(direction, lamp.Directions.front()) <= angle; };
    const auto found = angle > 0.0 ? std::find_if(lamps.begin(), lamps.end(), near) : lamps.end();
    if (found != lamps.end())
    {
      found->Add(texel.second, direction, texel.first);
    }
    else if (lamps.size() < static_cast<std::size_t>(angle > 0.0 ? Spare * maximum : maximum))
    {
      lamps.emplace_back().Add(texel.second, direction, texel.first);
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
  if (lamps.size() > static_cast<std::size_t>(maximum))
  {
    std::stable_sort(lamps.begin(), lamps.end(),
      [](const Lamp& first, const Lamp& second) { return first.Luminance > second.Luminance; });
    lamps.resize(static_cast<std::size_t>(maximum));
    all = false;
  }
  return all;
}

// Mean radiance of a texel's neighbors that are no lights; 0 where all are.
glm::dvec3 GetMeanAround(
  vtkEnvironment* environment, int x, int y, const std::unordered_map<int, int>& owners)
{
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  const std::vector<float>& pixels = environment->GetPixels();
  glm::dvec3 sum(0.0);
  int neighbors = 0;
  for (int dy = -1; dy <= 1; ++dy)
  {
    for (int dx = -1; dx <= 1; ++dx)
    {
      const int neighbor = std::clamp(y + dy, 0, height - 1) * width + (x + dx + width) % width;
      if (owners.count(neighbor) == 0)
      {
        sum += glm::dvec3(glm::make_vec3(&pixels[3 * static_cast<std::size_t>(neighbor)]));
        ++neighbors;
      }
    }
  }
  return neighbors > 0 ? sum / static_cast<double>(neighbors) : glm::dvec3(0.0);
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
    const double luminance = vtkEnvironment::GetLuminance(&part.Irradiance.x);
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

ExtractedEmitters::Ranking::Ranking(vtkEnvironment* environment, double share)
{
  const std::vector<float>& pixels = environment->GetPixels();
  double least = 0.0;
  for (const bool isSummed : { false, true }) // it is cheaper than to keep all luminances
  {
    int texel = 0;
    for (int y = 0; y < environment->GetHeight(); ++y)
    {
      const double solidAngle = environment->GetTexelSolidAngle(y);
      for (const int end = texel + environment->GetWidth(); texel < end; ++texel)
      {
        const double luminance =
          solidAngle * GetLuminance(&pixels[3 * static_cast<std::size_t>(texel)]);
        this->Total += isSummed ? 0.0 : luminance;
        if (isSummed && luminance > least)
        {
          this->Texels.emplace_back(luminance, texel);
        }
      }
    }
    least = GetLeast(this->Total, share, environment);
  }
  std::sort(this->Texels.begin(), this->Texels.end(), std::greater<std::pair<double, int>>());
}

ExtractedEmitters::ExtractedEmitters(
  vtkEnvironment* environment, double share, int maximum, double angle)
{
  environment = environment->GetSubdivided();
  if (share >= 1.0 || maximum <= 0)
  {
    return;
  }
  const Ranking ranking(environment, share);
  while (!this->Extract(environment, ranking, share, maximum, angle) && angle > 0.0 &&
         share < DefaultShare)
  {
    share *= 2.0;
  }
}

bool ExtractedEmitters::Extract(
  vtkEnvironment* environment, const Ranking& ranking, double share, int maximum, double angle)
{
  this->Rest.Texels.clear();
  this->Lights.clear();
  const int width = environment->GetWidth();
  const std::vector<float>& pixels = environment->GetPixels();
  const double least = GetLeast(ranking.Total, share, environment);
  std::vector<std::pair<double, int>> brightest(
    ranking.Texels.begin(), std::find_if(ranking.Texels.begin(), ranking.Texels.end(),
                              [least](const auto& texel) { return !(texel.first > least); }));

  std::vector<Lamp> lamps;
  const bool all = FindBrightestLamps(environment, brightest, maximum, angle, lamps);
  std::unordered_map<int, int> owners; // texels' lights
  for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp)
  {
    for (const int texel : lamps[lamp].Texels)
    {
      owners[texel] = static_cast<int>(lamp);
    }
  }

  this->Lights.resize(lamps.size());
  for (const auto& texel : brightest)
  {
    const auto owner = owners.find(texel.second);
    if (owner == owners.end())
    {
      continue;
    }
    const int x = texel.second % width;
    const int y = texel.second / width;
    // What is left is what its neighbors that are no lights show.
    const glm::dvec3 around = GetMeanAround(environment, x, y, owners);
    Light& light = this->Lights[static_cast<std::size_t>(owner->second)];
    TexelChanges::Texel rest{ static_cast<std::size_t>(texel.second), {} };
    const glm::dvec3 value = glm::make_vec3(&pixels[3 * rest.Index]);
    const glm::dvec3 kept = glm::min(value, around);
    const glm::dvec3 irradiance = (value - kept) * environment->GetTexelSolidAngle(y);
    rest.Radiance = kept;
    this->Rest.Texels.push_back(rest);
    glm::dvec3 direction;
    environment->GetTexelDirection(x, y, &direction.x);
    light.Parts.push_back({ direction, irradiance, GetTexelSpread(environment, direction) });
  }
  std::sort(this->Rest.Texels.begin(), this->Rest.Texels.end());
  for (std::size_t k = 0; k < this->Lights.size(); ++k)
  {
    Light& light = this->Lights[k];
    static_cast<Part&>(light) = Add(light.Parts, glm::normalize(lamps[k].Moment));
    light.Parts = Group(light.Parts);
  }
  return all;
}
} // namespace measuredbrdf
