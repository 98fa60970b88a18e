// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The part of MaterialDrawing that finds whether the materials of a frame are still those of the
// last one: a surface may have a thousand.
#include "MaterialDrawing.h"

#include "DrawsColor.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// A few materials are looked up as fast as compared.
constexpr std::size_t ManyUses = 8;
}

double MaterialDrawing::GetTolerance(vtkBRDF* brdf) const
{
  const double factor = this->ToleranceFactor ? this->ToleranceFactor(brdf) : 1.0;
  return std::min(factor * this->Settings->ErrorTolerance, LargestTolerance);
}

// Empty where the materials are to be looked up.
FrameStamp MaterialDrawing::GetStamp(const FrameState& state, const std::vector<MaterialUse>& uses)
{
  FrameStamp stamp;
  if (uses.size() < ManyUses || !state.Environment || !this->IsPlanned() || this->IsForView())
  {
    return stamp;
  }
  stamp.SettingsTime = this->Settings->GetMTime();
  stamp.Environment = state.Environment;
  stamp.EnvironmentTime = state.Environment->GetMTime();
  stamp.Hurries = state.Hurries;
  stamp.HasLight = HasLight(state.Renderer, state.Environment != nullptr);
  for (const MaterialUse& use : uses)
  {
    stamp.Uses.emplace_back(use.first, this->GetTolerance(use.first));
  }
  return stamp;
}

void MaterialDrawing::ResolveAll(
  ViewFrame& frame, const FrameState& state, const std::vector<MaterialUse>& uses)
{
  FrameStamp stamp = this->GetStamp(state, uses);
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(state.Renderer->GetVTKWindow());
  if (frame.Stays(stamp, window))
  {
    return;
  }
  this->AreUsesNew = true;
  const PlanJob::Hold hold;             // until what stands in is made
  std::vector<DrawnMaterial> materials; // the last ones stay until these have their textures
  for (const MaterialUse& use : uses)
  {
    materials.push_back(this->Resolve(use, state));
  }
  frame.Materials = std::move(materials);
  frame.Stamp = this->Plans.IsPending() ? FrameStamp() : std::move(stamp);
}
} // namespace measuredbrdf
