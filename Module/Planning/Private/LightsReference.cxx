// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightsReference.h"

#include "HalfVector.h" // for Pi
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
// All lights, and fewer where the material tells them by little.
const std::vector<int> Counts = { 4096, 2048, 1024, 256 };
constexpr int Probes = 16;           // pairs that show by how much
constexpr double LittleError = 1e-3; // relative L1 over those, or
constexpr double OwnError = 2.5e-4;  // of all lights
constexpr double LittleShare = 0.05; // this share of the tolerance
constexpr std::size_t AtOnce = 128;  // lights above the horizon
}

vtkStandardNewMacro(LightsReference);

LightsReference::LightsReference() = default;
LightsReference::~LightsReference() = default;

bool LightsReference::Begin()
{
  const auto goOn = [this]() { return this->Report(0.0); };
  EnvironmentPrecomputation& parts = this->Environment->GetParts();
  const auto bright = parts.GetExtractedEmitters(
    this->Environment, ExtractedEmitters::DefaultShare, MaximumSuns, goOn);
  const auto sets = bright ? parts.GetLightSets(this->Environment, bright->Rest, Counts, goOn)
                           : std::vector<vtkSmartPointer<vtkLightSet>>();
  if (sets.empty())
  {
    vtkErrorMacro("Integrate: aborted.");
    return false;
  }
  this->Lanes = LightLanes(this->BRDF);
  this->Suns = Lights();
  for (const ExtractedEmitters::Light& sun : bright->Lights)
  {
    this->Suns.Directions.push_back(sun.Direction);
    this->Suns.Irradiances.push_back(sun.Irradiance);
  }
  this->Others = GetLights(sets.front());
  this->ChooseLights(sets);
  return true;
}

// Broad lobes do not tell a few hundred lights from all of them. Some pairs show whether this one
// does.
void LightsReference::ChooseLights(const std::vector<vtkSmartPointer<vtkLightSet>>& sets)
{
  const double least = std::min(LittleError, LittleShare * this->ErrorTolerance);
  struct Pair
  {
    Frame Local;
    glm::dvec3 View;
  };
  std::vector<Pair> pairs;
  std::vector<glm::dvec3> all;
  double total = 0.0;
  for (unsigned int k = 1; k <= Probes; ++k)
  {
    // Normals over the sphere, views of a sphere's disc.
    const double z = 2.0 * RadicalInverse(k, 2) - 1.0;
    const double azimuth = 2.0 * Pi * RadicalInverse(k, 3);
    const double s = std::sqrt(1.0 - z * z);
    const double cosine = std::sqrt(RadicalInverse(k, 5));
    const Frame frame =
      FrameAbout(glm::dvec3(s * std::cos(azimuth), z, s * std::sin(azimuth)), glm::dvec3(0.0));
    const double turn = 2.0 * Pi * RadicalInverse(k, 7);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    pairs.push_back(
      { frame, LiftView(glm::dvec3(sine * std::cos(turn), sine * std::sin(turn), cosine)) });
    all.push_back(this->Sum(this->Others, frame, pairs.back().View));
    total += all.back().x + all.back().y + all.back().z;
  }
  this->Error = OwnError;
  for (std::size_t set = sets.size() - 1; set > 0; --set) // the fewest first
  {
    Lights lights = GetLights(sets[set]);
    double difference = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k)
    {
      const glm::dvec3 d = glm::abs(this->Sum(lights, pairs[k].Local, pairs[k].View) - all[k]);
      difference += d.x + d.y + d.z;
    }
    if (difference <= least * total)
    {
      this->Others = std::move(lights);
      this->Error = OwnError + difference / std::max(total, 1e-30);
      break;
    }
  }
}

LightsReference::Lights LightsReference::GetLights(vtkLightSet* set)
{
  const std::size_t count = static_cast<std::size_t>(set->GetNumberOfLights());
  Lights lights{ std::vector<glm::dvec3>(count), std::vector<glm::dvec3>(count) };
  for (std::size_t k = 0; k < count; ++k)
  {
    set->GetDirection(static_cast<int>(k), &lights.Directions[k].x);
    set->GetIrradiance(static_cast<int>(k), &lights.Irradiances[k].x);
  }
  return lights;
}

glm::dvec3 LightsReference::Sum(
  const Lights& lights, const Frame& frame, const glm::dvec3& view) const
{
  std::array<glm::dvec3, AtOnce> above, irradiances, values;
  glm::dvec3 sum(0.0);
  const std::size_t count = lights.Directions.size();
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    above[found] = ToLocal(frame, lights.Directions[k]);
    irradiances[found] = lights.Irradiances[k];
    found += above[found].z > 0.0 ? 1 : 0;
    if (found == AtOnce || k + 1 == count)
    {
      this->Lanes.Evaluate(found, above.data(), view, values.data());
      for (std::size_t n = 0; n < found; ++n)
      {
        sum += above[n].z * values[n] * irradiances[n];
      }
      found = 0;
    }
  }
  return sum;
}

void LightsReference::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const Frame frame = FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const glm::dvec3 view = LiftView(ToLocal(frame, glm::make_vec3(o)));
  const glm::dvec3 sum = this->Sum(this->Others, frame, view) + this->Sum(this->Suns, frame, view);
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += sum[c];
  }
}
} // namespace measuredbrdf
