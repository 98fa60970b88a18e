// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LaneForms_h
#define LaneForms_h

#include "Lanes.h"

#include <gtest/gtest.h>

/// Calls a test for each kind of vectors that the processor has.
template <typename Test>
void ForEachLaneForm(const Test& test)
{
  bool& usesWidest = measuredbrdf::UsesWidestVectors();
  const bool hasWider = usesWidest;
  for (const bool isWidest : { false, true })
  {
    if (!isWidest || hasWider)
    {
      SCOPED_TRACE(isWidest ? "widest vectors" : "vectors of every processor");
      usesWidest = isWidest;
      test();
    }
  }
  usesWidest = hasWider;
}

#endif
