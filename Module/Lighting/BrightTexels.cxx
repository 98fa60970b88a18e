// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BrightTexels.h"

#include "vtkEnvironment.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

namespace measuredbrdf
{
namespace
{
// A light holds so many times what texels hold in the mean: in a small environment many hold a
// large share without being lights.
constexpr double Contrast = 32.0;
}

BrightTexels::BrightTexels(vtkEnvironment* environment, double share, int maximum)
{
  this->Extract(environment, share, maximum, 0.0);
}

BrightTexels BrightTexels::FindLamps(vtkEnvironment* environment, double angle, int maximum)
{
  BrightTexels found;
  double share = LampShare;
  while (!found.Extract(environment, share, maximum, angle) && share < DefaultShare)
  {
    share *= 2.0;
  }
  return found;
}

bool BrightTexels::Extract(vtkEnvironment* environment, double share, int maximum, double angle)
{
  this->Rest = environment->GetPixels();
  this->Lights.clear();
  if (share >= 1.0 || maximum <= 0)
  {
    return true;
  }
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  const std::vector<float>& pixels = environment->GetPixels();
  const std::size_t texels = pixels.size() / 3;
  std::vector<double> luminances(texels);
  double total = 0.0;
  for (std::size_t k = 0; k < texels; ++k)
  {
    const double rgb[3] = { pixels[3 * k], pixels[3 * k + 1], pixels[3 * k + 2] };
    luminances[k] =
      environment->GetLuminance(rgb) *
      environment->GetTexelSolidAngle(static_cast<int>(k / static_cast<std::size_t>(width)));
    total += luminances[k];
  }
  const double least = total * std::max(share, Contrast / static_cast<double>(texels));
  std::vector<std::pair<double, int>> brightest;
  for (std::size_t k = 0; k < texels; ++k)
  {
    if (luminances[k] > least)
    {
      brightest.emplace_back(luminances[k], static_cast<int>(k));
    }
  }
  std::sort(brightest.begin(), brightest.end(), std::greater<std::pair<double, int>>());

  // Each texel's light, -1: none. The brightest texel of a light is its centre.
  std::vector<int> owners(texels, -1);
  std::vector<glm::dvec3> centres;
  bool all = true;
  for (const auto& texel : brightest)
  {
    glm::dvec3 direction;
    environment->GetTexelDirection(texel.second % width, texel.second / width, &direction.x);
    const auto near = [&](const glm::dvec3& centre)
    { return glm::distance(direction, centre) <= angle; };
    const auto found =
      angle > 0.0 ? std::find_if(centres.begin(), centres.end(), near) : centres.end();
    int& owner = owners[static_cast<std::size_t>(texel.second)];
    if (found != centres.end())
    {
      owner = static_cast<int>(found - centres.begin());
    }
    else if (centres.size() < static_cast<std::size_t>(maximum))
    {
      owner = static_cast<int>(centres.size());
      centres.push_back(direction);
    }
    else
    {
      all = false;
    }
  }

  this->Lights.resize(centres.size(), { glm::dvec3(0.0), glm::dvec3(0.0) });
  for (const auto& texel : brightest)
  {
    const int owner = owners[static_cast<std::size_t>(texel.second)];
    if (owner < 0)
    {
      continue;
    }
    const int x = texel.second % width;
    const int y = texel.second / width;
    // What is left is what its neighbours that are no lights show.
    glm::dvec3 sum(0.0);
    int neighbours = 0;
    for (int dy = -1; dy <= 1; ++dy)
    {
      for (int dx = -1; dx <= 1; ++dx)
      {
        const std::size_t k = static_cast<std::size_t>(
          std::clamp(y + dy, 0, height - 1) * width + (x + dx + width) % width);
        if (owners[k] < 0)
        {
          sum += glm::dvec3(pixels[3 * k], pixels[3 * k + 1], pixels[3 * k + 2]);
          ++neighbours;
        }
      }
    }
    Light& light = this->Lights[static_cast<std::size_t>(owner)];
    glm::dvec3 irradiance;
    for (int c = 0; c < 3; ++c)
    {
      float& value = this->Rest[3 * static_cast<std::size_t>(texel.second) + c];
      const double kept = std::min<double>(value, neighbours > 0 ? sum[c] / neighbours : 0.0);
      irradiance[c] = (value - kept) * environment->GetTexelSolidAngle(y);
      value = static_cast<float>(kept);
    }
    glm::dvec3 direction;
    environment->GetTexelDirection(x, y, &direction.x);
    light.Direction += environment->GetLuminance(&irradiance.x) * direction;
    light.Irradiance += irradiance;
  }
  for (std::size_t k = 0; k < this->Lights.size(); ++k)
  {
    const double length = glm::length(this->Lights[k].Direction);
    this->Lights[k].Direction = length > 0.0 ? this->Lights[k].Direction / length : centres[k];
  }
  return all;
}
} // namespace measuredbrdf
