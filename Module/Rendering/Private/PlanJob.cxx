// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanJob.h"

#include "BackgroundThreads.h"
#include "ParallelFor.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkRadiancePlanner.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <iterator>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr std::chrono::milliseconds ProgressInterval(50); // of a job that is waited for
}

// Its threads end when nothing is left to do, or the process ends. The queue is never destroyed.
class PlanJob::Queue
{
public:
  using Lock = std::unique_lock<std::mutex>;

  int GetLimit() const { return this->Waiters > 0 ? this->Cores : std::max(this->Cores - 1, 1); }

  /// Whether there is a thread for it, or will be.
  bool Add(PlanJob* job, const Lock& lock)
  {
    this->Jobs.push_back(job);
    this->AddThread(lock);
    job->Done = this->Running == 0;
    return !job->Done || !this->Remove(job, lock);
  }

  /// Whether it was still waiting for its turn.
  bool Remove(PlanJob* job, const Lock&)
  {
    const auto it = std::find(this->Jobs.begin(), this->Jobs.end(), job);
    const bool found = it != this->Jobs.end();
    if (found)
    {
      this->Jobs.erase(it);
    }
    return found;
  }

  /// goesOn is asked now and then, without the lock. Whether the job is done; false: it said no.
  bool Wait(PlanJob* job, Lock& lock, const std::function<bool()>& goesOn)
  {
    if (this->Remove(job, lock))
    {
      this->Jobs.push_front(job);
    }
    ++this->Waiters;
    this->Released.notify_all();
    this->AddThread(lock);
    while (!job->IsDone())
    {
      lock.unlock();
      const bool goes = goesOn();
      lock.lock();
      if (!goes)
      {
        break;
      }
      this->Finished.wait_for(lock, ProgressInterval, [job]() { return job->IsDone(); });
    }
    --this->Waiters;
    return job->IsDone();
  }

  void Change(int Queue::*count, int change)
  {
    const Lock lock(this->Mutex);
    this->*count += change;
    this->Released.notify_all();
  }

  std::mutex Mutex;
  std::map<PlanInputs::Key, std::weak_ptr<PlanJob>> ByInputs;
  int Largest = 0; // number of jobs that ran at once
  int Holds = 0;
  int Planning = 0; // threads that plan by themselves

private:
  void AddThread(const Lock&)
  {
    if (this->Jobs.empty() || this->Running >= this->GetLimit())
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
    const Lock lock(this->Mutex);
    this->IsStopped = true;
    for (PlanJob* job : this->Jobs)
    {
      job->Done = true;
    }
    this->Jobs.clear();
    for (PlanJob* job : this->Current)
    {
      job->Planner->SetAbort(true);
    }
    this->Released.notify_all();
    this->Finished.notify_all();
  }

  void Work()
  {
    Lock lock(this->Mutex);
    const auto mayBegin = [this]()
    { return this->Holds == 0 || this->Waiters > 0 || this->Planning > 0 || this->IsStopped; };
    for (this->Released.wait(lock, mayBegin);
         !this->Jobs.empty() && this->Running <= this->GetLimit();
         this->Released.wait(lock, mayBegin))
    {
      PlanJob* job = this->Jobs.front();
      this->Largest = std::max(this->Largest, this->Running);
      this->Current.splice(this->Current.end(), this->Jobs, this->Jobs.begin());
      const auto current = std::prev(this->Current.end());
      lock.unlock();
      job->Run();
      lock.lock();
      this->Current.erase(current);
      job->Done = true; // and it may be gone when the lock is
      this->Finished.notify_all();
    }
    --this->Running;
  }

  const int Cores = std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
  std::list<PlanJob*> Jobs;    // which wait
  std::list<PlanJob*> Current; // those that run
  std::condition_variable Finished;
  std::condition_variable Released;
  int Running = 0; // threads
  int Waiters = 0;
  bool IsStopped = false;
};

PlanJob::Queue& PlanJob::GetQueue()
{
  static Queue& queue = *new Queue;
  return queue;
}

PlanJob::Hold::Hold() { GetQueue().Change(&Queue::Holds, 1); }

PlanJob::Hold::~Hold() { GetQueue().Change(&Queue::Holds, -1); }

PlanJob::Beside::Beside() { GetQueue().Change(&Queue::Planning, 1); }

PlanJob::Beside::~Beside() { GetQueue().Change(&Queue::Planning, -1); }

int PlanJob::GetLimit()
{
  Queue& queue = GetQueue();
  const Queue::Lock lock(queue.Mutex);
  return queue.GetLimit();
}

int PlanJob::TakeLargestNumber()
{
  Queue& queue = GetQueue();
  const Queue::Lock lock(queue.Mutex);
  return std::exchange(queue.Largest, 0);
}

std::shared_ptr<PlanJob> PlanJob::Find(const PlanInputs& inputs)
{
  Queue& queue = GetQueue();
  const PlanInputs::Key key = inputs.GetKey();
  // Without the queue's lock: it may be the last to hold what it finds.
  const auto find = [&](const Queue::Lock&)
  {
    for (auto it = queue.ByInputs.begin(); it != queue.ByInputs.end();)
    {
      it = it->second.expired() ? queue.ByInputs.erase(it) : std::next(it);
    }
    const auto it = queue.ByInputs.find(key);
    return it == queue.ByInputs.end() ? nullptr : it->second.lock();
  };
  std::shared_ptr<PlanJob> job;
  {
    const Queue::Lock lock(queue.Mutex);
    job = find(lock);
    if (job && job->Users > 0) // else it is about to stop
    {
      job->WithForm = job->WithForm || inputs.WithForm;
      ++job->Users;
      return job;
    }
  }
  const vtkSmartPointer<vtkRadiancePlanner> planner = NewPlanner(inputs, true);
  if (!planner)
  {
    return nullptr;
  }
  const auto made = std::make_shared<PlanJob>(planner);
  made->WithForm = inputs.WithForm;
  const Queue::Lock lock(queue.Mutex);
  if (!queue.Add(made.get(), lock))
  {
    return nullptr;
  }
  made->Users = 1;
  queue.ByInputs[key] = made;
  return made;
}

PlanJob::PlanJob(vtkSmartPointer<vtkRadiancePlanner> planner)
  : Planner(planner)
{
}

PlanJob::~PlanJob()
{
  Queue& queue = GetQueue();
  Queue::Lock lock(queue.Mutex);
  if (!this->Done && !queue.Remove(this, lock))
  {
    this->Planner->SetAbort(true);
    queue.Wait(this, lock, []() { return true; });
  }
}

void PlanJob::Run()
{
  const vtkSmartPointer<vtkBRDF> brdf = this->Planner->GetBRDF();
  unsigned long tags[3] = { 0, 0, 0 };
  try
  {
    // Nobody's output window has to cope with other threads.
    tags[0] = this->Planner->AddObserver(vtkCommand::ErrorEvent, this, &PlanJob::TakeMessage);
    tags[1] = brdf->AddObserver(vtkCommand::WarningEvent, this, &PlanJob::TakeMessage);
    tags[2] = this->Planner->AddObserver(vtkCommand::ProgressEvent, this, &PlanJob::TakeProgress);
    this->Succeeded = this->Planner->Update();
    if (this->Succeeded && this->WithForm && !this->Planner->GetAbort())
    {
      const StoppableLoops loops([this]() { return this->Planner->GetAbort(); });
      brdf->GetRenderable(); // here, not where it is drawn
    }
  }
  catch (const std::exception& e) // no memory, say: nobody catches it above a thread
  {
    this->Succeeded = false;
    this->Problem = e.what();
  }
  catch (...) // of a program's own material
  {
    this->Succeeded = false;
    this->Problem = "an unknown exception";
  }
  this->Planner->RemoveObserver(tags[0]);
  brdf->RemoveObserver(tags[1]);
  this->Planner->RemoveObserver(tags[2]);
}

void PlanJob::TakeProgress(vtkObject*, unsigned long, void* share)
{
  this->Share = share ? *static_cast<double*>(share) : 0.0;
}

void PlanJob::TakeMessage(vtkObject*, unsigned long, void* text)
{
  this->Problem = text ? static_cast<const char*>(text) : "";
}

void PlanJob::Leave()
{
  Queue& queue = GetQueue();
  const Queue::Lock lock(queue.Mutex);
  if (--this->Users == 0 && !this->Done)
  {
    if (queue.Remove(this, lock))
    {
      this->Problem = "left before its turn";
      this->Done = true;
    }
    else
    {
      this->Planner->SetAbort(true);
    }
  }
}

bool PlanJob::Wait(const std::function<bool(double)>& progress)
{
  Queue& queue = GetQueue();
  Queue::Lock lock(queue.Mutex);
  return queue.Wait(this, lock, [&]() { return !progress || progress(this->Share); });
}

vtkSmartPointer<vtkRadiancePlanner> PlanJob::GetPlan() const
{
  return this->Succeeded ? this->Planner : nullptr;
}
} // namespace measuredbrdf
