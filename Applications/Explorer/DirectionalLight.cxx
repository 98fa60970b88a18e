// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DirectionalLight.h"

#include "LocalFrame.h"
#include "Methods.h"
#include "ParallelFor.h"

#include "vtkBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkLight.h"
#include "vtkMath.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace explorer
{
//------------------------------------------------------------------------------
std::array<double, 3> GetDirection(const LightState& light)
{
  const double theta = vtkMath::RadiansFromDegrees(light.Theta);
  const double phi = vtkMath::RadiansFromDegrees(light.Phi);
  return { std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi) };
}

//------------------------------------------------------------------------------
void SetDirection(LightState& light, const double direction[3])
{
  const double across = std::hypot(direction[0], direction[2]);
  light.Theta = vtkMath::DegreesFromRadians(std::atan2(across, direction[1]));
  if (across > 0.0) // straight above and below it keeps its azimuth
  {
    light.Phi = vtkMath::DegreesFromRadians(std::atan2(direction[0], direction[2]));
  }
}

//------------------------------------------------------------------------------
void PlaceLight(vtkLight* light, const LightState& state)
{
  const std::array<double, 3> direction = GetDirection(state);
  light->SetLightTypeToSceneLight();
  light->PositionalOff();
  light->SetColor(1.0, 1.0, 1.0);
  light->SetIntensity(state.Irradiance);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetPosition(direction[0], direction[1], direction[2]);
}

//------------------------------------------------------------------------------
std::vector<double> DrawDirectional(
  vtkBRDF* brdf, const tool::Surface& surface, const LightState& light)
{
  const std::array<double, 3> direction = GetDirection(light);
  const auto tangents = tool::MakeTangents(surface.Normals);
  brdf->Prepare();
  std::vector<double> radiance(surface.Normals.size());
  measuredbrdf::ParallelFor(0, tangents->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        const auto at = static_cast<std::size_t>(3 * k);
        double tangent[3];
        tangents->GetTuple(k, tangent);
        const measuredbrdf::Frame frame =
          measuredbrdf::FrameAbout(glm::make_vec3(&surface.Normals[at]), glm::make_vec3(tangent));
        const glm::dvec3 i = measuredbrdf::ToLocal(frame, glm::make_vec3(direction.data()));
        const glm::dvec3 o = measuredbrdf::ToLocal(frame, glm::make_vec3(&surface.Views[at]));
        glm::dvec3 f;
        brdf->Evaluate(&i.x, &o.x, &f.x);
        f *= light.Irradiance * std::max(0.0, i.z);
        std::copy_n(&f.x, 3, &radiance[at]);
      }
    });
  return radiance;
}
} // namespace explorer
