// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanJob.h"

#include "BackgroundThreads.h"
#include "ParallelFor.h"
#include "ScopedErrorCapture.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

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
    vtkNew<vtkDoubleArray> normals, views;
    inputs.Seen->CopyTo(normals, views);
    planner->SetPairs(normals, views);
  }
  return planner;
}

// Its threads end when nothing is left to do, or the process ends. The queue is never destroyed.
class PlanJob::Queue
{
public:
  using Lock = std::unique_lock<std::mutex>;
  using Jobs = std::list<std::shared_ptr<PlanJob>>;

  /// Whether there is a thread for it, or will be.
  bool Add(const std::shared_ptr<PlanJob>& job, const Lock& lock)
  {
    this->Waiting.push_back(job);
    this->AddThread(lock);
    if (this->Running == 0)
    {
      this->Waiting.pop_back();
    }
    return this->Running > 0;
  }

  /// Nobody waits for it any more.
  void Leave(std::shared_ptr<PlanJob> job)
  {
    const Lock lock(this->Mutex);
    job->IsLeft = true;
    this->Waiting.remove(job);
    if (!job->Done)
    {
      job->Planner->SetAbort(true);
    }
  }

  /// goesOn is asked now and then, without the lock. Whether the job is done; false: it said no.
  bool Wait(const PlanJob* job, const std::function<bool()>& goesOn)
  {
    Lock lock(this->Mutex);
    const auto it = std::find_if(this->Waiting.begin(), this->Waiting.end(),
      [job](const std::shared_ptr<PlanJob>& other) { return other.get() == job; });
    if (it != this->Waiting.end())
    {
      this->Waiting.splice(this->Waiting.begin(), this->Waiting, it);
    }
    ++this->Waiters;
    const std::shared_ptr<int> waits(&this->Waiters, // also where a program's observer throws
      [this, &lock](int* waiters)
      {
        if (!lock.owns_lock())
        {
          lock.lock();
        }
        --*waiters;
      });
    this->Released.notify_all();
    this->AddThread(lock);
    for (bool goes = true; goes && !job->IsDone();)
    {
      lock.unlock();
      goes = goesOn();
      lock.lock();
      this->Finished.wait_for(
        lock, ProgressInterval, [job, goes]() { return !goes || job->IsDone(); });
    }
    return job->IsDone();
  }

  void WaitForStopped()
  {
    Lock lock(this->Mutex);
    this->Finished.wait(lock,
      [this]()
      {
        return std::none_of(this->Current.begin(), this->Current.end(),
          [](const std::shared_ptr<PlanJob>& job) { return !job || job->IsLeft; });
      });
  }

  void ChangeHolds(int change)
  {
    const Lock lock(this->Mutex);
    this->Holds += change;
    this->Released.notify_all();
  }

  std::mutex Mutex;
  std::map<PlanInputs::Key, std::weak_ptr<PlanJob>> ByInputs;

private:
  int GetLimit() const { return this->Waiters > 0 ? this->Cores : std::max(this->Cores - 1, 1); }

  void AddThread(const Lock&)
  {
    if (this->Waiting.empty() || this->Running >= this->GetLimit())
    {
      return;
    }
    // It waits for the lock. Where there is none, those that there are have to do.
    this->Running +=
      RunInBackground([this]() { this->Work(); }, [this]() { this->Stop(); }) ? 1 : 0;
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
    this->Released.notify_all();
    this->Finished.notify_all();
  }

  void Work()
  {
    Lock lock(this->Mutex);
    const auto mayBegin = [this]()
    { return this->Holds == 0 || this->Waiters > 0 || this->IsStopped; };
    for (this->Released.wait(lock, mayBegin);
         !this->Waiting.empty() && this->Running <= this->GetLimit();
         this->Released.wait(lock, mayBegin))
    {
      const auto current = this->Waiting.begin();
      this->Current.splice(this->Current.end(), this->Waiting, current);
      lock.unlock();
      (*current)->Run(nullptr);
      lock.lock();
      std::shared_ptr<PlanJob> job = std::move(*current);
      job->Done = true;
      this->Finished.notify_all();
      lock.unlock();
      job.reset(); // with all that it used, where nobody waits for it
      lock.lock();
      this->Current.erase(current);
      this->Finished.notify_all();
    }
    --this->Running;
  }

  const int Cores = std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
  Jobs Waiting;
  Jobs Current; // those that run; null: about to be released
  std::condition_variable Finished;
  std::condition_variable Released;
  int Running = 0; // threads
  int Waiters = 0;
  int Holds = 0;
  bool IsStopped = false;
};

PlanJob::Queue& PlanJob::GetQueue()
{
  static Queue& queue = *new Queue;
  return queue;
}

PlanJob::Hold::Hold() { GetQueue().ChangeHolds(1); }

PlanJob::Hold::~Hold() { GetQueue().ChangeHolds(-1); }

// What is handed out is not the job itself, which the queue holds while it runs, but a pointer to
// it that says when the last one lets go.
std::shared_ptr<PlanJob> PlanJob::Find(const PlanInputs& inputs)
{
  Queue& queue = GetQueue();
  const PlanInputs::Key key = inputs.GetKey();
  {
    const Queue::Lock lock(queue.Mutex);
    const auto known = queue.ByInputs.find(key);
    if (std::shared_ptr<PlanJob> found =
          known == queue.ByInputs.end() ? nullptr : known->second.lock())
    {
      found->WithShaderInputs = found->WithShaderInputs || inputs.WithShaderInputs;
      return found;
    }
  }
  const vtkSmartPointer<vtkRadiancePlanner> planner = NewPlanner(inputs, true);
  if (!planner)
  {
    return nullptr;
  }
  const auto job = std::make_shared<PlanJob>(planner);
  job->WithShaderInputs = inputs.WithShaderInputs;
  const std::shared_ptr<PlanJob> handle(job.get(),
    [owned = job](PlanJob*) mutable { GetQueue().Leave(std::exchange(owned, nullptr)); });
  const Queue::Lock lock(queue.Mutex);
  for (auto it = queue.ByInputs.begin(); it != queue.ByInputs.end();)
  {
    it = it->second.expired() ? queue.ByInputs.erase(it) : std::next(it);
  }
  if (!queue.Add(job, lock))
  {
    return nullptr;
  }
  queue.ByInputs[key] = handle;
  return handle;
}

void PlanJob::WaitForStopped() { GetQueue().WaitForStopped(); }

bool PlanJob::Wait(const Progress& progress)
{
  return GetQueue().Wait(this, [&]() { return !progress || progress(this->Share); });
}

vtkSmartPointer<vtkRadiancePlanner> PlanJob::GetPlan() const
{
  return this->Succeeded ? this->Planner : nullptr;
}

PlanJob::PlanJob(vtkSmartPointer<vtkRadiancePlanner> planner)
  : Planner(planner)
{
}

void PlanJob::Run(const Progress& progress)
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
