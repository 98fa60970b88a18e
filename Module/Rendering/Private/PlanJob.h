// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A plan in the making, on another thread. Private to the rendering room.
 *
 * Jobs wait in one queue for the whole program. As many run at once as there are cores while a
 * Render waits for one of them; else one fewer, which is left to drawing.
 *
 * Nothing is shared with a job's thread but the planner: it works on snapshots (NewPlanner, apart)
 * that nobody reads until the job is done, and writes nowhere else. The end of its work is
 * published by Done; what it used is released by whoever holds the job. Reference counts and
 * modification times are atomic in VTK; planning has no global state. (VTK 9.1's vtkSMPTools keeps
 * a plain bool that says whether some thread is in a parallel loop: it decides only whether another
 * loop runs in parallel, too. Jobs side by side thus hardly start more threads than cores.)
 */

#ifndef PlanJob_h
#define PlanJob_h

#include "SharedPlans.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>

class vtkObject;

namespace measuredbrdf
{
class PlanJob
{
public:
  /// The job for these inputs, already queued for another mapper or queued now; null where the
  /// material has no snapshots, or there are no threads. Whoever has found it has to Leave it.
  static std::shared_ptr<PlanJob> Find(const PlanInputs& inputs);

  explicit PlanJob(vtkSmartPointer<vtkRadiancePlanner> planner);

  /// Aborts and waits for that: integrators look at it between the parts of their work.
  ~PlanJob();
  PlanJob(const PlanJob&) = delete;
  void operator=(const PlanJob&) = delete;

  /// One less waits for it; without anybody it stops soon.
  void Leave();

  bool IsDone() const { return this->Done; }

  /// Its turn is next. progress is called now and then, with the share that is done; where it says
  /// false, this returns false before the job is done. It may be empty.
  bool Wait(const std::function<bool(double)>& progress);

  ///@{
  /// Once it is done: the plan, null where it failed, and the error, or the plan's last warning, or
  /// "".
  vtkSmartPointer<vtkRadiancePlanner> GetPlan() const;
  const std::string& GetProblem() const { return this->Problem; }
  ///@}

  /// Make the material's form for shaders, too, if the plan is not done yet.
  void WantForm() { this->WithForm = true; }

  /// While one lives, no job begins unless somebody waits for one: what a Render makes to stand in
  /// for plans comes first, as it needs the cores.
  class Hold
  {
  public:
    Hold();
    ~Hold();
    Hold(const Hold&) = delete;
    void operator=(const Hold&) = delete;
  };

  /// While one lives, a thread plans by itself: jobs that are held may run beside it.
  class Beside
  {
  public:
    Beside();
    ~Beside();
    Beside(const Beside&) = delete;
    void operator=(const Beside&) = delete;
  };

  ///@{
  /// How many jobs may run at once, and the largest number that did since the last call: for tests.
  static int GetLimit();
  static int TakeLargestNumber();
  ///@}

private:
  class Queue;
  static Queue& GetQueue();

  void Run();
  void TakeMessage(vtkObject* caller, unsigned long event, void* text);
  void TakeProgress(vtkObject* caller, unsigned long event, void* share);

  vtkSmartPointer<vtkRadiancePlanner> Planner;
  int Users = 0; // the queue's lock guards it
  std::string Problem;
  bool Succeeded = false;
  std::atomic<bool> WithForm{ false };
  std::atomic<bool> Done{ true }; // until it is queued
  std::atomic<double> Share{ 0.0 };
};
} // namespace measuredbrdf

#endif
