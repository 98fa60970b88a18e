// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The plan that one view is drawn by, and the next one in the making.
 */

#ifndef CurrentPlan_h
#define CurrentPlan_h

#include "PlanJob.h"

#include <memory>
#include <string>

namespace measuredbrdf
{
class CurrentPlan
{
public:
  CurrentPlan() = default;
  ~CurrentPlan();
  CurrentPlan(const CurrentPlan&) = delete;
  void operator=(const CurrentPlan&) = delete;

  /// What Update does while a new plan is wanted and not there yet.
  enum class Timing
  {
    Foreground, // plan, or wait for the plan in the making
    Changes,    // keep the last plan, if that can still be drawn; else plan
    Always      // keep the last plan, or have none
  };

  using Progress = PlanJob::Progress;

  /// Bring the plan up to date, or begin to. Returns whether another plan took the place of the
  /// last one. problem says why there is no plan, or what the plan had to warn of; else it is "".
  /// What could not be planned, for lack of memory for instance, is not tried again until it
  /// changes.
  bool Update(const PlanInputs& wanted, Timing timing, std::string& problem,
    const Progress& progress = nullptr);

  /// Whether Update would take long: it would plan in the calling thread or wait for another one.
  bool WouldBlock(const PlanInputs& wanted, Timing timing) const;

  /// Begin the plan on another thread, for an Update to come. Does nothing for a material that has
  /// no snapshots.
  void Begin(const PlanInputs& wanted);

  /// Whether the plan is the one for this, or is known not to be possible.
  bool IsFor(const PlanInputs& wanted) const;

  ///@{
  /// The plan to draw by, which is of the objects or of snapshots of them, and the environment
  /// whose rotation applies to it. Null where there is none.
  vtkRadiancePlanner* GetPlan() const { return this->Plan; }
  vtkEnvironment* GetEnvironment() const { return this->Inputs.Environment; }
  ///@}

  /// Whether another plan is in the making, or made and not taken up yet.
  bool IsPending() const { return this->Job != nullptr; }

  /// Whether Update would take up the one in the making.
  bool IsReady() const { return this->Job && this->Job->IsDone(); }

private:
  bool EnsureCurrent(
    const PlanInputs& wanted, Timing timing, const Progress& progress, std::string& problem);
  bool CanShowPrevious(Timing timing) const;
  bool IsUsable() const;
  void Adopt(const PlanInputs& inputs, vtkSmartPointer<vtkRadiancePlanner> plan);

  vtkSmartPointer<vtkRadiancePlanner> Plan; // null: what Inputs ask for can't be planned
  PlanInputs Inputs;                        // of the plan
  vtkMTimeType Times[2] = { 0, 0 };         // of the plan's own objects when it was taken up

  std::shared_ptr<PlanJob> Job;
  PlanInputs::Key JobKey;
};
} // namespace measuredbrdf

#endif
