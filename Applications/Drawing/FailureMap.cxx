// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FailureMap.h"

#include "Picture.h"
#include "Tool.h"

#include "vtkAxis.h"
#include "vtkBRDFFailureMap.h"
#include "vtkChartXY.h"
#include "vtkColorTransferFunction.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPen.h"
#include "vtkPlotHistogram2D.h"
#include "vtkPlotPoints.h"
#include "vtkPointData.h"
#include "vtkRadianceMetrics.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
constexpr double ViewStep = 5.0; // degrees

// Range of the colors and of the radiance chart: logarithms of shares.
constexpr double Lowest = tool::LowestError;
constexpr double Highest = tool::HighestError;
constexpr double NoValue = -99.0; // in a map

// The figure, in pixels.
constexpr int Width = 1720;
constexpr int Height = 690;
constexpr int Side = 480; // of a map
constexpr int Bottom = 72;
constexpr int MapLefts[2] = { 90, 680 };
constexpr int BarLeft = 1224;
constexpr int BarWidth = 22;
constexpr int ViewsLeft = 1340;
constexpr int ViewsWidth = 340;
constexpr int LabelSize = 15;
constexpr int TitleSize = 17;

constexpr tool::RGB Ink = { 0.1, 0.1, 0.12 };
constexpr tool::RGB PaleInk = { 0.4, 0.4, 0.43 };
constexpr tool::RGB L1Color = { 0.267, 0.005, 0.329 };
constexpr tool::RGB P99Color = { 0.2, 0.62, 0.35 };

using Ticks = std::vector<std::pair<double, std::string>>;

const Ticks Degrees = { { 0, "0" }, { 15, "15" }, { 30, "30" }, { 45, "45" }, { 60, "60" },
  { 75, "75" }, { 90, "90" } };
const Ticks Shares = { { -3, "0.1 %" }, { -2, "1 %" }, { -1, "10 %" }, { 0, "100 %" } };

//------------------------------------------------------------------------------
// theta_h on its axis of square roots.
Ticks MakeHalfAngleTicks()
{
  Ticks ticks;
  for (const int degrees : { 0, 2, 5, 10, 20, 30, 45, 60, 90 })
  {
    ticks.emplace_back(std::sqrt(degrees / 90.0), std::to_string(degrees));
  }
  return ticks;
}

//------------------------------------------------------------------------------
double ToLogarithm(double share)
{
  return std::isnan(share) ? NoValue
                           : std::clamp(std::log10(std::max(share, 1e-12)), Lowest, Highest);
}

//------------------------------------------------------------------------------
void SetUpAxis(
  vtkAxis* axis, const std::string& title, double end, const Ticks& ticks, double begin = 0.0)
{
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const auto& tick : ticks)
  {
    positions->InsertNextValue(tick.first);
    labels->InsertNextValue(tick.second);
  }
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(begin, end);
  axis->SetCustomTickPositions(positions, labels);
  axis->SetTitle(title);
  axis->SetGridVisible(false);
  axis->GetTitleProperties()->SetFontSize(LabelSize);
  axis->GetTitleProperties()->SetBold(0);
  axis->GetTitleProperties()->SetColor(Ink[0], Ink[1], Ink[2]);
  axis->GetLabelProperties()->SetFontSize(LabelSize);
  axis->GetLabelProperties()->SetColor(Ink[0], Ink[1], Ink[2]);
  axis->GetPen()->SetColorF(Ink[0], Ink[1], Ink[2]);
}

//------------------------------------------------------------------------------
// A chart whose axes are the sides of a rectangle.
vtkSmartPointer<vtkChartXY> MakeChart(const std::string& title, int x, int y, int width, int height)
{
  auto chart = vtkSmartPointer<vtkChartXY>::New();
  chart->SetTitle(title);
  chart->GetTitleProperties()->SetFontSize(TitleSize);
  chart->GetTitleProperties()->SetColor(Ink[0], Ink[1], Ink[2]);
  chart->SetAutoSize(false);
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  chart->SetSize(vtkRectf(x, y, width, height));
  return chart;
}

//------------------------------------------------------------------------------
// Cells of logarithms over a rectangle of a chart.
void AddCells(vtkChartXY* chart, vtkImageData* cells, const vtkRectf& where)
{
  // Some versions take the place from the picture itself: from its origin, a spacing a cell.
  const int* size = cells->GetDimensions();
  cells->SetOrigin(where.GetX(), where.GetY(), 0.0);
  cells->SetSpacing(where.GetWidth() / size[0], where.GetHeight() / size[1], 1.0);
  vtkNew<vtkPlotHistogram2D> plot;
  plot->SetInputData(cells);
  plot->SetTransferFunction(tool::MakeErrorColors());
  plot->SetPosition(where);
  chart->AddPlot(plot);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ToLogarithms(vtkImageData* errors)
{
  auto logarithms = vtkSmartPointer<vtkImageData>::New();
  logarithms->SetDimensions(errors->GetDimensions());
  vtkNew<vtkDoubleArray> values;
  for (vtkIdType k = 0; k < errors->GetNumberOfPoints(); ++k)
  {
    values->InsertNextValue(ToLogarithm(errors->GetPointData()->GetScalars()->GetComponent(k, 0)));
  }
  logarithms->GetPointData()->SetScalars(values);
  return logarithms;
}

//------------------------------------------------------------------------------
void AddMap(vtkContextScene* scene, const std::string& title, int left, vtkImageData* errors,
  double width, const std::string& xTitle, const std::string& yTitle, const Ticks& xTicks)
{
  const auto chart = MakeChart(title, left, Bottom, Side, Side);
  SetUpAxis(chart->GetAxis(vtkAxis::BOTTOM), xTitle, width, xTicks);
  SetUpAxis(chart->GetAxis(vtkAxis::LEFT), yTitle, 90.0, Degrees);
  AddCells(chart, ToLogarithms(errors), vtkRectf(0.0f, 0.0f, static_cast<float>(width), 90.0f));
  scene->AddItem(chart);
}

//------------------------------------------------------------------------------
void AddColorBar(vtkContextScene* scene)
{
  constexpr int steps = 256;
  vtkNew<vtkImageData> gradient;
  gradient->SetDimensions(2, steps, 1);
  vtkNew<vtkDoubleArray> values;
  for (int k = 0; k < 2 * steps; ++k)
  {
    values->InsertNextValue(Lowest + (Highest - Lowest) * (k / 2) / (steps - 1.0));
  }
  gradient->GetPointData()->SetScalars(values);
  const auto chart = MakeChart("error", BarLeft, Bottom, BarWidth, Side);
  SetUpAxis(chart->GetAxis(vtkAxis::BOTTOM), "", 1.0, {});
  SetUpAxis(chart->GetAxis(vtkAxis::LEFT), "", Highest, Shares, Lowest);
  AddCells(chart, gradient,
    vtkRectf(0.0f, static_cast<float>(Lowest), 1.0f, static_cast<float>(Highest - Lowest)));
  scene->AddItem(chart);
}

//------------------------------------------------------------------------------
void AddCurve(vtkChartXY* chart, const std::vector<tool::ViewError>& views, const std::string& name,
  double tool::ViewError::*error, const tool::RGB& color, int marker)
{
  vtkNew<vtkDoubleArray> angles;
  vtkNew<vtkDoubleArray> errors;
  angles->SetName("theta_o");
  errors->SetName(name.c_str());
  for (const tool::ViewError& view : views)
  {
    angles->InsertNextValue(0.5 * (view.Begin + view.End));
    errors->InsertNextValue(ToLogarithm(view.*error));
  }
  vtkNew<vtkTable> table;
  table->AddColumn(angles);
  table->AddColumn(errors);
  auto* plot = vtkPlotPoints::SafeDownCast(chart->AddPlot(vtkChart::LINE));
  plot->SetInputData(table, 0, 1);
  plot->GetPen()->SetColorF(color[0], color[1], color[2]);
  plot->SetWidth(2.0f);
  plot->SetMarkerStyle(marker);
  plot->SetMarkerSize(7.0f);
}

//------------------------------------------------------------------------------
void AddViews(
  vtkContextScene* scene, const std::string& method, const std::vector<tool::ViewError>& views)
{
  const auto chart = MakeChart(tool::Fit("radiance: " + method, TitleSize, false, ViewsWidth),
    ViewsLeft, Bottom, ViewsWidth, Side);
  chart->SetShowLegend(true);
  vtkAxis* left = chart->GetAxis(vtkAxis::LEFT);
  SetUpAxis(chart->GetAxis(vtkAxis::BOTTOM), "theta_o (degrees)", 90.0, Degrees);
  SetUpAxis(left, "", Highest, Shares, Lowest);
  left->SetGridVisible(true);
  left->GetGridPen()->SetColorF(0.85, 0.85, 0.85);
  // Far from each other in brightness, and marks of two shapes.
  AddCurve(
    chart, views, "99th percentile", &tool::ViewError::P99, P99Color, vtkPlotPoints::DIAMOND);
  AddCurve(
    chart, views, "relative L1", &tool::ViewError::RelativeL1, L1Color, vtkPlotPoints::CIRCLE);
  scene->AddItem(chart);
}

//------------------------------------------------------------------------------
// A line of text with its lower left corner at (x, y).
vtkTextProperty* AddText(vtkRenderer* renderer, int x, int y, const std::string& text, int size,
  bool bold, const tool::RGB& color)
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(x, y);
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(size);
  property->SetBold(bold);
  property->SetColor(color[0], color[1], color[2]);
  renderer->AddActor(actor);
  return property;
}

//------------------------------------------------------------------------------
// Their numbers in the map, white on dark: the map may be bright or dark there.
void AddWorst(vtkRenderer* renderer, vtkBRDFFailureMap* map)
{
  for (int k = 0; k < map->GetNumberOfWorstAngles(); ++k)
  {
    double angles[3];
    map->GetWorstAngles(k, angles);
    vtkTextProperty* mark = AddText(renderer,
      MapLefts[0] + std::min(static_cast<int>(angles[0] * Side / 90.0) - 4, Side - 12),
      Bottom + std::min(static_cast<int>(angles[1] * Side / 90.0) - 6, Side - 15),
      std::to_string(k + 1), LabelSize, true, { 1.0, 1.0, 1.0 });
    mark->SetBackgroundColor(Ink[0], Ink[1], Ink[2]);
    mark->SetBackgroundOpacity(1.0);
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
std::vector<ViewError> MeasureViews(const std::vector<double>& normals,
  const std::vector<double>& views, const std::vector<double>& rgb,
  const std::vector<double>& reference)
{
  constexpr int count = static_cast<int>(90.0 / ViewStep);
  std::vector<std::vector<std::size_t>> pixels(count);
  for (std::size_t k = 0; k < normals.size(); k += 3)
  {
    const double cosine = std::clamp(vtkMath::Dot(&normals[k], &views[k]), 0.0, 1.0);
    const double theta = vtkMath::DegreesFromRadians(std::acos(cosine));
    pixels[std::min(count - 1, static_cast<int>(theta / ViewStep))].push_back(k);
  }
  std::vector<ViewError> errors;
  for (int step = 0; step < count; ++step)
  {
    vtkNew<vtkDoubleArray> x;
    vtkNew<vtkDoubleArray> r;
    double sum = 0.0;
    x->SetNumberOfComponents(3);
    r->SetNumberOfComponents(3);
    for (const std::size_t k : pixels[step])
    {
      x->InsertNextTuple(&rgb[k]);
      r->InsertNextTuple(&reference[k]);
      sum += reference[k] + reference[k + 1] + reference[k + 2];
    }
    if (sum > 0.0)
    {
      vtkNew<vtkRadianceMetrics> metrics;
      if (!metrics->Compare(x, r))
      {
        throw Error("measuring the views: " + TakeErrorText());
      }
      errors.push_back({ step * ViewStep, (step + 1) * ViewStep, pixels[step].size(),
        metrics->GetRelativeL1(), metrics->GetP99Relative() });
    }
  }
  return errors;
}

//------------------------------------------------------------------------------
void WriteFailureMap(const std::string& path, const FailureCaption& caption, vtkBRDFFailureMap* map,
  const std::vector<ViewError>& views)
{
  vtkNew<vtkContextActor> actor;
  vtkContextScene* scene = actor->GetScene();
  AddMap(scene, "f: light and view", MapLefts[0], map->GetIncidentOutgoing(), 90.0,
    "theta_i (degrees)", "theta_o (degrees)", Degrees);
  AddMap(scene, "f: half vector and difference", MapLefts[1], map->GetHalfDifference(), 1.0,
    "theta_h (degrees, square root axis)", "theta_d (degrees)", MakeHalfAngleTicks());
  AddColorBar(scene);
  AddViews(scene, caption.Method, views);

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  window->SetSize(Width, Height);
  scene->SetRenderer(renderer);
  const int room = Width - 2 * MapLefts[0];
  AddText(renderer, MapLefts[0], Height - 42, Fit(caption.Title, TitleSize + 5, true, room),
    TitleSize + 5, true, Ink);
  AddText(renderer, MapLefts[0], Height - 72, Fit(caption.Note, LabelSize, false, room), LabelSize,
    false, PaleInk);
  AddWorst(renderer, map);

  window->Render();
  vtkNew<vtkWindowToImageFilter> capture;
  capture->SetInput(window);
  capture->SetInputBufferTypeToRGB();
  capture->ReadFrontBufferOff();
  capture->Update();
  const std::string errors = TakeErrorText();
  if (!errors.empty())
  {
    throw Error("drawing the failure map: " + errors);
  }
  WritePNG(path, capture->GetOutput());
}
} // namespace tool
