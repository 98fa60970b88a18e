// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A loop on several threads whose work may throw.
 */

#ifndef ParallelFor_h
#define ParallelFor_h

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace measuredbrdf
{
/// While it lives, loops that this thread begins throw between their parts once isStopped holds.
/// Any thread calls that.
class StoppableLoops
{
public:
  explicit StoppableLoops(std::function<bool()> isStopped) { Get() = std::move(isStopped); }
  ~StoppableLoops() { Get() = nullptr; }
  StoppableLoops(const StoppableLoops&) = delete;
  void operator=(const StoppableLoops&) = delete;
  static std::function<bool()>& Get()
  {
    static thread_local std::function<bool()> isStopped;
    return isStopped;
  }
};

/// vtkSMPTools::For of parts of grain elements (0: as VTK has them). What a part throws is thrown
/// here once all parts have ended, the first of several; parts that have not begun are left out.
/// VTK's own threads would end the process.
template <typename Part>
void ParallelFor(vtkIdType first, vtkIdType last, vtkIdType grain, const Part& part)
{
  std::mutex mutex;
  std::exception_ptr thrown;
  std::atomic<bool> failed{ false };
  const std::function<bool()>& isStopped = StoppableLoops::Get();
  vtkSMPTools::For(first, last, grain,
    [&](vtkIdType begin, vtkIdType end)
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
    });
  if (thrown)
  {
    std::rethrow_exception(thrown);
  }
}

template <typename Part>
void ParallelFor(vtkIdType first, vtkIdType last, const Part& part)
{
  ParallelFor(first, last, 0, part);
}
} // namespace measuredbrdf

#endif
