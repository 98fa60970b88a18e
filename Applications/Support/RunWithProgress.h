// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Run the long work of a VTK object under a progress bar that Ctrl-C stops.
 */

#ifndef Watch_h
#define Watch_h

#include "Progress.h"

#include "vtkCommand.h"
#include "vtkObject.h"

#include <functional>
#include <string>

namespace tool
{
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
