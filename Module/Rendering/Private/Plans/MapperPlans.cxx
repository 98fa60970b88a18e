// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MapperPlans.h"

#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <exception>
#include <iterator>

namespace measuredbrdf
{
// The plan is the one for this, or is known not to be possible.
bool CurrentPlan::IsFor(const PlanInputs& wanted) const
{
  return this->Inputs.BRDF && this->Inputs.GetKey() == wanted.GetKey();
}

// A plan of objects that changed since prepares them anew where it is drawn; snapshots never
// change.
bool CurrentPlan::IsUsable() const
{
  vtkRadiancePlanner* plan = this->GetPlan();
  const PlanInputs& made = this->Inputs;
  return plan &&
         (plan->GetBRDF() != made.BRDF || (made.BRDF->GetMTime() == made.BRDFTime &&
                                            made.Environment->GetPixelsMTime() == made.PixelsTime));
}

void CurrentPlan::Adopt(const PlanInputs& inputs, std::shared_ptr<PlanJob> job)
{
  this->Next.reset();
  this->Current = std::move(job);
  this->Inputs = inputs;
}

bool CurrentPlan::CanShowPrevious(Timing timing) const
{
  return timing == Timing::Always || (timing == Timing::Changes && this->IsUsable());
}

bool CurrentPlan::WouldBlock(const PlanInputs& wanted, Timing timing) const
{
  return !this->IsFor(wanted) && !this->CanShowPrevious(timing) && !PlanJob::FindMade(wanted);
}

void CurrentPlan::Begin(const PlanInputs& wanted)
{
  try
  {
    const std::shared_ptr<PlanJob> last = std::move(this->Next); // where it is the same
    this->NextKey = wanted.GetKey();
    this->Next = PlanJob::Begin(wanted);
  }
  catch (const std::exception&) // no memory for snapshots: Update will tell
  {
  }
}

bool CurrentPlan::Update(
  const PlanInputs& wanted, Timing timing, std::string& problem, const PlanJob::Progress& progress)
{
  try
  {
    return this->EnsureCurrent(wanted, timing, progress, problem);
  }
  catch (const std::exception& e) // no memory, say
  {
    this->Adopt(wanted, nullptr);
    problem = e.what();
    return true;
  }
}

bool CurrentPlan::EnsureCurrent(
  const PlanInputs& wanted, Timing timing, const PlanJob::Progress& progress, std::string& problem)
{
  if (this->IsFor(wanted))
  {
    this->Next.reset();
    return false;
  }
  if (const std::shared_ptr<PlanJob> made = PlanJob::FindMade(wanted))
  {
    problem = made == this->Next ? made->GetProblem() : "";
    this->Adopt(wanted, made);
    return true;
  }
  const bool bridged = this->CanShowPrevious(timing);
  if (bridged)
  {
    this->Begin(wanted);
  }
  else if (this->NextKey != wanted.GetKey())
  {
    this->Next.reset();
  }
  if (bridged && this->IsPending() && !this->IsReady())
  {
    if (!this->IsUsable())
    {
      this->Current.reset();
      this->Inputs = PlanInputs();
    }
    return false;
  }
  bool done = true;
  std::shared_ptr<PlanJob> job = this->Next; // observers of progress may let go of it
  if (job)
  {
    done = job->Wait(progress);
  }
  else
  {
    job = PlanJob::Run(wanted, timing != Timing::Foreground, progress);
  }
  problem = done ? job->GetProblem() : "aborted";
  this->Adopt(wanted, done ? job : nullptr);
  return true;
}

struct MapperPlans::View
{
  vtkWeakPointer<vtkRenderer> Renderer;
  CurrentPlan Plan;
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
  this->EraseIf([renderer](const Key& key, const View&) { return key.first == renderer; });
}

void MapperPlans::Keep(const std::set<vtkBRDF*>& inUse, const std::set<vtkBRDF*>& known)
{
  this->EraseIf(
    [&](const Key& key, const View& view)
    {
      vtkBRDF* member = key.second;
      return known.count(member) == 0 || (view.Plan.IsPending() && inUse.count(member) == 0);
    });
}

bool MapperPlans::IsPending() const
{
  return std::any_of(this->Views.begin(), this->Views.end(),
    [](const auto& entry) { return entry.second->Plan.IsPending(); });
}

bool MapperPlans::IsReady() const
{
  return std::any_of(this->Views.begin(), this->Views.end(),
    [](const auto& entry) { return entry.second->Plan.IsReady(); });
}

// Only now and then looks for views of renderers that are gone, so that a Render does not look at
// every view for each.
std::shared_ptr<MapperPlans::View> MapperPlans::FindView(const PlanRequest& request)
{
  if (++this->Updates >= this->Views.size())
  {
    this->Updates = 0;
    this->EraseIf([](const Key&, const View& view) { return !view.Renderer; });
  }
  std::shared_ptr<View>& view = this->Views[{ request.Renderer, request.Member }];
  if (!view || !view->Renderer) // or an address used again
  {
    view = std::make_shared<View>();
    view->Renderer = request.Renderer;
  }
  return view;
}

void MapperPlans::BeginAll(const std::vector<PlanRequest>& requests)
{
  std::vector<std::pair<std::shared_ptr<View>, const PlanInputs*>> blocking;
  for (const PlanRequest& request : requests)
  {
    const std::shared_ptr<View> view = this->FindView(request);
    if (!view->Plan.IsPending() && view->Plan.WouldBlock(request.Inputs, request.Timing))
    {
      blocking.emplace_back(view, &request.Inputs);
    }
  }
  for (const auto& [view, inputs] : blocking)
  {
    if (blocking.size() > 1)
    {
      view->Plan.Begin(*inputs);
    }
  }
}

std::shared_ptr<CurrentPlan> MapperPlans::Update(
  const PlanRequest& request, bool& changed, std::string& problem)
{
  const std::shared_ptr<View> view = this->FindView(request); // observers of progress may clear all
  changed = view->Plan.Update(request.Inputs, request.Timing, problem, request.Progress);
  return { view, &view->Plan };
}
} // namespace measuredbrdf
