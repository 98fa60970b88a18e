// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What is planned for, and a plan in the making or made, mostly on another thread.
 *
 * Jobs wait in one queue for the whole program. As many run at once as there are cores while a
 * Render waits for one of them; else one fewer, which is left to drawing.
 *
 * Nothing is shared with a job's thread but the planner: it works on snapshots (NewPlanner, apart)
 * that nobody reads until the job is done, and writes nowhere else. The end of its work is
 * published by Done; what it used is released by whoever holds the job last, which is its thread
 * where it was stopped. Reference counts and modification times are atomic in VTK; planning has no
 * global state. (VTK 9.1's vtkSMPTools keeps a plain bool that says whether some thread is in a
 * parallel loop: it decides only whether another loop runs in parallel, too. Jobs side by side thus
 * hardly start more threads than cores.)
 */

#ifndef PlanJob_h
#define PlanJob_h

#include "VisibleSurface.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <tuple>

class vtkBRDF;
class vtkEnvironment;
class vtkObject;
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
  double MaximumCost = 1e6; // no bound

  ///@{
  /// What a camera sees, in the frame of the renderer's environment, and a time that no other one
  /// has; null, 0: a plan for every view.
  std::shared_ptr<const VisibleSurface> Seen;
  vtkMTimeType SeenTime = 0;
  ///@}

  /// Whether whoever plans apart sees to the material's shader inputs, too, because the scene's
  /// lights need it. It changes nothing about the plan.
  bool WithShaderInputs = false;
};

/// A plan's planner, not updated yet, of the objects themselves or, apart, of snapshots of its own,
/// which nobody changes, nor makes them prepare what they make when first asked for. Null where a
/// material has none.
vtkSmartPointer<vtkRadiancePlanner> NewPlanner(const PlanInputs& inputs, bool apart);

class PlanJob
{
public:
  /// Called now and then, with the share that is done. If it returns false, the plan stops, or the
  /// wait for it. May be empty.
  using Progress = std::function<bool(double)>;

  ///@{
  /// Mappers share the jobs for the same inputs for as long as one of them holds it. Begin: the one
  /// that somebody holds, done or not, or a new one on a thread; null where the material has no
  /// snapshots, or there are no threads. FindMade: one that has succeeded; null: nobody holds one.
  /// Run: a new one in the calling thread. A job stops when nobody holds it any more; whoever lets
  /// go of it does not wait for that.
  static std::shared_ptr<PlanJob> Begin(const PlanInputs& inputs);
  static std::shared_ptr<PlanJob> FindMade(const PlanInputs& inputs);
  static std::shared_ptr<PlanJob> Run(
    const PlanInputs& inputs, bool apart, const Progress& progress);
  ///@}

  /// Wait until all jobs that were stopped have ended. Integrators look for an abort between the
  /// parts of their work.
  static void WaitForStopped();

  explicit PlanJob(vtkSmartPointer<vtkRadiancePlanner> planner);

  bool IsDone() const { return this->Done; }

  /// Wait for the job, whose turn is next. Returns false where progress stopped the wait before the
  /// job was done.
  bool Wait(const Progress& progress);

  ///@{
  /// Once it is done: the plan, null where it failed, and the error, or the plan's last warning, or
  /// "".
  vtkRadiancePlanner* GetPlan() const { return this->Succeeded ? this->Planner.Get() : nullptr; }
  const std::string& GetProblem() const { return this->Problem; }
  ///@}

  /// While one of these lives, no job begins unless somebody waits for one. A Render holds one
  /// while it makes what stands in for plans, which needs the cores.
  class Hold
  {
  public:
    Hold();
    ~Hold();
    Hold(const Hold&) = delete;
    void operator=(const Hold&) = delete;
  };

private:
  struct Queue;
  static Queue& GetQueue();

  void Work(const Progress& progress);
  void TakeProgress(vtkObject* caller, unsigned long event, void* share);
  void TakeWarning(vtkObject* caller, unsigned long event, void* text);

  vtkSmartPointer<vtkRadiancePlanner> Planner;
  Progress Tell;
  std::string Problem;
  bool Succeeded = false;
  std::atomic<bool> WithShaderInputs{ false }; // make the material's, too
  std::atomic<bool> Done{ false };
  bool IsLeft = false; // nobody waits for it any more; the queue's lock guards it
  std::atomic<double> Share{ 0.0 };
};
} // namespace measuredbrdf

#endif
