// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BackgroundThreads.h"

#include "ParallelFor.h"
#include "vtkSMPTools.h"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <list>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

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
    std::list<Entry> done;
    const bool runs = this->Start(std::move(work), std::move(stop), done);
    Join(done);
    return runs;
  }

  void AddRelease(std::function<void()> release)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Register();
    this->Releases.push_back(std::move(release));
  }

private:
  struct Entry
  {
    std::function<void()> Stop;
    std::thread Thread;
    bool IsDone = false; // but for what the thread itself still destroys
  };

  bool Start(std::function<void()> work, std::function<void()> stop, std::list<Entry>& done)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->IsEnding)
    {
      return false;
    }
    this->Register();
    this->TakeDone(done);
    try // there may be no memory, or no thread
    {
      std::list<Entry> made(1);
      const auto place = made.begin();
      place->Stop = std::move(stop);
      place->Thread = std::thread(
        [this, place, own = std::move(work)]() mutable
        {
          FindThrown(own); // nobody catches it above a thread
          own = nullptr;   // what it held goes before the thread counts as ended
          const std::lock_guard<std::mutex> held(this->Mutex);
          place->IsDone = true;
          this->Changed.notify_all();
        });
      this->Entries.splice(this->Entries.end(), made);
    }
    catch (const std::exception&)
    {
      return false;
    }
    return true;
  }

  void TakeDone(std::list<Entry>& done)
  {
    for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
    {
      const auto next = std::next(entry);
      if (entry->IsDone)
      {
        done.splice(done.end(), this->Entries, entry);
      }
      entry = next;
    }
  }

  static void Join(std::list<Entry>& done)
  {
    for (Entry& entry : done)
    {
      entry.Thread.join();
    }
  }

  // Statics go in the reverse order in which they were made: the ones that VTK makes when they are
  // first used have to be there before.
  void Register()
  {
    if (!this->IsRegistered)
    {
      vtkSMPTools::GetEstimatedNumberOfThreads();
      this->IsRegistered = std::atexit([]() { Get().End(); }) == 0;
      this->Process = ::getpid();
    }
  }

  void End()
  {
    if (::getpid() != this->Process) // a fork has none of the threads
    {
      return;
    }
    std::vector<std::function<void()>> stops;
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->IsEnding = true;
    for (const Entry& entry : this->Entries)
    {
      stops.push_back(entry.Stop);
    }
    lock.unlock();
    for (const std::function<void()>& stop : stops)
    {
      stop();
    }
    stops.clear();
    lock.lock();
    std::list<Entry> done;
    const auto isDone = [this, &done]()
    {
      this->TakeDone(done);
      return this->Entries.empty();
    };
    if (!this->Changed.wait_for(lock, ThreadPatience, isDone))
    {
      lock.unlock();
      Join(done);
      return;
    }
    const std::vector<std::function<void()>> releases = std::move(this->Releases);
    lock.unlock();
    Join(done);
    for (auto release = releases.rbegin(); release != releases.rend(); ++release)
    {
      (*release)();
    }
  }

  std::mutex Mutex;
  std::condition_variable Changed;
  std::list<Entry> Entries; // one for each thread
  std::vector<std::function<void()>> Releases;
  bool IsRegistered = false;
  bool IsEnding = false;
  pid_t Process = 0;
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
