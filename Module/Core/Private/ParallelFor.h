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
#include "vtkType.h"

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
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

/// As many as run at once in a loop.
int GetNumberOfThreads();

/// A part of a loop, from the first element to before the last.
using LoopPart = std::function<void(vtkIdType, vtkIdType)>;

/**
 * vtkSMPTools::For of parts of grain elements (0: as VTK has them). What a part throws is thrown
 * here once all parts have ended, the first of several; parts that have not begun are left out.
 * VTK's own threads would end the process.
 *
 * VTK's wheels for Python are built to run loops on one thread. With such a VTK, loops run on
 * threads of this module's own, unless the environment's VTK_SMP_BACKEND_IN_USE is set.
 */
void ParallelFor(vtkIdType first, vtkIdType last, vtkIdType grain, const LoopPart& part);

inline void ParallelFor(vtkIdType first, vtkIdType last, const LoopPart& part)
{
  ParallelFor(first, last, 0, part);
}

/// vtkSMPTools::For on so many threads of this module's own, the calling one among them. What a
/// part throws ends the process.
void RunOnThreads(
  int threads, vtkIdType first, vtkIdType last, vtkIdType grain, const LoopPart& part);

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
