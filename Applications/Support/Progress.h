// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Long work: a progress bar, and a clean stop on Ctrl-C.
 */

#ifndef Progress_h
#define Progress_h

#include <chrono>
#include <string>

namespace tool
{
class BackgroundWork;

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
} // namespace tool

#endif
