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
  : Rest(environment->GetPixels())
{
  if (share >= 1.0 || maximum <= 0)
  {
    return;
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
  brightest.resize(std::min(brightest.size(), static_cast<std::size_t>(maximum)));
  std::vector<char> taken(texels, 0);
  for (const auto& texel : brightest)
  {
    taken[static_cast<std::size_t>(texel.second)] = 1;
  }
  for (const auto& texel : brightest)
  {
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
        if (!taken[k])
        {
          sum += glm::dvec3(pixels[3 * k], pixels[3 * k + 1], pixels[3 * k + 2]);
          ++neighbours;
        }
      }
    }
    Light light;
    environment->GetTexelDirection(x, y, &light.Direction.x);
    for (int c = 0; c < 3; ++c)
    {
      float& value = this->Rest[3 * static_cast<std::size_t>(texel.second) + c];
      const double kept = std::min<double>(value, neighbours > 0 ? sum[c] / neighbours : 0.0);
      light.Irradiance[c] = (value - kept) * environment->GetTexelSolidAngle(y);
      value = static_cast<float>(kept);
    }
    this->Lights.push_back(light);
  }
}
} // namespace measuredbrdf
