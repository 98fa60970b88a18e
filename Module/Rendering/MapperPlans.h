// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Placeholder of the plans of one mapper.
 */
#ifndef MapperPlans_h
#define MapperPlans_h

#include "CurrentPlan.h"

#include <map>

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace measuredbrdf
{
struct PlanRequest
{
  vtkBRDF* BRDF = nullptr;
  vtkEnvironment* Environment = nullptr;
  double Tolerance = 0.02;
  vtkRadianceCostModel* Costs = nullptr;
  CurrentPlan::Timing Timing = CurrentPlan::Timing::Foreground;
  bool ForView = false;
  int Slot = 0;
  vtkRenderer* Renderer = nullptr;
  vtkActor* Actor = nullptr;
  std::vector<vtkPolyData*> Surfaces;
};

class MapperPlans
{
public:
  CurrentPlan& Update(const PlanRequest& request, bool& changed, std::string& problem)
  {
    CurrentPlan& plan = this->Plans[request.Slot];
    changed =
      plan.Update(PlanInputs(request.BRDF, request.Environment, request.Tolerance, request.Costs),
        request.Timing, problem);
    return plan;
  }
  void Clear() { this->Plans.clear(); }
  bool IsPending() const
  {
    for (const auto& plan : this->Plans)
    {
      if (plan.second.IsPending())
        return true;
    }
    return false;
  }
  bool IsReady() const
  {
    for (const auto& plan : this->Plans)
    {
      if (plan.second.IsReady())
        return true;
    }
    return false;
  }

private:
  std::map<int, CurrentPlan> Plans;
};
} // namespace measuredbrdf
#endif
