// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What `chart` measured: the JSON document of DIR/results.json, which a later run goes on with.
 * ChartMeter makes its pairs of material and environment, each with the points that were measured.
 */

#ifndef ChartResults_h
#define ChartResults_h

#include <nlohmann/json.hpp>

#include <string>

namespace tool
{
using ChartJson = nlohmann::ordered_json;

/// The pair of these names, or null.
const ChartJson* FindPair(
  const ChartJson& results, const std::string& material, const std::string& environment);

///@{
/// A figure or an error of a point; NaN where it has none or was left out.
double GetFigure(const ChartJson& point, const std::string& name);
double GetPointError(const ChartJson& point, const std::string& metric);
///@}

/// Adds what follows from a pair's points: which are on the front of frame time and error, and what
/// the planner's points take over the least time of all points that are no less accurate.
void RatePair(ChartJson& pair);

/// The share of all the planner's points within 1 + FrontMargin of the front's time; NaN of none.
constexpr double FrontMargin = 0.2;
double GetShareWithin(const ChartJson& results);

/// DIR/results.json and DIR/results.csv, each whole or not at all. Throws Error.
void SaveResults(const std::string& folder, ChartJson& results);

/**
 * Those of DIR/results.json, without pairs where there is no such file. Throws Error where it is
 * not of this format and version, or its settings or machine are not these: nothing there is to be
 * overwritten.
 */
ChartJson LoadResults(
  const std::string& folder, const ChartJson& settings, const ChartJson& machine);
} // namespace tool

#endif
