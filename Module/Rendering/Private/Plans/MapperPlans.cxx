// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MapperPlans.h"

#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkCamera.h"
#include "vtkEnvironment.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTimeStamp.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <utility>

namespace measuredbrdf
{
namespace
{
// An orbit would want another plan every 15 degrees; whoever has shown so many different views gets
// one for all.
constexpr std::size_t MostLooks = 4;
}

struct MapperPlans::View
{
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkWeakPointer<vtkActor> Actor; // null but for plans for the view
  CurrentPlan Plan;
  bool Bridged = false; // drawn by another plan than was wanted

  // What the camera saw, and the plans for it, which are taken up again when it comes back.
  struct Seen
  {
    std::shared_ptr<const VisibleSurface> Surface;
    vtkMTimeType Time = 0;
    vtkSmartPointer<vtkRadiancePlanner> Plan; // kept, so that CurrentPlan finds it
  };
  std::vector<Seen> Looks;
  std::size_t Current = 0;
  bool Everywhere = false;  // for every view instead
  std::vector<double> From; // what the last look depended on
  PlanInputs::Key Inputs;   // of the kept plans, but for what is seen

  bool IsGone(const Key& key) const
  {
    return !this->Renderer || (std::get<2>(key) && !this->Actor);
  }
};

MapperPlans::MapperPlans() = default;

MapperPlans::~MapperPlans()
{
  this->Clear();
  PlanJob::WaitForStopped();
}

template <typename Condition>
void MapperPlans::EraseIf(const Condition& condition)
{
  for (auto it = this->Views.begin(); it != this->Views.end();)
  {
    it = condition(it->first, *it->second) ? this->Views.erase(it) : std::next(it);
  }
}

void MapperPlans::Clear() { this->Views.clear(); }

void MapperPlans::Clear(vtkRenderer* renderer)
{
  this->EraseIf([renderer](const Key& key, const View&) { return std::get<0>(key) == renderer; });
}

void MapperPlans::Keep(const std::set<vtkBRDF*>& inUse, const std::set<vtkBRDF*>& known)
{
  this->EraseIf(
    [&](const Key& key, const View& view)
    {
      vtkBRDF* member = std::get<1>(key);
      return known.count(member) == 0 || (view.Plan.IsPending() && inUse.count(member) == 0);
    });
}

bool MapperPlans::IsPending() const
{
  return std::any_of(this->Views.begin(), this->Views.end(),
    [](const auto& entry) { return entry.second->Bridged; });
}

bool MapperPlans::IsReady() const
{
  return std::any_of(this->Views.begin(), this->Views.end(),
    [](const auto& entry) { return entry.second->Bridged && entry.second->Plan.IsReady(); });
}

// Only now and then looks for views of renderers and actors that are gone, so that a Render does
// not look at every view for each.
std::shared_ptr<MapperPlans::View> MapperPlans::FindView(const PlanRequest& request)
{
  if (request.ForView != this->ForView)
  {
    this->Clear(); // none of these plans is drawn by any more
    this->ForView = request.ForView;
  }
  if (++this->Updates >= this->Views.size())
  {
    this->Updates = 0;
    this->EraseIf([](const Key& key, const View& view) { return view.IsGone(key); });
  }
  const Key key(request.Renderer, request.Member, request.ForView ? request.Actor : nullptr);
  const auto known = this->Views.find(key);
  if (known != this->Views.end() && !known->second->IsGone(key)) // no address used again
  {
    return known->second;
  }
  auto made = std::make_shared<View>();
  made->Renderer = request.Renderer;
  made->Actor = request.ForView ? request.Actor : nullptr;
  return this->Views[key] = made;
}

void MapperPlans::Look(View& view, const PlanRequest& request)
{
  vtkRenderer* ren = request.Renderer;
  double own[9];
  request.Environment->GetWorldToEnvironment(own);
  vtkCamera* camera = ren->GetActiveCamera();
  const int* size = ren->GetSize();
  std::vector<double> from(own, own + 9);
  for (const double* axis : { ren->GetEnvironmentRight(), ren->GetEnvironmentUp() })
  {
    from.insert(from.end(), axis, axis + 3);
  }
  for (vtkMatrix4x4* matrix :
    { camera->GetCompositeProjectionTransformMatrix(1.0, -1.0, 1.0), request.Actor->GetMatrix() })
  {
    from.insert(from.end(), matrix->GetData(), matrix->GetData() + 16);
  }
  from.insert(from.end(), { static_cast<double>(size[0]), static_cast<double>(size[1]) });
  for (vtkPolyData* surface : request.Surfaces)
  {
    from.push_back(static_cast<double>(surface->GetMTime()));
  }
  if (from == view.From)
  {
    return;
  }
  view.From = from;
  if (view.Everywhere)
  {
    return;
  }
  const auto seen = std::make_shared<VisibleSurface>(
    VisibleSurface::InView(request.Surfaces, ren, request.Actor, own));
  if (seen->IsEmpty()) // out of view: as it was
  {
    return;
  }
  const auto serves = [&seen](const View::Seen& look) { return look.Surface->Covers(*seen); };
  if (!view.Looks.empty() && serves(view.Looks[view.Current]))
  {
    return;
  }
  const auto found = std::find_if(view.Looks.begin(), view.Looks.end(), serves);
  view.Current = static_cast<std::size_t>(found - view.Looks.begin());
  if (found != view.Looks.end())
  {
    return;
  }
  if (view.Looks.size() < MostLooks)
  {
    vtkTimeStamp now;
    now.Modified();
    view.Looks.push_back({ seen, now.GetMTime(), nullptr });
    return;
  }
  view.Everywhere = true;
  view.Looks.clear();
}

PlanInputs MapperPlans::GetInputs(View& view, const PlanRequest& request)
{
  PlanInputs inputs(request.BRDF, request.Environment, request.Tolerance);
  inputs.MaximumCost = request.MaximumCost;
  inputs.WithShaderInputs = request.WithShaderInputs;
  if (!request.ForView)
  {
    return inputs;
  }
  Look(view, request);
  if (inputs.GetKey() != view.Inputs)
  {
    view.Inputs = inputs.GetKey();
    for (View::Seen& look : view.Looks)
    {
      look.Plan = nullptr;
    }
  }
  if (!view.Looks.empty())
  {
    const View::Seen& look = view.Looks[view.Current];
    inputs.Seen = look.Surface;
    inputs.SeenTime = look.Time;
  }
  return inputs;
}

// Its own first, and only if there are others.
void MapperPlans::BeginSideBySide(View& view, const PlanInputs& wanted, const PlanRequest& request)
{
  std::vector<std::pair<std::shared_ptr<View>, PlanInputs>> others;
  request.Others(
    [&](MapperPlans& plans, const PlanRequest& other)
    {
      const std::shared_ptr<View> its = plans.FindView(other);
      const PlanInputs inputs = GetInputs(*its, other);
      const bool outOfView = other.ForView && !inputs.Seen && !its->Everywhere;
      if (!outOfView && inputs.GetKey() != wanted.GetKey() &&
          its->Plan.WouldBlock(inputs, other.Timing))
      {
        others.emplace_back(its, inputs);
      }
    });
  if (!others.empty())
  {
    view.Plan.Begin(wanted);
  }
  for (const auto& [its, inputs] : others)
  {
    its->Plan.Begin(inputs);
  }
}

std::shared_ptr<CurrentPlan> MapperPlans::Update(
  const PlanRequest& request, bool& changed, std::string& problem)
{
  const std::shared_ptr<View> kept = this->FindView(request); // observers of progress may clear all
  View& view = *kept;
  const PlanInputs wanted = GetInputs(view, request);
  if (request.Others && !view.Plan.IsPending() && view.Plan.WouldBlock(wanted, request.Timing))
  {
    this->BeginSideBySide(view, wanted, request);
  }
  changed = view.Plan.Update(wanted, request.Timing, problem, request.Progress);
  view.Bridged = view.Plan.IsPending();
  if (wanted.Seen && view.Plan.IsFor(wanted) && view.Current < view.Looks.size())
  {
    view.Looks[view.Current].Plan = view.Plan.GetPlan();
  }
  return { kept, &kept->Plan };
}
} // namespace measuredbrdf
