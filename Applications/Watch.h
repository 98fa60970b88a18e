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

#include <string>

namespace tool
{
/**
 * (maker->*run)(), which raises ProgressEvent (calldata: double*) and stops at SetAbort(true).
 * Returns what it returns; throws Error where Ctrl-C was pressed. Needs an Interruptible.
 */
template <typename Maker>
bool Watch(Maker* maker, bool (Maker::*run)(), const std::string& label)
{
  struct Watcher
  {
    Maker* Source;
    ProgressBar Bar;

    void OnProgress(vtkObject*, unsigned long, void* data)
    {
      this->Bar.Update(*static_cast<double*>(data));
      if (Interruptible::IsInterrupted())
      {
        this->Source->SetAbort(true);
      }
    }
  };
  bool done = false;
  {
    Watcher watcher{ maker, ProgressBar(label) };
    const unsigned long tag =
      maker->AddObserver(vtkCommand::ProgressEvent, &watcher, &Watcher::OnProgress);
    done = (maker->*run)();
    maker->RemoveObserver(tag);
  }
  Interruptible::Check();
  return done;
}
} // namespace tool

#endif
