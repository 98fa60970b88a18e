// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanPictures.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr double LeastSine = 0.05; // of twice the view's angle: few pairs look from there
}

PictureSums::PictureSums(double width)
  : Width(glm::radians(width))
{
}

void PictureSums::Add(const PlanPairs& pairs, const std::vector<double>& differences,
  const std::vector<double>& references)
{
  const std::size_t cameras = pairs.Cameras.size() / 3;
  this->Differences.resize(cameras);
  this->References.resize(cameras);
  for (std::size_t k = 0; k < differences.size(); ++k)
  {
    const auto tuple = static_cast<vtkIdType>(k);
    const glm::dvec3 normal = glm::make_vec3(pairs.Normals->GetPointer(3 * tuple));
    const glm::dvec3 view = glm::make_vec3(pairs.Views->GetPointer(3 * tuple));
    const double cosine = std::clamp(glm::dot(normal, view), -1.0, 1.0);
    const glm::dvec3 mirror = 2.0 * cosine * normal - view;
    const double turned = 2.0 * std::acos(cosine); // from the view to the mirror direction
    const double density = std::max(std::sin(turned), LeastSine); // of views that do so
    for (std::size_t c = 0; c < cameras; ++c)
    {
      const double seen = glm::dot(mirror, glm::make_vec3(&pairs.Cameras[3 * c]));
      const double x = (std::acos(std::clamp(seen, -1.0, 1.0)) - turned) / this->Width;
      const double share = std::max(1.0 - x * x, 0.0) / density;
      this->Differences[c] += share * differences[k];
      this->References[c] += share * references[k];
    }
    this->AllDifferences += differences[k];
    this->AllReferences += references[k];
  }
}

std::vector<double> PictureSums::GetRatios() const
{
  std::vector<double> ratios;
  if (!(this->AllDifferences > 0.0) || !(this->AllReferences > 0.0))
  {
    return ratios;
  }
  for (std::size_t c = 0; c < this->References.size(); ++c)
  {
    const double error =
      this->References[c] > 0.0 ? this->Differences[c] / this->References[c] : 0.0;
    ratios.push_back(error * this->AllReferences / this->AllDifferences);
  }
  return ratios;
}
} // namespace measuredbrdf
