// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPanels.h"

#include "EnvironmentPyramid.h"
#include "HalfVector.h" // for Pi
#include "vtkLightSet.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace measuredbrdf
{
namespace
{
constexpr int Size = 32; // texels a side, of equal area
constexpr int Rounds = 60;
constexpr double FirstConcentration = 20.0;
constexpr double LeastConcentration = 4.0;
constexpr double MostConcentration = 150.0; // as sharp as the texels
// Panels: docs/methods/self-occlusion.md has the errors of others.
constexpr double PanelConcentration = 40.0;
constexpr double PanelShare = 0.01; // least, of all light
constexpr std::size_t MostPanels = 12;
}

EnvironmentPanels::EnvironmentPanels(
  vtkEnvironment* environment, const TexelChanges& changes, vtkLightSet* lights)
{
  using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  const EnvironmentPyramid map(environment, changes, Size);
  Vectors directions(Size * Size, 3), light(Size * Size, 3); // of texels
  for (int k = 0; k < Size * Size; ++k)
  {
    const glm::dvec3 d = EnvironmentPyramid::ToSphere(
      (glm::dvec2(k % Size, k / Size) + 0.5) / static_cast<double>(Size));
    const glm::vec3 radiance = map.Sample(glm::vec3(d), 0.0f);
    directions.row(k) << d.x, d.y, d.z;
    light.row(k) << radiance.x, radiance.y, radiance.z;
  }
  light = light.cwiseMax(0.0) * (4.0 * Pi / (Size * Size));
  const Eigen::ArrayXd sums = light.rowwise().sum();
  const double all = sums.sum();
  if (!(all > 0.0) || !std::isfinite(all))
  {
    return;
  }
  const int count = lights->GetNumberOfLights();
  Vectors axes(count, 3), received(count, 3); // of lobes
  for (int k = 0; k < count; ++k)
  {
    glm::dvec3 d;
    lights->GetDirection(k, &d.x);
    axes.row(k) << d.x, d.y, d.z;
  }
  Eigen::ArrayXd concentrations = Eigen::ArrayXd::Constant(count, FirstConcentration);
  double uniform = 1.0 / (count + 1);
  Eigen::ArrayXd shares = Eigen::ArrayXd::Constant(count, uniform); // of all light
  for (int round = 0; round < Rounds; ++round)
  {
    // Of a texel's light, the parts that belong to the lobes: by their densities.
    const Eigen::ArrayXd scales =
      shares * concentrations / (2.0 * Pi * (1.0 - (-2.0 * concentrations).exp()));
    Eigen::ArrayXXd parts = (directions * axes.transpose()).array() - 1.0;
    parts = (parts.rowwise() * concentrations.transpose()).exp().rowwise() * scales.transpose();
    const Eigen::ArrayXd densities =
      (parts.rowwise().sum() + uniform / (4.0 * Pi)).max(std::numeric_limits<double>::min());
    parts.colwise() /= densities;
    uniform *= (sums / densities).sum() / (4.0 * Pi * all);
    received = parts.matrix().transpose() * light;
    const Vectors means =
      parts.matrix().transpose() * (directions.array().colwise() * sums).matrix();
    shares = received.rowwise().sum() / all;
    for (int k = 0; k < count; ++k)
    {
      // The length of the mean direction gives the concentration.
      const double length = means.row(k).norm();
      if (length > 0.0 && shares[k] > 0.0)
      {
        const double mean = std::min(length / (all * shares[k]), 0.9999);
        axes.row(k) = means.row(k) / length;
        concentrations[k] = std::clamp(vtkLightSet::GetConcentrationOfVariance(1.0 - mean * mean),
          LeastConcentration, MostConcentration);
      }
    }
  }
  for (int k = 0; k < count; ++k)
  {
    if (concentrations[k] >= PanelConcentration && shares[k] > PanelShare)
    {
      this->Panels.push_back({ { axes(k, 0), axes(k, 1), axes(k, 2) },
        { received(k, 0), received(k, 1), received(k, 2) }, concentrations[k] });
    }
  }
  const auto brightness = [](const Panel& panel)
  { return (panel.Irradiance.x + panel.Irradiance.y + panel.Irradiance.z) * panel.Concentration; };
  std::stable_sort(this->Panels.begin(), this->Panels.end(),
    [&brightness](const Panel& a, const Panel& b) { return brightness(a) > brightness(b); });
  this->Panels.resize(std::min(this->Panels.size(), MostPanels));
}
} // namespace measuredbrdf
