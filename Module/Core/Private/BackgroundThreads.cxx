// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BackgroundThreads.h"

#include "RunGuarded.h"
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

#if !defined(_WIN32)
#include <unistd.h>
#endif

namespace measuredbrdf
{
namespace
{
constexpr std::chrono::seconds ThreadPatience(10); // with threads, when the process ends

// Never destroyed: threads may still run when a process's statics go.
class BackgroundThreads
{
public:
  static BackgroundThreads& Get()
  {
    static BackgroundThreads& threads = *new BackgroundThreads;
    return threads;
  }

  bool Run(std::function<void()> work, std::function<void()> stop)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->IsEnding)
    {
      return false;
    }
    this->Register();
    std::list<std::function<void()>> made;
    try
    {
      made.push_back(std::move(stop));
      const auto place = made.begin();
      std::thread(
        [this, place, own = std::move(work)]() mutable
        {
          FindThrown(own); // nobody catches it above a thread
          own = nullptr;   // what it held goes before the thread counts as ended
          std::unique_lock<std::mutex> held(this->Mutex); // until all else of the thread is gone
          this->Stops.erase(place);
          std::notify_all_at_thread_exit(this->Changed, std::move(held));
        })
        .detach();
    }
    catch (const std::exception&) // no thread, or no memory for one
    {
      return false;
    }
    this->Stops.splice(this->Stops.end(), made); // before the thread has the lock
    return true;
  }

  void AddRelease(std::function<void()> release)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Register();
    this->Releases.push_back(std::move(release));
  }

private:
  // Statics go in the reverse order in which they were made: the ones that VTK makes when they are
  // first used have to be there before.
  void Register()
  {
    if (!this->IsRegistered)
    {
      vtkSMPTools::GetEstimatedNumberOfThreads();
      this->IsRegistered = std::atexit([]() { Get().End(); }) == 0;
#if !defined(_WIN32)
      this->Process = ::getpid();
#endif
    }
  }

  void End()
  {
#if defined(_WIN32)
    return; // other threads are gone, perhaps with locks held, when libraries end there
#else
    if (::getpid() != this->Process) // a fork has none of the threads
    {
      return;
    }
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->IsEnding = true;
    const std::list<std::function<void()>> stops = this->Stops;
    lock.unlock();
    for (const std::function<void()>& stop : stops)
    {
      stop();
    }
    lock.lock();
    if (!this->Changed.wait_for(lock, ThreadPatience, [this]() { return this->Stops.empty(); }))
    {
      return;
    }
    const std::vector<std::function<void()>> releases = std::move(this->Releases);
    lock.unlock();
    for (auto release = releases.rbegin(); release != releases.rend(); ++release)
    {
      (*release)();
    }
#endif
  }

  std::mutex Mutex;
  std::condition_variable Changed;
  std::list<std::function<void()>> Stops; // one for each thread
  std::vector<std::function<void()>> Releases;
  bool IsRegistered = false;
  bool IsEnding = false;
#if !defined(_WIN32)
  pid_t Process = 0;
#endif
};
}

bool RunInBackground(std::function<void()> work, std::function<void()> stop)
{
  return BackgroundThreads::Get().Run(std::move(work), std::move(stop));
}

void ReleaseAtExit(std::function<void()> release)
{
  BackgroundThreads::Get().AddRelease(std::move(release));
}
} // namespace measuredbrdf
