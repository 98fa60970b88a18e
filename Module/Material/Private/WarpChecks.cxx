// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WarpChecks.h"

#include "BilinearWarp.h"
#include "HalfVector.h" // for Pi
#include "NumberText.h"
#include "RoundingNoise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr float AngleNoise = 1e-5f;
}

std::string CheckAxis(const char* name, std::vector<float>& axis)
{
  bool ascending = !axis.empty() && std::isfinite(axis.front());
  const float first = axis.empty() ? 0.0f : axis.front();
  for (std::size_t k = 1; ascending && k < axis.size(); ++k)
  {
    ascending = std::isfinite(axis[k]) && axis[k] >= axis[k - 1] - AngleNoise;
    axis[k] = std::max(axis[k], std::nextafter(axis[k - 1], HUGE_VALF));
  }
  ascending = ascending && (axis.size() == 1 || axis.back() - first > 0.5f * AngleNoise);
  return ascending ? "" : std::string(name) + ": expected ascending finite angles";
}

std::string CheckTable(const char* name, const std::vector<int>& shape,
  const std::vector<float>& values, const std::vector<int>& prefix)
{
  std::size_t count = 1;
  for (int n : shape)
  {
    if (n < 1 || n > (1 << 20) || count > (std::size_t(1) << 40))
    {
      return std::string(name) + ": shape out of range";
    }
    count *= static_cast<std::size_t>(n);
  }
  if (shape.size() != prefix.size() + 2 ||
      !std::equal(prefix.begin(), prefix.end(), shape.begin()) || shape[prefix.size()] < 2 ||
      shape[prefix.size() + 1] < 2 || values.size() != count)
  {
    return std::string(name) + ": shape does not match theta_i, phi_i or its values";
  }
  if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }))
  {
    return std::string(name) + ": expected finite values";
  }
  return "";
}

std::string CheckSpan(const std::vector<float>& phi)
{
  if (phi.size() <= 2)
  {
    return "";
  }
  const double span = static_cast<double>(phi.back()) - phi.front();
  const double parts = 2.0 * Pi / span;
  const double whole = std::round(parts);
  if ((whole != 1.0 && whole != 2.0 && whole != 4.0) || std::abs(parts - whole) > 0.05)
  {
    return "phi_i: found a span of " + NumberText(span * 180.0 / Pi) +
           " degrees, expected 360, 180 or 90";
  }
  // Mirrors are the planes of x and y.
  const double start = phi.front() / (0.5 * Pi);
  if (whole == 4.0 && std::abs(start - std::round(start)) > 0.05)
  {
    return "phi_i: found a quarter turn from " + NumberText(phi.front() * 180.0 / Pi) +
           " degrees, expected one from a multiple of 90";
  }
  return "";
}

std::string CheckDensity(
  const char* name, const std::vector<int>& shape, std::vector<float>& values)
{
  const int height = shape[shape.size() - 2];
  const int width = shape[shape.size() - 1];
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (!ClearNoise(values))
  {
    return std::string(name) + ": a density cannot be negative";
  }
  for (std::size_t offset = 0; offset < values.size(); offset += size)
  {
    if (!(BilinearWarp::GetSum(&values[offset], width, height) > 0.0))
    {
      return std::string(name) + ": a density cannot be 0 everywhere";
    }
  }
  return "";
}
} // namespace measuredbrdf
