// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelChanges.h"

#include "TexelInterpolation.h"

#include <algorithm>

const float* vtkEnvironment::TexelChanges::GetRow(
  vtkEnvironment* environment, int y, int x0, int x1, std::vector<float>& room) const
{
  const std::size_t row =
    static_cast<std::size_t>(y) * static_cast<std::size_t>(environment->GetWidth());
  const std::size_t first = row + static_cast<std::size_t>(x0);
  const std::size_t last = row + static_cast<std::size_t>(x1);
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

void vtkEnvironment::TexelChanges::GetRadiance(
  vtkEnvironment* environment, const double direction[3], double rgb[3]) const
{
  if (this->Texels.empty())
  {
    environment->GetRadiance(direction, rgb);
    return;
  }
  double u;
  double v;
  vtkEnvironment::GetCoordinates(direction, u, v);
  const std::size_t width = static_cast<std::size_t>(environment->GetWidth());
  const float* pixels = environment->GetPixels().data();
  measuredbrdf::InterpolateTexels(
    width, static_cast<std::size_t>(environment->GetHeight()), u, v,
    [&](std::size_t x, std::size_t y)
    {
      const std::size_t index = y * width + x;
      const auto found =
        std::lower_bound(this->Texels.begin(), this->Texels.end(), Texel{ index, {} });
      return found != this->Texels.end() && found->Index == index ? &found->Radiance.x
                                                                  : pixels + 3 * index;
    },
    rgb);
}
