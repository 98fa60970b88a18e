// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The plan that one view is drawn by, and the next one in the making. Private to the rendering
 * room.
 */

#ifndef CurrentPlan_h
#define CurrentPlan_h

#include "PlanJob.h"

#include <memory>
#include <string>
#include <vector>

namespace measuredbrdf
{
class CurrentPlan
{
public:
  CurrentPlan() = default;
  ~CurrentPlan();
  CurrentPlan(const CurrentPlan&) = delete;
  void operator=(const CurrentPlan&) = delete;

  enum class Timing
  {
    Foreground, // what is wanted, however long it takes
    Changes,    // meanwhile the last plan, where that can still be drawn
    Always      // meanwhile the last plan, or none
  };

  using Progress = PlanJob::Progress;

  /// Plan for this, or begin to: a new plan takes the place of the last when it is done. Returns
  /// whether it did. problem: why there is none, or what a plan made apart had to warn of, or "".
  /// What could not be planned, for lack of memory say, is not tried again until it changes.
  bool Update(const PlanInputs& wanted, Timing timing, std::string& problem,
    const Progress& progress = nullptr);

  /// Whether Update would plan in the calling thread, or wait.
  bool WouldBlock(const PlanInputs& wanted, Timing timing) const;

  /// Begin with the plan on another thread, if the material allows that, for an Update to come.
  void Begin(const PlanInputs& wanted);

  /// Whether the plan is the one for this, or is known not to be possible.
  bool IsFor(const PlanInputs& wanted) const;

  /// Begin as another one is, without what that has in the making.
  void CopyFrom(const CurrentPlan& other);

  ///@{
  /// The plan to draw by, of the objects or of snapshots of them, and the environment whose
  /// rotation applies to it; null where there is none.
  vtkRadiancePlanner* GetPlan() const { return this->Plan; }
  vtkEnvironment* GetEnvironment() const { return this->Inputs.Environment; }
  ///@}

  /// Whether another plan is in the making, or made and not taken up yet.
  bool IsPending() const { return this->Job != nullptr; }

  /// Whether Update would take up the one in the making.
  bool IsReady() const { return this->Job && this->Job->IsDone(); }

  /// What was uploaded to draw by this plan: kept for as long as the view is drawn by it, for other
  /// views may be drawn in between.
  std::vector<std::shared_ptr<void>> Uploads;

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
