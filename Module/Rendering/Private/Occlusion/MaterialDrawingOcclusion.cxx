// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// MaterialDrawing's part in shading with what surfaces hide from themselves.
#include "MaterialDrawing.h"

#include "SharedTrace.h"
#include "SurfaceBlocks.h"
#include "TextureEnvironment.h"
#include "vtkActor.h"
#include "vtkEnvironment.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderer.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Arrays of whoever made the surface.
bool HasArrays(vtkPolyData* surface)
{
  return surface->GetPointData()->HasArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName());
}

// From a surface's axes to those in which the renderer's environment is given.
vtkSmartPointer<vtkMatrix4x4> FindToEnvironment(vtkRenderer* renderer, vtkActor* actor)
{
  const glm::dmat3 toEnvironment = GetWorldToEnvironment(renderer, nullptr);
  vtkNew<vtkMatrix4x4> turn;
  for (int k = 0; k < 9; ++k)
  {
    turn->SetElement(k / 3, k % 3, toEnvironment[k % 3][k / 3]);
  }
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  vtkMatrix4x4::Multiply4x4(turn, actor->GetMatrix(), matrix);
  return matrix;
}
}

// Only where a plan's error is promised, and a surface without arrays is there.
void MaterialDrawing::ForecastOcclusion(
  const FrameState& state, const void* part, const ViewFrame& frame)
{
  vtkDataObject* input = this->Owner->GetInputDataObject(0, 0);
  if (this->Settings->OcclusionMode != 2)
  {
    this->Forecasts.erase(nullptr);
  }
  this->Given = GivenOcclusion();
  // Under a map each block has parts of its own, which would all list all blocks.
  const bool counts = this->Settings->OcclusionMode != 0 && !this->Settings->MaterialMap;
  for (vtkPolyData* surface : GetBlocks(counts ? input : nullptr))
  {
    if (surface->GetNumberOfPolys() > 0 || surface->GetNumberOfStrips() > 0)
    {
      ++this->Given.All;
      this->Given.Blocks += HasArrays(surface) ? 1 : 0;
    }
  }
  if (this->Settings->OcclusionMode != 1 || !this->IsPlanned() || this->Settings->MaterialMap ||
      this->Given.Blocks == this->Given.All)
  {
    this->Forecasts.erase(part);
    return;
  }
  OcclusionQuestion question;
  question.Input = input;
  question.Tolerance = this->Settings->ErrorTolerance;
  question.InBackground = this->Settings->PlanningMode != 0;
  question.WithBounce = this->Settings->OcclusionBounce;
  question.FindToEnvironment = [&state]()
  { return FindToEnvironment(state.Renderer, state.Actor); };
  for (const DrawnMaterial& drawn : frame.Materials)
  {
    if (drawn.IsReady && drawn.Plan && drawn.Environment)
    {
      question.Materials.push_back(
        { drawn.BRDF, drawn.Environment, drawn.Environment->GetPixelsMTime(),
          drawn.Plan->GetPredictedError(drawn.Plan->GetChoice()) });
      question.InBackground = question.InBackground && drawn.BRDF != drawn.Source;
    }
  }
  this->UpdateForecast(part, question);
}

void MaterialDrawing::UpdateForecast(const void* part, const OcclusionQuestion& question)
{
  std::unique_ptr<AutomaticOcclusion>& forecast = this->Forecasts[part];
  if (!forecast)
  {
    forecast = std::make_unique<AutomaticOcclusion>();
  }
  const std::string problem = forecast->Update(question);
  if (!problem.empty() && this->Warned.insert("forecast: " + problem).second)
  {
    vtkErrorWithObjectMacro(
      this->Owner, << "The surface is drawn as if it hid nothing from itself: " << problem << ".");
  }
}

// Where the mode says so, the input is traced once a Render for all of its blocks.
vtkDataObject* MaterialDrawing::GetTracedOcclusion(const void* part)
{
  const bool always = this->Settings->OcclusionMode == 2;
  if (always && !this->IsTraceCurrent)
  {
    this->IsTraceCurrent = true;
    OcclusionQuestion question;
    question.Input = this->Owner->GetInputDataObject(0, 0);
    question.Always = true;
    question.WithBounce = this->Settings->OcclusionBounce;
    const auto blocks = GetBlocks(question.Input);
    if (std::all_of(blocks.begin(), blocks.end(),
          [](vtkPolyData* block)
          { return block->GetNumberOfPoints() == 0 || OcclusionArrays::HasAny(block); }))
    {
      this->Forecasts.erase(nullptr);
    }
    else
    {
      this->UpdateForecast(nullptr, question);
    }
  }
  const auto found = this->Forecasts.find(always ? nullptr : part);
  return found == this->Forecasts.end() ? nullptr : found->second->GetTraced();
}

// What stands for a surface without arrays; null: nothing was traced for it.
vtkPolyData* MaterialDrawing::FindTraced(vtkPolyData* surface, const void* part)
{
  return OcclusionArrays::HasAny(surface) ? nullptr
                                          : this->TracedBlocks.Find(this->GetTracedOcclusion(part),
                                              this->Owner->GetInputDataObject(0, 0), surface);
}

vtkPolyData* MaterialDrawing::FindWhole(vtkPolyData* surface, WholeSurface& last)
{
  vtkPolyData* traced =
    this->Settings->OcclusionMode == 2 ? this->FindTraced(surface, nullptr) : nullptr;
  if (!traced)
  {
    last = {};
    return surface;
  }
  if (last.Traced != traced || last.Time != surface->GetMTime())
  {
    last = { traced, surface->GetMTime(), vtkSmartPointer<vtkPolyData>::New() };
    last.Data->ShallowCopy(surface); // what was traced is the geometry alone
    CopyTraced(traced, last.Data);
  }
  return last.Data;
}

std::string MaterialDrawing::DescribeOcclusion() const
{
  const AutomaticOcclusion* worst = nullptr;
  for (const auto& [part, forecast] : this->Forecasts)
  {
    worst = !worst || forecast->GetError() > worst->GetError() ? forecast.get() : worst;
  }
  const std::string text = worst ? worst->GetText() : "";
  std::string given;
  if (this->Given.Blocks > 0 && this->Given.Blocks < this->Given.All)
  {
    given = "; hidden sky is given for " + std::to_string(this->Given.Blocks) + " of " +
            std::to_string(this->Given.All) + " blocks" +
            (this->Settings->OcclusionMode == 2 ? ", traced for the others"
              : this->Forecasts.empty()         ? ", left out of the others"
                                                : "");
  }
  return (text.empty() ? "" : "; " + text) + given +
         (this->BouncingParts.empty() ? "" : "; one bounce modeled");
}

bool MaterialDrawing::IsPending() const
{
  return this->Plans.IsPending() || this->Sums.IsPending() ||
         std::any_of(this->Forecasts.begin(), this->Forecasts.end(),
           [](const auto& forecast) { return forecast.second->IsPending(); });
}

bool MaterialDrawing::IsReady() const
{
  return this->Plans.IsReady() || this->Sums.IsPending() ||
         std::any_of(this->Forecasts.begin(), this->Forecasts.end(),
           [](const auto& forecast) { return forecast.second->IsReady(); });
}

std::shared_ptr<OcclusionArrays> MaterialDrawing::FindOcclusion(
  vtkPolyData* surface, const void* part, bool isPart)
{
  const int mode = this->Settings->OcclusionMode;
  if (mode == 0 || !surface)
  {
    return nullptr;
  }
  std::string problem;
  vtkPolyData* traced = isPart ? nullptr : this->FindTraced(surface, part);
  const auto arrays = OcclusionArrays::Read(
    traced ? traced : surface, isPart, this->Settings->OcclusionBounce, problem);
  if (arrays && arrays->HasBounce())
  {
    this->BouncingParts.insert(part);
  }
  if (!problem.empty())
  {
    this->WarnOnce("occlusion: " + problem,
      (arrays ? "What the surface hides from itself is drawn black, without a bounce: "
              : "The surface is drawn as if it hid nothing from itself: ") +
        problem + ".");
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
  const bool bounces = this->Settings->OcclusionBounce;
  const auto found = this->KnownLights.find(integrator);
  if (found != this->KnownLights.end() && found->second.Time == time &&
      (found->second.Light->Bounce != nullptr) == bounces)
  {
    return found->second.Light.get();
  }
  KnownLight known = { time,
    std::make_unique<OcclusionLight>(drawn.BRDF, drawn.Environment, integrator, bounces) };
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
    this->WarnOnce(
      "occluded mixture", std::to_string(selected.size()) +
                            " materials meet on a part of the surface, which is drawn "
                            "as if it hid nothing from itself: that is done for up to " +
                            std::to_string(MaximumOccludedMembers) + ".");
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
