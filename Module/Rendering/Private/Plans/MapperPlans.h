// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The plans that a mapper draws by: one for each of its materials in each renderer.
 */

#ifndef MapperPlans_h
#define MapperPlans_h

#include "PlanJob.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

class vtkRenderer;

namespace measuredbrdf
{
/// The plan that one material is drawn by in one renderer, and the next one in the making.
class CurrentPlan
{
public:
  /// What Update does while a new plan is wanted and not there yet.
  enum class Timing
  {
    Foreground, // plan, or wait for the plan in the making
    Changes,    // keep the last plan, if that can still be drawn; else plan
    Always      // keep the last plan, or have none
  };

  /// Bring the plan up to date, or begin to. Returns whether another plan took the place of the
  /// last one. problem says why there is no plan, or what the plan had to warn of; else it is "".
  /// What could not be planned, for lack of memory for instance, is not tried again until it
  /// changes.
  bool Update(const PlanInputs& wanted, Timing timing, std::string& problem,
    const PlanJob::Progress& progress = nullptr);

  /// Whether Update would take long: it would plan in the calling thread or wait for another one.
  bool WouldBlock(const PlanInputs& wanted, Timing timing) const;

  /// Begin the plan on another thread, for an Update to come. Does nothing for a material that has
  /// no snapshots.
  void Begin(const PlanInputs& wanted);

  ///@{
  /// The plan to draw by, which is of the objects or of snapshots of them, and the environment
  /// whose rotation applies to it. Null where there is none.
  vtkRadiancePlanner* GetPlan() const { return this->Current ? this->Current->GetPlan() : nullptr; }
  vtkEnvironment* GetEnvironment() const { return this->Inputs.Environment; }
  ///@}

  /// Whether another plan is in the making, or made and not taken up yet.
  bool IsPending() const { return this->Next != nullptr; }

  /// Whether Update would take up the one in the making.
  bool IsReady() const { return this->Next && this->Next->IsDone(); }

private:
  bool EnsureCurrent(const PlanInputs& wanted, Timing timing, const PlanJob::Progress& progress,
    std::string& problem);
  bool CanShowPrevious(Timing timing) const;
  bool IsFor(const PlanInputs& wanted) const;
  bool IsUsable() const;
  void Adopt(const PlanInputs& inputs, std::shared_ptr<PlanJob> job);

  std::shared_ptr<PlanJob> Current; // null or without a plan: what Inputs ask for can't be planned
  PlanInputs Inputs;                // of the plan
  std::shared_ptr<PlanJob> Next;
  PlanInputs::Key NextKey;
};

/// What a mapper wants to draw one of its materials by, now.
struct PlanRequest
{
  PlanInputs Inputs;
  CurrentPlan::Timing Timing = CurrentPlan::Timing::Foreground;
  /// Which of the mapper's materials. Null: the one that is set for all, whatever it is: the plan
  /// of the last one stands in for the plan of the next one.
  vtkBRDF* Member = nullptr;
  vtkRenderer* Renderer = nullptr;

  /// Update calls it now and then while it plans or waits, with the share that is done. It stops if
  /// that returns false. May be empty.
  PlanJob::Progress Progress;
};

/// An old plan stands in for a new one in its own view only. Views that want the same plan share
/// it.
class MapperPlans
{
public:
  MapperPlans();
  ~MapperPlans();
  MapperPlans(const MapperPlans&) = delete;
  void operator=(const MapperPlans&) = delete;

  /// The view's plan after CurrentPlan::Update. changed says whether it is another one than after
  /// the last call for this view. What is returned stays valid when an observer of progress, or a
  /// later call, drops the view.
  std::shared_ptr<CurrentPlan> Update(
    const PlanRequest& request, bool& changed, std::string& problem);

  /// Begin the plans of several materials side by side, where Update would have to wait for more
  /// than one of them.
  void BeginAll(const std::vector<PlanRequest>& requests);

  ///@{
  /// Drop the plans of all views, or of a renderer's. What is in the making stops, but nobody waits
  /// for that.
  void Clear();
  void Clear(vtkRenderer* renderer);
  ///@}

  /// Drop the plans of materials that are not known any more, and the plans in the making of those
  /// that are not in use.
  void Keep(const std::set<vtkBRDF*>& inUse, const std::set<vtkBRDF*>& known);

  ///@{
  /// Whether some view was drawn by another plan than was wanted, which is in the making; whether
  /// one of these is made and not taken up yet.
  bool IsPending() const;
  bool IsReady() const;
  ///@}

  /// Views that have or want a plan: for tests.
  int GetNumberOfViews() const { return static_cast<int>(this->Views.size()); }

private:
  struct View;
  using Key = std::pair<vtkRenderer*, vtkBRDF*>; // the member

  std::shared_ptr<View> FindView(const PlanRequest& request);
  template <typename Condition>
  void EraseIf(const Condition& condition);

  std::map<Key, std::shared_ptr<View>> Views;
  std::size_t Updates = 0; // since the last look for views that are gone
};
} // namespace measuredbrdf

#endif
