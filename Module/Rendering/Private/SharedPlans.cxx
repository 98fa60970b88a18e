// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedPlans.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"

#include <glm/gtc/type_ptr.hpp>

#include <utility>

namespace measuredbrdf
{
namespace
{
using SharedPlans = SharedObjects<std::pair<PlanInputs::Key, bool>, vtkRadiancePlanner>;

// From the environment's frame.
vtkSmartPointer<vtkDoubleArray> ToWorld(
  const std::vector<glm::dvec3>& directions, vtkEnvironment* environment)
{
  double rows[9];
  environment->GetWorldToEnvironment(rows);
  const glm::dmat3 toWorld = glm::make_mat3(rows); // glm takes columns: the transpose
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(3);
  for (const glm::dvec3& direction : directions)
  {
    const glm::dvec3 turned = toWorld * direction;
    array->InsertNextTuple(&turned.x);
  }
  return array;
}
}

PlanInputs::PlanInputs(vtkBRDF* brdf, vtkEnvironment* environment, double tolerance)
  : BRDF(brdf)
  , BRDFTime(brdf->GetMTime())
  , Environment(environment)
  , PixelsTime(environment->GetPixelsMTime())
  , Tolerance(tolerance)
{
}

vtkSmartPointer<vtkRadiancePlanner> NewPlanner(const PlanInputs& inputs, bool apart)
{
  vtkSmartPointer<vtkBRDF> brdf =
    apart ? vtkSmartPointer<vtkBRDF>::Take(inputs.BRDF->NewSnapshot()) : inputs.BRDF;
  if (!brdf)
  {
    return nullptr;
  }
  auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
  planner->SetBRDF(brdf);
  planner->SetEnvironment(
    apart ? vtkSmartPointer<vtkEnvironment>::Take(inputs.Environment->NewSnapshot())
          : inputs.Environment);
  planner->SetErrorTolerance(inputs.Tolerance);
  planner->SetMaximumCost(inputs.MaximumCost);
  if (inputs.Seen)
  {
    planner->SetPairs(ToWorld(inputs.Seen->GetNormals(), planner->GetEnvironment()),
      ToWorld(inputs.Seen->GetViews(), planner->GetEnvironment()));
  }
  return planner;
}

vtkSmartPointer<vtkRadiancePlanner> FindPlan(const PlanInputs& inputs, bool apart)
{
  const auto none = []() { return vtkSmartPointer<vtkRadiancePlanner>(); };
  vtkSmartPointer<vtkRadiancePlanner> plan =
    SharedPlans::Get().Find({ inputs.GetKey(), true }, none);
  return plan || apart ? plan : SharedPlans::Get().Find({ inputs.GetKey(), false }, none);
}

void SharePlan(const PlanInputs& inputs, bool apart, vtkRadiancePlanner* plan)
{
  if (!FindPlan(inputs, apart)) // not under two keys: nobody else would be left to hold it
  {
    SharedPlans::Get().Find(
      { inputs.GetKey(), apart }, [plan]() { return vtkSmartPointer<vtkRadiancePlanner>(plan); });
  }
}

void SweepPlans() { SharedPlans::Get().Sweep(); }
} // namespace measuredbrdf
