// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CurrentPlan.h"

#include "TakenError.h"
#include "vtkBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace measuredbrdf
{
namespace
{
bool UpdateWithProgress(vtkRadiancePlanner* planner, const CurrentPlan::Progress& progress)
{
  if (!progress)
  {
    return planner->Update();
  }
  std::pair<vtkRadiancePlanner*, const CurrentPlan::Progress*> both(planner, &progress);
  vtkNew<vtkCallbackCommand> follow;
  follow->SetClientData(&both);
  follow->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* share)
    {
      const auto& [working, tell] = *static_cast<decltype(both)*>(data);
      if (!(*tell)(*static_cast<double*>(share)))
      {
        working->SetAbort(true);
      }
    });
  const unsigned long tag = planner->AddObserver(vtkCommand::ProgressEvent, follow);
  const bool planned = planner->Update();
  planner->RemoveObserver(tag);
  return planned;
}
}

bool CurrentPlan::IsOf(const PlanInputs& wanted, bool apart) const
{
  return this->Inputs.BRDF && this->Inputs.GetKey() == wanted.GetKey() &&
         (this->FromSnapshot || !apart);
}

// A plan of objects that changed since prepares them anew where it is drawn; snapshots never
// change.
bool CurrentPlan::IsUsable() const
{
  return this->Plan && this->Plan->GetBRDF()->GetMTime() == this->Times[0] &&
         this->Plan->GetEnvironment()->GetPixelsMTime() == this->Times[1];
}

void CurrentPlan::Take(
  const PlanInputs& inputs, bool apart, vtkSmartPointer<vtkRadiancePlanner> plan)
{
  if (plan)
  {
    SharePlan(inputs, apart, plan);
    this->Times[0] = plan->GetBRDF()->GetMTime();
    this->Times[1] = plan->GetEnvironment()->GetPixelsMTime();
  }
  this->Plan = plan;
  this->Inputs = inputs;
  this->FromSnapshot = apart;
  this->Uploads.clear();
  SweepPlans();
}

void CurrentPlan::TakeOver(const CurrentPlan& other)
{
  this->Retire();
  this->Plan = other.Plan;
  this->Inputs = other.Inputs;
  this->FromSnapshot = other.FromSnapshot;
  std::copy_n(other.Times, 2, this->Times);
}

CurrentPlan::~CurrentPlan()
{
  this->Stop();
  this->Plan = nullptr;
  SweepPlans();
}

void CurrentPlan::LeaveJob()
{
  if (this->Job)
  {
    this->Job->Leave();
    this->Job.reset();
    this->JobInputs = PlanInputs();
  }
}

void CurrentPlan::Retire()
{
  if (this->Job)
  {
    this->Retired.push_back(this->Job); // not to be waited for here
    this->LeaveJob();
  }
  this->HasStopped(); // those that have, go
}

void CurrentPlan::Clear()
{
  this->Retire();
  this->Take(PlanInputs(), false, nullptr);
}

void CurrentPlan::Stop()
{
  this->LeaveJob();
  this->Retired.clear();
}

bool CurrentPlan::HasStopped()
{
  this->Retired.erase(std::remove_if(this->Retired.begin(), this->Retired.end(),
                        [](const std::shared_ptr<PlanJob>& job) { return job->IsDone(); }),
    this->Retired.end());
  return !this->Job && this->Retired.empty();
}

bool CurrentPlan::IsBridged(Timing timing) const
{
  return timing == Timing::Always || (timing == Timing::Changes && this->IsUsable());
}

bool CurrentPlan::NeedsTime(const PlanInputs& wanted, Timing timing) const
{
  const bool background = timing != Timing::Foreground;
  return !this->IsOf(wanted, background) && !this->IsBridged(timing) &&
         !FindPlan(wanted, background);
}

void CurrentPlan::Begin(const PlanInputs& wanted)
{
  if (this->Job && this->JobInputs.GetKey() != wanted.GetKey())
  {
    this->Retire();
  }
  try
  {
    if (this->Job && wanted.WithForm)
    {
      this->Job->WantForm(); // a light has come since
    }
    this->Job = this->Job ? this->Job : PlanJob::Find(wanted);
    this->JobInputs = wanted;
  }
  catch (const std::exception&) // no memory for snapshots: Update will tell
  {
  }
}

bool CurrentPlan::Update(
  const PlanInputs& wanted, Timing timing, std::string& problem, const Progress& progress)
{
  try
  {
    return this->Bring(wanted, timing, progress, problem);
  }
  catch (const std::exception& e) // no memory, say
  {
    this->Retire();
    this->Take(wanted, timing != Timing::Foreground, nullptr);
    problem = e.what();
    return true;
  }
}

bool CurrentPlan::Bring(
  const PlanInputs& wanted, Timing timing, const Progress& progress, std::string& problem)
{
  const bool background = timing != Timing::Foreground;
  if (this->IsOf(wanted, background))
  {
    this->Retire();
    return false;
  }
  if (vtkSmartPointer<vtkRadiancePlanner> shared = FindPlan(wanted, background))
  {
    this->Retire();
    this->Take(wanted, background, shared);
    return true;
  }
  if (this->Job && this->JobInputs.GetKey() != wanted.GetKey())
  {
    this->Retire();
  }
  const bool bridged = this->IsBridged(timing);
  if (bridged)
  {
    this->Begin(wanted);
  }
  if (this->Job && !this->Job->IsDone() && bridged)
  {
    if (!this->IsUsable())
    {
      this->Take(PlanInputs(), false, nullptr);
    }
    return false;
  }
  if (this->Job)
  {
    const std::shared_ptr<PlanJob> job = this->Job; // observers of progress may retire it
    const bool done = job->Wait(progress);
    problem = done ? job->GetProblem() : "aborted";
    this->Take(wanted, true, done ? job->GetPlan() : nullptr);
    this->Retire();
    return true;
  }
  vtkSmartPointer<vtkRadiancePlanner> planner = NewPlanner(wanted, background);
  planner = planner ? planner : NewPlanner(wanted, false);
  const TakenError reason(planner);
  const PlanJob::Beside beside;
  const bool planned = UpdateWithProgress(planner, progress);
  problem = planned ? "" : reason.GetText();
  this->Take(wanted, background, planned ? planner : nullptr);
  return true;
}
} // namespace measuredbrdf
