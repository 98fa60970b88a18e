// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPanels.h"

#include "EnvironmentPyramid.h"
#include "HalfVector.h" // for Pi
#include "vtkLightSet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int Size = 32; // texels a side, of equal area
constexpr int Rounds = 60;
constexpr double LeastConcentration = 4.0;
constexpr double MostConcentration = 150.0; // as sharp as the texels
// Panels: docs/methods/self-occlusion.md has the errors of others.
constexpr double PanelConcentration = 40.0;
constexpr double PanelShare = 0.01; // least, of all light
constexpr std::size_t MostPanels = 12;

struct Texel
{
  glm::dvec3 Direction;
  glm::dvec3 Light; // radiance times solid angle
};

double Sum(const glm::dvec3& v) { return v.x + v.y + v.z; }

std::vector<Texel> ListTexels(const EnvironmentPyramid& map)
{
  std::vector<Texel> texels;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const glm::dvec3 d =
        EnvironmentPyramid::ToSphere((glm::dvec2(x, y) + 0.5) / static_cast<double>(Size));
      const glm::dvec3 radiance(map.Sample(glm::vec3(d), 0.0f));
      texels.push_back({ d, glm::max(radiance, glm::dvec3(0.0)) * (4.0 * Pi / (Size * Size)) });
    }
  }
  return texels;
}

// One of the mixture's lobes and what it has got of the light in this round.
struct Lobe
{
  EnvironmentPanels::Panel Panel;
  double Share;
  glm::dvec3 Mean = glm::dvec3(0.0);
  glm::dvec3 Light = glm::dvec3(0.0);

  double GetDensity(const glm::dvec3& d) const
  {
    const double k = this->Panel.Concentration;
    return this->Share * k / (2.0 * Pi * (1.0 - std::exp(-2.0 * k))) *
           std::exp(k * (glm::dot(d, this->Panel.Direction) - 1.0));
  }

  // The length of the mean direction gives the concentration.
  void Move(double all)
  {
    const double light = Sum(this->Light);
    const double length = glm::length(this->Mean);
    this->Share = light / all;
    this->Panel.Irradiance = this->Light;
    if (length > 0.0 && light > 0.0)
    {
      const double mean = std::min(length / light, 0.9999);
      this->Panel.Direction = this->Mean / length;
      this->Panel.Concentration =
        std::clamp(vtkLightSet::GetConcentrationOfVariance(1.0 - mean * mean), LeastConcentration,
          MostConcentration);
    }
    this->Mean = this->Light = glm::dvec3(0.0);
  }
};

void Fit(const std::vector<Texel>& texels, double all, std::vector<Lobe>& lobes)
{
  double uniform = 1.0 / static_cast<double>(lobes.size() + 1);
  std::vector<double> densities(lobes.size());
  for (int round = 0; round < Rounds; ++round)
  {
    double rest = 0.0;
    for (const Texel& texel : texels)
    {
      double sum = uniform / (4.0 * Pi);
      for (std::size_t k = 0; k < lobes.size(); ++k)
      {
        densities[k] = lobes[k].GetDensity(texel.Direction);
        sum += densities[k];
      }
      const double light = Sum(texel.Light);
      for (std::size_t k = 0; k < lobes.size() && sum > 0.0; ++k)
      {
        const double part = densities[k] / sum;
        lobes[k].Light += part * texel.Light;
        lobes[k].Mean += part * light * texel.Direction;
      }
      rest += sum > 0.0 ? uniform / (4.0 * Pi) / sum * light : 0.0;
    }
    uniform = rest / all;
    for (Lobe& lobe : lobes)
    {
      lobe.Move(all);
    }
  }
}
}

EnvironmentPanels::EnvironmentPanels(
  vtkEnvironment* environment, const TexelChanges* changes, vtkLightSet* lights)
{
  const std::vector<Texel> texels = ListTexels(EnvironmentPyramid(environment, changes, Size));
  double all = 0.0;
  for (const Texel& texel : texels)
  {
    all += Sum(texel.Light);
  }
  std::vector<Lobe> lobes;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    Lobe lobe = { { {}, glm::dvec3(0.0), 20.0 }, 1.0 / (lights->GetNumberOfLights() + 1) };
    lights->GetDirection(k, &lobe.Panel.Direction.x);
    lobes.push_back(lobe);
  }
  if (!(all > 0.0) || !std::isfinite(all))
  {
    return;
  }
  Fit(texels, all, lobes);
  for (const Lobe& lobe : lobes)
  {
    if (lobe.Panel.Concentration >= PanelConcentration && lobe.Share > PanelShare)
    {
      this->Panels.push_back(lobe.Panel);
    }
  }
  const auto brightness = [](const Panel& panel)
  { return Sum(panel.Irradiance) * panel.Concentration; };
  std::stable_sort(this->Panels.begin(), this->Panels.end(),
    [&brightness](const Panel& a, const Panel& b) { return brightness(a) > brightness(b); });
  this->Panels.resize(std::min(this->Panels.size(), MostPanels));
}
} // namespace measuredbrdf
