// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialDrawing.h"

#include "ParallelFor.h"
#include "RenderPassQueries.h"
#include "SharedIntegrators.h"
#include "SurfaceBlocks.h"
#include "TextureEnvironment.h"
#include "VisibleSurface.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProperty.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

#include <algorithm>
#include <exception>
#include <iterator>

namespace measuredbrdf
{
namespace
{
// Interactors ask for 15 frames a second while somebody moves what is shown, for one in hours else.
constexpr double LeastInteractiveRate = 1.0;

bool IsInteracting(vtkRenderer* renderer)
{
  auto* window = vtkRenderWindow::SafeDownCast(renderer->GetVTKWindow());
  return window && window->GetDesiredUpdateRate() >= LeastInteractiveRate;
}
}

MaterialDrawing::MaterialDrawing(vtkMapper* owner, std::function<std::vector<vtkBRDF*>()> toCome)
  : Owner(owner)
  , ToCome(std::move(toCome))
{
}

MaterialDrawing::~MaterialDrawing() = default;

void MaterialDrawing::WarnOnce(const std::string& cause, const std::string& text)
{
  if (this->Warned.insert(cause).second)
  {
    vtkWarningWithObjectMacro(this->Owner, << text);
  }
}

MaterialDrawing::SweepAtEnd::~SweepAtEnd()
{
  SweepIntegrators(); // which hold environments
  SweepEnvironments();
}

void MaterialDrawing::KeepPlansInUse()
{
  std::set<vtkBRDF*> inUse; // as GetMember has them
  std::set<vtkBRDF*> known = { nullptr };
  const auto add = [this](std::set<vtkBRDF*>& members, vtkBRDF* brdf)
  {
    if (brdf)
    {
      members.insert(this->GetMember(brdf));
    }
  };
  for (vtkBRDF* brdf : this->ToCome())
  {
    add(inUse, brdf);
  }
  if (this->Settings->BRDF)
  {
    inUse.insert(nullptr); // blocks of it may be there, too
  }
  for (const auto& [index, brdf] : this->Settings->BlocksByIndex)
  {
    add(inUse, brdf);
  }
  for (const auto& [name, brdf] : this->Settings->BlocksByName)
  {
    add(inUse, brdf);
  }
  vtkMaterialMap* map = this->Settings->MaterialMap;
  for (int k = 0; map && k < map->GetNumberOfMaterials(); ++k)
  {
    add(known, map->GetBRDF(k));
  }
  known.insert(inUse.begin(), inUse.end());
  this->Plans.Keep(inUse, known);
}

vtkSmartPointer<vtkEnvironment> MaterialDrawing::ResolveEnvironment(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkEnvironment> environment = this->Settings->Environment;
  if (!environment && renderer->GetEnvironmentTexture())
  {
    std::string problem;
    environment = FindEnvironment(renderer, problem);
    if (!problem.empty())
    {
      this->WarnOnce("environment: " + problem,
        "The renderer's environment texture" +
          std::string(environment ? ": " : " lights nothing here: ") + problem);
    }
  }
  return environment && environment->GetWidth() > 0 ? environment : nullptr;
}

PlanRequest MaterialDrawing::GetRequest(vtkBRDF* brdf, const FrameState& state)
{
  const CurrentPlan::Timing timings[] = { CurrentPlan::Timing::Foreground,
    CurrentPlan::Timing::Changes, CurrentPlan::Timing::Always };
  PlanRequest request;
  request.Inputs = PlanInputs(brdf, state.Environment, this->Settings->ErrorTolerance);
  request.Inputs.MaximumCost = this->Settings->MaximumCost;
  request.Inputs.WithShaderInputs =
    this->Settings->UseSceneLights && HasLight(state.Renderer, state.Environment != nullptr);
  if (this->Settings->PlanForView && this->Seen)
  {
    request.Inputs.Seen = this->Seen;
    request.Inputs.SeenTime = this->SeenTime;
  }
  request.Timing = timings[this->Settings->PlanningMode];
  request.Member = this->GetMember(brdf);
  request.Renderer = state.Renderer;
  return request;
}

// What the first picture after SetPlanForView shows of all surfaces. Nothing may be in view then:
// the next picture of another view looks again.
void MaterialDrawing::Look(const FrameState& state)
{
  const ViewStamp view = { state.Renderer, state.Renderer->GetActiveCamera()->GetMTime(),
    state.Actor->GetRedrawMTime() };
  if (this->SeenTime < this->Settings->ViewTime || (!this->Seen && view != this->SeenIn))
  {
    this->SeenIn = view;
    this->Seen = std::make_shared<VisibleSurface>(
      GetBlocks(this->Owner->GetInputDataObject(0, 0)), state.Renderer, state.Actor);
    this->SeenTime.Modified();
    this->Seen = this->Seen->IsEmpty() ? nullptr : this->Seen;
  }
}

bool MaterialDrawing::ResolvePlan(DrawnMaterial& drawn, const FrameState& state)
{
  PlanRequest request = this->GetRequest(drawn.Source, state);
  request.Progress = [this](double progress)
  {
    this->Owner->UpdateProgress(progress);
    return !this->AbortPlanning;
  };
  bool changed = false;
  std::string problem;
  const std::shared_ptr<CurrentPlan> current = this->Plans.Update(request, changed, problem);
  vtkRadiancePlanner* plan = current->GetPlan();
  if (!problem.empty() && plan)
  {
    vtkWarningWithObjectMacro(this->Owner, << "Planning: " << problem);
  }
  else if (!problem.empty())
  {
    vtkErrorWithObjectMacro(this->Owner, << "Planning: " << problem);
  }
  if (plan)
  {
    drawn.Integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(
      plan->NewIntegrator(state.Hurries ? plan->GetInteractiveChoice() : plan->GetChoice()));
    drawn.BRDF = plan->GetBRDF();
    drawn.Environment = current->GetEnvironment();
    drawn.Plan = plan;
  }
  if (changed)
  {
    this->Owner->InvokeEvent(vtkCommand::UpdateDataEvent);
  }
  return current->IsPending();
}

void MaterialDrawing::ResolveIntegrator(DrawnMaterial& drawn, const FrameState& state)
{
  if (vtkRadianceIntegrator* wanted = this->Settings->Integrator)
  {
    if (!drawn.Environment)
    {
      drawn.Environment = wanted->GetEnvironment();
    }
    if (drawn.Environment || !wanted->NeedsEnvironment())
    {
      drawn.Integrator = FindIntegrator(wanted, drawn.BRDF, drawn.Environment);
    }
  }
  else if (state.Environment)
  {
    const bool pending = this->ResolvePlan(drawn, state);
    if (!drawn.Integrator) // one that failed is not drawn by a coarse table for good
    {
      drawn.Integrator = FindStandIn(drawn.BRDF, drawn.Environment, pending);
      drawn.BRDF = drawn.Integrator->GetBRDF();
    }
  }
}

std::string MaterialDrawing::UploadInputs(DrawnMaterial& drawn, vtkRenderer* renderer)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetVTKWindow());
  std::size_t samplers = 0;
  std::string problem;
  if (drawn.Integrator)
  {
    drawn.Radiance = ShaderTextures::Find(drawn.Integrator, window, problem);
    samplers += drawn.Radiance->GetNumberOfSamplers();
  }
  const bool lit =
    this->Settings->UseSceneLights && HasLight(renderer, drawn.Integrator != nullptr);
  if (problem.empty() && (lit || (drawn.Integrator && drawn.Integrator->UsesBRDFOnGPU())))
  {
    const bool soft = drawn.Integrator && drawn.Integrator->UsesSoftLights();
    drawn.Material = ShaderTextures::Find(drawn.BRDF, soft, window, problem);
    samplers += drawn.Material->GetNumberOfSamplers();
  }
  return problem.empty() ? CheckTextureUnits(samplers, window) : problem;
}

DrawnMaterial MaterialDrawing::Resolve(vtkBRDF* brdf, const FrameState& state)
{
  DrawnMaterial drawn;
  if (!brdf)
  {
    return drawn;
  }
  drawn.Source = brdf;
  drawn.BRDF = brdf;
  drawn.Environment = state.Environment;
  std::string problem;
  try
  {
    this->ResolveIntegrator(drawn, state);
    problem = this->UploadInputs(drawn, state.Renderer);
  }
  catch (const std::exception& e) // no memory, say
  {
    problem = e.what();
  }
  drawn.IsReady = problem.empty();
  if (!drawn.IsReady)
  {
    this->AddFailure("The material is not drawn: " + problem + ".");
    return drawn; // with its textures, which know what failed: it is not tried in every frame
  }
  drawn.Key = (drawn.Material ? drawn.Material->GetInputs().GetShaderKey() : "") + "/" +
              (drawn.Radiance ? drawn.Radiance->GetInputs().GetShaderKey() : "") +
              (drawn.BRDF->IsIsotropic() ? "" : "/anisotropic") +
              (this->Settings->UseSceneLights ? "" : "/environment only");
  return drawn;
}

void MaterialDrawing::ResolveAll(
  ViewFrame& frame, const FrameState& state, const std::vector<vtkBRDF*>& brdfs)
{
  const PlanJob::Hold hold; // until what stands in is made
  std::vector<PlanRequest> requests;
  const bool isPlanned = state.Environment && this->IsPlanned();
  if (isPlanned && this->Settings->PlanForView)
  {
    this->Look(state);
  }
  for (vtkBRDF* brdf : brdfs)
  {
    if (isPlanned && brdf)
    {
      requests.push_back(this->GetRequest(brdf, state));
    }
  }
  this->Plans.BeginAll(requests);
  std::vector<DrawnMaterial> materials; // the last ones stay until these have their textures
  for (vtkBRDF* brdf : brdfs)
  {
    materials.push_back(this->Resolve(brdf, state));
  }
  frame.Materials = std::move(materials);
}

MaterialDrawing::ViewFrame& MaterialDrawing::FindFrame(vtkRenderer* renderer, const void* part)
{
  const auto [found, isNew] = this->Frames.try_emplace({ part, renderer });
  if (isNew || !found->second.Renderer) // or an address used again
  {
    found->second = { renderer, {} };
    for (auto it = this->Frames.begin(); it != this->Frames.end();)
    {
      it = it->second.Renderer ? std::next(it) : this->Frames.erase(it);
    }
  }
  return found->second;
}

void MaterialDrawing::BeginFrame(
  vtkRenderer* renderer, vtkActor* actor, const void* part, const std::vector<vtkBRDF*>& brdfs)
{
  this->Selected.Clear();
  this->Frame = nullptr;
  if (!DrawsColor(renderer, actor) || !IsShaded(actor))
  {
    return;
  }
  ViewFrame& frame = this->FindFrame(renderer, part);
  const bool any =
    std::any_of(brdfs.begin(), brdfs.end(), [](vtkBRDF* brdf) { return brdf != nullptr; });
  const FrameState state = { renderer, actor, any ? this->ResolveEnvironment(renderer) : nullptr,
    IsInteracting(renderer) && !this->Sums.HasTime(renderer, actor, part) };
  this->DropPlans(state, any);
  this->ResolveAll(frame, state, brdfs);
  this->DropOcclusionLights();
  this->ForecastOcclusion(state, part, frame);
  this->Frame = &frame;
  this->LastRenderer = renderer;
}

// Those that are not drawn by any more.
void MaterialDrawing::DropPlans(const FrameState& state, bool anyMaterial)
{
  const bool none =
    !this->Settings->BRDF && !this->Settings->MaterialMap && !this->Settings->HasBlockMaterials();
  if (none || !this->IsPlanned())
  {
    this->Plans.Clear();
  }
  else if (anyMaterial && !state.Environment) // other renderers may have light
  {
    this->Plans.Clear(state.Renderer);
  }
}

void MaterialDrawing::AddSamples(
  vtkRenderer* renderer, vtkActor* actor, const void* part, const std::function<void()>& draw)
{
  if (!this->Sums.IsConcerned(this->GetMaterials()))
  {
    return;
  }
  vtkDataObject* input = this->Owner->GetInputDataObject(0, 0);
  vtkMTimeType time = std::max(this->Settings->GetMTime(), this->StyleTime);
  for (vtkPolyData* surface : GetBlocks(input))
  {
    time = std::max({ time, input->GetMTime(), surface->GetMTime() });
  }
  vtkDataObject* traced = this->GetTracedOcclusion(part);
  this->Sums.Add(
    { renderer, actor, part, time, traced ? traced->GetMTime() : 0 }, this->GetMaterials(), draw);
}

void MaterialDrawing::EndFrame()
{
  this->Selected.Clear();
  this->Sums.End();
  this->Frame = nullptr;
}

const std::vector<DrawnMaterial>& MaterialDrawing::GetMaterials() const
{
  static const std::vector<DrawnMaterial> none;
  return this->Frame ? this->Frame->Materials : none;
}

void MaterialDrawing::Render(
  vtkRenderer* renderer, vtkActor* actor, const std::function<void()>& draw, vtkMTimeType styleTime)
{
  this->AbortPlanning = false;
  this->StyleTime = styleTime;
  this->IsTraceCurrent = false;
  this->Sums.Begin();
  this->Failures.clear();
  this->Try(
    [&]()
    {
      draw();
      if (DrawsColor(renderer, actor))
      {
        this->KeepPlansInUse();
      }
    });
  const std::pair<vtkRenderer*, vtkActor*> view(renderer, actor);
  for (const std::string& failure : this->Failures)
  {
    if (this->Said.insert_or_assign(failure, view).second)
    {
      vtkErrorWithObjectMacro(this->Owner, << failure);
    }
  }
  // Those that this view was the last to have, and has no more, would be said again.
  for (auto it = this->Said.begin(); it != this->Said.end() && DrawsColor(renderer, actor);)
  {
    const bool isOver = it->second == view && this->Failures.count(it->first) == 0;
    it = isOver ? this->Said.erase(it) : std::next(it);
  }
}

bool MaterialDrawing::Try(const std::function<void()>& step)
{
  const std::optional<std::string> problem = FindThrown(step);
  if (problem)
  {
    this->EndFrame();
    this->AddFailure("Render: " + *problem + ". The next one tries again.");
  }
  return !problem;
}

void MaterialDrawing::Select(std::size_t material) { this->SelectMixture({ material }, {}); }

void MaterialDrawing::SelectMixture(const std::vector<std::size_t>& materials, MixtureText text)
{
  DrawnMaterials selected;
  for (std::size_t material : materials)
  {
    selected.push_back(&this->Frame->Materials[material]);
  }
  this->Selected.Set(selected, std::move(text));
}

std::vector<const DrawnMaterial*> MaterialDrawing::GetLastFrame() const
{
  std::vector<const DrawnMaterial*> materials;
  for (const auto& [key, frame] : this->Frames)
  {
    for (const DrawnMaterial& drawn : frame.Materials)
    {
      if (frame.Renderer && frame.Renderer == this->LastRenderer)
      {
        materials.push_back(&drawn);
      }
    }
  }
  return materials;
}

void MaterialDrawing::Forget(const void* part)
{
  const auto first = this->Frames.lower_bound({ part, nullptr });
  const auto isOther = [part](const auto& entry) { return entry.first.first != part; };
  this->Frames.erase(first, std::find_if(first, this->Frames.end(), isOther));
  this->Sums.Forget(part);
  this->Forecasts.erase(part);
  this->BouncingParts.erase(part);
}

void MaterialDrawing::GetVisiblePairs(
  vtkRenderer* renderer, vtkActor* actor, vtkDataArray* normals, vtkDataArray* views)
{
  const VisibleSurface seen(GetBlocks(this->Owner->GetInputDataObject(0, 0)), renderer, actor);
  normals->DeepCopy(seen.Normals);
  views->DeepCopy(seen.Views);
}

vtkMTimeType MaterialDrawing::GetAppearanceMTime()
{
  const bool ready = this->IsReady();
  if (ready && !this->WasReady)
  {
    this->ReadyTime.Modified();
  }
  this->WasReady = ready;
  return std::max(this->Settings->GetMTime(), this->ReadyTime.GetMTime());
}

void MaterialDrawing::ReleaseGraphicsResources(vtkWindow* window, const void* part)
{
  this->Selected.Clear();
  for (auto& [key, frame] : this->Frames)
  {
    const bool here = !window || !frame.Renderer || frame.Renderer->GetVTKWindow() == window;
    if (here && key.first == part)
    {
      for (DrawnMaterial& drawn : frame.Materials)
      {
        drawn.Material.reset();
        drawn.Radiance.reset();
        drawn.IsReady = false;
      }
    }
  }
  this->Sums.Release(window);
}
} // namespace measuredbrdf
