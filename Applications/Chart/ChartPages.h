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
Page MakePairPage(const ChartJson& results, const ChartJson& pair, const Metric& metric);

/// A summary shows errors over the frame time, the set-up or the memory.
struct Summary
{
  const char* File;   // without its ending
  const char* Figure; // of a point
  const char* Title;
  const char* Label;
  Unit Kind;
};
constexpr Summary Summaries[] = { { "summary", "frame_ms", "Accuracy against speed",
                                    "time of a frame", Unit::Milliseconds },
  { "setup", "setup_ms", "Accuracy against set-up time", "set-up, until the first frame is done",
    Unit::Milliseconds },
  { "memory", "texture_bytes", "Accuracy against texture memory", "textures", Unit::Bytes } };

/**
 * All pairs: geometric means of each method and size that all pairs have. Those of a single pair
 * are its figures.
 */
Page MakeSummaryPage(const ChartJson& results, const Metric& metric, const Summary& summary);

/// A file's name for a pair, without its ending: letters, digits and -_. only.
std::string MakeFileName(const ChartJson& pair);
} // namespace tool

#endif
