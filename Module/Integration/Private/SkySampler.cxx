// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SkySampler.h"

#include "HalfVector.h" // for Pi
#include "vtkEnvironment.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace measuredbrdf
{
namespace
{
// The mean over a texel of what is interpolated linearly between the middles of it and its
// neighbors.
constexpr double OwnShare = 0.75;
constexpr double NeighborShare = 0.125;
// Below this cosine of the latitude, next to a pole, densities per solid angle end.
constexpr double LeastCosine = 1e-6;

glm::dmat3 GetTurn(vtkEnvironment* environment)
{
  double m[9];
  environment->GetWorldToEnvironment(m);
  return glm::dmat3(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]); // glm takes columns
}
} // namespace

//------------------------------------------------------------------------------
SkySampler::SkySampler(vtkEnvironment* environment)
  : Environment(environment)
  , ToEnvironment(GetTurn(environment))
  , Width(static_cast<std::size_t>(environment->GetWidth()))
  , Height(static_cast<std::size_t>(environment->GetHeight()))
{
  const std::vector<float>& pixels = environment->GetPixels();
  std::vector<double> sums(this->Width * this->Height); // of the channels, mixed along rows
  const auto sum = [&](std::size_t x, std::size_t y)
  {
    const float* p = &pixels[3 * (y * this->Width + x)];
    return static_cast<double>(p[0]) + static_cast<double>(p[1]) + static_cast<double>(p[2]);
  };
  for (std::size_t y = 0; y < this->Height; ++y)
  {
    for (std::size_t x = 0; x < this->Width; ++x)
    {
      const std::size_t left = x > 0 ? x - 1 : this->Width - 1;
      const std::size_t right = x + 1 < this->Width ? x + 1 : 0;
      sums[y * this->Width + x] =
        OwnShare * sum(x, y) + NeighborShare * (sum(left, y) + sum(right, y));
    }
  }
  std::vector<double> weights(sums.size());
  for (std::size_t y = 0; y < this->Height; ++y)
  {
    const std::size_t below = y > 0 ? y - 1 : 0;
    const std::size_t above = std::min(y + 1, this->Height - 1);
    const double solidAngle = environment->GetTexelSolidAngle(static_cast<int>(y));
    for (std::size_t x = 0; x < this->Width; ++x)
    {
      weights[y * this->Width + x] =
        solidAngle *
        (OwnShare * sums[y * this->Width + x] +
          NeighborShare * (sums[below * this->Width + x] + sums[above * this->Width + x]));
    }
  }
  this->Texels = Distribution2D(weights, this->Width, this->Height);
}

//------------------------------------------------------------------------------
glm::dvec3 SkySampler::Sample(const glm::dvec2& u) const
{
  std::size_t x = 0;
  std::size_t y = 0;
  double inX = 0.0;
  double inY = 0.0;
  this->Texels.Invert(u.x, u.y, x, y, inX, inY);
  glm::dvec3 d;
  vtkEnvironment::GetDirection((static_cast<double>(x) + inX) / static_cast<double>(this->Width),
    (static_cast<double>(y) + inY) / static_cast<double>(this->Height), &d.x);
  return d * this->ToEnvironment; // transposed: back to the world
}

//------------------------------------------------------------------------------
double SkySampler::GetDensity(const glm::dvec3& direction) const
{
  const glm::dvec3 d = this->ToEnvironment * direction;
  double u = 0.0;
  double v = 0.0;
  vtkEnvironment::GetCoordinates(&d.x, u, v);
  const double width = static_cast<double>(this->Width);
  const double height = static_cast<double>(this->Height);
  const auto x = static_cast<std::size_t>(std::clamp(std::floor(u * width), 0.0, width - 1.0));
  const auto y = static_cast<std::size_t>(std::clamp(std::floor(v * height), 0.0, height - 1.0));
  const double cosine = std::max(std::sqrt(std::max(1.0 - d.y * d.y, 0.0)), LeastCosine);
  return this->Texels.GetProbability(x, y) * width * height / (2.0 * Pi * Pi * cosine);
}

//------------------------------------------------------------------------------
glm::dvec3 SkySampler::GetRadiance(const glm::dvec3& direction) const
{
  const glm::dvec3 d = this->ToEnvironment * direction;
  glm::dvec3 radiance;
  this->Environment->GetRadiance(&d.x, &radiance.x);
  return radiance;
}
} // namespace measuredbrdf
