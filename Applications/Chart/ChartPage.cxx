// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartPage.h"

#include "LogAxis.h"
#include "Picture.h"
#include "Tool.h"

#include "vtkAxis.h"
#include "vtkChartXY.h"
#include "vtkContext2D.h"
#include "vtkContextActor.h"
#include "vtkContextItem.h"
#include "vtkContextScene.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPen.h"
#include "vtkPlotPoints.h"
#include "vtkRect.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStdString.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{
using tool::RGB;

// In pixels. Drawn at twice the size and averaged: no jagged lines, whatever the driver.
constexpr int Smooth = 2;
constexpr int Width = 1600;
constexpr int Height = 1000;
constexpr int Left = 130;
constexpr int Right = 340; // with the names of the curves
constexpr int Bottom = 120;
constexpr int Top = 190;
constexpr int PlotWidth = Width - Left - Right;
constexpr int PlotHeight = Height - Bottom - Top;
constexpr int TitleFont = 40;
constexpr int Font = 26;
constexpr int SmallFont = 20;

constexpr RGB Ink = { 0.1, 0.1, 0.1 };
constexpr RGB Faint = { 0.4, 0.4, 0.4 };
constexpr RGB GridColor = { 0.88, 0.88, 0.88 };
constexpr RGB Band = { 0.97, 0.91, 0.62 };

//------------------------------------------------------------------------------
/// Whatever a function draws, over the chart.
class Overlay : public vtkContextItem
{
public:
  static Overlay* New();
  vtkTypeMacro(Overlay, vtkContextItem);

  bool Paint(vtkContext2D* painter) override
  {
    this->Draw(painter);
    return true;
  }

  std::function<void(vtkContext2D*)> Draw;

protected:
  Overlay() = default;
  ~Overlay() override = default;
};
vtkStandardNewMacro(Overlay);

//------------------------------------------------------------------------------
void DrawText(vtkContext2D* painter, double x, double y, const std::string& text, int size,
  const RGB& color, bool bold = false, bool right = false)
{
  vtkTextProperty* property = painter->GetTextProp();
  property->SetFontFamilyToArial();
  property->SetFontSize(Smooth * size);
  property->SetBold(bold);
  property->SetColor(color[0], color[1], color[2]);
  property->SetJustification(right ? VTK_TEXT_RIGHT : VTK_TEXT_LEFT);
  property->SetVerticalJustificationToBottom();
  painter->DrawString(
    static_cast<float>(Smooth * x), static_cast<float>(Smooth * y), vtkStdString(text));
}

//------------------------------------------------------------------------------
unsigned char ToByte(double value)
{
  return static_cast<unsigned char>(std::lround(255.0 * value));
}

//------------------------------------------------------------------------------
bool IsDrawn(const tool::PagePoint& point)
{
  return point.X > 0.0 && point.Y > 0.0 && std::isfinite(point.X) && std::isfinite(point.Y);
}

//------------------------------------------------------------------------------
// Draws one page. The chart's own coordinates are pixels.
class Painter
{
public:
  explicit Painter(const tool::Page& page);
  void Write(const std::string& path);

private:
  void SetUpAxis(vtkAxis* axis, const tool::LogAxis& scale, int length, tool::Unit unit) const;
  vtkPlotPoints* AddPlot(
    int type, const std::vector<tool::PagePoint>& points, const RGB& color, double width);
  void AddMethods();
  void DrawTexts(vtkContext2D* painter) const;

  const tool::Page& Page;
  tool::LogAxis X;
  tool::LogAxis Y;
  vtkNew<vtkChartXY> Chart;
};

//------------------------------------------------------------------------------
Painter::Painter(const tool::Page& page)
  : Page(page)
{
  const auto take = [this](const tool::PagePoint& point)
  {
    if (IsDrawn(point))
    {
      this->X.Take(point.X);
      this->Y.Take(point.Y);
    }
  };
  for (const tool::PageCurve& curve : page.Curves)
  {
    std::for_each(curve.Points.begin(), curve.Points.end(), take);
  }
  for (const tool::PageMark& mark : page.Marks)
  {
    take(mark.Point);
  }
  this->X.Widen();
  this->Y.Widen();
}

//------------------------------------------------------------------------------
void Painter::SetUpAxis(
  vtkAxis* axis, const tool::LogAxis& scale, int length, tool::Unit unit) const
{
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const double tick : scale.GetTicks())
  {
    const double value = std::pow(10.0, tick);
    positions->InsertNextValue(scale.Find(value) * length);
    labels->InsertNextValue(tool::FormatTick(value, unit));
  }
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(0.0, length);
  axis->SetCustomTickPositions(positions, labels);
  axis->SetTitle("");
  axis->GetLabelProperties()->SetFontFamilyToArial();
  axis->GetLabelProperties()->SetFontSize(Smooth * Font);
  axis->GetLabelProperties()->SetColor(&Ink.x);
  axis->SetLabelOffset(Smooth * 12.0f);
  axis->GetGridPen()->SetColorF(GridColor[0], GridColor[1], GridColor[2]);
  axis->GetGridPen()->SetWidth(Smooth * 1.5f);
  axis->GetPen()->SetColorF(Faint[0], Faint[1], Faint[2]);
  axis->GetPen()->SetWidth(Smooth * 1.5f);
}

//------------------------------------------------------------------------------
vtkPlotPoints* Painter::AddPlot(
  int type, const std::vector<tool::PagePoint>& points, const RGB& color, double width)
{
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> columns[2];
  columns[0]->SetName("x");
  columns[1]->SetName("y");
  for (const tool::PagePoint& point : points)
  {
    if (IsDrawn(point))
    {
      columns[0]->InsertNextValue(this->X.Find(point.X) * PlotWidth);
      columns[1]->InsertNextValue(this->Y.Find(point.Y) * PlotHeight);
    }
  }
  if (type == vtkChart::LINE && columns[0]->GetNumberOfTuples() < 2)
  {
    return nullptr; // a dot
  }
  table->AddColumn(columns[0]);
  table->AddColumn(columns[1]);
  auto* plot = vtkPlotPoints::SafeDownCast(this->Chart->AddPlot(type));
  plot->SetInputData(table, 0, 1);
  plot->SetColor(ToByte(color[0]), ToByte(color[1]), ToByte(color[2]), 255);
  plot->SetWidth(static_cast<float>(Smooth * width));
  plot->SetMarkerStyle(type == vtkChart::LINE ? vtkPlotPoints::NONE : vtkPlotPoints::CIRCLE);
  return plot;
}

//------------------------------------------------------------------------------
void Painter::AddMethods()
{
  this->AddPlot(vtkChart::LINE, this->Page.Front, Band, 24.0);
  for (const tool::PageCurve& curve : this->Page.Curves)
  {
    this->AddPlot(vtkChart::LINE, curve.Line, curve.Color, 4.0);
    this->AddPlot(vtkChart::POINTS, curve.Points, curve.Color, 4.0)->SetMarkerSize(Smooth * 16.0f);
  }
  for (const tool::PageMark& mark : this->Page.Marks)
  {
    vtkPlotPoints* plot = this->AddPlot(vtkChart::POINTS, { mark.Point }, Ink, 4.0);
    plot->SetMarkerSize(Smooth * 24.0f);
    plot->SetMarkerStyle(mark.Diamond ? vtkPlotPoints::DIAMOND : vtkPlotPoints::SQUARE);
  }
}

//------------------------------------------------------------------------------
void Painter::DrawTexts(vtkContext2D* painter) const
{
  const int width = Width - 60;
  DrawText(painter, 30, Height - 72, tool::Fit(this->Page.Title, TitleFont, true, width), TitleFont,
    Ink, true);
  DrawText(
    painter, 30, Height - 114, tool::Fit(this->Page.Subtitle, Font, false, width), Font, Faint);
  DrawText(painter, 30, Height - Top + 16, this->Page.YLabel, Font, Ink, true);
  DrawText(painter, Width - Right, 24, this->Page.XLabel, Font, Ink, true, true);
  const int names = Width - Right + 30;
  int line = Height - Top - 30;
  for (const tool::PageCurve& curve : this->Page.Curves)
  {
    DrawText(painter, names, line, curve.Label, Font, curve.Color, true);
    line -= 40;
  }
  if (!this->Page.Front.empty())
  {
    DrawText(painter, names, line, "band: nothing is both", SmallFont, Faint);
    DrawText(painter, names, line - 28, "cheaper and better", SmallFont, Faint);
  }
  for (const tool::PageMark& mark : this->Page.Marks)
  {
    if (IsDrawn(mark.Point))
    {
      // Beside the mark: marks of several tolerances lie above each other.
      const double x = Left + this->X.Find(mark.Point.X) * PlotWidth;
      const double y = Bottom + this->Y.Find(mark.Point.Y) * PlotHeight - 0.6 * Font;
      const bool left = x + 20 + tool::MeasureText(mark.Name, Font, true) > Width - Right;
      DrawText(painter, x + (left ? -20 : 20), y, mark.Name, Font, Ink, true, left);
    }
  }
}

//------------------------------------------------------------------------------
void Painter::Write(const std::string& path)
{
  vtkChartXY* chart = this->Chart;
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  chart->SetSize(vtkRectf(Smooth * Left, Smooth * Bottom, Smooth * PlotWidth, Smooth * PlotHeight));
  this->SetUpAxis(chart->GetAxis(vtkAxis::BOTTOM), this->X, PlotWidth, this->Page.XUnit);
  this->SetUpAxis(chart->GetAxis(vtkAxis::LEFT), this->Y, PlotHeight, this->Page.YUnit);
  this->AddMethods();
  chart->SetShowLegend(false);
  vtkNew<Overlay> overlay;
  overlay->Draw = [this](vtkContext2D* painter) { this->DrawTexts(painter); };

  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  actor->GetScene()->AddItem(overlay);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetDPI(72); // a font's size is its height in pixels
  window->SetSize(Smooth * Width, Smooth * Height);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, Smooth * Width - 1, Smooth * Height - 1, 0, bytes);
  tool::Picture picture(Smooth * Width, Smooth * Height);
  if (bytes->GetNumberOfValues() != 3 * static_cast<vtkIdType>(Smooth * Width) * Smooth * Height)
  {
    throw tool::Error(path + ": the chart can't be read back: " + tool::TakeErrorText());
  }
  for (vtkIdType k = 0; k < bytes->GetNumberOfValues(); ++k)
  {
    picture.Pixels[static_cast<std::size_t>(k / 3 * 4 + k % 3)] = bytes->GetValue(k) / 255.0f;
  }
  tool::WritePNG(path, tool::Downsample(picture, Smooth), [](double shown) { return shown; });
}
}

namespace tool
{
//------------------------------------------------------------------------------
void DrawPage(const Page& page, const std::string& path) { Painter(page).Write(path); }
} // namespace tool
