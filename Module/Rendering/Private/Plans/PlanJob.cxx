// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanJob.h"

#include "BackgroundThreads.h"
#include "ParallelFor.h"
#include "ScopedErrorCapture.h"
#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <list>
#include <mutex>
#include <thread>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr std::chrono::milliseconds ProgressInterval(50); // of a job that is waited for
}

PlanInputs::PlanInputs(vtkBRDF* brdf, vtkEnvironment* environment, double tolerance)
  : BRDF(brdf)
  , BRDFTime(brdf->GetMTime())
  , Environment(environment)
  , PixelsTime(environment->GetPixelsMTime())
  , Tolerance(tolerance)
{
}

vtkSmartPointer<vtkRadiancePlanner> NewPlanner(const PlanInputs& inputs, bool apart)
{
  vtkSmartPointer<vtkBRDF> brdf =
    apart ? vtkSmartPointer<vtkBRDF>::Take(inputs.BRDF->NewSnapshot()) : inputs.BRDF;
  if (!brdf)
  {
    return nullptr;
  }
  auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
  planner->SetBRDF(brdf);
  planner->SetEnvironment(
    apart ? vtkSmartPointer<vtkEnvironment>::Take(inputs.Environment->NewSnapshot())
          : inputs.Environment);
  planner->SetErrorTolerance(inputs.Tolerance);
  planner->SetMaximumCost(inputs.MaximumCost);
  if (inputs.Seen)
  {
    planner->SetPairs(inputs.Seen->Normals, inputs.Seen->Views);
  }
  return planner;
}

// Its threads end when nothing is left to do, or the process ends. The queue is never destroyed.
struct PlanJob::Queue
{
  using Lock = std::unique_lock<std::mutex>;
  using Jobs = std::list<std::shared_ptr<PlanJob>>;

  // Whether there is a thread for it, or will be.
  bool Add(const std::shared_ptr<PlanJob>& job)
  {
    const Lock lock(this->Mutex);
    this->Waiting.push_back(job);
    this->AddThread();
    if (this->Threads == 0 || this->IsStopped)
    {
      this->Waiting.pop_back();
      return false;
    }
    return true;
  }

  // With the lock, for which the thread waits. Where there is none, those that there are have to
  // do.
  void AddThread()
  {
    if (!this->Waiting.empty() && this->Threads < this->Limit + (this->Waiters > 0 ? 1 : 0))
    {
      this->Threads +=
        RunInBackground([this]() { this->Work(); }, [this]() { this->Stop(); }) ? 1 : 0;
    }
  }

  void Work()
  {
    Lock lock(this->Mutex);
    const auto mayBegin = [this]()
    {
      return this->Waiting.empty() ||
             (this->Waiters > 0 ? this->Running <= this->Limit
                                : this->Holds == 0 && this->Running < this->Limit);
    };
    for (this->Changed.wait(lock, mayBegin); !this->Waiting.empty();
         this->Changed.wait(lock, mayBegin))
    {
      const auto place = this->Waiting.begin();
      this->Current.splice(this->Current.end(), this->Waiting, place);
      ++this->Running;
      lock.unlock();
      (*place)->Work(nullptr);
      lock.lock();
      --this->Running;
      std::shared_ptr<PlanJob> job = std::move(*place);
      job->Done = true;
      this->Changed.notify_all();
      lock.unlock();
      job.reset(); // with all that it used, where nobody waits for it
      lock.lock();
      this->Current.erase(place);
      this->Changed.notify_all();
    }
    --this->Threads;
  }

  // Nobody waits for it any more.
  void Leave(const std::shared_ptr<PlanJob>& job)
  {
    const Lock lock(this->Mutex);
    this->Waiting.remove(job);
    job->IsLeft = true;
    job->Planner->SetAbort(!job->Done);
    this->Changed.notify_all();
  }

  // The process ends.
  void Stop()
  {
    Jobs dropped; // after the lock
    const Lock lock(this->Mutex);
    this->IsStopped = true;
    dropped.swap(this->Waiting);
    for (const std::shared_ptr<PlanJob>& job : dropped)
    {
      job->Done = true;
    }
    for (const std::shared_ptr<PlanJob>& job : this->Current)
    {
      if (job)
      {
        job->Planner->SetAbort(true);
      }
    }
    this->Changed.notify_all();
  }

  void ChangeHolds(int change)
  {
    const Lock lock(this->Mutex);
    this->Holds += change;
    this->Changed.notify_all();
  }

  const int Limit = std::max(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1);
  std::mutex Mutex;
  std::condition_variable Changed;
  Jobs Waiting;
  Jobs Current; // null: done, and about to be released
  int Threads = 0;
  int Running = 0; // jobs
  int Waiters = 0; // Renders
  int Holds = 0;
  bool IsStopped = false;
  HeldObjects<PlanInputs::Key, PlanJob> ByInputs; // which has a lock of its own
};

PlanJob::Queue& PlanJob::GetQueue()
{
  static Queue& queue = *new Queue;
  return queue;
}

PlanJob::Hold::Hold() { GetQueue().ChangeHolds(1); }

PlanJob::Hold::~Hold() { GetQueue().ChangeHolds(-1); }

PlanJob::PlanJob(vtkSmartPointer<vtkRadiancePlanner> planner)
  : Planner(planner)
{
}

// What is handed out is not the job itself, which the queue holds while it runs, but a pointer to
// it that says when the last one lets go.
std::shared_ptr<PlanJob> PlanJob::Begin(const PlanInputs& inputs)
{
  if (std::shared_ptr<PlanJob> found = GetQueue().ByInputs.Find(inputs.GetKey()))
  {
    found->WithShaderInputs = found->WithShaderInputs || inputs.WithShaderInputs;
    return found;
  }
  const vtkSmartPointer<vtkRadiancePlanner> planner = NewPlanner(inputs, true);
  if (!planner)
  {
    return nullptr;
  }
  const auto job = std::make_shared<PlanJob>(planner);
  job->WithShaderInputs = inputs.WithShaderInputs;
  const std::shared_ptr<PlanJob> handle(job.get(),
    [owned = job](PlanJob*) mutable
    {
      GetQueue().Leave(owned);
      owned.reset();
    });
  if (!GetQueue().Add(job))
  {
    return nullptr;
  }
  GetQueue().ByInputs.Add(inputs.GetKey(), handle);
  return handle;
}

std::shared_ptr<PlanJob> PlanJob::FindMade(const PlanInputs& inputs)
{
  const std::shared_ptr<PlanJob> found = GetQueue().ByInputs.Find(inputs.GetKey());
  return found && found->Done && found->Succeeded ? found : nullptr;
}

std::shared_ptr<PlanJob> PlanJob::Run(
  const PlanInputs& inputs, bool apart, const Progress& progress)
{
  const vtkSmartPointer<vtkRadiancePlanner> planner = NewPlanner(inputs, apart);
  const auto job = std::make_shared<PlanJob>(planner ? planner : NewPlanner(inputs, false));
  job->Work(progress);
  job->Done = true;
  if (job->Succeeded)
  {
    GetQueue().ByInputs.Add(inputs.GetKey(), job);
  }
  return job;
}

void PlanJob::WaitForStopped()
{
  Queue& queue = GetQueue();
  Queue::Lock lock(queue.Mutex);
  queue.Changed.wait(lock,
    [&queue]()
    {
      return std::none_of(queue.Current.begin(), queue.Current.end(),
        [](const std::shared_ptr<PlanJob>& job) { return !job || job->IsLeft; });
    });
}

bool PlanJob::Wait(const Progress& progress)
{
  Queue& queue = GetQueue();
  Queue::Lock lock(queue.Mutex);
  const auto it = std::find_if(queue.Waiting.begin(), queue.Waiting.end(),
    [this](const std::shared_ptr<PlanJob>& other) { return other.get() == this; });
  if (it != queue.Waiting.end())
  {
    queue.Waiting.splice(queue.Waiting.begin(), queue.Waiting, it);
  }
  ++queue.Waiters;
  const std::shared_ptr<Queue> waits(&queue, // also where a program's observer throws
    [&lock](Queue* waited)
    {
      if (!lock.owns_lock())
      {
        lock.lock();
      }
      --waited->Waiters;
    });
  queue.Changed.notify_all();
  queue.AddThread();
  for (bool goes = true; goes && !this->Done;)
  {
    lock.unlock();
    goes = !progress || progress(this->Share);
    lock.lock();
    queue.Changed.wait_for(lock, ProgressInterval, [this, goes]() { return !goes || this->Done; });
  }
  return this->Done;
}

void PlanJob::Work(const Progress& progress)
{
  this->Tell = progress;
  const vtkSmartPointer<vtkBRDF> brdf = this->Planner->GetBRDF();
  unsigned long tags[2] = { 0, 0 };                     // no observer's
  const std::optional<std::string> thrown = FindThrown( // nobody catches it above a thread
    [this, &brdf, &tags]()
    {
      tags[0] = this->Planner->AddObserver(vtkCommand::ProgressEvent, this, &PlanJob::TakeProgress);
      tags[1] = brdf->AddObserver(vtkCommand::WarningEvent, this, &PlanJob::TakeWarning);
      // Nobody's output window has to cope with other threads.
      const ScopedErrorCapture error(this->Planner);
      this->Succeeded = this->Planner->Update();
      this->Problem = this->Succeeded ? this->Problem : error.GetText();
      if (this->Succeeded && this->WithShaderInputs && !this->Planner->GetAbort())
      {
        const StoppableLoops loops([this]() { return this->Planner->GetAbort(); });
        brdf->GetRenderable(); // here, not where it is drawn
      }
    });
  if (thrown)
  {
    this->Succeeded = false;
    this->Problem = *thrown;
  }
  this->Planner->RemoveObserver(tags[0]);
  brdf->RemoveObserver(tags[1]);
}

void PlanJob::TakeProgress(vtkObject*, unsigned long, void* share)
{
  this->Share = share ? *static_cast<double*>(share) : 0.0;
  if (this->Tell && !this->Tell(this->Share))
  {
    this->Planner->SetAbort(true);
  }
}

void PlanJob::TakeWarning(vtkObject*, unsigned long, void* text)
{
  this->Problem = text ? static_cast<const char*>(text) : "";
}
} // namespace measuredbrdf
