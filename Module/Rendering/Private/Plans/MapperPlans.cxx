// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MapperPlans.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <vector>

namespace measuredbrdf
{
namespace
{
// Plans of a material under an environment, that mappers share for as long as somebody holds them.
using SharedPlans = SharedObjects<PlanInputs::Key, vtkRadiancePlanner>;

// Null where nobody has one.
vtkSmartPointer<vtkRadiancePlanner> FindPlan(const PlanInputs& inputs)
{
  return SharedPlans::Get().Find(
    inputs.GetKey(), []() { return vtkSmartPointer<vtkRadiancePlanner>(); });
}
}

CurrentPlan::~CurrentPlan()
{
  this->Plan = nullptr;
  SharedPlans::Get().Sweep();
}

// The plan is the one for this, or is known not to be possible.
bool CurrentPlan::IsFor(const PlanInputs& wanted) const
{
  return this->Inputs.BRDF && this->Inputs.GetKey() == wanted.GetKey();
}

// A plan of objects that changed since prepares them anew where it is drawn; snapshots never
// change.
bool CurrentPlan::IsUsable() const
{
  return this->Plan && this->Plan->GetBRDF()->GetMTime() == this->Times[0] &&
         this->Plan->GetEnvironment()->GetPixelsMTime() == this->Times[1];
}

void CurrentPlan::Adopt(const PlanInputs& inputs, vtkSmartPointer<vtkRadiancePlanner> plan)
{
  if (plan)
  {
    SharedPlans::Get().Find(inputs.GetKey(), [&plan]() { return plan; });
    this->Times[0] = plan->GetBRDF()->GetMTime();
    this->Times[1] = plan->GetEnvironment()->GetPixelsMTime();
  }
  this->Plan = plan;
  this->Inputs = inputs;
  SharedPlans::Get().Sweep();
}

bool CurrentPlan::CanShowPrevious(Timing timing) const
{
  return timing == Timing::Always || (timing == Timing::Changes && this->IsUsable());
}

bool CurrentPlan::WouldBlock(const PlanInputs& wanted, Timing timing) const
{
  return !this->IsFor(wanted) && !this->CanShowPrevious(timing) && !FindPlan(wanted);
}

void CurrentPlan::Begin(const PlanInputs& wanted)
{
  try
  {
    if (!this->Job || this->JobKey != wanted.GetKey())
    {
      this->Job = PlanJob::Find(wanted);
      this->JobKey = wanted.GetKey();
    }
    else if (wanted.WithShaderInputs)
    {
      this->Job->WantShaderInputs(); // a light has come since
    }
  }
  catch (const std::exception&) // no memory for snapshots: Update will tell
  {
    this->Job.reset();
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
    this->Job.reset();
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
    this->Job.reset();
    return false;
  }
  if (vtkSmartPointer<vtkRadiancePlanner> shared = FindPlan(wanted))
  {
    this->Job.reset();
    this->Adopt(wanted, shared);
    return true;
  }
  const bool bridged = this->CanShowPrevious(timing);
  if (bridged)
  {
    this->Begin(wanted);
  }
  else if (this->JobKey != wanted.GetKey())
  {
    this->Job.reset();
  }
  if (bridged && this->IsPending() && !this->IsReady())
  {
    if (!this->IsUsable())
    {
      this->Adopt(PlanInputs(), nullptr);
    }
    return false;
  }
  bool done = true;
  std::shared_ptr<PlanJob> job = this->Job; // observers of progress may let go of it
  if (job)
  {
    done = job->Wait(progress);
  }
  else
  {
    const vtkSmartPointer<vtkRadiancePlanner> planner =
      NewPlanner(wanted, timing != Timing::Foreground);
    job = std::make_shared<PlanJob>(planner ? planner : NewPlanner(wanted, false));
    job->Run(progress);
  }
  problem = done ? job->GetProblem() : "aborted";
  this->Adopt(wanted, done ? job->GetPlan() : nullptr);
  this->Job.reset();
  return true;
}

struct MapperPlans::View
{
  vtkWeakPointer<vtkRenderer> Renderer;
  CurrentPlan Plan;
  bool Bridged = false; // drawn by another plan than was wanted
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
    [](const auto& entry) { return entry.second->Bridged; });
}

bool MapperPlans::IsReady() const
{
  return std::any_of(this->Views.begin(), this->Views.end(),
    [](const auto& entry) { return entry.second->Bridged && entry.second->Plan.IsReady(); });
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

std::shared_ptr<CurrentPlan> MapperPlans::Update(
  const PlanRequest& request, bool& changed, std::string& problem)
{
  const std::shared_ptr<View> view = this->FindView(request); // observers of progress may clear all
  const PlanInputs& wanted = request.Inputs;
  if (request.Others && !view->Plan.IsPending() && view->Plan.WouldBlock(wanted, request.Timing))
  {
    // Side by side: its own first, and only if there are others.
    std::vector<std::pair<std::shared_ptr<View>, PlanInputs>> begun;
    request.Others(
      [&](MapperPlans& plans, const PlanRequest& other)
      {
        const std::shared_ptr<View> its = plans.FindView(other);
        if (other.Inputs.GetKey() != wanted.GetKey() &&
            its->Plan.WouldBlock(other.Inputs, other.Timing))
        {
          begun.emplace_back(its, other.Inputs);
        }
      });
    if (!begun.empty())
    {
      view->Plan.Begin(wanted);
    }
    for (const auto& [its, inputs] : begun)
    {
      its->Plan.Begin(inputs);
    }
  }
  changed = view->Plan.Update(wanted, request.Timing, problem, request.Progress);
  view->Bridged = view->Plan.IsPending();
  return { view, &view->Plan };
}
} // namespace measuredbrdf
