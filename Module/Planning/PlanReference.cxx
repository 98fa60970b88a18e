// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanReference.h"

#include "KernelLayers.h"
#include "LobeSampler.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "RadianceParts.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr int NumberOfLights = 4096;
constexpr int FewestDirections = 256;
constexpr int MostDirections = 2048;
constexpr double FullShare = 0.25; // of the albedo, that a sharp layer has to get the most
constexpr int MaximumSuns = 64;
constexpr double ResolvedAngle = 0.35; // sr, that the broad layer's lobes fill
constexpr double LeastShare = 2e-3;    // of the albedo: below, there is no sharp layer
}

vtkStandardNewMacro(PlanReference);

PlanReference::PlanReference() = default;
PlanReference::~PlanReference() = default;

bool PlanReference::Begin()
{
  const auto goOn = [this]() { return this->Report(0.0); };
  EnvironmentParts& parts = this->Environment->GetParts();
  const auto bright =
    parts.GetBrightTexels(this->Environment, BrightTexels::DefaultShare, MaximumSuns, goOn);
  const auto lights =
    bright ? parts.GetLightSet(this->Environment, bright->Rest, NumberOfLights, goOn) : nullptr;
  if (!lights)
  {
    vtkErrorMacro("Integrate: aborted.");
    return false;
  }
  this->Suns = bright->Lights;
  this->Rest = bright->Rest;
  this->Lights.resize(static_cast<std::size_t>(lights->GetNumberOfLights()));
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    BrightTexels::Light& light = this->Lights[static_cast<std::size_t>(k)];
    lights->GetDirection(k, &light.Direction.x);
    lights->GetIrradiance(k, &light.Irradiance.x);
  }
  this->Cut = nullptr;
  this->Lobes = nullptr;
  if (this->BRDF->IsIsotropic())
  {
    const auto known = this->Parts ? this->Parts : std::make_shared<RadianceParts>();
    const auto cut = std::make_shared<KernelCut>(known->GetViews(this->BRDF), ResolvedAngle);
    if (cut->GetSharpShare() > LeastShare)
    {
      auto sharp = vtkSmartPointer<KernelLayer>::New();
      sharp->Set(this->BRDF, cut, true);
      this->Sharp = sharp;
      this->Lobes = std::make_unique<LobeTable>(sharp);
      this->Cut = cut;
    }
  }
  return true;
}

void PlanReference::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  Frame frame = FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  glm::dvec3 view = LiftView(ToLocal(frame, glm::make_vec3(o)));
  if (this->Cut) // isotropic: any frame about the normal does, this one has the view over its x
  {
    const double s = std::hypot(view.x, view.y);
    const glm::dvec2 a = s > 1e-6 ? glm::dvec2(view) / s : glm::dvec2(1.0, 0.0);
    frame = Frame(frame * glm::dvec3(a, 0.0), frame * glm::dvec3(-a.y, a.x, 0.0), frame[2]);
    view = glm::dvec3(s, 0.0, view.z);
  }
  const KernelCut::View cut = this->Cut ? this->Cut->GetView(view) : KernelCut::View();
  glm::dvec3 sum(0.0);
  const auto evaluate = [&](const glm::dvec3& i)
  {
    glm::dvec3 f;
    this->BRDF->Evaluate(&i.x, &view.x, &f.x);
    return f;
  };
  for (const BrightTexels::Light& sun : this->Suns)
  {
    const glm::dvec3 i = ToLocal(frame, sun.Direction);
    if (i.z > 0.0)
    {
      sum += i.z * evaluate(i) * sun.Irradiance;
    }
  }
  for (const BrightTexels::Light& light : this->Lights)
  {
    const glm::dvec3 i = ToLocal(frame, light.Direction);
    if (i.z > 0.0)
    {
      const glm::dvec3 f = evaluate(i);
      sum += i.z * (this->Cut ? cut.GetBroad(f, i.z) : f) * light.Irradiance;
    }
  }
  if (this->Cut)
  {
    const TexelChanges none;
    const TexelChanges& rest = this->Rest ? *this->Rest : none;
    const LobeSampler lobe(this->Sharp, view, this->Lobes.get());
    // A smaller share of the radiance may be less accurate.
    const int directions = std::clamp(
      static_cast<int>(MostDirections * cut.Share / FullShare), FewestDirections, MostDirections);
    for (int k = 0; k < directions && !lobe.IsBlack(); ++k)
    {
      const glm::dvec2 u((k + 0.5) / directions, RadicalInverse(static_cast<unsigned int>(k), 2));
      double density = 0.0;
      const glm::dvec3 i = lobe.Sample(u, density);
      if (i.z > 0.0)
      {
        const glm::dvec3 direction = frame * i;
        glm::dvec3 light;
        rest.GetRadiance(this->Environment->GetSubdivided(), &direction.x, &light.x);
        const glm::dvec3 f = evaluate(i);
        sum += (f - cut.GetBroad(f, i.z)) * light * (i.z / (density * directions));
      }
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += sum[c];
  }
}
} // namespace measuredbrdf
