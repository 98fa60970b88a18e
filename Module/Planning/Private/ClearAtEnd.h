// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the end of a planner's run leaves. Private to the module.
 */

#ifndef ClearAtEnd_h
#define ClearAtEnd_h

#include "PlanCandidate.h"

#include <atomic>

namespace measuredbrdf
{
/// Whatever way a run ends; plans outlive it, in mappers, and share nothing.
class ClearAtEnd
{
public:
  ClearAtEnd(std::atomic<bool>& flag, PlanTask& task)
    : Flag(flag)
    , Task(task)
  {
  }
  ~ClearAtEnd()
  {
    this->Flag = false;
    this->Task = PlanTask();
  }
  ClearAtEnd(const ClearAtEnd&) = delete;
  void operator=(const ClearAtEnd&) = delete;

private:
  std::atomic<bool>& Flag;
  PlanTask& Task;
};
} // namespace measuredbrdf

#endif
