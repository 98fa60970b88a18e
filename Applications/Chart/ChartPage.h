// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A chart on logarithmic axes, drawn by VTK's charts.
 */

#ifndef ChartPage_h
#define ChartPage_h

#include "LogAxis.h"
#include "Picture.h"

#include <string>
#include <vector>

namespace tool
{
struct PagePoint
{
  double X; // in the axis' unit, positive
  double Y;
};

struct PageCurve
{
  std::string Label;             // beside the chart
  RGB Color;                     // sRGB in [0,1]
  std::vector<PagePoint> Points; // dots
  std::vector<PagePoint> Line;   // joined in their order; empty: none
};

/// A point to be found at once.
struct PageMark
{
  PagePoint Point;
  std::string Name; // beside it
  bool Diamond;     // black, else a black square
};

struct Page
{
  std::string Title;
  std::string Subtitle;
  std::string XLabel;
  std::string YLabel;
  Unit XUnit = Unit::Milliseconds;
  Unit YUnit = Unit::Share;
  std::vector<PageCurve> Curves;
  std::vector<PageMark> Marks;
  std::vector<PagePoint> Front; // a band below the curves; empty: none
};

/// A PNG picture, whole or not at all. What is not positive and finite is left out. Throws Error.
void DrawPage(const Page& page, const std::string& path);
} // namespace tool

#endif
