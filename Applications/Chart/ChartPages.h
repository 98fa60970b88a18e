// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The charts of what `chart` measured.
 */

#ifndef ChartPages_h
#define ChartPages_h

#include "ChartPage.h"
#include "ChartResults.h"
#include "Measuring.h"

#include <string>

namespace tool
{
/// One pair: error over frame time, the front, the planner's choices.
Page MakePairPage(const ChartResults& results, const ChartPair& pair, const Metric& metric);

/// What a summary's errors are shown over.
enum class Cost
{
  Frame,
  SetUp,
  Memory
};

/**
 * All pairs: geometric means of each method and size that all pairs have. Those of a single pair
 * are its figures.
 */
Page MakeSummaryPage(const ChartResults& results, const Metric& metric, Cost cost);

/// A file's name for a pair, without its ending: letters, digits and -_. only.
std::string MakeFileName(const ChartPair& pair);
} // namespace tool

#endif
