// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanJob.h"

#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"

#include <exception>
#include <iterator>
#include <map>
#include <system_error>

namespace measuredbrdf
{
std::shared_ptr<PlanJob> PlanJob::Find(const PlanInputs& inputs)
{
  static std::map<PlanInputs::Key, std::weak_ptr<PlanJob>> jobs;
  for (auto it = jobs.begin(); it != jobs.end();)
  {
    it = it->second.expired() ? jobs.erase(it) : std::next(it);
  }
  std::weak_ptr<PlanJob>& entry = jobs[inputs.GetKey()];
  std::shared_ptr<PlanJob> job = entry.lock();
  if (job && job->Users == 0) // about to stop
  {
    job = nullptr;
  }
  vtkSmartPointer<vtkRadiancePlanner> planner = job ? nullptr : NewPlanner(inputs, true);
  if (planner)
  {
    try
    {
      job = std::make_shared<PlanJob>(planner);
      entry = job;
    }
    catch (const std::system_error&)
    {
      return nullptr;
    }
  }
  if (job)
  {
    ++job->Users;
  }
  return job;
}

PlanJob::PlanJob(vtkSmartPointer<vtkRadiancePlanner> planner)
  : Planner(planner)
  , BRDF(planner->GetBRDF())
{
  // Nobody's output window has to cope with other threads.
  planner->AddObserver(vtkCommand::ErrorEvent, this, &PlanJob::TakeMessage);
  this->BRDF->AddObserver(vtkCommand::WarningEvent, this, &PlanJob::TakeMessage);
  this->Thread = std::thread([this]() { this->Run(); });
}

PlanJob::~PlanJob()
{
  this->Abort();
  this->Wait();
}

void PlanJob::Run()
{
  try
  {
    this->Succeeded = this->Planner->Update();
  }
  catch (const std::exception& e) // no memory, say: nobody catches it above a thread
  {
    this->Problem = e.what();
  }
  this->Done = true;
}

void PlanJob::TakeMessage(vtkObject*, unsigned long, void* text)
{
  this->Problem = text ? static_cast<const char*>(text) : "";
}

void PlanJob::Leave()
{
  if (--this->Users == 0)
  {
    this->Abort();
  }
}

void PlanJob::Abort()
{
  if (!this->Done)
  {
    this->Planner->SetAbort(true);
  }
}

void PlanJob::Wait()
{
  if (this->Thread.joinable())
  {
    this->Thread.join();
    this->Planner->RemoveObservers(vtkCommand::ErrorEvent);
    this->BRDF->RemoveObservers(vtkCommand::WarningEvent);
  }
}

vtkSmartPointer<vtkRadiancePlanner> PlanJob::GetPlan() const
{
  return this->Succeeded ? this->Planner : nullptr;
}
} // namespace measuredbrdf
