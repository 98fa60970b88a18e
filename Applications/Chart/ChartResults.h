// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What `chart` measured, as a file that a later run goes on with.
 */

#ifndef ChartResults_h
#define ChartResults_h

#include <nlohmann/json.hpp>

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace tool
{
/// A method in one size on one pair of material and environment.
struct ChartPoint
{
  std::string Method;
  std::string Size;
  std::string Left;                     // why it was not measured; empty: it was
  std::map<std::string, double> Errors; // by metric
  double SetUp = 0.0;                   // ms, until the first frame is done
  double Frame = 0.0;                   // ms, median
  double FrameLow = 0.0;                // ms, quartiles
  double FrameHigh = 0.0;
  int NumberOfFrames = 0;
  double Bytes = 0.0; // of textures
  int Fetches = 0;    // of textures for a pixel (vtkBRDFShaderInputs::CountFetches)
  // The planner's only.
  std::string Plan;
  double PredictedError = 0.0;
  double PredictedPictureError = 0.0;
  bool MeetsTolerance = false;

  bool IsMeasured() const { return this->Left.empty(); }
};

struct ChartPair
{
  std::string Material;
  std::string Environment;
  std::string Fingerprint; // of what both hold
  std::size_t NumberOfPixels = 0;
  double Load = 0.0; // of the machine when it began, as uptime says: what else was running
  // Of leaving occlusion out on this mesh, predicted: relative L1, and two standard errors of it.
  double UnoccludedError = std::numeric_limits<double>::quiet_NaN();
  double UnoccludedUncertainty = std::numeric_limits<double>::quiet_NaN();
  std::vector<ChartPoint> Points;
};

/// What the planner did on a pair at a tolerance, beside what else was measured there.
struct PlannerFigure
{
  std::size_t Point; // index
  double OverFront;  // its frame time over the least of all points that are no less accurate
};

struct ChartResults
{
  static constexpr const char* Format = "measured-brdf chart";
  static constexpr int Version = 1;

  nlohmann::ordered_json Settings; // that all pairs have in common; a later run must have the same
  nlohmann::ordered_json Machine;
  std::vector<ChartPair> Pairs;

  /// The pair of these names, or null.
  const ChartPair* Find(const std::string& material, const std::string& environment) const;
};

/// Processes that run or wait, the mean of the last minute; -1 where the system does not say.
double GetLoad();

/// Indices of a pair's points on the front of frame time and error, by rising time.
std::vector<std::size_t> FindFront(const ChartPair& pair, const std::string& metric);

/// The planner's points of a pair.
std::vector<PlannerFigure> RatePlanner(const ChartPair& pair, const std::string& metric);

/// The share of all the planner's points within 1 + margin of the front's time; NaN of none.
double GetShareWithin(const ChartResults& results, const std::string& metric, double margin);

/// DIR/results.json and DIR/results.csv, each whole or not at all. Throws Error.
void SaveResults(const std::string& folder, const ChartResults& results);

/**
 * Those of DIR/results.json, none where there is no such file. Throws Error where it is not of this
 * format and version, or its settings or machine are not these: nothing there is to be overwritten.
 */
ChartResults LoadResults(const std::string& folder, const nlohmann::ordered_json& settings,
  const nlohmann::ordered_json& machine);
} // namespace tool

#endif
