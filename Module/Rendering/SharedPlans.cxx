// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedPlans.h"

#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"

#include <tuple>

namespace measuredbrdf
{
vtkSmartPointer<vtkRadiancePlanner> FindPlan(
  vtkBRDF* brdf, vtkEnvironment* environment, double tolerance)
{
  using Key = std::tuple<vtkBRDF*, vtkMTimeType, vtkEnvironment*, vtkMTimeType, double>;
  static SharedObjects<Key, vtkRadiancePlanner> plans;
  return plans.Find(
    { brdf, brdf->GetMTime(), environment, environment->GetPixelsMTime(), tolerance },
    [&]() -> vtkSmartPointer<vtkRadiancePlanner>
    {
      auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
      planner->SetBRDF(brdf);
      planner->SetEnvironment(environment);
      planner->SetErrorTolerance(tolerance);
      planner->SetCacheFolder(vtkRadiancePlanner::GetDefaultCacheFolder());
      return planner->Update() ? planner : nullptr;
    });
}
} // namespace measuredbrdf
