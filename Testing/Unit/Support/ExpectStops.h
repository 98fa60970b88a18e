// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What classes promise that tell of their progress and have a flag to abort.
 */

#ifndef ExpectStops_h
#define ExpectStops_h

#include "ErrorCatcher.h"
#include "vtkCommand.h"

#include <gtest/gtest.h>

#include <initializer_list>

/**
 * run() succeeds, and progress grows to 1. Where the flag is set at a share of it, run() fails with
 * so many messages, and what get() gives stays. The flag does not: the next run() succeeds.
 */
template <typename Worker, typename Run, typename Get>
void ExpectStops(Worker* worker, const Run& run, const Get& get, int messages = 0,
  std::initializer_list<double> shares = { 0.0, 0.5 })
{
  struct Observer
  {
    Worker* Object;
    double At;
    double Last = -1.0;

    void Look(vtkObject*, unsigned long, void* data)
    {
      const double share = *static_cast<double*>(data);
      EXPECT_GE(share, this->Last);
      EXPECT_LE(share, 1.0);
      this->Last = share;
      if (share >= this->At)
      {
        this->Object->SetAbort(true);
      }
    }
  };
  constexpr double never = 2.0;
  ErrorCatcher errors(worker);
  Observer observer{ worker, never };
  const unsigned long tag =
    worker->AddObserver(vtkCommand::ProgressEvent, &observer, &Observer::Look);
  ASSERT_TRUE(run());
  EXPECT_EQ(observer.Last, 1.0);
  for (const double share : shares)
  {
    const auto before = get();
    observer = { worker, share };
    EXPECT_FALSE(run()) << share;
    EXPECT_EQ(errors.Take(), messages) << errors.GetText();
    EXPECT_EQ(get(), before);
    EXPECT_LT(observer.Last, 1.0);
  }
  observer = { worker, never };
  EXPECT_TRUE(run());
  worker->RemoveObserver(tag);
}

#endif
