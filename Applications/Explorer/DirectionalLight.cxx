// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DirectionalLight.h"

#include "LocalFrame.h"
#include "Methods.h"
#include "Tool.h"

#include "vtkBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkNew.h"

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
  vtkNew<vtkDoubleArray> lights;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> values;
  for (vtkDoubleArray* array : { lights.Get(), views.Get() })
  {
    array->SetNumberOfComponents(3);
    array->Allocate(static_cast<vtkIdType>(surface.Normals.size()));
  }
  for (std::size_t k = 0; k < surface.Normals.size(); k += 3)
  {
    glm::dvec3 tangent;
    tangents->GetTuple(static_cast<vtkIdType>(k / 3), &tangent.x);
    const measuredbrdf::Frame frame =
      measuredbrdf::FrameAbout(glm::make_vec3(&surface.Normals[k]), tangent);
    const glm::dvec3 towards = measuredbrdf::ToLocal(frame, glm::make_vec3(direction.data()));
    const glm::dvec3 view = measuredbrdf::ToLocal(frame, glm::make_vec3(&surface.Views[k]));
    lights->InsertNextTuple(&towards.x);
    views->InsertNextTuple(&view.x);
  }
  if (!brdf->EvaluateArray(lights, views, values))
  {
    throw tool::Error("exact picture: " + tool::TakeErrorText());
  }
  std::vector<double> radiance(surface.Normals.size());
  for (std::size_t k = 0; k < radiance.size(); ++k)
  {
    const double cosine = lights->GetValue(static_cast<vtkIdType>(k - k % 3 + 2));
    radiance[k] =
      values->GetValue(static_cast<vtkIdType>(k)) * light.Irradiance * std::max(0.0, cosine);
  }
  return radiance;
}
} // namespace explorer
