// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SliceView.h"

#include "ChartLines.h"
#include "PolarChart.h"

#include "vtkAxis.h"
#include "vtkChartXY.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkPen.h"
#include "vtkRect.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"

#include <QEvent>
#include <QTimer>

#include <algorithm>

namespace
{
const char* const Titles[5] = { "f (1/sr) over theta_h", "f (1/sr) over theta_d",
  "f (1/sr) over phi_d", "albedo over theta_o",
  "f (1/sr) over theta_o, negative towards the light" };
const char* const AlbedoTitle = "albedo; dashed: transmitted";
const char* const CircleTitle = "the same over theta_o; beyond 90: transmitted";
constexpr int FontSize = 12; // the window's resolution counts, too

//------------------------------------------------------------------------------
// Degrees at which a chart begins and ends.
std::pair<double, double> GetRange(int chart, bool allAround)
{
  if (chart == explorer::SliceView::Plane)
  {
    return allAround ? std::pair(-180.0, 180.0) : std::pair(-90.0, 90.0);
  }
  return { 0.0, chart == explorer::SliceView::PhiD ? 180.0 : 90.0 };
}

//------------------------------------------------------------------------------
void AddLines(vtkChartXY* chart, const std::vector<explorer::ChartLine>& lines,
  const explorer::ChartScale& scale, double width, bool dashed)
{
  for (const explorer::ChartLine& line : lines)
  {
    std::vector<double> y;
    for (const double value : line.Values)
    {
      y.push_back(scale.Find(value));
    }
    explorer::AddLine(chart, line.Degrees, y, line.Rgb, width, dashed);
  }
}
}

namespace explorer
{
//------------------------------------------------------------------------------
SliceView::SliceView(Session* session, Comparison* comparison, QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , Model(session)
  , Compared(comparison)
{
  this->setRenderWindow(this->Window);
  this->setAcceptDrops(false);
  this->setMinimumSize(260, 260);
  this->setAccessibleName(tr("Slices and albedo"));
  this->Window->SetMultiSamples(0);
  this->Window->SetLineSmoothing(true);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.97, 0.97, 0.97);
  this->Renderer->AddActor(this->Scene);
  this->Scene->GetScene()->SetRenderer(this->Renderer);
  for (const auto& chart : this->Charts)
  {
    chart->SetAutoSize(false);
    chart->SetShowLegend(false);
    this->Scene->GetScene()->AddItem(chart);
  }
  this->Polar = std::make_unique<PolarChart>(this->Scene->GetScene());
  connect(session, &Session::materialChanged, this,
    [this]()
    {
      this->Albedos = this->Transmittances = Curve();
      this->Update();
    });
  connect(session, &Session::slicesChanged, this, &SliceView::Update);
  connect(comparison, &Comparison::changed, this, &SliceView::Update);
  connect(session, &Session::lobeChanged, this,
    [this]()
    {
      if (this->Model->GetState().SlicePolar)
      {
        this->Update();
      }
    });
}

//------------------------------------------------------------------------------
SliceView::~SliceView() = default;

//------------------------------------------------------------------------------
void SliceView::SetInspection(const nlohmann::ordered_json& info)
{
  this->Albedos = this->Transmittances = Curve();
  for (const auto& row : info["albedo"])
  {
    this->Albedos.Degrees.push_back(row["degrees"]);
    this->Albedos.Values.push_back(row["rgb"]);
  }
  if (info.contains("transmission"))
  {
    for (const auto& row : info["transmission"]["per_angle"])
    {
      this->Transmittances.Degrees.push_back(row["degrees"]);
      this->Transmittances.Values.push_back(row["view"]);
    }
  }
  this->Update();
}

//------------------------------------------------------------------------------
std::vector<ComparedMaterial> SliceView::GetMaterials() const
{
  const tool::Material& shown = this->Model->GetMaterial();
  std::vector<ComparedMaterial> materials = { { shown.File, shown.Name, shown.BRDF, this->Albedos,
    {}, shown.Transmission, this->Transmittances } };
  for (const ComparedMaterial& material : this->Compared->GetMaterials())
  {
    // An edited material may be seen beside its original.
    if (material.File != shown.File || shown.BRDF != this->Model->GetOriginal().BRDF)
    {
      materials.push_back(material);
    }
  }
  return materials;
}

//------------------------------------------------------------------------------
Curve SliceView::Sample(int chart, const ComparedMaterial& material) const
{
  const State& state = this->Model->GetState();
  switch (chart)
  {
    case Albedo:
      return material.Albedo;
    case Plane:
      return SamplePlaneOfIncidence(
        material.BRDF, state.LobeThetaI, state.LobePhiI, material.Transmission);
    default:
      return SampleSlice(
        material.BRDF, chart, { state.SliceThetaH, state.SliceThetaD, state.SlicePhiD });
  }
}

//------------------------------------------------------------------------------
bool SliceView::IsAllAround() const
{
  const std::vector<Curve>& curves = this->Curves[Plane];
  return std::any_of(curves.begin(), curves.end(),
    [](const Curve& curve) { return !curve.Degrees.empty() && curve.Degrees.back() > 90.0; });
}

//------------------------------------------------------------------------------
void SliceView::Update()
{
  if (!this->Model->GetMaterial().BRDF)
  {
    return;
  }
  const State& state = this->Model->GetState();
  const std::vector<ComparedMaterial> materials = this->GetMaterials();
  this->Transmitted.clear();
  for (const ComparedMaterial& material : materials)
  {
    this->Transmitted.push_back(material.Transmittance);
  }
  for (int chart = 0; chart < NumberOfCharts; ++chart)
  {
    std::vector<Curve>& curves = this->Curves[static_cast<std::size_t>(chart)];
    curves.clear();
    const bool shown = (chart == Plane) == state.SlicePolar;
    this->Charts[static_cast<std::size_t>(chart)]->SetVisible(shown);
    if (!shown)
    {
      continue;
    }
    for (const ComparedMaterial& material : materials)
    {
      curves.push_back(this->Sample(chart, material));
    }
    this->Draw(chart);
  }
  this->Polar->SetVisible(state.SlicePolar);
  if (state.SlicePolar)
  {
    this->Polar->SetAllAround(this->IsAllAround());
    this->Polar->Draw(MakeLines(this->Curves[Plane]), state.LobeThetaI, state.SliceLogarithmic,
      this->devicePixelRatioF());
  }
  this->PlaceCharts();
  this->RequestRender();
  emit this->updated();
}

//------------------------------------------------------------------------------
void SliceView::Draw(int chart)
{
  const State& state = this->Model->GetState();
  const bool logarithmic = state.SliceLogarithmic && chart != Albedo;
  const double ratio = this->devicePixelRatioF();
  const std::vector<ChartLine> lines = MakeLines(this->Curves[static_cast<std::size_t>(chart)]);
  const std::vector<ChartLine> dashed =
    chart == Albedo ? MakeLines(this->Transmitted) : std::vector<ChartLine>();
  std::vector<ChartLine> all = lines;
  all.insert(all.end(), dashed.begin(), dashed.end());
  const ChartScale scale(all, logarithmic);
  vtkChartXY* drawn = this->Charts[static_cast<std::size_t>(chart)];
  drawn->ClearPlots();
  if (chart == Plane)
  {
    AddLine(drawn, { -state.LobeThetaI, -state.LobeThetaI },
      { scale.GetLeast(), scale.GetLargest() }, PolarChart::LightColor, 3.0 * ratio);
    AddLine(drawn, { state.LobeThetaI, state.LobeThetaI }, { scale.GetLeast(), scale.GetLargest() },
      PolarChart::LightColor, ratio, true);
  }
  AddLines(drawn, lines, scale, 2.0 * ratio, false);
  AddLines(drawn, dashed, scale, 2.0 * ratio, true);
  const bool allAround = chart == Plane && this->IsAllAround();
  const bool transmits = std::any_of(
    dashed.begin(), dashed.end(), [](const ChartLine& line) { return !line.Values.empty(); });
  drawn->SetTitle(allAround ? CircleTitle : transmits ? AlbedoTitle : Titles[chart]);
  drawn->GetTitleProperties()->SetFontSize(FontSize + 1);
  for (const int which : { vtkAxis::LEFT, vtkAxis::BOTTOM })
  {
    vtkAxis* axis = drawn->GetAxis(which);
    axis->GetLabelProperties()->SetFontSize(FontSize);
    axis->SetTitle("");
    axis->GetGridPen()->SetColor(225, 225, 225);
    axis->SetBehavior(vtkAxis::FIXED);
  }
  const auto [first, last] = GetRange(chart, allAround);
  std::vector<std::pair<double, std::string>> degrees;
  for (double at = first; at <= last; at += last > 90.0 ? 60.0 : 30.0)
  {
    degrees.emplace_back(at, std::to_string(static_cast<int>(at)));
  }
  drawn->GetAxis(vtkAxis::BOTTOM)->SetRange(first, last);
  SetTicks(drawn->GetAxis(vtkAxis::BOTTOM), degrees);
  drawn->GetAxis(vtkAxis::LEFT)->SetRange(scale.GetLeast(), scale.GetLargest());
  SetTicks(drawn->GetAxis(vtkAxis::LEFT), scale.GetTicks());
  drawn->RecalculateBounds();
}

//------------------------------------------------------------------------------
// Slices two by two, the first in the upper left. Or the polar chart above the same over an axis.
void SliceView::PlaceCharts()
{
  const double ratio = this->devicePixelRatioF();
  const double gap = 4.0 * ratio;
  const double width = ratio * this->width();
  const double height = ratio * this->height();
  const auto place = [&](int chart, double left, double bottom, double w, double h)
  {
    this->Charts[static_cast<std::size_t>(chart)]->SetSize(
      vtkRectf(static_cast<float>(left + gap), static_cast<float>(bottom + gap),
        static_cast<float>(w - 2.0 * gap), static_cast<float>(h - 2.0 * gap)));
  };
  for (int k = 0; k < 4; ++k)
  {
    place(k, k % 2 == 0 ? 0.0 : 0.5 * width, k < 2 ? 0.5 * height : 0.0, 0.5 * width, 0.5 * height);
  }
  const double texts = this->Polar->GetHeight(0.0, ratio);
  const double share = this->Polar->IsAllAround() ? 0.7 : 1.2;
  const double polar = std::min(width - 2.0 * gap, std::max(gap, share * height - 2.0 * texts));
  const double rest = height - this->Polar->GetHeight(polar, ratio);
  this->Polar->Place(0.5 * (width - polar), rest, polar, ratio);
  place(Plane, 0.0, 0.0, width, rest);
}

//------------------------------------------------------------------------------
void SliceView::resizeEvent(QResizeEvent* event)
{
  this->PlaceCharts(); // first: the superclass draws at once
  QVTKOpenGLNativeWidget::resizeEvent(event);
}

//------------------------------------------------------------------------------
void SliceView::RequestRender()
{
  if (this->IsRequested)
  {
    return;
  }
  this->IsRequested = true;
  QTimer::singleShot(0, this,
    [this]()
    {
      this->IsRequested = false;
      if (this->isVisible())
      {
        this->Window->Render();
      }
    });
}

//------------------------------------------------------------------------------
// Nothing of VTK's: its keys would close the program.
bool SliceView::event(QEvent* event)
{
  switch (event->type())
  {
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::MouseButtonPress:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease:
    case QEvent::Wheel:
      return QOpenGLWidget::event(event);
    default:
      return QVTKOpenGLNativeWidget::event(event);
  }
}
} // namespace explorer
