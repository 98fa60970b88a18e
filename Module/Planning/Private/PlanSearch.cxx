// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanSearch.h"

#include "MaterialPrecomputation.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Times a table's pixel: tables and maps beside lamps take less, samples more.
constexpr double InteractiveCost = 4.0;
}

AbortForwarder::AbortForwarder(
  const IsAborted& isAborted, vtkRadianceIntegrator* integrator, std::string& problem)
  : Aborted(isAborted)
  , Integrator(integrator)
  , Problem(problem)
{
  this->Tags[0] =
    integrator->AddObserver(vtkCommand::ProgressEvent, this, &AbortForwarder::OnProgress);
  this->Tags[1] = integrator->AddObserver(vtkCommand::ErrorEvent, this, &AbortForwarder::OnError);
}

AbortForwarder::~AbortForwarder()
{
  this->Integrator->RemoveObserver(this->Tags[0]);
  this->Integrator->RemoveObserver(this->Tags[1]);
}

void AbortForwarder::OnProgress(vtkObject*, unsigned long, void*)
{
  if (this->Aborted())
  {
    this->Integrator->SetAbort(true);
  }
}

void AbortForwarder::OnError(vtkObject*, unsigned long, void* text)
{
  this->Problem = text ? static_cast<const char*>(text) : "";
}

bool PrepareCandidate(
  const PlanTask& task, const IsAborted& isAborted, PlanCandidate& candidate, std::string& problem)
{
  const auto start = std::chrono::steady_clock::now();
  const AbortForwarder supervision(isAborted, candidate.Integrator, problem);
  candidate.Integrator->SetPrecomputation(task.Shared);
  const bool prepared = candidate.Integrator->Prepare();
  candidate.Integrator->SetPrecomputation(nullptr); // it may go to another thread
  const auto end = std::chrono::steady_clock::now();
  candidate.SetUp += std::chrono::duration<double, std::milli>(end - start).count();
  return prepared;
}

PlanSearch::PlanSearch(const PlanTask& task, const PlanComparison& comparison, IsAborted isAborted)
  : Task(task)
  , Comparison(comparison)
  , Aborted(std::move(isAborted))
{
}

bool PlanSearch::Run(std::vector<PlanCandidate> ladder)
{
  this->Ladder = std::move(ladder);
  this->Tried.assign(this->Ladder.size(), false);
  bool done = this->Climb();
  for (std::size_t rung = 0; done && this->Task.All && rung < this->Ladder.size(); ++rung)
  {
    if (!this->Tried[rung])
    {
      this->Ladder[rung].MayBeChosen = false; // the choice is the climb's
      done = this->Try(rung);
    }
  }
  if (!done || this->Aborted())
  {
    return false;
  }
  this->Choose();
  return true;
}

bool PlanSearch::Climb()
{
  std::vector<std::size_t> rungs; // without what is only listed
  std::size_t lamps = 0;          // the lowest rung that has some; none of the lowest two is
  for (std::size_t k = 0; k < this->Ladder.size(); ++k)
  {
    if (this->Ladder[k].MayBeChosen)
    {
      lamps = lamps == 0 && this->Ladder[k].Method == "hybrid" ? rungs.size() : lamps;
      rungs.push_back(k);
    }
  }
  std::size_t at = 0;
  while (at < rungs.size())
  {
    if (!this->Try(rungs[at]))
    {
      return false;
    }
    if (this->IsWithin(rungs[at]))
    {
      break;
    }
    at = at == 1 ? std::max(lamps, at + 1) : at + 1;
  }
  for (; at > 0 && at < rungs.size() && this->IsWithin(rungs[at]) && !this->Tried[rungs[at - 1]];
       --at)
  {
    if (!this->Try(rungs[at - 1]))
    {
      return false;
    }
  }
  return true;
}

bool PlanSearch::IsWithin(std::size_t rung) const
{
  return this->Tried[rung] && this->Ladder[rung].Error <= this->Task.Tolerance;
}

// Prepare a rung and see how far it is from the reference.
bool PlanSearch::Try(std::size_t rung)
{
  PlanCandidate& candidate = this->Ladder[rung];
  vtkNew<vtkDoubleArray> radiance;
  bool done = PrepareCandidate(this->Task, this->Aborted, candidate, this->Problem);
  if (done)
  {
    const AbortForwarder supervision(this->Aborted, candidate.Integrator, this->Problem);
    const PlanPairs& pairs = this->Comparison.Pairs;
    done = candidate.Integrator->Integrate(pairs.Normals, pairs.Views, radiance);
  }
  if (!done)
  {
    if (this->Aborted() || vtkRadianceMethods::IsBuiltIn(candidate.Method))
    {
      return false;
    }
    this->Warnings += (this->Warnings.empty() ? "" : "\n") + candidate.Method + ", " +
                      candidate.Description + ": " + this->Problem;
    this->Problem.clear();
    return true;
  }
  if (candidate.Integrator->UsesBRDFOnGPU())
  {
    vtkBRDFShaderInputs form;
    form.SoftLights = candidate.Integrator->UsesSoftLights();
    this->Task.BRDF->GetShaderInputs(form);
    candidate.Bytes += static_cast<vtkIdType>(form.GetTextureBytes());
  }
  static_cast<PlanError&>(candidate) = Compare(this->Comparison, radiance);
  this->Tried[rung] = candidate.Bytes <= this->Task.MaximumBytes;
  if (this->Progress)
  {
    const auto tried = std::count(this->Tried.begin(), this->Tried.end(), true);
    this->Progress(static_cast<double>(tried) / static_cast<double>(this->Ladder.size()));
  }
  return true;
}

// The integrators of the others go.
void PlanSearch::Choose()
{
  Plan& plan = this->Found;
  for (std::size_t rung = 0; rung < this->Ladder.size(); ++rung)
  {
    if (!this->Tried[rung])
    {
      continue;
    }
    const int index = static_cast<int>(plan.Candidates.size());
    const PlanCandidate& candidate = this->Ladder[rung];
    plan.Candidates.push_back(candidate);
    const auto isBetterThan = [&](int other) {
      return other < 0 || candidate.Error < plan.Candidates[static_cast<std::size_t>(other)].Error;
    };
    if (candidate.MayBeChosen && !plan.Meets && isBetterThan(plan.Choice))
    {
      plan.Choice = index;
      plan.Meets = candidate.Error <= this->Task.Tolerance;
    }
    if (candidate.MayBeChosen && candidate.Cost <= InteractiveCost &&
        isBetterThan(plan.Interactive))
    {
      plan.Interactive = index;
    }
  }
  const bool isCheap =
    plan.Choice >= 0 &&
    plan.Candidates[static_cast<std::size_t>(plan.Choice)].Cost <= InteractiveCost;
  plan.Interactive = isCheap || plan.Interactive < 0 ? plan.Choice : plan.Interactive;
  for (int index = 0; index < static_cast<int>(plan.Candidates.size()); ++index)
  {
    if (index != plan.Choice && index != plan.Interactive)
    {
      plan.Candidates[static_cast<std::size_t>(index)].Integrator = nullptr;
    }
  }
}
} // namespace measuredbrdf
