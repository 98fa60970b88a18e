// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// MaterialDrawing's part in shading with what surfaces hide from themselves.
#include "MaterialDrawing.h"

#include "vtkMapper.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace measuredbrdf
{
std::shared_ptr<OcclusionArrays> MaterialDrawing::FindOcclusion(vtkPolyData* surface, bool isPart)
{
  const int mode = this->Settings->OcclusionMode;
  if (mode == 0 || !surface)
  {
    return nullptr;
  }
  auto* owner = vtkMapper::SafeDownCast(this->Owner);
  const bool make = mode == 2 && !isPart && owner;
  std::string problem;
  auto arrays = this->Occlusion.Find(
    surface, make ? owner->GetInputDataObject(0, 0) : nullptr, make, isPart, problem);
  if (!problem.empty() && this->WarnOnce("occlusion: " + problem))
  {
    vtkWarningWithObjectMacro(
      this->Owner, << "The surface is drawn as if it hid nothing from itself: " << problem << ".");
  }
  return arrays;
}

const OcclusionLight* MaterialDrawing::FindOcclusionLight(const DrawnMaterial& drawn)
{
  vtkRadianceIntegrator* integrator = drawn.Integrator;
  if (!integrator || !drawn.BRDF || !drawn.Environment || !integrator->NeedsEnvironment())
  {
    return nullptr;
  }
  const vtkMTimeType time = integrator->GetInputsMTime();
  const auto found = this->KnownLights.find(integrator);
  if (found != this->KnownLights.end() && found->second.Time == time)
  {
    return found->second.Light.get();
  }
  KnownLight known = { time,
    std::make_unique<OcclusionLight>(drawn.BRDF, drawn.Environment, integrator) };
  KnownLight& kept = this->KnownLights[integrator];
  kept = std::move(known);
  return kept.Light.get();
}

OcclusionLights MaterialDrawing::GetSelectedOcclusion(bool any)
{
  OcclusionLights lights;
  const DrawnMaterials& selected = this->Selected.Get();
  if (!any)
  {
    return lights;
  }
  if (selected.size() > MaximumOccludedMembers)
  {
    if (this->WarnOnce("occluded mixture"))
    {
      vtkWarningWithObjectMacro(this->Owner,
        << selected.size() << " materials meet on a part of the surface, which is drawn as if it "
        << "hid nothing from itself: that is done for up to " << MaximumOccludedMembers << ".");
    }
    return lights;
  }
  for (const DrawnMaterial* drawn : selected)
  {
    lights.push_back(this->FindOcclusionLight(*drawn));
  }
  const bool lit = std::any_of(
    lights.begin(), lights.end(), [](const OcclusionLight* light) { return light != nullptr; });
  return lit ? lights : OcclusionLights();
}

void MaterialDrawing::DropOcclusionLights()
{
  for (auto it = this->KnownLights.begin(); it != this->KnownLights.end();)
  {
    const bool last = it->first->GetReferenceCount() == 1; // nothing is drawn with it any more
    it = last ? this->KnownLights.erase(it) : std::next(it);
  }
}
} // namespace measuredbrdf
