// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FailureMap.h"

#include "Methods.h"
#include "Picture.h"
#include "Sheets.h"
#include "Tool.h"

#include "vtkBRDFFailureMap.h"
#include "vtkColorTransferFunction.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkRadianceMetrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace
{
constexpr double ViewStep = 5.0; // degrees
constexpr int Views = static_cast<int>(90.0 / ViewStep);

// A map with its axes, in pixels.
constexpr int MapSide = 480;
constexpr int MapMargin = 60; // left of it and below, for the ticks
constexpr int TickSize = 15;

/// Where on an axis, as a share of it, there is which text.
using AxisTicks = std::vector<std::pair<double, std::string>>;

//------------------------------------------------------------------------------
// A logarithm of an error as a share of the colors' range.
double FindShare(double error)
{
  return (std::log10(std::max(error, 1e-12)) - tool::LowestError) /
         (tool::HighestError - tool::LowestError);
}

//------------------------------------------------------------------------------
// Angles on an axis where theta is at theta / 90 or, on one of square roots, at its root.
AxisTicks MakeAngleTicks(const std::vector<int>& degrees, bool isRoot)
{
  AxisTicks ticks;
  for (const int theta : degrees)
  {
    ticks.emplace_back(isRoot ? std::sqrt(theta / 90.0) : theta / 90.0, std::to_string(theta));
  }
  return ticks;
}

//------------------------------------------------------------------------------
// The colors of errors over a square, of its places in [0, 1), gray where an error is not a number;
// with ticks below it and left of it.
tool::Picture DrawMap(const std::function<double(double, double)>& find, const AxisTicks& across,
  const AxisTicks& upwards)
{
  constexpr int side = MapMargin + MapSide + TickSize;
  tool::Picture tile = tool::MakePaper(side, side);
  const auto colors = tool::MakeErrorColors();
  for (int k = 0; k < MapSide * MapSide; ++k)
  {
    const int x = k % MapSide;
    const int y = k / MapSide;
    const double error = find((x + 0.5) / MapSide, (y + 0.5) / MapSide);
    tool::RGB rgb(0.87); // of what is no error
    if (!std::isnan(error))
    {
      colors->GetColor(tool::LowestError + (tool::HighestError - tool::LowestError) *
                                             std::clamp(FindShare(error), 0.0, 1.0),
        &rgb.x);
    }
    tile.Blend(MapMargin + x, MapMargin + y,
      { measuredbrdf::DecodeSRGB(rgb.r), measuredbrdf::DecodeSRGB(rgb.g),
        measuredbrdf::DecodeSRGB(rgb.b) },
      1.0);
  }
  for (const auto& [share, text] : across)
  {
    const int width = tool::MeasureText(text, TickSize, false);
    tool::DrawText(tile, MapMargin + static_cast<int>(share * MapSide) - width / 2,
      MapMargin - 2 * TickSize, text, TickSize, false, tool::White);
  }
  for (const auto& [share, text] : upwards)
  {
    const int width = tool::MeasureText(text, TickSize, false);
    tool::DrawText(tile, MapMargin - width - 6,
      MapMargin + static_cast<int>(share * MapSide) - TickSize / 2, text, TickSize, false,
      tool::White);
  }
  return tile;
}

//------------------------------------------------------------------------------
tool::Picture DrawErrors(vtkImageData* errors, const AxisTicks& across)
{
  const int* size = errors->GetDimensions();
  return DrawMap(
    [=](double u, double v)
    {
      return errors->GetScalarComponentAsDouble(
        static_cast<int>(u * size[0]), static_cast<int>(v * size[1]), 0, 0);
    },
    across, MakeAngleTicks({ 0, 15, 30, 45, 60, 75, 90 }, false));
}
}

namespace tool
{
//------------------------------------------------------------------------------
std::vector<ViewError> MeasureViews(const std::vector<double>& normals,
  const std::vector<double>& views, const std::vector<double>& rgb,
  const std::vector<double>& reference)
{
  std::vector<double> x[Views];
  std::vector<double> r[Views];
  for (std::size_t k = 0; k < normals.size(); k += 3)
  {
    const double cosine = std::clamp(vtkMath::Dot(&normals[k], &views[k]), 0.0, 1.0);
    const double theta = vtkMath::DegreesFromRadians(std::acos(cosine));
    const int step = std::min(Views - 1, static_cast<int>(theta / ViewStep));
    x[step].insert(x[step].end(), { rgb[k], rgb[k + 1], rgb[k + 2] });
    r[step].insert(r[step].end(), { reference[k], reference[k + 1], reference[k + 2] });
  }
  std::vector<ViewError> errors;
  for (int step = 0; step < Views; ++step)
  {
    if (std::any_of(r[step].begin(), r[step].end(), [](double value) { return value > 0.0; }))
    {
      vtkNew<vtkRadianceMetrics> metrics;
      if (!metrics->Compare(MakeArray(x[step], 3), MakeArray(r[step], 3)))
      {
        throw Error("measuring the views: " + TakeErrorText());
      }
      errors.push_back({ step * ViewStep, (step + 1) * ViewStep, x[step].size() / 3,
        metrics->GetRelativeL1(), metrics->GetP99Relative() });
    }
  }
  return errors;
}

//------------------------------------------------------------------------------
void WriteFailureMap(const std::string& path, const std::string& title, const std::string& note,
  const std::string& method, vtkBRDFFailureMap* map, const std::vector<ViewError>& views)
{
  const AxisTicks degrees = MakeAngleTicks({ 0, 15, 30, 45, 60, 75, 90 }, false);
  Picture first = DrawErrors(map->GetIncidentOutgoing(), degrees);
  for (int k = 0; k < map->GetNumberOfWorstAngles(); ++k) // white on black: seen on any color
  {
    double angles[3];
    map->GetWorstAngles(k, angles);
    const int x = MapMargin + static_cast<int>(angles[0] / 90.0 * MapSide) - 4;
    const int y = MapMargin + static_cast<int>(angles[1] / 90.0 * MapSide) - 6;
    Paste(first, MakePaper(TickSize - 3, TickSize), x - 2, y - 2);
    DrawText(first, x, y, std::to_string(k + 1), TickSize - 1, true, White);
  }
  const Picture second =
    DrawErrors(map->GetHalfDifference(), MakeAngleTicks({ 0, 2, 5, 10, 20, 30, 45, 60, 90 }, true));
  const Picture third = DrawMap(
    [&views](double u, double v)
    {
      const auto view = std::find_if(views.begin(), views.end(),
        [u](const ViewError& one) { return 90.0 * u >= one.Begin && 90.0 * u < one.End; });
      const double place = std::pow(10.0, LowestError + (HighestError - LowestError) * v);
      const bool isBar =
        view != views.end() &&
        place <= (90.0 * u < view->Begin + 0.5 * ViewStep ? view->P99 : view->RelativeL1);
      return isBar ? place : std::numeric_limits<double>::quiet_NaN();
    },
    degrees,
    { { FindShare(0.001), "0.1 %" }, { FindShare(0.01), "1 %" }, { FindShare(0.1), "10 %" },
      { FindShare(1.0), "100 %" } });
  ContactSheet sheet(title, 3, 1, first.Width, first.Height);
  sheet.Add(0, 0, first, "f: theta_i across, theta_o upwards", note);
  sheet.Add(1, 0, second, "f: theta_h across, theta_d upwards",
    "The numbers in the first map mark the worst angles.");
  sheet.Add(2, 0, third, "radiance over theta_o: " + method,
    "Left of each pair: the 99th percentile; right: relative L1. The maps have the same colors.");
  sheet.Write(path);
}
} // namespace tool
