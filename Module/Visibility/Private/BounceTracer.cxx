// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BounceTracer.h"

#include "LocalFrame.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstddef>

namespace measuredbrdf
{
BounceTracer::BounceTracer(const SurfaceTracer& tracer, const std::vector<SurfaceArrays>& surfaces,
  int elevations, double farthest)
  : Tracer(tracer)
  , Surfaces(surfaces)
  , Rays(elevations)
  , Farthest(farthest)
{
}

// The irradiance at what a ray has met, on the side that it came from.
BouncedLight::Transfer BounceTracer::GetVisible(
  const SurfaceTracer::Hit& hit, const glm::dvec3& direction) const
{
  BouncedLight::Transfer sum{};
  const auto surface = static_cast<std::size_t>(hit.Surface);
  if (surface >= this->Surfaces.size())
  {
    return sum; // an occluder, of which nothing is known
  }
  const std::vector<SideArrays>& sides = this->Surfaces[surface].Sides;
  const glm::dvec3 facet = glm::make_vec3(hit.Normal);
  HiddenSky::Code codes[3];
  glm::dvec3 normal(0.0);
  for (int k = 0; k < 3; ++k)
  {
    codes[k] = sides[0].Get(hit.Points[k]);
    normal += HiddenSky::UnpackNormal(codes[k].data());
  }
  const bool isBack = (glm::dot(normal, facet) > 0.0) == (glm::dot(facet, direction) > 0.0);
  if (isBack && sides.size() < 2)
  {
    return sum;
  }
  for (int k = 0; k < 3; ++k)
  {
    const BouncedLight::Transfer corner =
      BouncedLight::GetVisible(isBack ? sides[1].Get(hit.Points[k]) : codes[k]);
    for (std::size_t j = 0; j < sum.size(); ++j)
    {
      sum[j] += hit.Barycentrics[k] * corner[j];
    }
  }
  return sum;
}

BouncedLight::Code BounceTracer::Trace(
  const SurfaceVertex& point, double side, const HiddenSky::Code& code) const
{
  const HiddenSky sky(code);
  const double hidden = sky.GetHiddenCosine();
  if (hidden <= 0.0 || glm::dot(point.Normal, point.Normal) == 0.0)
  {
    return BouncedLight::MakeDark();
  }
  const glm::dmat3 frame = FrameAbout(sky.GetNormal());
  const glm::dvec3 face = side * point.FaceNormal;
  glm::dvec3 origin;
  this->Tracer.OffsetOrigin(&point.Origin.x, &face.x, &face.x, &origin.x);
  BouncedLight::Transfer sum{};
  double met = 0.0;
  for (const glm::dvec3& ray : this->Rays.GetDirections())
  {
    const glm::dvec3 direction = frame * ray;
    SurfaceTracer::Hit hit;
    if (this->Tracer.Intersect(&origin.x, &direction.x, 0.0, this->Farthest, hit))
    {
      const BouncedLight::Transfer visible = this->GetVisible(hit, direction);
      for (std::size_t j = 0; j < sum.size(); ++j)
      {
        sum[j] += ray.z * visible[j];
      }
      met += ray.z;
    }
  }
  // The mean over what these rays meet, of the share that all rays found to be hidden.
  for (double& value : sum)
  {
    value *= met > 0.0 ? hidden / met : 0.0;
  }
  return BouncedLight::Encode(sum);
}
} // namespace measuredbrdf
