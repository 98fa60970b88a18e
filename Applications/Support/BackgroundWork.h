// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Work of the tool on a thread of its own, beside a window.
 */

#ifndef BackgroundWork_h
#define BackgroundWork_h

#include <atomic>
#include <functional>
#include <string>

namespace tool
{
/**
 * While one of these lives on a thread, that thread's progress bars go to a function, its errors
 * and notes stay here instead of going to stderr, and a flag takes the place of Ctrl-C.
 */
class BackgroundWork
{
public:
  /// stop: asked from time to time, set by any thread. show: gets what is being done and the share
  /// of it, on this thread.
  BackgroundWork(
    const std::atomic<bool>& stop, std::function<void(const std::string&, double)> show);
  ~BackgroundWork();
  BackgroundWork(const BackgroundWork&) = delete;
  void operator=(const BackgroundWork&) = delete;

  /// This thread's; null where there is none.
  static BackgroundWork* Get();

  bool IsStopped() const { return this->Stopped; }

  void Show(const std::string& label, double share) const { this->ShowProgress(label, share); }

  std::string Errors; // of VTK, since they were taken
  std::string Notes;  // one line each

private:
  std::function<void(const std::string&, double)> ShowProgress;
  const std::atomic<bool>& Stopped;
  BackgroundWork* Outer;
};
} // namespace tool

#endif
