// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanReference.h"

#include "LightsReference.h"
#include "LobeViews.h"
#include "MaterialPrecomputation.h"
#include "vtkAdaptiveRadianceIntegrator.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr double ResolvedAngle = 0.35; // sr, that lobes fill whose lights need not be told apart
// Of the albedo, times the tolerance: with a smaller sharp part, lights are within 0.2 % at the
// usual tolerance of 2 %, in half the time.
constexpr double SharpShare = 15.0;
constexpr double LargestSharpShare = 0.3;
constexpr double ShareOfTolerance = 0.5; // that the adaptive integral may be off in a pair, but
constexpr double LargestTolerance = 0.01;
constexpr double AdaptiveError = 5e-4; // in the mean: 1 % over the root of some hundred pairs
}

vtkSmartPointer<vtkRadianceIntegrator> NewPlanReference(vtkBRDF* brdf, vtkEnvironment* environment,
  double tolerance, const std::shared_ptr<vtkRadianceIntegrator::Precomputation>& shared,
  const std::atomic<bool>& abort)
{
  vtkSmartPointer<vtkRadianceIntegrator> reference;
  if (brdf->IsIsotropic() && shared->GetViews(brdf, abort).GetSharpShare(ResolvedAngle) >
                               std::min(SharpShare * tolerance, LargestSharpShare))
  {
    auto adaptive = vtkSmartPointer<vtkAdaptiveRadianceIntegrator>::New();
    adaptive->SetTolerance(std::min(ShareOfTolerance * tolerance, LargestTolerance));
    reference = adaptive;
  }
  else
  {
    auto lights = vtkSmartPointer<LightsReference>::New();
    lights->SetErrorTolerance(tolerance);
    reference = lights;
  }
  reference->SetBRDF(brdf);
  reference->SetEnvironment(environment);
  return reference;
}

bool MakeReference(const PlanTask& task, const IsAborted& isAborted, const std::atomic<bool>& abort,
  PlanComparison& comparison, std::string& problem)
{
  if (comparison.Reference || !comparison.Pairs.Normals)
  {
    return comparison.Reference != nullptr;
  }
  if (!comparison.Integrator)
  {
    comparison.Integrator =
      NewPlanReference(task.BRDF, task.Environment, task.Tolerance, task.Shared, abort);
  }
  const auto& integrator = comparison.Integrator;
  const AbortForwarder supervision(isAborted, integrator, problem);
  comparison.Reference = vtkSmartPointer<vtkDoubleArray>::New();
  const bool made =
    integrator->Integrate(comparison.Pairs.Normals, comparison.Pairs.Views, comparison.Reference);
  const auto* lights = LightsReference::SafeDownCast(integrator);
  comparison.ReferenceError = lights ? lights->GetError() : AdaptiveError;
  return made;
}
} // namespace measuredbrdf
