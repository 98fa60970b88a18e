// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanSearch.h"

#include "MaterialPrecomputation.h"
#include "NumberText.h"
#include "ScopedErrorCapture.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkCommand.h"
#include "vtkRadianceMethods.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Times a table's pixel: tables and maps beside lamps take less, samples more.
constexpr double InteractiveCost = 4.0;

std::string Percent(double value) { return NumberText(100.0 * value, 2) + " %"; }

// While one lives, an integrator at work hears of an abort, and its error is kept.
class Supervision
{
public:
  Supervision(const PlanTask& task, vtkRadianceIntegrator* integrator)
    : Task(task)
    , Integrator(integrator)
    , Error(integrator)
    , Tag(integrator->AddObserver(vtkCommand::ProgressEvent, this, &Supervision::OnProgress))
  {
  }
  ~Supervision() { this->Integrator->RemoveObserver(this->Tag); }
  Supervision(const Supervision&) = delete;
  void operator=(const Supervision&) = delete;

  void Check(bool done) const
  {
    if (!done)
    {
      throw PlanFailure(this->Error.GetText());
    }
  }

private:
  void OnProgress(vtkObject*, unsigned long, void*)
  {
    if (this->Task.IsAborted())
    {
      this->Integrator->SetAbort(true);
    }
  }

  const PlanTask& Task;
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
  ScopedErrorCapture Error;
  unsigned long Tag;
};
}

vtkSmartPointer<vtkRadianceIntegrator> MakeIntegrator(
  const PlanCandidate& candidate, vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto made = vtkSmartPointer<vtkRadianceIntegrator>::Take(
    vtkRadianceMethods::NewIntegrator(candidate.Method));
  if (!made || !made->SetSizes(candidate.Sizes))
  {
    return nullptr;
  }
  made->SetBRDF(brdf);
  made->SetEnvironment(environment);
  return made;
}

std::vector<PlanCandidate> ListCandidates(const PlanTask& task, std::string& givenUp)
{
  double cheapest = HUGE_VAL; // of what is given up
  std::vector<PlanCandidate> candidates;
  for (const vtkSmartPointer<vtkRadianceIntegrator>& method : vtkRadianceMethods::GetMethods())
  {
    PlanCandidate candidate;
    candidate.Method = method->GetMethodName();
    const auto asked = MakeIntegrator(candidate, task.BRDF, task.Environment);
    if (!asked)
    {
      continue; // taken away by another thread
    }
    asked->SetPrecomputation(task.Shared);
    const std::vector<std::vector<int>> choices = asked->GetCandidateSizes(false);
    for (const std::vector<int>& sizes : task.All ? asked->GetCandidateSizes(true) : choices)
    {
      candidate.Sizes = sizes;
      candidate.MayBeChosen = std::find(choices.begin(), choices.end(), sizes) != choices.end();
      candidate.Integrator = MakeIntegrator(candidate, task.BRDF, task.Environment);
      if (!candidate.Integrator)
      {
        continue; // it has said which size is out of range
      }
      candidate.Integrator->SetPrecomputation(task.Shared); // for what they ask of the material
      candidate.Description = candidate.Integrator->GetSizesText();
      candidate.Cost = candidate.Integrator->EstimateCost();
      candidate.Bytes = candidate.Integrator->EstimateTextureBytes();
      candidate.Integrator->SetPrecomputation(nullptr);
      if (candidate.Cost > task.MaximumCost && candidate.MayBeChosen && candidate.Cost < cheapest)
      {
        cheapest = candidate.Cost;
        givenUp = candidate.Method + ", " + candidate.Description;
      }
      if (candidate.Bytes <= task.MaximumBytes && candidate.Cost <= task.MaximumCost)
      {
        candidates.push_back(candidate);
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const PlanCandidate& a, const PlanCandidate& b)
    { return a.Cost < b.Cost || (a.Cost == b.Cost && a.Bytes < b.Bytes); });
  return candidates;
}

void Prepare(const PlanTask& task, PlanCandidate& candidate)
{
  const auto start = std::chrono::steady_clock::now();
  const Supervision supervision(task, candidate.Integrator);
  candidate.Integrator->SetPrecomputation(task.Shared);
  const bool prepared = candidate.Integrator->Prepare();
  candidate.Integrator->SetPrecomputation(nullptr); // it may go to another thread
  const auto end = std::chrono::steady_clock::now();
  candidate.SetUp += std::chrono::duration<double, std::milli>(end - start).count();
  supervision.Check(prepared);
}

vtkSmartPointer<vtkDoubleArray> Integrate(
  const PlanTask& task, vtkRadianceIntegrator* integrator, const PlanPairs& pairs)
{
  auto radiance = vtkSmartPointer<vtkDoubleArray>::New();
  const Supervision supervision(task, integrator);
  supervision.Check(integrator->Integrate(pairs.Normals, pairs.Views, radiance));
  return radiance;
}

namespace
{
// Prepare a rung and see how far it is from the reference. Returns whether it belongs to the plan.
bool Try(const PlanTask& task, const PlanComparison& comparison, PlanCandidate& candidate,
  std::string& warnings)
{
  vtkSmartPointer<vtkDoubleArray> radiance;
  try
  {
    Prepare(task, candidate);
    radiance = Integrate(task, candidate.Integrator, comparison.Pairs);
    const double* values = radiance->GetPointer(0);
    if (!std::all_of(values, values + radiance->GetNumberOfValues(),
          [](double value) { return std::isfinite(value); }))
    {
      throw PlanFailure("its radiance is not finite");
    }
  }
  catch (const PlanFailure& failure)
  {
    if (task.IsAborted() || vtkRadianceMethods::IsBuiltIn(candidate.Method))
    {
      throw;
    }
    warnings += (warnings.empty() ? "" : "\n") + candidate.Method + ", " + candidate.Description +
                ": " + failure.what();
    return false;
  }
  if (candidate.Integrator->UsesBRDFOnGPU())
  {
    vtkBRDFShaderInputs inputs;
    inputs.SoftLights = candidate.Integrator->UsesSoftLights();
    task.BRDF->GetShaderInputs(inputs);
    candidate.Bytes += static_cast<vtkIdType>(inputs.GetTextureBytes());
  }
  static_cast<PlanError&>(candidate) = Compare(comparison, radiance);
  return candidate.Bytes <= task.MaximumBytes;
}

// Of what was tried, the cheapest first, and costs at most so much: the cheapest within the
// tolerance, or the most accurate where there is none; -1 where nothing may be chosen.
int FindBest(const std::vector<PlanCandidate>& tried, double tolerance, double mostCost)
{
  std::size_t best = tried.size();
  for (std::size_t k = 0; k < tried.size(); ++k)
  {
    const bool isBetter =
      best == tried.size() || (tried[best].Error > tolerance && tried[k].Error < tried[best].Error);
    best = tried[k].MayBeChosen && tried[k].Cost <= mostCost && isBetter ? k : best;
  }
  return best < tried.size() ? static_cast<int>(best) : -1;
}
}

void Climb(const PlanTask& task, const PlanComparison& comparison,
  std::vector<PlanCandidate> ladder, Plan& plan, const std::function<void(double)>& progress)
{
  bool found = false;
  for (std::size_t rung = 0; rung < ladder.size() && (!found || task.All); ++rung)
  {
    PlanCandidate& candidate = ladder[rung];
    candidate.MayBeChosen = candidate.MayBeChosen && !found; // the choice is the climb's
    if (Try(task, comparison, candidate, plan.Warnings))
    {
      plan.Candidates.push_back(candidate);
      found = found || (candidate.MayBeChosen && candidate.Error <= task.Tolerance);
    }
    if (progress)
    {
      progress(static_cast<double>(rung + 1) / static_cast<double>(ladder.size()));
    }
  }
  if (task.IsAborted())
  {
    throw PlanFailure("aborted");
  }
  plan.Choice = FindBest(plan.Candidates, task.Tolerance, HUGE_VAL);
  const int quick = FindBest(plan.Candidates, task.Tolerance, InteractiveCost);
  plan.Interactive = quick < 0 ? plan.Choice : quick;
  for (int index = 0; index < static_cast<int>(plan.Candidates.size()); ++index)
  {
    PlanCandidate& candidate = plan.Candidates[static_cast<std::size_t>(index)];
    plan.Meets = plan.Meets || (index == plan.Choice && candidate.Error <= task.Tolerance);
    if (index != plan.Choice && index != plan.Interactive)
    {
      candidate.Integrator = nullptr; // which holds its tables
    }
  }
}

std::string ExplainChoice(const Plan& plan, double tolerance, const std::string& givenUp)
{
  const std::size_t choice = static_cast<std::size_t>(plan.Choice);
  const PlanCandidate& chosen = plan.Candidates[choice];
  if (!plan.Meets)
  {
    return "no method that was tried is within " + Percent(tolerance) +
           "; this one is the most accurate, with " + Percent(chosen.Error) +
           (givenUp.empty() ? "" : "; " + givenUp + ", costs more than MaximumCost");
  }
  std::string reason = "the cheapest within " + Percent(tolerance);
  for (std::size_t k = choice; k > 0; --k)
  {
    if (plan.Candidates[k - 1].MayBeChosen)
    {
      const PlanCandidate& cheaper = plan.Candidates[k - 1];
      reason +=
        ": " + cheaper.Method + ", " + cheaper.Description + ", has " + Percent(cheaper.Error);
      break;
    }
  }
  return reason + (chosen.Picture > tolerance
                      ? "; that is the mean over all views: a single picture may have up to " +
                          Percent(chosen.Picture)
                      : "");
}

std::string DescribePlan(const Plan& plan)
{
  if (plan.Choice < 0)
  {
    return "no plan yet";
  }
  const PlanCandidate& chosen = plan.Candidates[static_cast<std::size_t>(plan.Choice)];
  const std::string error = ", error " + Percent(chosen.Error) + " (" +
                            NumberText(100.0 * (chosen.Error - chosen.Uncertainty), 2) + " + " +
                            NumberText(100.0 * chosen.Uncertainty, 2) + " for chance)";
  const std::string percentiles = ", 95 % of the pixels within " + Percent(chosen.Percentiles[0]) +
                                  ", 99 % within " + Percent(chosen.Percentiles[1]);
  const std::string costs = ", " + FixedText(1e-6 * static_cast<double>(chosen.Bytes), 1) +
                            " MB, set up in " + FixedText(chosen.SetUp, 0) + " ms: ";
  const std::string pictures = chosen.Picture > chosen.Error
                                 ? ", up to " + Percent(chosen.Picture) + " in a single picture"
                                 : "";
  std::string interactive;
  if (plan.Interactive >= 0 && plan.Interactive != plan.Choice)
  {
    const PlanCandidate& other = plan.Candidates[static_cast<std::size_t>(plan.Interactive)];
    interactive = "; while one interacts and that takes too long: " + other.Method + ", " +
                  other.Description + ", with " + Percent(other.Error);
  }
  return chosen.Method + ", " + chosen.Description + error + percentiles + pictures + costs +
         plan.Reason + interactive;
}
} // namespace measuredbrdf
