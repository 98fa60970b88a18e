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
// depends on the material. Throws where it was aborted.
void SetLights(const PlanTask& task, int count, vtkLightSetRadianceIntegrator* integrator)
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
    throw PlanFailure("aborted");
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

// How far an integrator is from what the few pairs reflect, with two standard errors.
double Measure(const PlanTask& task, vtkRadianceIntegrator* integrator, const PlanComparison& few)
{
  return Compare(few, Integrate(task, integrator, few.Pairs)).Error;
}

bool MayLightsDo(const PlanTask& task)
{
  const double light = 4.0 * Pi / LightCounts[0]; // sr
  const std::atomic<bool> never{ false };         // the views are known
  return task.BRDF->IsIsotropic() && task.Shared->GetViews(task.BRDF, never).GetSharpShare(light) <=
                                       std::min(UnseenShare * task.Tolerance, LargestError);
}

// The fewest lights that do, and how far they are off: what half of all differ from all, and they.
// Null where all lights do not.
vtkSmartPointer<vtkRadianceIntegrator> TryLights(
  const PlanTask& task, PlanComparison& few, double& error)
{
  const auto lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  lights->SetBRDF(task.BRDF);
  lights->SetEnvironment(task.Environment);
  lights->SetInLanes(true);
  SetLights(task, LightCounts[0], lights);
  few.Reference = Integrate(task, lights, few.Pairs);
  double own = 0.0;
  double fewer = 0.0;
  int number = LightCounts[0];
  for (const int count : LightCounts)
  {
    double other = 0.0;
    if (count < LightCounts[0])
    {
      SetLights(task, count, lights);
      other = Measure(task, lights, few);
    }
    own = count == LightCounts[1] ? other : own;
    if (!(own <= std::min(LightsShare * task.Tolerance, LargestError)))
    {
      return nullptr;
    }
    if (other > std::min(FewerShare * task.Tolerance, LargestError))
    {
      break;
    }
    number = count;
    fewer = other;
  }
  SetLights(task, number, lights);
  error = own + fewer;
  return lights;
}

vtkSmartPointer<vtkRadianceIntegrator> TakeAdaptive(
  const PlanTask& task, PlanComparison& few, double& error)
{
  const double tolerance = std::min(ShareOfTolerance * task.Tolerance, LargestTolerance);
  const auto adaptive = vtkSmartPointer<vtkAdaptiveRadianceIntegrator>::New();
  adaptive->SetBRDF(task.BRDF);
  adaptive->SetEnvironment(task.Environment);
  adaptive->SetTolerance(Finer * tolerance);
  few.Reference = Integrate(task, adaptive, few.Pairs);
  adaptive->SetTolerance(tolerance);
  error = Measure(task, adaptive, few);
  return adaptive;
}
}

vtkSmartPointer<vtkRadianceIntegrator> MakeReference(
  const PlanTask& task, PlanComparison& comparison)
{
  PlanComparison few;
  few.Pairs = TakeSome(comparison.Pairs);
  vtkSmartPointer<vtkRadianceIntegrator> chosen;
  if (MayLightsDo(task))
  {
    chosen = TryLights(task, few, comparison.ReferenceError);
  }
  if (!chosen)
  {
    chosen = TakeAdaptive(task, few, comparison.ReferenceError);
  }
  comparison.Reference = Integrate(task, chosen, comparison.Pairs);
  return chosen;
}
} // namespace measuredbrdf
