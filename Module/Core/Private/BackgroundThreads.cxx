// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BackgroundThreads.h"

#include "ParallelFor.h"
#include "vtkSMPTools.h"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <list>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#if defined(_WIN32)
#include <process.h>
#else
#include <unistd.h>
#endif

namespace measuredbrdf
{
namespace
{
constexpr std::chrono::seconds ThreadPatience(10); // with threads, when the process ends

int GetProcess()
{
#if defined(_WIN32)
  return ::_getpid();
#else
  return ::getpid();
#endif
}

// Never destroyed: threads may still run when a process's statics go.
struct BackgroundThreads
{
  std::mutex Mutex;
  std::condition_variable Changed;
  std::list<std::function<void()>> Stops; // one for each thread that works
  int Running = 0;                        // threads, with those that destroy what they kept
  std::vector<std::function<void()>> Releases;
  bool IsRegistered = false;
  bool IsEnding = false;
  int Process = 0;

  static BackgroundThreads& Get()
  {
    static BackgroundThreads& threads = *new BackgroundThreads;
    return threads;
  }

  // Statics go in the reverse order in which they were made: the ones that VTK makes when they are
  // first used have to be there before.
  void Register()
  {
    if (!this->IsRegistered)
    {
      vtkSMPTools::GetEstimatedNumberOfThreads();
      this->IsRegistered = std::atexit([]() { Get().End(); }) == 0;
      this->Process = GetProcess();
    }
  }

  void End()
  {
    if (GetProcess() != this->Process) // a fork has none of the threads
    {
      return;
    }
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->IsEnding = true;
    auto stops = this->Stops;
    lock.unlock();
    for (const std::function<void()>& stop : stops)
    {
      stop();
    }
    stops.clear();
    lock.lock();
    if (this->Changed.wait_for(lock, ThreadPatience, [this]() { return this->Running == 0; }))
    {
      const std::vector<std::function<void()>> releases = std::move(this->Releases);
      lock.unlock();
      for (auto release = releases.rbegin(); release != releases.rend(); ++release)
      {
        (*release)();
      }
    }
  }
};
}

bool RunInBackground(std::function<void()> work, std::function<void()> stop)
{
  BackgroundThreads& threads = BackgroundThreads::Get();
  std::list<std::function<void()>> made; // outlives the lock, as a thread that did not start does
  const std::lock_guard<std::mutex> lock(threads.Mutex);
  if (threads.IsEnding)
  {
    return false;
  }
  threads.Register();
  try // there may be no memory, or no thread
  {
    made.push_back(std::move(stop));
    std::thread(
      [&threads, place = made.begin(), own = std::move(work)]() mutable
      {
        FindThrown(own); // nobody catches it above a thread
        own = nullptr;   // what it held goes before the thread counts as ended
        std::list<std::function<void()>> ended;
        std::unique_lock<std::mutex> held(threads.Mutex);
        ended.splice(ended.end(), threads.Stops, place);
        held.unlock();
        ended.clear();
        held.lock();
        --threads.Running;
        std::notify_all_at_thread_exit(threads.Changed, std::move(held));
      })
      .detach();
  }
  catch (const std::exception&)
  {
    return false;
  }
  threads.Stops.splice(threads.Stops.end(), made);
  ++threads.Running;
  return true;
}

void ReleaseAtExit(std::function<void()> release)
{
  BackgroundThreads& threads = BackgroundThreads::Get();
  const std::lock_guard<std::mutex> lock(threads.Mutex);
  threads.Register();
  threads.Releases.push_back(std::move(release));
}
} // namespace measuredbrdf
