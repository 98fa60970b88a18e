// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CurrentPlan.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"

#include <exception>

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
  const PlanInputs& wanted, Timing timing, std::string& problem, const Progress& progress)
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
  const PlanInputs& wanted, Timing timing, const Progress& progress, std::string& problem)
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
} // namespace measuredbrdf
