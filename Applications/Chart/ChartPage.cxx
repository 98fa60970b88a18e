// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartPage.h"

#include "Files.h"
#include "LabelPlaces.h"
#include "LogAxis.h"
#include "Picture.h"
#include "Tool.h"

#include "vtkAxis.h"
#include "vtkBrush.h"
#include "vtkChartXY.h"
#include "vtkContext2D.h"
#include "vtkContextActor.h"
#include "vtkContextItem.h"
#include "vtkContextScene.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPen.h"
#include "vtkPlot.h"
#include "vtkRect.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSVGExporter.h"
#include "vtkStdString.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"

#include <stdlib.h> // mkdtemp

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

namespace fs = std::filesystem;

namespace
{
using tool::RGB;

// In pixels. Drawn at twice the size and averaged: no jagged lines, whatever the driver.
constexpr int Smooth = 2;
constexpr int Width = 1600;
constexpr int Height = 1000;
constexpr int Left = 130;
constexpr int Right = 60;
constexpr int Bottom = 120;
constexpr int Top = 190;
constexpr int PlotWidth = Width - Left - Right;
constexpr int PlotHeight = Height - Bottom - Top;
constexpr int TitleFont = 40;
constexpr int Font = 26;
constexpr int LabelFont = 28;
constexpr int SmallFont = 19;
constexpr double LineWidth = 4.0;
constexpr double DotRadius = 8.0;
constexpr double RingRadius = 17.0;
constexpr double BandWidth = 24.0;

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
unsigned char ToByte(double value)
{
  return static_cast<unsigned char>(std::lround(255.0 * value));
}

//------------------------------------------------------------------------------
// With the size that it is meant for, and a box that lets viewers scale it.
std::string MakeScalable(std::string text)
{
  const std::string drawn = "width=\"" + std::to_string(Smooth * Width) + "\" height=\"" +
                            std::to_string(Smooth * Height) + "\"";
  const std::size_t at = text.find(drawn);
  if (at != std::string::npos)
  {
    text.replace(at, drawn.size(),
      "width=\"" + std::to_string(Width) + "\" height=\"" + std::to_string(Height) +
        "\" viewBox=\"0 0 " + std::to_string(Smooth * Width) + " " +
        std::to_string(Smooth * Height) + "\"");
  }
  return text;
}

//------------------------------------------------------------------------------
// The window's charts as SVG. VTK writes it to files only, and does not say when it cannot.
std::string MakeSVG(vtkRenderWindow* window, const std::string& title)
{
  std::string folder = (fs::temp_directory_path() / "measured-brdf-XXXXXX").string();
  if (!mkdtemp(folder.data()))
  {
    throw tool::Error(folder + ": no folder for a temporary file can be made");
  }
  const fs::path path = fs::path(folder) / "chart.svg";
  vtkNew<vtkSVGExporter> exporter;
  exporter->SetRenderWindow(window);
  exporter->SetTitle(title.c_str());
  exporter->SetFileName(path.c_str());
  exporter->Write();
  std::ifstream in(path);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  if (text.find("</svg>") == std::string::npos)
  {
    throw tool::Error(path.string() + ": the chart could not be written there whole");
  }
  return text;
}

//------------------------------------------------------------------------------
bool IsDrawn(const tool::PagePoint& point)
{
  return point.X > 0.0 && point.Y > 0.0 && std::isfinite(point.X) && std::isfinite(point.Y);
}

//------------------------------------------------------------------------------
class Painter
{
public:
  explicit Painter(const tool::Page& page)
    : Page(page)
  {
    for (const tool::PageCurve& curve : page.Curves)
    {
      for (const tool::PagePoint& point : curve.Points)
      {
        this->Take(point);
      }
    }
    for (const tool::PageMark& mark : page.Marks)
    {
      this->Take(mark.Point);
    }
    this->X.Widen();
    this->Y.Widen();
  }

  void Write(const std::string& stem);

private:
  using Place = std::array<double, 2>;

  void Take(const tool::PagePoint& point)
  {
    if (IsDrawn(point))
    {
      this->X.Take(point.X);
      this->Y.Take(point.Y);
    }
  }

  // In pixels of the finished picture.
  Place Find(const tool::PagePoint& point) const
  {
    return { Left + this->X.Find(point.X) * PlotWidth,
      Bottom + this->Y.Find(point.Y) * PlotHeight };
  }

  void SetUpAxis(vtkAxis* axis, const tool::LogAxis& scale, int length, tool::Unit unit) const;
  void AddLine(vtkChartXY* chart, const std::vector<tool::PagePoint>& points, const RGB& color,
    double width) const;
  void DrawText(vtkContext2D* painter, double x, double y, const std::string& text, int size,
    const RGB& color, bool bold = false, bool right = false) const;
  void DrawOver(vtkContext2D* painter) const;
  void DrawDots(vtkContext2D* painter, tool::LabelPlaces& places) const;
  void DrawLabels(vtkContext2D* painter, tool::LabelPlaces& places) const;
  void DrawHeading(vtkContext2D* painter) const;

  const tool::Page& Page;
  tool::LogAxis X;
  tool::LogAxis Y;
};

//------------------------------------------------------------------------------
// The chart's own coordinates are pixels: its lines would come out stretched as SVG else.
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
  axis->GetLabelProperties()->SetColor(Ink.data());
  axis->SetLabelOffset(Smooth * 12.0f);
  axis->GetGridPen()->SetColorF(GridColor[0], GridColor[1], GridColor[2]);
  axis->GetGridPen()->SetWidth(Smooth * 1.5f);
  axis->GetPen()->SetColorF(Faint[0], Faint[1], Faint[2]);
  axis->GetPen()->SetWidth(Smooth * 1.5f);
}

//------------------------------------------------------------------------------
void Painter::AddLine(vtkChartXY* chart, const std::vector<tool::PagePoint>& points,
  const RGB& color, double width) const
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
  if (columns[0]->GetNumberOfTuples() < 2)
  {
    return; // a dot
  }
  table->AddColumn(columns[0]);
  table->AddColumn(columns[1]);
  vtkPlot* plot = chart->AddPlot(vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->SetColor(ToByte(color[0]), ToByte(color[1]), ToByte(color[2]), 255);
  plot->SetWidth(static_cast<float>(Smooth * width));
}

//------------------------------------------------------------------------------
void Painter::DrawText(vtkContext2D* painter, double x, double y, const std::string& text, int size,
  const RGB& color, bool bold, bool right) const
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
void Painter::DrawHeading(vtkContext2D* painter) const
{
  const int room = Width - Right - 30;
  this->DrawText(painter, 30, Height - 72, tool::Fit(this->Page.Title, TitleFont, true, room),
    TitleFont, Ink, true);
  this->DrawText(
    painter, 30, Height - 114, tool::Fit(this->Page.Subtitle, Font, false, room), Font, Faint);
  this->DrawText(painter, 30, Height - Top + 16, this->Page.YLabel, Font, Ink, true);
  this->DrawText(painter, Width - Right, 24, this->Page.XLabel, Font, Ink, true, true);
  if (!this->Page.Front.empty())
  {
    const std::string text = "nothing is both cheaper and better";
    const int width = tool::MeasureText(text, Font, false);
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->GetBrush()->SetColorF(Band[0], Band[1], Band[2], 1.0);
    painter->DrawRect(Smooth * (Width - Right - width - 70.0f), Smooth * (Height - Top + 22.0f),
      Smooth * 54.0f, Smooth * static_cast<float>(BandWidth));
    this->DrawText(painter, Width - Right, Height - Top + 16, text, Font, Faint, false, true);
  }
}

//------------------------------------------------------------------------------
void Painter::DrawDots(vtkContext2D* painter, tool::LabelPlaces& places) const
{
  const auto at = [&painter](const Place& place, double radius)
  {
    painter->DrawEllipse(static_cast<float>(Smooth * place[0]),
      static_cast<float>(Smooth * place[1]), static_cast<float>(Smooth * radius),
      static_cast<float>(Smooth * radius));
  };
  for (const tool::PageCurve& curve : this->Page.Curves)
  {
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->GetBrush()->SetColorF(curve.Color[0], curve.Color[1], curve.Color[2], 1.0);
    for (const tool::PagePoint& point : curve.Points)
    {
      if (IsDrawn(point))
      {
        const Place place = this->Find(point);
        at(place, DotRadius);
        places.AvoidDot(place[0], place[1], DotRadius);
      }
    }
    for (std::size_t k = 1; k < curve.Line.size(); ++k)
    {
      if (IsDrawn(curve.Line[k - 1]) && IsDrawn(curve.Line[k]))
      {
        const Place from = this->Find(curve.Line[k - 1]);
        const Place to = this->Find(curve.Line[k]);
        places.AvoidLine(from[0], from[1], to[0], to[1]);
      }
    }
  }
  for (const tool::PageMark& mark : this->Page.Marks)
  {
    if (!IsDrawn(mark.Point))
    {
      continue;
    }
    const Place place = this->Find(mark.Point);
    if (mark.Ring)
    {
      // A ring: its edge as a polygon, which every device draws as thick as it should be.
      painter->GetPen()->SetLineType(vtkPen::NO_PEN);
      painter->GetBrush()->SetColorF(0.0, 0.0, 0.0, 1.0);
      painter->DrawEllipseWedge(static_cast<float>(Smooth * place[0]),
        static_cast<float>(Smooth * place[1]), Smooth * RingRadius, Smooth * RingRadius,
        Smooth * (RingRadius - LineWidth), Smooth * (RingRadius - LineWidth), 0.0f, 360.0f);
    }
    else
    {
      painter->GetPen()->SetLineType(vtkPen::NO_PEN);
      painter->GetBrush()->SetColorF(0.0, 0.0, 0.0, 1.0);
      const float side = static_cast<float>(Smooth * 2.4 * DotRadius);
      painter->DrawRect(static_cast<float>(Smooth * place[0]) - 0.5f * side,
        static_cast<float>(Smooth * place[1]) - 0.5f * side, side, side);
    }
    places.AvoidDot(place[0], place[1], mark.Ring ? RingRadius : 1.2 * DotRadius);
  }
}

//------------------------------------------------------------------------------
void Painter::DrawLabels(vtkContext2D* painter, tool::LabelPlaces& places) const
{
  const auto measure = [](const std::string& text, int size, bool bold)
  { return static_cast<double>(tool::MeasureText(text, size, bold)); };
  // The most important first: they get the best places.
  for (const tool::PageMark& mark : this->Page.Marks)
  {
    if (IsDrawn(mark.Point))
    {
      const Place at = this->Find(mark.Point);
      const tool::LabelPlace place = places.Put({ { at[0], at[1] } }, RingRadius + 4.0,
        measure(mark.Point.Name, LabelFont, true), LabelFont, true);
      this->DrawText(painter, place.X, place.Y, mark.Point.Name, LabelFont, Ink, true);
    }
  }
  for (const tool::PageCurve& curve : this->Page.Curves)
  {
    std::vector<Place> dots;
    for (const tool::PagePoint& point : curve.Points)
    {
      if (IsDrawn(point))
      {
        dots.insert(dots.begin(), this->Find(point)); // the largest size first
      }
    }
    if (dots.empty())
    {
      continue;
    }
    const tool::LabelPlace place =
      places.Put(dots, DotRadius + 6.0, measure(curve.Label, LabelFont, true), LabelFont, true);
    this->DrawText(painter, place.X, place.Y, curve.Label, LabelFont, curve.Color, true);
  }
  for (const tool::PageCurve& curve : this->Page.Curves)
  {
    for (const tool::PagePoint& point : curve.Points)
    {
      if (!IsDrawn(point) || point.Name.empty())
      {
        continue;
      }
      const Place at = this->Find(point);
      const tool::LabelPlace place = places.Put({ { at[0], at[1] } }, DotRadius + 2.0,
        measure(point.Name, SmallFont, false), SmallFont, false);
      if (place.Free)
      {
        this->DrawText(painter, place.X, place.Y, point.Name, SmallFont, curve.Color);
      }
    }
  }
}

//------------------------------------------------------------------------------
void Painter::DrawOver(vtkContext2D* painter) const
{
  tool::LabelPlaces places(Left + 4, Bottom + 4, Width - 6, Height - Top + 10);
  this->DrawHeading(painter);
  this->DrawDots(painter, places);
  this->DrawLabels(painter, places);
}

//------------------------------------------------------------------------------
void Painter::Write(const std::string& stem)
{
  vtkNew<vtkChartXY> chart;
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  chart->SetSize(vtkRectf(Smooth * Left, Smooth * Bottom, Smooth * PlotWidth, Smooth * PlotHeight));
  chart->SetShowLegend(false);
  this->SetUpAxis(chart->GetAxis(vtkAxis::BOTTOM), this->X, PlotWidth, this->Page.XUnit);
  this->SetUpAxis(chart->GetAxis(vtkAxis::LEFT), this->Y, PlotHeight, this->Page.YUnit);
  this->AddLine(chart, this->Page.Front, Band, BandWidth);
  for (const tool::PageCurve& curve : this->Page.Curves)
  {
    this->AddLine(chart, curve.Line, curve.Color, LineWidth);
  }
  vtkNew<Overlay> overlay;
  overlay->Draw = [this](vtkContext2D* painter) { this->DrawOver(painter); };

  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  actor->GetScene()->AddItem(overlay);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->SetBackgroundAlpha(1.0); // of the SVG
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
    throw tool::Error(stem + ".png: the chart can't be read back: " + tool::TakeErrorText());
  }
  for (vtkIdType k = 0; k < bytes->GetNumberOfValues(); ++k)
  {
    picture.Pixels[static_cast<std::size_t>(k / 3 * 4 + k % 3)] = bytes->GetValue(k) / 255.0f;
  }
  tool::WritePNG(
    stem + ".png", tool::Downsample(picture, Smooth), [](double shown) { return shown; });
  tool::WriteWhole(stem + ".svg", MakeScalable(MakeSVG(window, this->Page.Title)));
}
}

namespace tool
{
//------------------------------------------------------------------------------
void DrawPage(const Page& page, const std::string& stem) { Painter(page).Write(stem); }
} // namespace tool
