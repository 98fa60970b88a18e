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
};

///@{
/// Those that are always there, and not by --methods: VTK's own shading and the planner's choices.
constexpr const char* PBRMethod = "pbr";
constexpr const char* PlannerMethod = "planner";
///@}

///@{
/// What follows the tolerance in the size of a plan for the picture's own view, and of what a plan
/// draws while somebody interacts.
constexpr const char* InView = " in view";
constexpr const char* Interacting = " while interacting";
///@}

/// All of them, those that are always there included. A method of vtkRadianceMethods that is not
/// one of the tool's curves gets one of its own, by its candidate sizes.
const std::vector<ChartMethod>& GetChartMethods();

/// One of them; throws UsageError that names the others.
const ChartMethod& FindChartMethod(const std::string& name);

/// A method in one size: what is measured.
struct ChartSize
{
  const ChartMethod* Method;
  std::string Size; // of the planner's: the tolerance, and whether it is InView, Interacting

  MethodOptions MakeOptions() const;
};

/// In the order of the methods and their sizes: those named, VTK's, and the planner's for each
/// tolerance, with forView for the picture's own view, too.
std::vector<ChartSize> ListChartSizes(const std::vector<std::string>& methods,
  const std::vector<double>& tolerances, bool full, bool forView);
} // namespace tool

#endif
