// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelChanges.h"

#include "Neighbors.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

const float* vtkEnvironment::TexelChanges::GetRow(
  vtkEnvironment* environment, int y, int x0, int x1, std::vector<float>& room) const
{
  const std::size_t row = static_cast<std::size_t>(y) * environment->GetWidth();
  const std::size_t first = row + x0;
  const std::size_t last = row + x1;
  const float* pixels = environment->GetPixels().data() + 3 * first;
  auto change = std::lower_bound(this->Texels.begin(), this->Texels.end(), Texel{ first, {} });
  if (change == this->Texels.end() || change->Index >= last)
  {
    return pixels;
  }
  room.assign(pixels, pixels + 3 * (last - first));
  for (; change != this->Texels.end() && change->Index < last; ++change)
  {
    std::copy_n(&change->Radiance.x, 3, &room[3 * (change->Index - first)]);
  }
  return room.data();
}

glm::dvec3 vtkEnvironment::TexelChanges::Interpolate(
  vtkEnvironment* environment, double u, double v) const
{
  const int width = environment->GetWidth();
  const float* pixels = environment->GetPixels().data();
  return measuredbrdf::InterpolateTexels(width, environment->GetHeight(), u, v,
    [&](std::size_t x, std::size_t y)
    {
      const std::size_t index = y * width + x;
      const auto found =
        std::lower_bound(this->Texels.begin(), this->Texels.end(), Texel{ index, {} });
      return glm::dvec3(found != this->Texels.end() && found->Index == index
                          ? found->Radiance
                          : glm::make_vec3(pixels + 3 * index));
    });
}
