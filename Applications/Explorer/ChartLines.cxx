// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartLines.h"

#include "LogAxis.h"

#include "vtkAxis.h"
#include "vtkChartXY.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkPen.h"
#include "vtkPlot.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr explorer::Color Channels[3] = { { 214, 64, 54 }, { 46, 140, 62 }, { 52, 98, 204 } };
// The material that is shown, then those that it is compared with.
constexpr explorer::Color Materials[] = { { 30, 30, 30 }, { 31, 119, 180 }, { 230, 110, 10 },
  { 44, 150, 44 }, { 214, 39, 40 }, { 148, 103, 189 }, { 140, 86, 75 }, { 227, 90, 180 },
  { 0, 170, 190 } };
constexpr double Darkest = 1e-6; // of the largest value

//------------------------------------------------------------------------------
// 1, 2 or 5 times a power of ten: three to five steps up to the largest value.
double FindStep(double largest)
{
  const double power = std::pow(10.0, std::floor(std::log10(largest / 4.0)));
  for (const double factor : { 1.0, 2.0, 5.0 })
  {
    if (factor * power >= largest / 4.0)
    {
      return factor * power;
    }
  }
  return 10.0 * power;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
Color GetMaterialColor(std::size_t k) { return Materials[k % std::size(Materials)]; }

//------------------------------------------------------------------------------
std::vector<ChartLine> MakeLines(const std::vector<Curve>& curves)
{
  std::vector<ChartLine> lines;
  if (curves.size() == 1)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      ChartLine line{ Channels[c], curves[0].Degrees, {} };
      for (const auto& rgb : curves[0].Values)
      {
        line.Values.push_back(rgb[c]);
      }
      lines.push_back(line);
    }
    return lines;
  }
  for (std::size_t k = 0; k < curves.size(); ++k)
  {
    ChartLine line{ GetMaterialColor(k), curves[k].Degrees, {} };
    for (const auto& rgb : curves[k].Values)
    {
      line.Values.push_back(vtkEnvironment::GetLuminance(rgb.data()));
    }
    lines.push_back(line);
  }
  return lines;
}

//------------------------------------------------------------------------------
ChartScale::ChartScale(const std::vector<ChartLine>& lines, bool logarithmic)
  : Logarithmic(logarithmic)
{
  double peak = 0.0;
  for (const ChartLine& line : lines)
  {
    for (const double value : line.Values)
    {
      peak = std::max(peak, value);
    }
  }
  this->Floor = std::max(Darkest * peak, std::numeric_limits<double>::min());
  if (!logarithmic)
  {
    this->Largest = peak > 0.0 ? 1.05 * peak : 1.0;
    return;
  }
  tool::LogAxis axis;
  for (const ChartLine& line : lines)
  {
    for (const double value : line.Values)
    {
      axis.Take(peak > 0.0 ? std::max(value, this->Floor) : 0.0);
    }
  }
  axis.Widen();
  this->Least = axis.GetLeast();
  this->Largest = axis.GetLargest();
  this->Exponents = axis.GetTicks();
}

//------------------------------------------------------------------------------
double ChartScale::Find(double value) const
{
  return !this->Logarithmic ? value
                            : std::max(std::log10(std::max(value, this->Floor)), this->Least);
}

//------------------------------------------------------------------------------
std::vector<std::pair<double, std::string>> ChartScale::GetTicks() const
{
  std::vector<std::pair<double, std::string>> ticks;
  for (const double exponent : this->Exponents)
  {
    ticks.emplace_back(exponent, tool::FormatTick(std::pow(10.0, exponent), tool::Unit::Number));
  }
  if (!this->Logarithmic)
  {
    const double step = FindStep(this->Largest);
    for (int k = 0; k * step <= this->Largest; ++k)
    {
      ticks.emplace_back(k * step, tool::FormatTick(k * step, tool::Unit::Number));
    }
  }
  return ticks;
}

//------------------------------------------------------------------------------
void SetTicks(vtkAxis* axis, const std::vector<std::pair<double, std::string>>& ticks)
{
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const auto& [position, label] : ticks)
  {
    positions->InsertNextValue(position);
    labels->InsertNextValue(label);
  }
  axis->SetCustomTickPositions(positions, labels);
}

//------------------------------------------------------------------------------
void AddLine(vtkChartXY* chart, const std::vector<double>& x, const std::vector<double>& y,
  const Color& color, double width, bool dashed)
{
  if (x.size() < 2)
  {
    return;
  }
  vtkNew<vtkTable> table;
  for (const auto* values : { &x, &y })
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(values == &x ? "x" : "y");
    for (const double value : *values)
    {
      column->InsertNextValue(value);
    }
    table->AddColumn(column);
  }
  vtkPlot* plot = chart->AddPlot(vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetWidth(static_cast<float>(width));
  plot->GetPen()->SetLineType(dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
}
} // namespace explorer
