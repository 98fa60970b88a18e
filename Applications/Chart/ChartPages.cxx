// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartPages.h"

#include "ChartMethods.h"
#include "ParetoFront.h"
#include "Tool.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace
{
// Below this an error is taken as this, lest a single zero draws a geometric mean there.
constexpr double LeastError = 1e-7;
// Marks closer than this, in powers of ten, are one.
constexpr double SamePlace = 0.03;

/// A method in one size, in one pair or over all.
struct Dot
{
  std::string Method;
  std::string Size;
  double Cost;
  double Error;
};

//------------------------------------------------------------------------------
double GetCost(const tool::ChartPoint& point, tool::Cost cost)
{
  switch (cost)
  {
    case tool::Cost::SetUp:
      return point.SetUp;
    case tool::Cost::Memory:
      return point.Bytes;
    default:
      return point.Frame;
  }
}

//------------------------------------------------------------------------------
std::vector<Dot> ListDots(const tool::ChartPair& pair, const std::string& metric, tool::Cost cost)
{
  std::vector<Dot> dots;
  for (const tool::ChartPoint& point : pair.Points)
  {
    const auto error = point.Errors.find(metric);
    if (point.IsMeasured() && error != point.Errors.end())
    {
      dots.push_back(
        { point.Method, point.Size, GetCost(point, cost), std::max(error->second, LeastError) });
    }
  }
  return dots;
}

//------------------------------------------------------------------------------
// Means of what all pairs have: others would be means over easier pairs.
std::vector<Dot> ListMeans(
  const tool::ChartResults& results, const std::string& metric, tool::Cost cost)
{
  std::vector<Dot> means;
  if (results.Pairs.empty())
  {
    return means;
  }
  for (const Dot& first : ListDots(results.Pairs.front(), metric, cost))
  {
    std::vector<double> costs;
    std::vector<double> errors;
    for (const tool::ChartPair& pair : results.Pairs)
    {
      for (const Dot& dot : ListDots(pair, metric, cost))
      {
        if (dot.Method == first.Method && dot.Size == first.Size)
        {
          costs.push_back(dot.Cost);
          errors.push_back(dot.Error);
        }
      }
    }
    if (costs.size() == results.Pairs.size())
    {
      means.push_back({ first.Method, first.Size, tool::GetGeometricMean(costs),
        tool::GetGeometricMean(errors) });
    }
  }
  return means;
}

//------------------------------------------------------------------------------
std::string FormatTolerance(const std::string& tolerance)
{
  return tool::FormatNumber(100.0 * std::stod(tolerance)) + " %" +
         (tool::IsInView(tolerance) ? tool::InView : "") +
         (tool::IsInteracting(tolerance) ? tool::Interacting : "");
}

//------------------------------------------------------------------------------
void AddMark(tool::Page& page, const Dot& dot)
{
  const bool planner = dot.Method == tool::PlannerMethod;
  for (tool::PageMark& mark : page.Marks)
  {
    if (planner && mark.Diamond && std::abs(std::log10(mark.Point.X / dot.Cost)) < SamePlace &&
        std::abs(std::log10(mark.Point.Y / dot.Error)) < SamePlace)
    {
      mark.Name += ", " + FormatTolerance(dot.Size);
      return;
    }
  }
  const std::string name = tool::FindChartMethod(dot.Method).Label;
  page.Marks.push_back({ { dot.Cost, dot.Error },
    planner ? name + " at " + FormatTolerance(dot.Size) : name, planner });
}

//------------------------------------------------------------------------------
// Joined are those points of a method that none of its own beats.
std::vector<tool::PagePoint> MakeLine(const std::vector<tool::PagePoint>& points)
{
  std::vector<tool::CostPoint> costs;
  for (const tool::PagePoint& point : points)
  {
    costs.push_back({ point.X, point.Y });
  }
  std::vector<tool::PagePoint> line;
  for (const std::size_t k : tool::FindFront(costs))
  {
    line.push_back(points[k]);
  }
  return line;
}

//------------------------------------------------------------------------------
void Fill(tool::Page& page, const std::vector<Dot>& dots, const tool::Metric& metric)
{
  std::vector<tool::CostPoint> costs;
  for (const Dot& dot : dots)
  {
    costs.push_back({ dot.Cost, dot.Error });
    if (dot.Method == tool::PlannerMethod || dot.Method == tool::PBRMethod)
    {
      AddMark(page, dot);
      continue;
    }
    const tool::ChartMethod& method = tool::FindChartMethod(dot.Method);
    if (page.Curves.empty() || page.Curves.back().Label != method.Label)
    {
      page.Curves.push_back({ method.Label, method.Color, {}, {} });
    }
    page.Curves.back().Points.push_back({ dot.Cost, dot.Error });
  }
  for (tool::PageCurve& curve : page.Curves)
  {
    curve.Line = MakeLine(curve.Points);
  }
  for (const std::size_t k : tool::FindFront(costs))
  {
    page.Front.push_back({ dots[k].Cost, dots[k].Error });
  }
  page.YLabel = metric.Label + ", smaller is better";
  page.YUnit = metric.Relative ? tool::Unit::Share : tool::Unit::Number;
}

//------------------------------------------------------------------------------
std::string DescribePicture(const tool::ChartResults& results)
{
  const std::string renderer = results.Machine.value("renderer", "");
  return results.Settings.value("size", "") + " pixels, " + renderer.substr(0, renderer.find(" ("));
}
}

namespace tool
{
//------------------------------------------------------------------------------
Page MakePairPage(const ChartResults& results, const ChartPair& pair, const Metric& metric)
{
  Page page;
  page.Title = pair.Material + " under " + pair.Environment;
  page.Subtitle = DescribePicture(results);
  page.XLabel = "time of a frame";
  page.XUnit = Unit::Milliseconds;
  Fill(page, ListDots(pair, metric.Name, Cost::Frame), metric);
  return page;
}

//------------------------------------------------------------------------------
Page MakeSummaryPage(const ChartResults& results, const Metric& metric, Cost cost)
{
  std::set<std::string> materials;
  std::set<std::string> environments;
  for (const ChartPair& pair : results.Pairs)
  {
    materials.insert(pair.Material);
    environments.insert(pair.Environment);
  }
  Page page;
  page.Title = cost == Cost::Frame   ? "Accuracy against speed"
               : cost == Cost::SetUp ? "Accuracy against set-up time"
                                     : "Accuracy against texture memory";
  page.Subtitle = "Geometric means of " + FormatCount(results.Pairs.size(), "pair") + " of " +
                  FormatCount(materials.size(), "material") + " and " +
                  FormatCount(environments.size(), "environment") + ", " + DescribePicture(results);
  page.XLabel = cost == Cost::Frame   ? "time of a frame"
                : cost == Cost::SetUp ? "set-up, until the first frame is done"
                                      : "textures";
  page.XUnit = cost == Cost::Memory ? Unit::Bytes : Unit::Milliseconds;
  Fill(page, ListMeans(results, metric.Name, cost), metric);
  return page;
}

//------------------------------------------------------------------------------
std::string MakeFileName(const ChartPair& pair)
{
  std::string name = pair.Material + "." + pair.Environment;
  std::replace_if(
    name.begin(), name.end(),
    [](unsigned char c)
    { return c >= 128 || (std::isalnum(c) == 0 && c != '-' && c != '_' && c != '.'); },
    '-');
  return name;
}
} // namespace tool
