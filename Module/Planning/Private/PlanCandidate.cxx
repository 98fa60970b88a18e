// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanCandidate.h"

#include "vtkRadianceMethods.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
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
} // namespace measuredbrdf
