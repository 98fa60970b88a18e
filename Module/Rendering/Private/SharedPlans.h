// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Plans of a material under an environment, made once and shared by all mappers that hold them:
 * what was asked for, and who has it. Private to the rendering room.
 */

#ifndef SharedPlans_h
#define SharedPlans_h

#include "VisibleSurface.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
#include <string>
#include <tuple>

class vtkBRDF;
class vtkEnvironment;
class vtkRadiancePlanner;

namespace measuredbrdf
{
/// What to plan for, at one moment: it differs from a later one where anything changed since.
struct PlanInputs
{
  PlanInputs() = default;
  PlanInputs(vtkBRDF* brdf, vtkEnvironment* environment, double tolerance);

  /// The plans' key. Modification times are never used twice: a recycled address does no harm.
  using Key =
    std::tuple<vtkBRDF*, vtkMTimeType, vtkEnvironment*, vtkMTimeType, double, double, vtkMTimeType>;
  Key GetKey() const
  {
    return { this->BRDF, this->BRDFTime, this->Environment, this->PixelsTime, this->Tolerance,
      this->MaximumCost, this->SeenTime };
  }

  vtkSmartPointer<vtkBRDF> BRDF;
  vtkMTimeType BRDFTime = 0;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkMTimeType PixelsTime = 0;
  double Tolerance = 0.0;
  double MaximumCost = 150.0;

  ///@{
  /// What the camera sees, in the environment's frame, and a time that no other one has; null, 0:
  /// a plan for every view.
  std::shared_ptr<const VisibleSurface> Seen;
  vtkMTimeType SeenTime = 0;
  ///@}

  /// Whether whoever plans apart sees to the material's form for shaders, too, because the scene's
  /// lights need it. It changes nothing about the plan.
  bool WithForm = false;
};

/// A plan's planner, not updated yet, of the objects themselves or, apart, of snapshots of its own,
/// which nobody changes, nor makes them prepare what they make when first asked for. Null where a
/// material has none.
vtkSmartPointer<vtkRadiancePlanner> NewPlanner(const PlanInputs& inputs, bool apart);

/// The plan that somebody has; null where nobody has. apart: of snapshots only.
vtkSmartPointer<vtkRadiancePlanner> FindPlan(const PlanInputs& inputs, bool apart);

/// Let others find a plan, for as long as somebody holds it.
void SharePlan(const PlanInputs& inputs, bool apart, vtkRadiancePlanner* plan);

/// Release the plans that nobody holds any more.
void SweepPlans();
} // namespace measuredbrdf

#endif
