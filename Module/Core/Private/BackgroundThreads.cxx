// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BackgroundThreads.h"

#include "ParallelFor.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <future>
#include <list>
#include <mutex>
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

struct BackgroundThread
{
  std::function<void()> Stop;
  std::future<void> Work; // its end waits for the thread
};

// Never destroyed: threads may still run when a process's statics go.
struct BackgroundThreads
{
  std::mutex Mutex;
  std::list<BackgroundThread> Threads;
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
      GetNumberOfThreads();
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
    this->IsEnding = true; // no thread comes or goes any more
    lock.unlock();
    for (const BackgroundThread& thread : this->Threads)
    {
      thread.Stop();
    }
    const auto last = std::chrono::steady_clock::now() + ThreadPatience;
    const bool areDone = std::all_of(this->Threads.begin(), this->Threads.end(),
      [&last](const BackgroundThread& thread)
      { return thread.Work.wait_until(last) == std::future_status::ready; });
    if (areDone)
    {
      this->Threads.clear();
      for (auto release = this->Releases.rbegin(); release != this->Releases.rend(); ++release)
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
  std::list<BackgroundThread> done; // outlives the lock, as a thread that did not start does
  const std::lock_guard<std::mutex> lock(threads.Mutex);
  if (threads.IsEnding)
  {
    return false;
  }
  threads.Register();
  for (auto next = threads.Threads.begin(); next != threads.Threads.end();)
  {
    const auto thread = next++;
    if (thread->Work.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    {
      done.splice(done.end(), threads.Threads, thread);
    }
  }
  try // there may be no memory, or no thread
  {
    std::list<BackgroundThread> made(1);
    made.front().Stop = std::move(stop);
    made.front().Work = std::async(std::launch::async,
      [own = std::move(work)]() mutable
      {
        FindThrown(own); // nobody catches it above a thread
        own = nullptr;   // what it held goes before the thread counts as ended
      });
    threads.Threads.splice(threads.Threads.end(), made);
  }
  catch (const std::exception&)
  {
    return false;
  }
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
