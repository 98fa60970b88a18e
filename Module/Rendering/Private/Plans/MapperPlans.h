// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The plans that a mapper draws by, one for each view of each of its materials. Private to the
 * rendering room.
 *
 * A view is a renderer or, planned for the view, an actor in it. What one view is drawn by is never
 * shown in another, and an old plan stands in for a new one in its own view only. Equal plans are
 * shared (CurrentPlan).
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
class vtkWindow;

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
  /// Which of the mapper's materials; null: the one that is set for all, of which one's plan stands
  /// in for the next one's.
  vtkBRDF* Member = nullptr;
  vtkRenderer* Renderer = nullptr;
  vtkActor* Actor = nullptr;
  std::vector<vtkPolyData*> Surfaces; // what ForView looks at
  bool WithShaderInputs = false;      // PlanInputs::WithShaderInputs

  /// Visits what other mappers of the renderer want to draw by in the same frame (this one may be
  /// among them): where Update has to plan at once, it begins theirs side by side. May be empty.
  using Visit = std::function<void(MapperPlans&, const PlanRequest&)>;
  std::function<void(const Visit&)> Others;

  /// Called now and then while Update plans in the calling thread, with the share that is done;
  /// false stops it. May be empty.
  CurrentPlan::Progress Progress;
};

class MapperPlans
{
public:
  MapperPlans();
  ~MapperPlans();
  MapperPlans(const MapperPlans&) = delete;
  void operator=(const MapperPlans&) = delete;

  /// The view's plan, brought up to date, or with a newer one begun (CurrentPlan::Update). changed:
  /// whether it is another one than in the last call for this view. What is returned stays until
  /// the next call of a function that is not const.
  CurrentPlan& Update(const PlanRequest& request, bool& changed, std::string& problem);

  ///@{
  /// No plans any more, of all views or of a renderer's; what is in the making stops, but is not
  /// waited for.
  void Clear();
  void Clear(vtkRenderer* renderer);
  ///@}

  /// In all views: plans of other members than these, in the making or made, go (known), or only
  /// what is in the making (inUse).
  void Keep(const std::set<vtkBRDF*>& inUse, const std::set<vtkBRDF*>& known);

  /// Let go of what was uploaded to a window.
  void ReleaseUploads(vtkWindow* window);

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
  /// What the request's view was drawn by before ForView was switched.
  std::vector<AllViews::iterator> FindOfOtherKind(const PlanRequest& request);
  template <typename Condition>
  void EraseIf(const Condition& condition);
  static void Look(View& view, const PlanRequest& request);
  static PlanInputs GetInputs(View& view, const PlanRequest& request);
  void BeginSideBySide(View& view, const PlanInputs& wanted, const PlanRequest& request);

  AllViews Views;
  std::size_t Updates = 0; // since the last look for views that are gone
};
} // namespace measuredbrdf

#endif
