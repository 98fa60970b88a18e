// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanReference.h"

#include "KernelLayers.h"
#include "LobeSampler.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkVarianceLightSetGenerator.h"

#include <glm/gtc/type_ptr.hpp>

#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int NumberOfLights = 4096;
constexpr int Directions = 2048;
constexpr int MaximumSuns = 64;
constexpr double ResolvedAngle = 0.35; // sr, that the broad layer's lobes fill
constexpr double LeastShare = 2e-3;    // of the albedo: below, there is no sharp layer
}

vtkStandardNewMacro(PlanReference);

PlanReference::PlanReference() = default;
PlanReference::~PlanReference() = default;

bool PlanReference::Begin()
{
  vtkEnvironment* environment = this->Environment->GetSubdivided();
  BrightTexels bright(environment, BrightTexels::DefaultShare, MaximumSuns);
  this->Suns = std::move(bright.Lights);
  this->Rest = environment;
  if (!this->Suns.empty())
  {
    this->Rest = vtkSmartPointer<vtkEnvironment>::New();
    this->Rest->SetPixels(
      environment->GetWidth(), environment->GetHeight(), std::move(bright.Rest));
  }
  this->Broad = this->BRDF;
  this->Sharp = nullptr;
  if (this->BRDF->IsIsotropic())
  {
    const auto cut = std::make_shared<KernelCut>(this->BRDF, ResolvedAngle);
    if (cut->GetSharpShare() > LeastShare)
    {
      const auto layer = [&](bool sharp)
      {
        auto brdf = vtkSmartPointer<KernelLayer>::New();
        brdf->Set(this->BRDF, cut, sharp);
        return brdf;
      };
      this->Broad = layer(false);
      this->Sharp = layer(true);
    }
  }
  this->Lights = vtkSmartPointer<vtkLightSet>::New();
  vtkNew<vtkVarianceLightSetGenerator> generator;
  return generator->Generate(this->Rest, NumberOfLights, this->Lights);
}

void PlanReference::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const Frame frame = FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const glm::dvec3 view = LiftView(ToLocal(frame, glm::make_vec3(o)));
  glm::dvec3 sum(0.0);
  const auto add = [&](vtkBRDF* brdf, const glm::dvec3& direction, const glm::dvec3& irradiance)
  {
    const glm::dvec3 i = ToLocal(frame, direction);
    if (i.z > 0.0)
    {
      glm::dvec3 f;
      brdf->Evaluate(&i.x, &view.x, &f.x);
      sum += i.z * f * irradiance;
    }
  };
  for (const BrightTexels::Light& sun : this->Suns)
  {
    add(this->BRDF, sun.Direction, sun.Irradiance);
  }
  for (int k = 0; k < this->Lights->GetNumberOfLights(); ++k)
  {
    glm::dvec3 direction;
    glm::dvec3 irradiance;
    this->Lights->GetDirection(k, &direction.x);
    this->Lights->GetIrradiance(k, &irradiance.x);
    add(this->Broad, direction, irradiance);
  }
  if (this->Sharp)
  {
    const LobeSampler lobe(this->Sharp, view);
    for (int k = 0; k < Directions && !lobe.IsBlack(); ++k)
    {
      const glm::dvec2 u((k + 0.5) / Directions, RadicalInverse(static_cast<unsigned int>(k), 2));
      double density = 0.0;
      const glm::dvec3 i = lobe.Sample(u, density);
      if (i.z > 0.0)
      {
        const glm::dvec3 direction = frame * i;
        glm::dvec3 light;
        this->Rest->GetRadiance(&direction.x, &light.x);
        add(this->Sharp, direction, light / (density * Directions));
      }
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += sum[c];
  }
}
} // namespace measuredbrdf
