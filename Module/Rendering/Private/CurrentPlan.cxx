// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CurrentPlan.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Plans of a material under an environment, of objects or of snapshots, that mappers share.
using SharedPlans = SharedObjects<std::pair<PlanInputs::Key, bool>, vtkRadiancePlanner>;

// The plan that somebody has; null where nobody has. apart: of snapshots only.
vtkSmartPointer<vtkRadiancePlanner> FindPlan(const PlanInputs& inputs, bool apart)
{
  const auto none = []() { return vtkSmartPointer<vtkRadiancePlanner>(); };
  vtkSmartPointer<vtkRadiancePlanner> plan =
    SharedPlans::Get().Find({ inputs.GetKey(), true }, none);
  return plan || apart ? plan : SharedPlans::Get().Find({ inputs.GetKey(), false }, none);
}

// Lets others find a plan, for as long as somebody holds it.
void SharePlan(const PlanInputs& inputs, bool apart, vtkRadiancePlanner* plan)
{
  if (!FindPlan(inputs, apart)) // not under two keys: nobody else would be left to hold it
  {
    SharedPlans::Get().Find(
      { inputs.GetKey(), apart }, [plan]() { return vtkSmartPointer<vtkRadiancePlanner>(plan); });
  }
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

void CurrentPlan::Adopt(
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
  SharedPlans::Get().Sweep();
}

void CurrentPlan::CopyFrom(const CurrentPlan& other)
{
  this->Adopt(other.Inputs, other.FromSnapshot, other.Plan);
  std::copy_n(other.Times, 2, this->Times);
}

CurrentPlan::~CurrentPlan()
{
  this->Plan = nullptr;
  SharedPlans::Get().Sweep();
}

bool CurrentPlan::CanShowPrevious(Timing timing) const
{
  return timing == Timing::Always || (timing == Timing::Changes && this->IsUsable());
}

bool CurrentPlan::WouldBlock(const PlanInputs& wanted, Timing timing) const
{
  const bool background = timing != Timing::Foreground;
  return !this->IsOf(wanted, background) && !this->CanShowPrevious(timing) &&
         !FindPlan(wanted, background);
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
    else if (wanted.WithForm)
    {
      this->Job->WantForm(); // a light has come since
    }
  }
  catch (const std::exception&) // no memory for snapshots: Update will tell
  {
    this->Job.reset();
  }
}

bool CurrentPlan::Update(
  const PlanInputs& wanted, Timing timing, std::string& problem, const Progress& progress)
{
  try
  {
    return this->EnsureCurrent(wanted, timing, progress, problem);
  }
  catch (const std::exception& e) // no memory, say
  {
    this->Job.reset();
    this->Adopt(wanted, timing != Timing::Foreground, nullptr);
    problem = e.what();
    return true;
  }
}

bool CurrentPlan::EnsureCurrent(
  const PlanInputs& wanted, Timing timing, const Progress& progress, std::string& problem)
{
  const bool background = timing != Timing::Foreground;
  if (this->IsOf(wanted, background))
  {
    this->Job.reset();
    return false;
  }
  if (vtkSmartPointer<vtkRadiancePlanner> shared = FindPlan(wanted, background))
  {
    this->Job.reset();
    this->Adopt(wanted, background, shared);
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
      this->Adopt(PlanInputs(), false, nullptr);
    }
    return false;
  }
  const bool apart = background || this->Job;
  bool done = true;
  std::shared_ptr<PlanJob> job = this->Job; // observers of progress may let go of it
  if (job)
  {
    done = job->Wait(progress);
  }
  else
  {
    const vtkSmartPointer<vtkRadiancePlanner> planner = NewPlanner(wanted, background);
    job = std::make_shared<PlanJob>(planner ? planner : NewPlanner(wanted, false));
    job->Run(progress);
  }
  problem = done ? job->GetProblem() : "aborted";
  this->Adopt(wanted, apart, done ? job->GetPlan() : nullptr);
  this->Job.reset();
  return true;
}
} // namespace measuredbrdf
