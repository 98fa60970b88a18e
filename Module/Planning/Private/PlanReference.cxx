// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanSearch.h"

#include "EnvironmentPrecomputation.h"
#include "HalfVector.h" // for Pi
#include "LobeViews.h"
#include "MaterialPrecomputation.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <atomic>
#include <iterator>

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

constexpr int LightCounts[] = { 4096, 2048, 1024, 256 }; // of variance light sets

// A sum over many lights, for lobes that are broad. Suns and lamps are lights of their own; the
// rest is a variance light set of so many, one of LightCounts. How far that is from the integral
// depends on the material. False where it was aborted.
bool SetLights(PlanTask& task, int count, vtkLightSetRadianceIntegrator* integrator)
{
  const auto goOn = [&task]() { return !task.IsAborted(); };
  EnvironmentPrecomputation& parts = task.Environment->GetParts();
  const auto bright = parts.GetExtractedEmitters(
    task.Environment, ExtractedEmitters::DefaultShare, MostReferenceSuns, goOn);
  const std::vector<int> counts(std::begin(LightCounts), std::end(LightCounts));
  const auto sets = bright ? parts.GetLightSets(task.Environment, bright->Rest, counts, goOn)
                           : std::vector<vtkSmartPointer<vtkLightSet>>();
  if (sets.empty())
  {
    task.Problem = "aborted.";
    return false;
  }
  vtkNew<vtkLightSet> all;
  for (const ExtractedEmitters::Light& sun : bright->Lights)
  {
    all->AddLight(&sun.Direction.x, &sun.Irradiance.x);
  }
  vtkLightSet* others = sets[std::find(counts.begin(), counts.end(), count) - counts.begin()];
  for (int k = 0; k < others->GetNumberOfLights(); ++k)
  {
    glm::dvec3 direction, irradiance;
    others->GetDirection(k, &direction.x);
    others->GetIrradiance(k, &irradiance.x);
    all->AddLight(&direction.x, &irradiance.x);
  }
  integrator->SetLightSet(all);
  return true;
}

// Some of the pairs.
PlanPairs TakeSome(const PlanPairs& all)
{
  PlanPairs pairs = MakeEmptyPairs();
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
  return pairs;
}

// What an integrator says of the few pairs becomes what others are compared with.
bool SetReference(PlanTask& task, vtkRadianceIntegrator* integrator, PlanComparison& few)
{
  few.Reference = vtkSmartPointer<vtkDoubleArray>::New();
  return Integrate(task, integrator, few.Pairs, few.Reference);
}

// How far an integrator is from that, with two standard errors.
bool Measure(
  PlanTask& task, vtkRadianceIntegrator* integrator, const PlanComparison& few, double& error)
{
  vtkNew<vtkDoubleArray> radiance;
  const bool integrated = Integrate(task, integrator, few.Pairs, radiance);
  error = integrated ? Compare(few, radiance).Error : 0.0;
  return integrated;
}

bool MayLightsDo(const PlanTask& task)
{
  const double light = 4.0 * Pi / LightCounts[0]; // sr
  const std::atomic<bool> never{ false };         // the views are known
  return task.BRDF->IsIsotropic() && task.Shared->GetViews(task.BRDF, never).GetSharpShare(light) <=
                                       std::min(UnseenShare * task.Tolerance, LargestError);
}

// The fewest lights that do, and how far they are off: what half of all differ from all, and they.
// None where all lights do not.
bool TryLights(PlanTask& task, PlanComparison& few, vtkSmartPointer<vtkRadianceIntegrator>& chosen,
  double& error)
{
  const auto lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  lights->SetBRDF(task.BRDF);
  lights->SetEnvironment(task.Environment);
  lights->SetInLanes(true);
  if (!SetLights(task, LightCounts[0], lights) || !SetReference(task, lights, few))
  {
    return false;
  }
  double own = 0.0;
  double fewer = 0.0;
  int number = LightCounts[0];
  for (const int count : LightCounts)
  {
    double other = 0.0;
    if (count < LightCounts[0] &&
        (!SetLights(task, count, lights) || !Measure(task, lights, few, other)))
    {
      return false;
    }
    own = count == LightCounts[1] ? other : own;
    if (!(own <= std::min(LightsShare * task.Tolerance, LargestError)))
    {
      return true;
    }
    if (other > std::min(FewerShare * task.Tolerance, LargestError))
    {
      break;
    }
    number = count;
    fewer = other;
  }
  chosen = lights;
  error = own + fewer;
  return SetLights(task, number, lights);
}

bool TakeAdaptive(PlanTask& task, PlanComparison& few,
  vtkSmartPointer<vtkRadianceIntegrator>& chosen, double& error)
{
  const double tolerance = std::min(ShareOfTolerance * task.Tolerance, LargestTolerance);
  const auto adaptive = vtkSmartPointer<vtkAdaptiveRadianceIntegrator>::New();
  adaptive->SetBRDF(task.BRDF);
  adaptive->SetEnvironment(task.Environment);
  adaptive->SetTolerance(Finer * tolerance);
  if (!SetReference(task, adaptive, few))
  {
    return false;
  }
  adaptive->SetTolerance(tolerance);
  chosen = adaptive;
  return Measure(task, adaptive, few, error);
}
}

vtkSmartPointer<vtkRadianceIntegrator> MakeReference(PlanTask& task, PlanComparison& comparison)
{
  PlanComparison few;
  few.Pairs = TakeSome(comparison.Pairs);
  vtkSmartPointer<vtkRadianceIntegrator> chosen;
  double& error = comparison.ReferenceError;
  const bool known = !MayLightsDo(task) || TryLights(task, few, chosen, error);
  if (!known || (!chosen && !TakeAdaptive(task, few, chosen, error)))
  {
    return nullptr;
  }
  comparison.Reference = vtkSmartPointer<vtkDoubleArray>::New();
  return Integrate(task, chosen, comparison.Pairs, comparison.Reference) ? chosen : nullptr;
}
} // namespace measuredbrdf
