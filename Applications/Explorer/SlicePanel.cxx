// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SlicePanel.h"

#include "Controls.h"

#include "vtkAxis.h"
#include "vtkChartXY.h"
#include "vtkContext2D.h"
#include "vtkContextActor.h"
#include "vtkContextItem.h"
#include "vtkContextScene.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPen.h"
#include "vtkRect.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"

#include <QHBoxLayout>

#include <algorithm>
#include <cmath>
#include <string>

namespace explorer
{
namespace
{
constexpr double Reach = 1.14;      // of the chart; the largest circle has radius 1
constexpr double TextHeight = 26.0; // pixels of the screen
constexpr int PolarFontSize = 12;
constexpr Color PolarGrid = { 215, 215, 215 };
constexpr Color Surface = { 150, 150, 150 };

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
  AddLine(chart, x, y, PolarGrid, ratio);
}

//------------------------------------------------------------------------------
// From the origin, at an angle from the normal.
void AddRay(vtkChartXY* chart, double degrees, const Color& color, double width, bool dashed)
{
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  AddLine(chart, { 0.0, std::sin(angle) }, { 0.0, std::cos(angle) }, color, width, dashed);
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
  if (chart == SliceView::Plane)
  {
    return allAround ? std::pair(-180.0, 180.0) : std::pair(-90.0, 90.0);
  }
  return { 0.0, chart == SliceView::PhiD ? 180.0 : 90.0 };
}

//------------------------------------------------------------------------------
void AddLines(vtkChartXY* chart, const std::vector<ChartLine>& lines, const ChartScale& scale,
  double width, bool dashed)
{
  for (const ChartLine& line : lines)
  {
    std::vector<double> y;
    for (const double value : line.Values)
    {
      y.push_back(scale.Find(value));
    }
    AddLine(chart, line.Degrees, y, line.Rgb, width, dashed);
  }
}
}

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

/**
 * Upwards is the normal, the mirror's side is right; below the surface is what is transmitted,
 * where the chart goes all around. The distance from the origin is the value:
 * from 0, or from the least value where it is logarithmic. Circles have constant values.
 */
class PolarChart
{
public:
  static constexpr Color LightColor = { 240, 170, 0 };

  explicit PolarChart(vtkContextScene* scene);
  ~PolarChart();

  /// Lines over the angle from the normal, negative on the light's side. thetaI: of the light, in
  /// degrees; ratio: of the screen's pixels.
  void Draw(const std::vector<ChartLine>& lines, double thetaI, bool logarithmic, double ratio);

  /// Whether it has directions below the surface, too; default: no.
  void SetAllAround(bool allAround) { this->AllAround = allAround; }
  bool IsAllAround() const { return this->AllAround; }

  /// Into a rectangle of the scene, in pixels; it takes half its width in height, or all of it
  /// where it goes all around, and two lines of text.
  void Place(double left, double bottom, double width, double ratio);
  double GetHeight(double width, double ratio) const;

  void SetVisible(bool visible);

private:
  vtkNew<vtkChartXY> Chart;
  vtkNew<PolarLabels> Labels;
  bool AllAround = false;
};

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

//------------------------------------------------------------------------------
SliceView::SliceView(Session* session, Comparison* comparison, QWidget* parent)
  : RenderView(tr("Slices and albedo"), parent)
  , Model(session)
  , Compared(comparison)
{
  this->setMinimumSize(260, 260);
  this->IsInteractive = false;
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
QWidget* MakeSlicePanel(Session* session, Comparison* comparison)
{
  auto* panel = new QWidget;
  auto* view = new SliceView(session, comparison);
  auto* logarithmic = MakeBox(QObject::tr("Lo&g"), QObject::tr("Draw f on a logarithmic axis"));
  auto* polar = MakeBox(QObject::tr("&Polar"),
    QObject::tr("f in the plane of incidence of the lobe's light, whose direction is yellow"));
  polar->setObjectName("polar");
  auto* legend = new QLabel;
  legend->setObjectName("slice legend");
  legend->setTextFormat(Qt::RichText);
  legend->setWordWrap(true);
  std::array<QDoubleSpinBox*, 3> angles;
  auto* row = new QHBoxLayout;
  const QString names[3] = { QObject::tr("θ&h"), QObject::tr("θ&d"), QObject::tr("&φd") };
  for (std::size_t k = 0; k < 3; ++k)
  {
    angles[k] = MakeField(0.0, k < 2 ? 90.0 : 180.0, 1, 5.0, "°",
      QObject::tr("The other two slices are cut at this angle (Rusinkiewicz 1998)"));
    AddNamed(row, names[k], angles[k]);
  }
  row->addWidget(logarithmic);
  row->addWidget(polar);
  row->addStretch(1);
  auto* layout = MakeColumn(panel);
  layout->addLayout(row);
  layout->addWidget(view, 1);
  layout->addWidget(legend);

  const auto set = [=]()
  {
    session->SetSlices(
      angles[0]->value(), angles[1]->value(), angles[2]->value(), logarithmic->isChecked());
  };
  for (QDoubleSpinBox* angle : angles)
  {
    OnChange(angle, set);
  }
  OnChange(logarithmic, set);
  OnChange(polar, [=](bool on) { session->SetSlicePolar(on); });
  const auto update = [=]()
  {
    const State& state = session->GetState();
    Show(angles[0], state.SliceThetaH);
    Show(angles[1], state.SliceThetaD);
    Show(angles[2], state.SlicePhiD);
    Show(logarithmic, state.SliceLogarithmic);
    Show(polar, state.SlicePolar);
  };
  QObject::connect(session, &Session::slicesChanged, panel, update);
  update();
  QObject::connect(view, &SliceView::updated, panel,
    [=]()
    {
      const std::vector<ComparedMaterial> materials = view->GetMaterials();
      QStringList lines;
      for (std::size_t k = 0; k < materials.size() && materials.size() > 1; ++k)
      {
        const Color color = GetMaterialColor(k);
        lines << QString("<span style='color:%1'>&#9632;</span>&nbsp;%2")
                   .arg(QColor(color[0], color[1], color[2]).name(),
                     QString::fromStdString(materials[k].Name).toHtmlEscaped());
      }
      legend->setText(
        lines.isEmpty() ? QString() : QObject::tr("Luminance: ") + lines.join("&ensp; "));
      legend->setVisible(!lines.isEmpty());
    });
  return panel;
}
} // namespace explorer
