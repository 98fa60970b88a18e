// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The pictures of what `chart` measured, PNG, drawn by VTK's charts on logarithmic axes.
 */

#ifndef ChartPages_h
#define ChartPages_h

#include "ChartResults.h"

#include <string>

namespace tool
{
/// FOLDER/MATERIAL.ENVIRONMENT.png: error over frame time of one pair, the front, the planner's
/// choices. Throws Error.
void DrawPairPage(const ChartJson& results, const ChartJson& pair, const std::string& folder);

/// FOLDER/summary.png, setup.png and memory.png: errors over the frame time, the set-up and the
/// memory, as geometric means of each method and size that all pairs have. Throws Error.
void DrawSummaryPages(const ChartJson& results, const std::string& folder);
} // namespace tool

#endif
