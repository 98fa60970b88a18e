// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The methods that `chart` sweeps, with the sizes that each comes in.
 */

#ifndef ChartMethods_h
#define ChartMethods_h

#include "Methods.h"
#include "Picture.h"

#include <functional>
#include <string>
#include <vector>

namespace tool
{
/// One curve of a chart.
struct ChartMethod
{
  std::string Name;  // of --methods, files and tables
  std::string Label; // for people
  RGB Color;         // sRGB in [0,1]
  bool Grows;        // whether the frame time is about proportional to the size's first number
  std::vector<std::string> FewSizes; // of --sweep small
  std::vector<std::string> AllSizes; // of --sweep full
  // Sets a size; empty: not a measured material.
  std::function<void(const std::string& size, MethodOptions& options)> Apply;
};

///@{
/// Those that are always there, and not by --methods: VTK's own shading and the planner's choices.
constexpr const char* PBRMethod = "pbr";
constexpr const char* PlannerMethod = "planner";
constexpr const char* ThesisMethod = "thesis";
///@}

/// What follows the tolerance in the size of a plan for the picture's own view.
constexpr const char* InView = " in view";
bool IsInView(const std::string& size);

/// The same of what a plan draws while somebody interacts.
constexpr const char* Interacting = " while interacting";
bool IsInteracting(const std::string& size);

/// All of them, those that are always there included. A method of vtkRadianceMethods that is not
/// one of the tool's curves gets one of its own, by its candidate sizes.
const std::vector<ChartMethod>& GetChartMethods();

/// One of them; throws UsageError that names the others.
const ChartMethod& FindChartMethod(const std::string& name);

/// A method in one size: what is measured.
struct ChartSize
{
  const ChartMethod* Method = nullptr;
  std::string Size; // of the planner's: the tolerance, and whether it is InView, Interacting
  MethodOptions Options;
};

/// In the order of the methods and their sizes: those named, the thesis's and VTK's, and the
/// planner's for each tolerance, with forView for the picture's own view, too.
std::vector<ChartSize> ListChartSizes(const std::vector<std::string>& methods,
  const std::vector<double>& tolerances, bool full, bool forView);
} // namespace tool

#endif
