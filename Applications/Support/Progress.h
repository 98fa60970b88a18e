// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Long work: a progress bar, a clean stop on Ctrl-C, and the same on a thread beside a window.
 */

#ifndef Progress_h
#define Progress_h

#include "vtkCommand.h"
#include "vtkObject.h"

#include <atomic>
#include <chrono>
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

  const std::function<void(const std::string&, double)> Show;
  std::string Errors; // of VTK, since they were taken
  std::string Notes;  // one line each

private:
  const std::atomic<bool>& Stopped;
  BackgroundWork* Outer;
};

/// While one of these lives, Ctrl-C only sets a flag. On a thread with a BackgroundWork, which
/// needs none of these, the flag is that work's.
class Interruptible
{
public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  void operator=(const Interruptible&) = delete;

  static bool IsInterrupted();

  /// Throws Error("interrupted") where Ctrl-C was pressed.
  static void Check();
};

/// A bar on stderr where that is a terminal; nothing else. On a thread with a BackgroundWork, that
/// shows it. With the time left where it takes long; a bar within another one is not shown.
class ProgressBar
{
public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  void operator=(const ProgressBar&) = delete;

  void Update(double share);

private:
  std::string GetTimeLeft(double share) const;

  std::string Label;
  BackgroundWork* Work; // shows it instead; may be null
  bool Terminal;
  std::chrono::steady_clock::time_point Begin;
  int Shown = -1;
};

///@{
/**
 * run(maker), a method of the maker or a function, which raises ProgressEvent (calldata: double*)
 * and stops at SetAbort(true); show gets the share done, the other form draws a bar of that label.
 * Returns what run returns; throws Error where Ctrl-C was pressed. Needs an Interruptible.
 */
template <typename Maker, typename Run>
bool RunWithProgress(Maker* maker, Run run, const std::function<void(double)>& show)
{
  struct Watcher
  {
    Maker* Source;
    const std::function<void(double)>& Show;

    void OnProgress(vtkObject*, unsigned long, void* data)
    {
      if (data)
      {
        this->Show(*static_cast<double*>(data));
      }
      if (Interruptible::IsInterrupted())
      {
        this->Source->SetAbort(true);
      }
    }
  } watcher{ maker, show };
  const unsigned long tag =
    maker->AddObserver(vtkCommand::ProgressEvent, &watcher, &Watcher::OnProgress);
  const bool done = std::invoke(run, maker);
  maker->RemoveObserver(tag);
  Interruptible::Check();
  return done;
}

template <typename Maker, typename Run>
bool RunWithProgress(Maker* maker, Run run, const std::string& label)
{
  ProgressBar bar(label);
  return RunWithProgress(
    maker, run, std::function<void(double)>([&bar](double share) { bar.Update(share); }));
}
///@}
} // namespace tool

#endif
