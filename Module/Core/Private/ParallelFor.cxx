// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ParallelFor.h"

#include "vtkSMP.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <future>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
// VTK's environment variable sets how many threads its loops have at most.
int GetNumberOfOwnThreads()
{
  const char* most = std::getenv("VTK_SMP_MAX_THREADS");
  const int cores = std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
  return most && std::atoi(most) > 0 ? std::min(std::atoi(most), cores) : cores;
}

bool UsesOwnThreads()
{
  return VTK_SMP_DEFAULT_IMPLEMENTATION_SEQUENTIAL &&
         std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0 &&
         !std::getenv("VTK_SMP_BACKEND_IN_USE");
}
}

//------------------------------------------------------------------------------
int GetNumberOfThreads()
{
  return UsesOwnThreads() ? GetNumberOfOwnThreads() : vtkSMPTools::GetEstimatedNumberOfThreads();
}

//------------------------------------------------------------------------------
void ParallelFor(vtkIdType first, vtkIdType last, vtkIdType grain, const LoopPart& part)
{
  std::mutex mutex;
  std::exception_ptr thrown;
  std::atomic<bool> failed{ false };
  const std::function<bool()>& isStopped = StoppableLoops::Get();
  const auto guarded = [&](vtkIdType begin, vtkIdType end)
  {
    if (failed)
    {
      return;
    }
    try
    {
      if (isStopped && isStopped())
      {
        throw std::runtime_error("aborted");
      }
      part(begin, end);
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      thrown = thrown ? thrown : std::current_exception();
      failed = true;
    }
  };
  if (UsesOwnThreads())
  {
    RunOnThreads(GetNumberOfOwnThreads(), first, last, grain, guarded);
  }
  else
  {
    vtkSMPTools::For(first, last, grain, guarded);
  }
  if (thrown)
  {
    std::rethrow_exception(thrown);
  }
}

//------------------------------------------------------------------------------
void RunOnThreads(
  int threads, vtkIdType first, vtkIdType last, vtkIdType grain, const LoopPart& part)
{
  static thread_local bool isInLoop = false; // loops within loops stay on their thread
  const vtkIdType step = grain > 0 ? grain : std::max<vtkIdType>((last - first) / (4 * threads), 1);
  std::atomic<vtkIdType> next{ first };
  const auto work = [&]()
  {
    const bool wasInLoop = std::exchange(isInLoop, true);
    for (vtkIdType begin = next.fetch_add(step); begin < last; begin = next.fetch_add(step))
    {
      part(begin, std::min(begin + step, last));
    }
    isInLoop = wasInLoop;
  };
  std::vector<std::future<void>> others; // their ends wait for the threads
  const vtkIdType parts = (last - first + step - 1) / step;
  while (
    !isInLoop && static_cast<vtkIdType>(others.size()) + 1 < std::min<vtkIdType>(threads, parts))
  {
    try
    {
      others.push_back(std::async(std::launch::async, work));
    }
    catch (const std::exception&) // no memory or no thread: the others do it
    {
      break;
    }
  }
  work();
}
} // namespace measuredbrdf
