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
  const auto hasLamps = [](const PlanCandidate& candidate) { return candidate.Method == "hybrid"; };
  const std::size_t number = this->Ladder.size();
  const std::size_t lamps = static_cast<std::size_t>(
    std::find_if(this->Ladder.begin(), this->Ladder.end(), hasLamps) - this->Ladder.begin());
  std::size_t rung = 0;
  while (rung < number)
  {
    if (this->Ladder[rung].MayBeChosen && !this->Try(rung))
    {
      return false;
    }
    if (this->IsWithin(rung))
    {
      break;
    }
    rung = rung == 1 && lamps < number ? std::max(lamps, rung + 1) : rung + 1;
  }
  for (; rung < number && rung > 0 && this->IsWithin(rung) && !this->Tried[rung - 1]; --rung)
  {
    if (this->Ladder[rung - 1].MayBeChosen && !this->Try(rung - 1))
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
    this->Progress(static_cast<double>(rung + 1) / static_cast<double>(this->Ladder.size()));
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
