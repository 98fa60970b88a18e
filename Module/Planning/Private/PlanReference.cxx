// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanReference.h"

#include "HalfVector.h" // for Pi
#include "LightsReference.h"
#include "LobeViews.h"
#include "MaterialPrecomputation.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkNew.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr vtkIdType ProbePairs = 32; // pairs that tell how far off a reference is

// Of the tolerance: what lights may be off and fewer of them differ from all; but at most so much.
constexpr double LightsShare = 0.25;
constexpr double FewerShare = 0.05;
constexpr double LargestError = 0.01;
// Of the tolerance, and of the albedo: what may be sharper than one of all lights is wide. Lights
// miss it, and so may what tells their error.
constexpr double UnseenShare = 0.05;

constexpr double ShareOfTolerance = 0.5; // that the adaptive integral may be off in a pair, but
constexpr double LargestTolerance = 0.01;
constexpr double Finer = 0.125; // of that, against which its error is measured

// Some of a comparison's pairs, and what a nearly exact reference says of them.
class FewPairs
{
public:
  FewPairs(
    const PlanTask& task, const IsAborted& isAborted, const PlanPairs& all, std::string& problem)
    : Task(task)
    , Aborted(isAborted)
    , Problem(problem)
  {
    PlanPairs& pairs = this->Comparison.Pairs;
    pairs = MakeEmptyPairs();
    const vtkIdType count = all.Normals->GetNumberOfTuples();
    const vtkIdType step = std::max<vtkIdType>(count / ProbePairs, 1);
    for (vtkIdType k = step / 2; k < count; k += step)
    {
      pairs.Normals->InsertNextTuple(all.Normals->GetTuple(k));
      pairs.Views->InsertNextTuple(all.Views->GetTuple(k));
      if (!all.Weights.empty())
      {
        pairs.Weights.push_back(all.Weights[static_cast<std::size_t>(k)]);
      }
    }
  }

  /// False, with a problem in words, where that failed or was aborted.
  bool SetExact(vtkRadianceIntegrator* integrator)
  {
    this->Comparison.Reference = vtkSmartPointer<vtkDoubleArray>::New();
    return this->Integrate(integrator, this->Comparison.Reference);
  }

  /// How far an integrator is from that, with two standard errors, as Compare has it.
  bool Measure(vtkRadianceIntegrator* integrator, double& error)
  {
    vtkNew<vtkDoubleArray> radiance;
    const bool integrated = this->Integrate(integrator, radiance);
    error = integrated ? Compare(this->Comparison, radiance).Error : 0.0;
    return integrated;
  }

private:
  bool Integrate(vtkRadianceIntegrator* integrator, vtkDoubleArray* radiance)
  {
    integrator->SetBRDF(this->Task.BRDF);
    integrator->SetEnvironment(this->Task.Environment);
    const AbortForwarder supervision(this->Aborted, integrator, this->Problem);
    const PlanPairs& pairs = this->Comparison.Pairs;
    return integrator->Integrate(pairs.Normals, pairs.Views, radiance);
  }

  const PlanTask& Task;
  const IsAborted& Aborted;
  std::string& Problem;
  PlanComparison Comparison;
};

bool MayLightsDo(const PlanTask& task, const std::atomic<bool>& abort)
{
  const double light = 4.0 * Pi / LightsReference::GetCounts().front(); // sr
  return task.BRDF->IsIsotropic() && task.Shared->GetViews(task.BRDF, abort).GetSharpShare(light) <=
                                       std::min(UnseenShare * task.Tolerance, LargestError);
}

// The fewest lights that do, and how far they are off: what half of all differ from all, and they.
// Leaves the comparison as it is where all lights do not.
bool TryLights(const PlanTask& task, FewPairs& few, PlanComparison& comparison)
{
  const std::vector<int>& counts = LightsReference::GetCounts();
  const auto lights = vtkSmartPointer<LightsReference>::New();
  if (!few.SetExact(lights))
  {
    return false;
  }
  double own = 0.0;
  double fewer = 0.0;
  int chosen = counts.front();
  for (std::size_t k = 1; k < counts.size(); ++k)
  {
    double error = 0.0;
    lights->SetNumberOfLights(counts[k]);
    if (!few.Measure(lights, error))
    {
      return false;
    }
    own = k == 1 ? error : own;
    if (!(own <= std::min(LightsShare * task.Tolerance, LargestError)))
    {
      return true;
    }
    if (error > std::min(FewerShare * task.Tolerance, LargestError))
    {
      break;
    }
    chosen = counts[k];
    fewer = error;
  }
  lights->SetNumberOfLights(chosen);
  comparison.Integrator = lights;
  comparison.ReferenceError = own + fewer;
  return true;
}

bool TakeAdaptive(const PlanTask& task, FewPairs& few, PlanComparison& comparison)
{
  const double tolerance = std::min(ShareOfTolerance * task.Tolerance, LargestTolerance);
  const auto adaptive = vtkSmartPointer<vtkAdaptiveRadianceIntegrator>::New();
  adaptive->SetTolerance(Finer * tolerance);
  if (!few.SetExact(adaptive))
  {
    return false;
  }
  adaptive->SetTolerance(tolerance);
  comparison.Integrator = adaptive;
  return few.Measure(adaptive, comparison.ReferenceError);
}
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
    FewPairs few(task, isAborted, comparison.Pairs, problem);
    if ((MayLightsDo(task, abort) && !TryLights(task, few, comparison)) ||
        (!comparison.Integrator && !TakeAdaptive(task, few, comparison)))
    {
      return false;
    }
  }
  const auto& integrator = comparison.Integrator;
  const AbortForwarder supervision(isAborted, integrator, problem);
  comparison.Reference = vtkSmartPointer<vtkDoubleArray>::New();
  return integrator->Integrate(
    comparison.Pairs.Normals, comparison.Pairs.Views, comparison.Reference);
}
} // namespace measuredbrdf
