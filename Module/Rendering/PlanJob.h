// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A plan in the making, on a thread of its own. Private to the rendering room.
 *
 * Nothing is shared with that thread but the planner: it works on snapshots (NewPlanner, apart)
 * that the render thread reads no more until the job is done, and writes nowhere else. The end of
 * the thread's work is published by Done; what it used is released by the render thread, which
 * holds the job. Reference counts and modification times are atomic in VTK; planning has no global
 * state. (VTK 9.1's vtkSMPTools keeps a plain bool that says whether some thread is in a parallel
 * loop: it decides only whether another loop runs in parallel, too.)
 */

#ifndef PlanJob_h
#define PlanJob_h

#include "SharedPlans.h"

#include <atomic>
#include <memory>
#include <string>
#include <thread>

class vtkObject;

namespace measuredbrdf
{
class PlanJob
{
public:
  /// The job for these inputs, already at work for another mapper or begun now; null where the
  /// material has no snapshots, or there are no threads. Whoever has found it has to Leave it.
  static std::shared_ptr<PlanJob> Find(const PlanInputs& inputs);

  /// Begin. Throws std::system_error where there are no threads.
  explicit PlanJob(vtkSmartPointer<vtkRadiancePlanner> planner);

  /// Aborts and waits for that: integrators look at it between the parts of their work.
  ~PlanJob();
  PlanJob(const PlanJob&) = delete;
  void operator=(const PlanJob&) = delete;

  /// One less waits for it; without anybody it stops soon.
  void Leave();

  bool IsDone() const { return this->Done; }
  void Wait();

  ///@{
  /// Once it is done: the plan, null where it failed, and the error, or the plan's last warning, or
  /// "".
  vtkSmartPointer<vtkRadiancePlanner> GetPlan() const;
  const std::string& GetProblem() const { return this->Problem; }
  ///@}

private:
  void Run();
  void Abort();
  void TakeMessage(vtkObject* caller, unsigned long event, void* text);

  vtkSmartPointer<vtkRadiancePlanner> Planner;
  vtkSmartPointer<vtkBRDF> BRDF; // the planner's, observed
  int Users = 0;                 // render thread only
  std::string Problem;
  bool Succeeded = false;
  std::atomic<bool> Done{ false };
  std::thread Thread; // last: it uses the others
};
} // namespace measuredbrdf

#endif
