// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightsReference.h"

#include "EnvironmentPrecomputation.h"
#include "LocalFrame.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t AtOnce = 128; // lights above the horizon
}

vtkStandardNewMacro(LightsReference);

LightsReference::LightsReference()
  : NumberOfLights(GetCounts().front())
{
}

LightsReference::~LightsReference() = default;

const std::vector<int>& LightsReference::GetCounts()
{
  static const auto& counts = *new std::vector<int>{ 4096, 2048, 1024, 256 }; // for threads, too
  return counts;
}

bool LightsReference::Begin()
{
  const auto goOn = [this]() { return this->Report(0.0); };
  EnvironmentPrecomputation& parts = this->Environment->GetParts();
  const auto bright = parts.GetExtractedEmitters(
    this->Environment, ExtractedEmitters::DefaultShare, MaximumSuns, goOn);
  const std::vector<int>& counts = GetCounts();
  const auto sets = bright ? parts.GetLightSets(this->Environment, bright->Rest, counts, goOn)
                           : std::vector<vtkSmartPointer<vtkLightSet>>();
  if (sets.empty())
  {
    vtkErrorMacro("Integrate: aborted.");
    return false;
  }
  this->Lanes = LightLanes(this->BRDF);
  this->Directions.clear();
  this->Irradiances.clear();
  for (const ExtractedEmitters::Light& sun : bright->Lights)
  {
    this->Directions.push_back(sun.Direction);
    this->Irradiances.push_back(sun.Irradiance);
  }
  const auto which = std::find(counts.begin(), counts.end(), this->NumberOfLights);
  vtkLightSet* others = sets[static_cast<std::size_t>(which - counts.begin())];
  for (int k = 0; k < others->GetNumberOfLights(); ++k)
  {
    glm::dvec3 direction, irradiance;
    others->GetDirection(k, &direction.x);
    others->GetIrradiance(k, &irradiance.x);
    this->Directions.push_back(direction);
    this->Irradiances.push_back(irradiance);
  }
  return true;
}

void LightsReference::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const Frame frame = FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const glm::dvec3 view = LiftView(ToLocal(frame, glm::make_vec3(o)));
  std::array<glm::dvec3, AtOnce> above, irradiances, values;
  glm::dvec3 sum(0.0);
  const std::size_t count = this->Directions.size();
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    above[found] = ToLocal(frame, this->Directions[k]);
    irradiances[found] = this->Irradiances[k];
    found += above[found].z > 0.0 ? 1 : 0;
    if (found == AtOnce || k + 1 == count)
    {
      this->Lanes.Evaluate(found, above.data(), view, values.data());
      for (std::size_t j = 0; j < found; ++j)
      {
        sum += above[j].z * values[j] * irradiances[j];
      }
      found = 0;
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += sum[c];
  }
}
} // namespace measuredbrdf
