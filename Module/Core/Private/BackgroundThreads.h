// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Threads of the module's own, and what is released when the process ends: first the threads stop,
 * then what they may have used is released.
 */

#ifndef BackgroundThreads_h
#define BackgroundThreads_h

#include <functional>

namespace measuredbrdf
{
/**
 * Run work on a thread of its own. False where there is no thread to be had, or the process ends:
 * nothing is run then. What work throws ends it and nothing else; work reports its own failures.
 *
 * stop asks work to end soon. Another thread calls it when the process ends, which then waits for
 * the thread. It must not throw, and must not own what work owns.
 */
bool RunInBackground(std::function<void()> work, std::function<void()> stop);

/**
 * Have something called when the process ends and no thread of RunInBackground runs any more; the
 * last one first. An object that is released this way is usable until then and, empty, afterwards:
 * statics of the program may still use it. Where a thread does not stop within ten seconds, nothing
 * is released.
 */
void ReleaseAtExit(std::function<void()> release);
} // namespace measuredbrdf

#endif
