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
std::vector<Dot> ListDots(
  const tool::ChartJson& pair, const std::string& metric, const std::string& figure)
{
  std::vector<Dot> dots;
  for (const tool::ChartJson& point : pair.at("points"))
  {
    const double error = tool::GetPointError(point, metric);
    if (!point.contains("left_out"))
    {
      dots.push_back({ point.at("method"), point.at("size"), tool::GetFigure(point, figure),
        std::isnan(error) ? error : std::max(error, LeastError) });
    }
  }
  return dots;
}

//------------------------------------------------------------------------------
// Means of what all pairs have: others would be means over easier pairs.
std::vector<Dot> ListMeans(
  const tool::ChartJson& results, const std::string& metric, const std::string& figure)
{
  std::vector<Dot> means;
  const tool::ChartJson& pairs = results.at("pairs");
  if (pairs.empty())
  {
    return means;
  }
  for (const Dot& first : ListDots(pairs.front(), metric, figure))
  {
    std::vector<double> costs;
    std::vector<double> errors;
    for (const tool::ChartJson& pair : pairs)
    {
      for (const Dot& dot : ListDots(pair, metric, figure))
      {
        if (dot.Method == first.Method && dot.Size == first.Size)
        {
          costs.push_back(dot.Cost);
          errors.push_back(dot.Error);
        }
      }
    }
    if (costs.size() == pairs.size())
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
std::string DescribePicture(const tool::ChartJson& results)
{
  const std::string renderer = results.at("machine").value("renderer", "");
  return results.at("settings").value("size", "") + " pixels, " +
         renderer.substr(0, renderer.find(" ("));
}
}

namespace tool
{
//------------------------------------------------------------------------------
Page MakePairPage(const ChartJson& results, const ChartJson& pair, const Metric& metric)
{
  Page page;
  page.Title =
    pair["material"].get<std::string>() + " under " + pair["environment"].get<std::string>();
  page.Subtitle = DescribePicture(results);
  page.XLabel = Summaries[0].Label;
  page.XUnit = Summaries[0].Kind;
  Fill(page, ListDots(pair, metric.Name, Summaries[0].Figure), metric);
  return page;
}

//------------------------------------------------------------------------------
Page MakeSummaryPage(const ChartJson& results, const Metric& metric, const Summary& summary)
{
  const ChartJson& pairs = results.at("pairs");
  std::set<std::string> materials;
  std::set<std::string> environments;
  for (const ChartJson& pair : pairs)
  {
    materials.insert(pair["material"]);
    environments.insert(pair["environment"]);
  }
  Page page;
  page.Title = summary.Title;
  page.Subtitle = "Geometric means of " + FormatCount(pairs.size(), "pair") + " of " +
                  FormatCount(materials.size(), "material") + " and " +
                  FormatCount(environments.size(), "environment") + ", " + DescribePicture(results);
  page.XLabel = summary.Label;
  page.XUnit = summary.Kind;
  Fill(page, ListMeans(results, metric.Name, summary.Figure), metric);
  return page;
}

//------------------------------------------------------------------------------
std::string MakeFileName(const ChartJson& pair)
{
  std::string name =
    pair["material"].get<std::string>() + "." + pair["environment"].get<std::string>();
  std::replace_if(
    name.begin(), name.end(),
    [](unsigned char c)
    { return c >= 128 || (std::isalnum(c) == 0 && c != '-' && c != '_' && c != '.'); },
    '-');
  return name;
}
} // namespace tool
