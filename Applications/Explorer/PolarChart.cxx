// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PolarChart.h"

#include "vtkAxis.h"
#include "vtkChartXY.h"
#include "vtkContext2D.h"
#include "vtkContextItem.h"
#include "vtkContextScene.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkRect.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
constexpr double Reach = 1.14;      // of the chart; the largest circle has radius 1
constexpr double TextHeight = 26.0; // pixels of the screen
constexpr int PolarFontSize = 12;
constexpr explorer::Color PolarGrid = { 215, 215, 215 };
constexpr explorer::Color Surface = { 150, 150, 150 };

//------------------------------------------------------------------------------
void AddCircle(vtkChartXY* chart, double radius, bool allAround, double ratio)
{
  std::vector<double> x;
  std::vector<double> y;
  for (int degrees = 0; degrees <= (allAround ? 360 : 180); degrees += 2)
  {
    const double angle = vtkMath::RadiansFromDegrees(static_cast<double>(degrees));
    x.push_back(radius * std::cos(angle));
    y.push_back(radius * std::sin(angle));
  }
  explorer::AddLine(chart, x, y, PolarGrid, ratio);
}

//------------------------------------------------------------------------------
// From the origin, at an angle from the normal.
void AddRay(
  vtkChartXY* chart, double degrees, const explorer::Color& color, double width, bool dashed)
{
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  explorer::AddLine(
    chart, { 0.0, std::sin(angle) }, { 0.0, std::cos(angle) }, color, width, dashed);
}

//------------------------------------------------------------------------------
// As many as have room: every second, third ... where there are more than most.
std::vector<std::pair<double, std::string>> ThinOut(
  const std::vector<std::pair<double, std::string>>& ticks, std::size_t most)
{
  const std::size_t step = 1 + (ticks.size() - (ticks.empty() ? 0 : 1)) / most;
  std::vector<std::pair<double, std::string>> some;
  for (std::size_t k = ticks.size(); k > 0; k -= std::min(k, step))
  {
    some.push_back(ticks[k - 1]); // the largest stays
  }
  return some;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
/// The title, and the angles from the normal around the largest circle.
class PolarLabels : public vtkContextItem
{
public:
  static PolarLabels* New();
  vtkTypeMacro(PolarLabels, vtkContextItem);

  double Center[2] = { 0.0, 0.0 }; // pixels of the scene
  double Radius = 0.0;
  double Title = 0.0; // its height
  bool AllAround = false;

  bool Paint(vtkContext2D* painter) override
  {
    vtkTextProperty* text = painter->GetTextProp();
    text->SetFontSize(PolarFontSize);
    text->SetColor(0.25, 0.25, 0.25);
    text->SetBold(false);
    text->SetJustificationToCentered();
    text->SetVerticalJustificationToCentered();
    for (const int degrees : { -60, -30, 0, 30, 60, -150, -120, 120, 150, 180 })
    {
      if (std::abs(degrees) > 90 && !this->AllAround)
      {
        continue;
      }
      const double angle = vtkMath::RadiansFromDegrees(static_cast<double>(degrees));
      painter->DrawString(static_cast<float>(this->Center[0] + this->Radius * std::sin(angle)),
        static_cast<float>(this->Center[1] + this->Radius * std::cos(angle)),
        std::to_string(degrees));
    }
    text->SetFontSize(PolarFontSize + 1);
    text->SetColor(0.0, 0.0, 0.0);
    painter->DrawString(static_cast<float>(this->Center[0]), static_cast<float>(this->Title),
      "f (1/sr) in the plane of incidence");
    return true;
  }
};
vtkStandardNewMacro(PolarLabels);

//------------------------------------------------------------------------------
PolarChart::PolarChart(vtkContextScene* scene)
{
  this->Chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT); // both axes have one scale
  this->Chart->SetShowLegend(false);
  scene->AddItem(this->Chart);
  scene->AddItem(this->Labels);
}

//------------------------------------------------------------------------------
PolarChart::~PolarChart() = default;

//------------------------------------------------------------------------------
void PolarChart::Draw(
  const std::vector<ChartLine>& lines, double thetaI, bool logarithmic, double ratio)
{
  const ChartScale scale(lines, logarithmic);
  const double range = scale.GetLargest() - scale.GetLeast();
  this->Chart->ClearPlots();
  std::vector<std::pair<double, std::string>> ticks;
  const std::size_t most = this->AllAround ? 4 : 5; // a full circle is smaller
  for (const auto& [place, text] : ThinOut(scale.GetTicks(), most))
  {
    const double radius = (place - scale.GetLeast()) / range;
    ticks.emplace_back(radius, text);
    AddCircle(this->Chart, radius, this->AllAround, ratio);
  }
  AddCircle(this->Chart, 1.0, this->AllAround, ratio);
  for (const double degrees : { -60.0, -30.0, 0.0, 30.0, 60.0 })
  {
    AddRay(this->Chart, degrees, PolarGrid, ratio, false);
    if (this->AllAround)
    {
      AddRay(this->Chart, degrees + 180.0, PolarGrid, ratio, false);
    }
  }
  if (this->AllAround)
  {
    AddLine(this->Chart, { -1.0, 1.0 }, { 0.0, 0.0 }, Surface, 2.0 * ratio);
    AddRay(this->Chart, 180.0 - thetaI, LightColor, ratio, true); // straight on
  }
  AddRay(this->Chart, -thetaI, LightColor, 3.0 * ratio, false);
  AddRay(this->Chart, thetaI, LightColor, ratio, true); // the mirror direction
  for (const ChartLine& line : lines)
  {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t k = 0; k < line.Degrees.size(); ++k)
    {
      const double angle = vtkMath::RadiansFromDegrees(line.Degrees[k]);
      const double radius = (scale.Find(line.Values[k]) - scale.GetLeast()) / range;
      x.push_back(radius * std::sin(angle));
      y.push_back(radius * std::cos(angle));
    }
    AddLine(this->Chart, x, y, line.Rgb, 2.0 * ratio);
  }
  for (const int which : { vtkAxis::LEFT, vtkAxis::BOTTOM })
  {
    vtkAxis* axis = this->Chart->GetAxis(which);
    axis->SetTitle("");
    axis->GetLabelProperties()->SetFontSize(PolarFontSize);
    axis->SetGridVisible(false);
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(which == vtkAxis::LEFT && !this->AllAround ? 0.0 : -Reach, Reach);
  }
  vtkAxis* upwards = this->Chart->GetAxis(vtkAxis::LEFT);
  upwards->SetAxisVisible(false);
  upwards->SetTicksVisible(false);
  upwards->SetLabelsVisible(false);
  SetTicks(this->Chart->GetAxis(vtkAxis::BOTTOM), ticks);
  this->Chart->RecalculateBounds();
}

//------------------------------------------------------------------------------
void PolarChart::Place(double left, double bottom, double width, double ratio)
{
  const double base = bottom + ratio * TextHeight;
  const double height = this->AllAround ? width : 0.5 * width;
  this->Chart->SetSize(vtkRectf(static_cast<float>(left), static_cast<float>(base),
    static_cast<float>(width), static_cast<float>(height)));
  this->Labels->AllAround = this->AllAround;
  this->Labels->Center[0] = left + 0.5 * width;
  this->Labels->Center[1] = base + (this->AllAround ? 0.5 * height : 0.0);
  this->Labels->Title = base + height + 0.5 * ratio * TextHeight;
  this->Labels->Radius = 0.5 * width * (1.0 + Reach) / (2.0 * Reach);
}

//------------------------------------------------------------------------------
double PolarChart::GetHeight(double width, double ratio) const
{
  return (this->AllAround ? 1.0 : 0.5) * width + 2.0 * ratio * TextHeight;
}

//------------------------------------------------------------------------------
void PolarChart::SetVisible(bool visible)
{
  this->Chart->SetVisible(visible);
  this->Labels->SetVisible(visible);
}
} // namespace explorer
