// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Work that may throw, under VTK, which catches nothing: loops on several threads, and methods that
 * VTK calls.
 */

#ifndef ParallelFor_h
#define ParallelFor_h

#include "vtkObject.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
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

/// Calls use(k) for each k < count; not for those that are left once abort holds. A thread takes
/// `grain` of them at a time (0: as VTK has them).
template <typename Index, typename Use>
void ParallelForEach(
  Index count, const Use& use, const std::atomic<bool>* abort = nullptr, vtkIdType grain = 1)
{
  ParallelFor(0, static_cast<vtkIdType>(count), grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end && !(abort && *abort); ++k)
      {
        use(static_cast<Index>(k));
      }
    });
}

/// What work throws, for lack of memory say.
template <typename Work>
std::optional<std::string> FindThrown(const Work& work)
{
  try
  {
    work();
    return std::nullopt;
  }
  catch (const std::exception& e)
  {
    return e.what();
  }
  catch (...) // of a program's own material
  {
    return "an unknown exception";
  }
}

/// Whether work was done. What it throws is an error of the object.
template <typename Work>
bool RunGuarded(vtkObject* object, const char* method, const Work& work)
{
  const std::optional<std::string> problem = FindThrown(work);
  if (problem)
  {
    vtkErrorWithObjectMacro(object, << method << ": " << *problem << ".");
  }
  return !problem;
}
} // namespace measuredbrdf

#endif
