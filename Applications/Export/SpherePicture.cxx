// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SpherePicture.h"

#include "vtkMath.h"

#include <cmath>

namespace tool
{
//------------------------------------------------------------------------------
std::array<double, 3> GetViewDirection(const View& view)
{
  const double azimuth = vtkMath::RadiansFromDegrees(view.Azimuth);
  const double elevation = vtkMath::RadiansFromDegrees(view.Elevation);
  return { std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth) };
}

//------------------------------------------------------------------------------
Surface MakeSphereSurface(int size, const View& view)
{
  const std::array<double, 3> eye = GetViewDirection(view);
  const double azimuth = vtkMath::RadiansFromDegrees(view.Azimuth);
  const double right[3] = { std::cos(azimuth), 0.0, -std::sin(azimuth) };
  double up[3];
  vtkMath::Cross(eye.data(), right, up);
  Surface surface;
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const double u = 2.0 * (x + 0.5) / size - 1.0;
      const double v = 2.0 * (y + 0.5) / size - 1.0;
      const double depth2 = 1.0 - u * u - v * v;
      if (depth2 <= 0.0)
      {
        continue;
      }
      surface.Pixels.push_back(y * size + x);
      for (std::size_t c = 0; c < 3; ++c)
      {
        surface.Normals.push_back(u * right[c] + v * up[c] + std::sqrt(depth2) * eye[c]);
        surface.Views.push_back(eye[c]);
      }
    }
  }
  surface.NumberOfCovered = static_cast<int>(surface.Pixels.size());
  return surface;
}
} // namespace tool
