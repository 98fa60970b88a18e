// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartPages.h"

#include "ChartMethods.h"
#include "LogAxis.h"
#include "ParetoFront.h"
#include "Picture.h"
#include "Tool.h"

#include "vtkAxis.h"
#include "vtkChartXY.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkNew.h"
#include "vtkPen.h"
#include "vtkPlotPoints.h"
#include "vtkRect.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTextProperty.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace
{
using tool::ChartJson;
using tool::RGB;

// Below this an error is taken as this, lest a single zero draws a geometric mean there.
constexpr double LeastError = 1e-7;
// Marks closer than this, in powers of ten, are one.
constexpr double SamePlace = 0.03;

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

/// A method in one size, in one pair or over all.
struct Dot
{
  std::string Method;
  std::string Size;
  double Cost;
  double Error;

  bool IsPlan() const { return this->Method == tool::PlannerMethod; }
  bool IsMark() const { return this->IsPlan() || this->Method == tool::PBRMethod; }
  bool IsDrawn() const
  {
    return this->Cost > 0.0 && this->Error > 0.0 && std::isfinite(this->Cost) &&
           std::isfinite(this->Error);
  }
};

struct Page
{
  std::string Title;
  std::string Subtitle;
  std::string XLabel;
  tool::Unit XUnit;
  std::vector<Dot> Dots;
};

//------------------------------------------------------------------------------
std::vector<Dot> ListDots(const ChartJson& pair, const std::string& figure)
{
  std::vector<Dot> dots;
  for (const ChartJson& point : pair.at("points"))
  {
    const double error = tool::GetPointError(point, tool::GetMetrics().front().Name);
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
std::vector<Dot> ListMeans(const ChartJson& results, const std::string& figure)
{
  const ChartJson& pairs = results.at("pairs");
  std::map<std::pair<std::string, std::string>, std::pair<std::vector<double>, std::vector<double>>>
    all;
  std::vector<Dot> first;
  for (const ChartJson& pair : pairs)
  {
    const std::vector<Dot> dots = ListDots(pair, figure);
    first = first.empty() ? dots : first;
    for (const Dot& dot : dots)
    {
      auto& [costs, errors] = all[{ dot.Method, dot.Size }];
      costs.push_back(dot.Cost);
      errors.push_back(dot.Error);
    }
  }
  std::vector<Dot> means;
  for (const Dot& dot : first)
  {
    const auto& [costs, errors] = all[{ dot.Method, dot.Size }];
    if (costs.size() == pairs.size())
    {
      means.push_back(
        { dot.Method, dot.Size, tool::GetGeometricMean(costs), tool::GetGeometricMean(errors) });
    }
  }
  return means;
}

//------------------------------------------------------------------------------
std::vector<Dot> PickFront(const std::vector<Dot>& dots)
{
  std::vector<tool::CostPoint> costs;
  for (const Dot& dot : dots)
  {
    costs.push_back({ dot.Cost, dot.Error });
  }
  std::vector<Dot> front;
  for (const std::size_t k : tool::FindFront(costs))
  {
    front.push_back(dots[k]);
  }
  return front;
}

//------------------------------------------------------------------------------
// Draws one page. The chart's own coordinates are pixels.
class Painter
{
public:
  explicit Painter(const Page& page)
    : Drawn(page)
  {
    std::vector<double> costs, errors;
    for (const Dot& dot : page.Dots)
    {
      if (dot.IsDrawn())
      {
        costs.push_back(dot.Cost);
        errors.push_back(dot.Error);
      }
      if (!dot.IsMark())
      {
        const bool isNew = this->Curves.empty() || this->Curves.back().front().Method != dot.Method;
        isNew ? this->Curves.push_back({ dot }) : this->Curves.back().push_back(dot);
      }
    }
    this->X = tool::LogAxis(costs);
    this->Y = tool::LogAxis(errors);
  }

  void Write(const std::string& path)
  {
    this->Chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
    this->Chart->SetSize(
      vtkRectf(Smooth * Left, Smooth * Bottom, Smooth * PlotWidth, Smooth * PlotHeight));
    this->Chart->SetShowLegend(false);
    this->SetUpAxis(vtkAxis::BOTTOM, this->X, PlotWidth, this->Drawn.XUnit);
    this->SetUpAxis(vtkAxis::LEFT, this->Y, PlotHeight, tool::Unit::Share);
    this->AddPlots();

    vtkNew<vtkContextActor> actor;
    actor->GetScene()->AddItem(this->Chart);
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
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(window);
    picture->ReadFrontBufferOff();
    vtkNew<vtkImageShrink3D> mean;
    mean->SetInputConnection(picture->GetOutputPort());
    mean->SetShrinkFactors(Smooth, Smooth, 1);
    mean->MeanOn();
    mean->Update();
    if (mean->GetOutput()->GetDimensions()[0] != Width)
    {
      throw tool::Error(path + ": the chart can't be read back: " + tool::TakeErrorText());
    }
    const auto* bytes = static_cast<const unsigned char*>(mean->GetOutput()->GetScalarPointer());
    tool::Picture drawn(Width, Height);
    for (int k = 0; k < Width * Height; ++k)
    {
      const unsigned char* rgb = bytes + 3 * k;
      drawn.At(k % Width, k / Width) = glm::vec4(rgb[0], rgb[1], rgb[2], 255.0f) / 255.0f;
    }
    this->DrawTexts(drawn);
    tool::WritePNG(path, drawn, [](double value) { return value; });
  }

private:
  void SetUpAxis(int place, const tool::LogAxis& scale, int length, tool::Unit unit)
  {
    vtkNew<vtkDoubleArray> positions;
    vtkNew<vtkStringArray> labels;
    for (const double tick : scale.GetTicks())
    {
      const double value = std::pow(10.0, tick);
      positions->InsertNextValue(scale.Find(value) * length);
      labels->InsertNextValue(tool::FormatTick(value, unit));
    }
    vtkAxis* axis = this->Chart->GetAxis(place);
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

  // A line, or dots of a marker's style.
  vtkPlotPoints* AddPlot(
    int type, const std::vector<Dot>& dots, const RGB& color, double width, int marker)
  {
    vtkNew<vtkTable> table;
    vtkNew<vtkDoubleArray> columns[2];
    columns[0]->SetName("x");
    columns[1]->SetName("y");
    for (const Dot& dot : dots)
    {
      if (dot.IsDrawn())
      {
        columns[0]->InsertNextValue(this->X.Find(dot.Cost) * PlotWidth);
        columns[1]->InsertNextValue(this->Y.Find(dot.Error) * PlotHeight);
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
    plot->GetPen()->SetColorF(color[0], color[1], color[2]);
    plot->SetWidth(static_cast<float>(Smooth * width));
    plot->SetMarkerStyle(marker);
    return plot;
  }

  void AddPlots()
  {
    this->AddPlot(vtkChart::LINE, PickFront(this->Drawn.Dots), Band, 24.0, vtkPlotPoints::NONE);
    for (const std::vector<Dot>& curve : this->Curves)
    {
      // Joined are those points of a method that none of its own beats.
      const RGB color = tool::FindChartMethod(curve.front().Method).Color;
      this->AddPlot(vtkChart::LINE, PickFront(curve), color, 4.0, vtkPlotPoints::NONE);
      this->AddPlot(vtkChart::POINTS, curve, color, 4.0, vtkPlotPoints::CIRCLE)
        ->SetMarkerSize(Smooth * 16.0f);
    }
    for (const Dot& dot : this->Drawn.Dots)
    {
      if (dot.IsMark())
      {
        this
          ->AddPlot(vtkChart::POINTS, { dot }, Ink, 4.0,
            dot.IsPlan() ? vtkPlotPoints::DIAMOND : vtkPlotPoints::SQUARE)
          ->SetMarkerSize(Smooth * 24.0f);
      }
    }
  }

  void DrawTexts(tool::Picture& picture) const
  {
    const auto draw = [&picture](double x, int y, const std::string& text, int size,
                        const RGB& color, bool bold = false, bool right = false)
    {
      const int width = right ? tool::MeasureText(text, size, bold) : 0;
      tool::DrawText(picture, static_cast<int>(x) - width, y, text, size, bold, color);
    };
    const int width = Width - 60;
    draw(
      30, Height - 72, tool::Fit(this->Drawn.Title, TitleFont, true, width), TitleFont, Ink, true);
    draw(30, Height - 114, tool::Fit(this->Drawn.Subtitle, Font, false, width), Font, Faint);
    draw(30, Height - Top + 16, "relative L1 error, smaller is better", Font, Ink, true);
    draw(Width - Right, 24, this->Drawn.XLabel, Font, Ink, true, true);
    const int names = Width - Right + 30;
    int line = Height - Top - 30;
    for (const std::vector<Dot>& curve : this->Curves)
    {
      const tool::ChartMethod& method = tool::FindChartMethod(curve.front().Method);
      draw(names, line, method.Label, Font, method.Color, true);
      line -= 40;
    }
    draw(names, line, "band: nothing is both", SmallFont, Faint);
    draw(names, line - 28, "cheaper and better", SmallFont, Faint);

    // Beside each mark; plans of several tolerances at one place have one text.
    std::vector<std::pair<Dot, std::string>> marks;
    for (const Dot& dot : this->Drawn.Dots)
    {
      const std::string size = dot.IsPlan()
                                 ? tool::FormatNumber(100.0 * std::stod(dot.Size)) + " %" +
                                     dot.Size.substr(std::min(dot.Size.find(' '), dot.Size.size()))
                                 : "";
      const auto same = std::find_if(marks.begin(), marks.end(),
        [&dot](const auto& other)
        {
          return dot.IsPlan() && other.first.IsPlan() &&
                 std::abs(std::log10(other.first.Cost / dot.Cost)) < SamePlace &&
                 std::abs(std::log10(other.first.Error / dot.Error)) < SamePlace;
        });
      if (same != marks.end())
      {
        same->second += ", " + size;
      }
      else if (dot.IsMark() && dot.IsDrawn())
      {
        const std::string label = tool::FindChartMethod(dot.Method).Label;
        marks.emplace_back(dot, dot.IsPlan() ? label + " at " + size : label);
      }
    }
    for (const auto& [dot, name] : marks)
    {
      const double x = Left + this->X.Find(dot.Cost) * PlotWidth;
      const int y = static_cast<int>(Bottom + this->Y.Find(dot.Error) * PlotHeight - 0.6 * Font);
      const bool left = x + 20 + tool::MeasureText(name, Font, true) > Width - Right;
      draw(x + (left ? -20 : 20), y, name, Font, Ink, true, left);
    }
  }

  const Page& Drawn;
  std::vector<std::vector<Dot>> Curves; // of each method
  tool::LogAxis X;
  tool::LogAxis Y;
  vtkNew<vtkChartXY> Chart;
};

//------------------------------------------------------------------------------
std::string DescribePicture(const ChartJson& results)
{
  const std::string renderer = results.at("machine").value("renderer", "");
  return results.at("settings").value("size", "") + " pixels, " +
         renderer.substr(0, renderer.find(" ("));
}

//------------------------------------------------------------------------------
// Letters, digits and -_. only.
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
}

namespace tool
{
//------------------------------------------------------------------------------
void DrawPairPage(const ChartJson& results, const ChartJson& pair, const std::string& folder)
{
  const Page page = { pair["material"].get<std::string>() + " under " +
                        pair["environment"].get<std::string>(),
    DescribePicture(results), "time of a frame", Unit::Milliseconds, ListDots(pair, "frame_ms") };
  Painter(page).Write(folder + "/" + MakeFileName(pair) + ".png");
}

//------------------------------------------------------------------------------
void DrawSummaryPages(const ChartJson& results, const std::string& folder)
{
  const struct
  {
    const char* File;
    const char* Figure;
    const char* Title;
    const char* Label;
    Unit Kind;
  } summaries[] = { { "summary", "frame_ms", "Accuracy against speed", "time of a frame",
                      Unit::Milliseconds },
    { "setup", "setup_ms", "Accuracy against set-up time", "set-up, until the first frame is done",
      Unit::Milliseconds },
    { "memory", "texture_bytes", "Accuracy against texture memory", "textures", Unit::Bytes } };
  std::set<std::string> materials;
  std::set<std::string> environments;
  for (const ChartJson& pair : results.at("pairs"))
  {
    materials.insert(pair["material"]);
    environments.insert(pair["environment"]);
  }
  const std::string subtitle =
    "Geometric means of " + FormatCount(results.at("pairs").size(), "pair") + " of " +
    FormatCount(materials.size(), "material") + " and " +
    FormatCount(environments.size(), "environment") + ", " + DescribePicture(results);
  for (const auto& summary : summaries)
  {
    const Page page = { summary.Title, subtitle, summary.Label, summary.Kind,
      ListMeans(results, summary.Figure) };
    Painter(page).Write(folder + "/" + summary.File + ".png");
  }
}
} // namespace tool
