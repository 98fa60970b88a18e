// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The plans that a mapper draws by, one for each view of each of its materials.
 *
 * A view is a renderer or, where plans are for what the camera sees, an actor in a renderer. Each
 * view is drawn by its own plan, and an old plan stands in for a new one in its own view only.
 * Views that want the same plan share it (CurrentPlan).
 */

#ifndef MapperPlans_h
#define MapperPlans_h

#include "CurrentPlan.h"
#include "vtkType.h"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

class vtkActor;
class vtkBRDF;
class vtkEnvironment;
class vtkPolyData;
class vtkRadiancePlanner;
class vtkRenderer;

namespace measuredbrdf
{
class MapperPlans;

/// What a mapper wants to draw one of its materials by, now.
struct PlanRequest
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  double Tolerance = 0.0;
  double MaximumCost = 1e6; // no bound
  CurrentPlan::Timing Timing = CurrentPlan::Timing::Foreground;
  bool ForView = false; // or for every view
  /// Which of the mapper's materials. Null: the one that is set for all, whatever it is: the plan
  /// of the last one stands in for the plan of the next one.
  vtkBRDF* Member = nullptr;
  vtkRenderer* Renderer = nullptr;
  vtkActor* Actor = nullptr;
  std::vector<vtkPolyData*> Surfaces; // what ForView looks at
  bool WithShaderInputs = false;      // PlanInputs::WithShaderInputs

  /// Visits what other mappers of the renderer want to draw by in the same frame; this one may be
  /// among them. Where Update has to plan at once, it begins theirs side by side. May be empty.
  using Visit = std::function<void(MapperPlans&, const PlanRequest&)>;
  std::function<void(const Visit&)> Others;

  /// Update calls it now and then while it plans or waits, with the share that is done. It stops if
  /// that returns false. May be empty.
  CurrentPlan::Progress Progress;
};

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
  using Key = std::tuple<vtkRenderer*, vtkBRDF*, vtkActor*>; // the member, and for the view
  using AllViews = std::map<Key, std::shared_ptr<View>>;

  std::shared_ptr<View> FindView(const PlanRequest& request);
  template <typename Condition>
  void EraseIf(const Condition& condition);
  static void Look(View& view, const PlanRequest& request);
  static PlanInputs GetInputs(View& view, const PlanRequest& request);
  void BeginSideBySide(View& view, const PlanInputs& wanted, const PlanRequest& request);

  AllViews Views;
  bool ForView = false;    // of the last request
  std::size_t Updates = 0; // since the last look for views that are gone
};
} // namespace measuredbrdf

#endif
