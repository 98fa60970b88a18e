// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SlicePanel.h"

#include "Controls.h"
#include "Display.h"
#include "LogAxis.h"

#include "vtkBRDFImageSource.h"
#include "vtkBRDFSliceSource.h"
#include "vtkEnvironment.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <QPainter>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace explorer
{
namespace
{
constexpr int SliceSamples = 361;
constexpr int PlaneSamples = 720;   // even ones, of which none is on the horizon
constexpr int MirrorSamples = 128;  // on each side of the mirror direction
constexpr double MirrorWidth = 4.0; // degrees on each side

//------------------------------------------------------------------------------
// All around: the upper half's, mirrored at the surface.
std::vector<double> MakePlaneAngles(double thetaI, bool allAround)
{
  std::vector<double> angles = { thetaI };
  const double step = 180.0 / PlaneSamples;
  for (int k = 0; k < PlaneSamples; ++k)
  {
    angles.push_back(-90.0 + (k + 0.5) * step);
  }
  for (int k = 1; k <= MirrorSamples; ++k)
  {
    const double share = static_cast<double>(k) / MirrorSamples;
    angles.push_back(thetaI - MirrorWidth * share * share);
    angles.push_back(std::min(thetaI + MirrorWidth * share * share, 90.0 - 0.5 * step));
  }
  for (std::size_t k = 0, above = angles.size(); k < above && allAround; ++k)
  {
    angles.push_back(angles[k] > 0.0 ? 180.0 - angles[k] : -180.0 - angles[k]);
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  return angles;
}
}

//------------------------------------------------------------------------------
Curve SampleSlice(vtkBRDF* brdf, int which, const std::array<double, 3>& at)
{
  vtkNew<vtkBRDFSliceSource> source;
  source->SetBRDF(brdf);
  source->SetThetaHRange(which == 0 ? 0.0 : at[0], which == 0 ? 90.0 : at[0]);
  source->SetThetaDRange(which == 1 ? 0.0 : at[1], which == 1 ? 90.0 : at[1]);
  source->SetPhiDRange(which == 2 ? 0.0 : at[2], which == 2 ? 180.0 : at[2]);
  source->SetNumberOfThetaH(which == 0 ? SliceSamples : 1);
  source->SetNumberOfThetaD(which == 1 ? SliceSamples : 1);
  source->SetNumberOfPhiD(which == 2 ? SliceSamples : 1);
  source->SetUseThetaHSquared(true);
  source->Update();

  vtkTable* table = source->GetOutput();
  const char* const names[3] = { "theta_h", "theta_d", "phi_d" };
  Curve curve;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto get = [&](const char* name) { return table->GetValueByName(row, name).ToDouble(); };
    if (get("vtkValidPointMask") != 0.0)
    {
      curve.Degrees.push_back(get(names[which]));
      curve.Values.push_back({ get("red"), get("green"), get("blue") });
    }
  }
  return curve;
}

//------------------------------------------------------------------------------
Curve SamplePlaneOfIncidence(vtkBRDF* brdf, double thetaI, double phiI, vtkBTDF* transmission)
{
  const double phi = glm::radians(phiI);
  const auto point = [phi](double degrees) // from the normal, to where the light comes from
  {
    const double s = std::sin(glm::radians(degrees));
    return glm::dvec3(s * std::cos(phi), s * std::sin(phi), std::cos(glm::radians(degrees)));
  };
  const glm::dvec3 i = point(thetaI);
  Curve curve;
  curve.Degrees = MakePlaneAngles(thetaI, transmission != nullptr);
  for (const double degrees : curve.Degrees)
  {
    const glm::dvec3 o = point(-degrees);
    std::array<double, 3> f{};
    std::abs(degrees) < 90.0 ? brdf->Evaluate(&i.x, &o.x, f.data())
                             : transmission->Evaluate(&i.x, &o.x, f.data());
    curve.Values.push_back(f);
  }
  return curve;
}

namespace
{
//------------------------------------------------------------------------------
Curve TakeCurve(const nlohmann::ordered_json& rows, const char* key)
{
  Curve curve;
  for (const auto& row : rows)
  {
    curve.Degrees.push_back(row["degrees"]);
    curve.Values.push_back(row[key]);
  }
  return curve;
}
}

//------------------------------------------------------------------------------
Curve GetAlbedo(const nlohmann::ordered_json& info)
{
  return info.is_null() ? Curve() : TakeCurve(info["albedo"], "rgb");
}

//------------------------------------------------------------------------------
Curve GetTransmittance(const nlohmann::ordered_json& info)
{
  return info.contains("transmission") ? TakeCurve(info["transmission"]["per_angle"], "view")
                                       : Curve();
}

namespace
{
const QColor Channels[3] = { { 214, 64, 54 }, { 46, 140, 62 }, { 52, 98, 204 } };
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

//------------------------------------------------------------------------------
QColor GetMaterialColor(std::size_t k)
{
  static const QColor colors[] = { { 30, 30, 30 }, { 31, 119, 180 }, { 230, 110, 10 },
    { 44, 150, 44 }, { 214, 39, 40 }, { 148, 103, 189 }, { 140, 86, 75 }, { 227, 90, 180 },
    { 0, 170, 190 } };
  return colors[k % std::size(colors)];
}

//------------------------------------------------------------------------------
std::vector<ChartLine> MakeLines(const std::vector<Curve>& curves)
{
  const bool isOne = curves.size() == 1;
  std::vector<ChartLine> lines;
  for (std::size_t k = 0; k < (isOne ? 3 : curves.size()); ++k)
  {
    const Curve& curve = curves[isOne ? 0 : k];
    ChartLine line{ isOne ? Channels[k] : GetMaterialColor(k), curve.Degrees, {} };
    for (const auto& rgb : curve.Values)
    {
      line.Values.push_back(isOne ? rgb[k] : vtkEnvironment::GetLuminance(rgb.data()));
    }
    lines.push_back(line);
  }
  return lines;
}

//------------------------------------------------------------------------------
ChartScale::ChartScale(const std::vector<ChartLine>& lines, bool logarithmic)
  : Logarithmic(logarithmic)
{
  std::vector<double> values;
  for (const ChartLine& line : lines)
  {
    values.insert(values.end(), line.Values.begin(), line.Values.end());
  }
  const double peak = values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
  this->Floor = std::max(Darkest * peak, std::numeric_limits<double>::min());
  const auto add = [this](double value)
  { this->Ticks.emplace_back(this->Find(value), tool::FormatTick(value, tool::Unit::Number)); };
  if (!logarithmic)
  {
    this->Largest = peak > 0.0 ? 1.05 * peak : 1.0;
    const double step = FindStep(this->Largest);
    for (int k = 0; k * step <= this->Largest; ++k)
    {
      add(k * step);
    }
    return;
  }
  for (double& value : values)
  {
    value = peak > 0.0 ? std::max(value, this->Floor) : 0.0;
  }
  const tool::LogAxis axis(values);
  this->Least = axis.GetLeast();
  this->Largest = axis.GetLargest();
  for (const double exponent : axis.GetTicks())
  {
    add(std::pow(10.0, exponent));
  }
}

//------------------------------------------------------------------------------
double ChartScale::Find(double value) const
{
  const double place =
    this->Logarithmic ? std::max(std::log10(std::max(value, this->Floor)), this->Least) : value;
  return (place - this->Least) / (this->Largest - this->Least);
}

namespace
{
const QColor LightColor(240, 170, 0);
const QColor GridColor(215, 215, 215);

//------------------------------------------------------------------------------
QPen MakePen(const QColor& color, double width, bool dashed = false)
{
  return { color, width, dashed ? Qt::DashLine : Qt::SolidLine };
}

//------------------------------------------------------------------------------
void DrawCentered(QPainter& painter, const QPointF& middle, const QString& text)
{
  constexpr double space = 400.0; // more than any text takes
  painter.drawText(QRectF(middle.x() - space, middle.y() - space, 2.0 * space, 2.0 * space),
    Qt::AlignCenter, text);
}

}

//------------------------------------------------------------------------------
SliceView::SliceView(Session* session)
  : Model(session)
{
  this->setMinimumSize(260, 260);
  this->setAccessibleName(tr("Slices and albedo"));
  for (const auto signal : { &Session::materialChanged, &Session::inspected,
         &Session::slicesChanged, &Session::lobeChanged, &Session::comparedChanged })
  {
    connect(session, signal, this, &SliceView::Update);
  }
}

//------------------------------------------------------------------------------
Curve SliceView::Sample(int chart, const ShownMaterial& material) const
{
  const State& state = this->Model->GetState();
  const tool::Material& sampled = material.Material;
  return chart == Albedo  ? GetAlbedo(material.Info)
         : chart == Plane ? SamplePlaneOfIncidence(
                              sampled.BRDF, state.LobeThetaI, state.LobePhiI, sampled.Transmission)
                          : SampleSlice(sampled.BRDF, chart,
                              { state.SliceThetaH, state.SliceThetaD, state.SlicePhiD });
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
  this->Curves = {};
  this->Transmitted.clear();
  for (const ShownMaterial& material : this->Model->GetChartedMaterials())
  {
    this->Transmitted.push_back(GetTransmittance(material.Info));
    for (int chart = 0; chart < NumberOfCharts; ++chart)
    {
      if ((chart == Plane) == this->Model->GetState().SlicePolar)
      {
        this->Curves[chart].push_back(this->Sample(chart, material));
      }
    }
  }
  this->update();
}

//------------------------------------------------------------------------------
// Values over an axis of angles. Or a polar chart, where the distance from the origin is the value:
// upwards is the normal, the mirror's side is right, below the surface is what is transmitted.
void SliceView::DrawChart(QPainter& painter, int chart, bool polar, const QRectF& area) const
{
  const State& state = this->Model->GetState();
  const std::vector<ChartLine> lines = MakeLines(this->Curves[chart]);
  const std::vector<ChartLine> dashed =
    chart == Albedo ? MakeLines(this->Transmitted) : std::vector<ChartLine>();
  std::vector<ChartLine> all = lines;
  all.insert(all.end(), dashed.begin(), dashed.end());
  const ChartScale scale(all, state.SliceLogarithmic && chart != Albedo);
  const bool allAround = chart == Plane && this->IsAllAround();
  const double last = allAround || chart == PhiD ? 180.0 : 90.0;
  const double first = chart == Plane ? -last : 0.0;
  const double line = painter.fontMetrics().height();
  const double left = painter.fontMetrics().horizontalAdvance("0.0001") + 10.0;
  const QRectF frame = area.adjusted(left, 1.5 * line, -line, -1.3 * line - 4.0);
  const double radius = std::min(0.5 * area.width() - 2.0 * line,
    (area.height() - (allAround ? 4.5 : 4.0) * line) / (allAround ? 2.0 : 1.0));
  const QPointF center(area.center().x(), area.top() + 2.7 * line + radius);
  const auto place = [&](double degrees, double share) // of the axis of values
  {
    const double angle = glm::radians(degrees);
    return polar ? center + share * radius * QPointF(std::sin(angle), -std::cos(angle))
                 : QPointF(frame.left() + (degrees - first) / (last - first) * frame.width(),
                     frame.bottom() - share * frame.height());
  };
  const auto drawAngle = [&](double degrees, const QPen& pen)
  {
    painter.setPen(pen);
    painter.drawLine(place(degrees, 0.0), place(degrees, 1.0));
  };
  const auto drawValue = [&](double share)
  {
    QPolygonF points;
    for (double degrees = first; degrees <= last; degrees += 1.0)
    {
      points << place(degrees, share);
    }
    painter.setPen(GridColor);
    painter.drawPolyline(points);
  };
  const auto drawLines = [&](const std::vector<ChartLine>& shown, bool isDashed)
  {
    for (const ChartLine& one : shown)
    {
      QPolygonF points;
      for (std::size_t k = 0; k < one.Values.size(); ++k)
      {
        points << place(one.Degrees[k], std::max(0.0, scale.Find(one.Values[k])));
      }
      painter.setPen(MakePen(one.Color, 2.0, isDashed));
      painter.drawPolyline(points);
    }
  };

  for (double at = first; at <= last; at += polar || last <= 90.0 ? 30.0 : 60.0)
  {
    if (polar && (at == first || std::abs(at) == 90.0))
    {
      continue; // the texts of values are there
    }
    drawAngle(at, GridColor);
    painter.setPen(Qt::darkGray);
    DrawCentered(painter,
      polar ? place(at, 1.0 + 0.8 * line / radius) : place(at, 0.0) + QPointF(0.0, 0.8 * line),
      QString::number(at));
  }
  drawValue(1.0);
  const std::size_t count = scale.Ticks.size();
  const std::size_t step = polar ? 1 + count / (allAround ? 4 : 5) : 1; // as fit beside each other
  for (std::size_t k = 0; k < count; k += step)
  {
    const auto& [share, text] = scale.Ticks[count - 1 - k];
    drawValue(share);
    painter.setPen(Qt::darkGray);
    DrawCentered(painter,
      polar ? place(90.0, share) + QPointF(0.0, 0.6 * line)
            : place(first, share) - QPointF(0.5 * left, 0.0),
      QString::fromStdString(text));
  }
  painter.setPen(MakePen(Qt::darkGray, polar && allAround ? 2.0 : 1.0)); // the surface
  polar ? painter.drawLine(place(-90.0, 1.0), place(90.0, 1.0)) : painter.drawRect(frame);
  if (chart == Plane)
  {
    drawAngle(-state.LobeThetaI, MakePen(LightColor, 3.0));
    drawAngle(state.LobeThetaI, MakePen(LightColor, 1.0, true)); // the mirror direction
    if (allAround)
    {
      drawAngle(180.0 - state.LobeThetaI, MakePen(LightColor, 1.0, true)); // straight on
    }
  }
  drawLines(lines, false);
  drawLines(dashed, true);
  const bool transmits = std::any_of(
    dashed.begin(), dashed.end(), [](const ChartLine& one) { return !one.Values.empty(); });
  const char* const titles[] = { "f (1/sr) over θh", "f (1/sr) over θd", "f (1/sr) over φd",
    "albedo over θo", "f (1/sr) over θo, negative towards the light" };
  painter.setPen(Qt::black);
  DrawCentered(painter, { area.center().x(), area.top() + 0.8 * line },
    polar       ? "f (1/sr) in the plane of incidence"
    : allAround ? "the same over θo; beyond 90: transmitted"
    : transmits ? "albedo; dashed: transmitted"
                : titles[chart]);
}

//------------------------------------------------------------------------------
// Slices two by two; or the polar chart above the same over an axis.
void SliceView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.fillRect(this->rect(), QColor(247, 247, 247));
  painter.setRenderHint(QPainter::Antialiasing);
  const double w = this->width();
  const double h = this->height();
  if (this->Model->GetState().SlicePolar)
  {
    const double polar = (this->IsAllAround() ? 0.6 : 0.45) * h;
    this->DrawChart(painter, Plane, true, QRectF(0.0, 0.0, w, polar));
    this->DrawChart(painter, Plane, false, QRectF(0.0, polar, w, h - polar));
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    this->DrawChart(painter, k, false,
      QRectF(k % 2 == 0 ? 0.0 : 0.5 * w, k < 2 ? 0.0 : 0.5 * h, 0.5 * w, 0.5 * h));
  }
}

//------------------------------------------------------------------------------
QWidget* MakeSlicePanel(Session* session)
{
  auto* panel = new QWidget;
  auto* view = new SliceView(session);
  auto* legend = new QLabel;
  legend->setObjectName("slice legend");
  legend->setTextFormat(Qt::RichText);
  legend->setWordWrap(true);
  auto* row = new QHBoxLayout;
  const auto add = [&](const QString& name, double largest, auto value)
  {
    auto* field = MakeField(0.0, largest, 1, 5.0, "°",
      QObject::tr("The other two slices are cut at this angle (Rusinkiewicz 1998)"));
    AddNamed(row, name, Bind(field, session, &Session::slicesChanged, value));
  };
  add(QObject::tr("θ&h"), 90.0, &State::SliceThetaH);
  add(QObject::tr("θ&d"), 90.0, &State::SliceThetaD);
  add(QObject::tr("&φd"), 180.0, &State::SlicePhiD);
  row->addWidget(Bind(MakeBox(QObject::tr("Lo&g"), QObject::tr("Draw f on a logarithmic axis")),
    session, &Session::slicesChanged, &State::SliceLogarithmic));
  auto* polar = Bind(MakeBox(QObject::tr("&Polar"),
                       QObject::tr("f in the plane of incidence of the lobe's light, whose "
                                   "direction is yellow")),
    session, &Session::slicesChanged, &State::SlicePolar);
  polar->setObjectName("polar");
  row->addWidget(polar);
  row->addStretch(1);
  auto* layout = MakeColumn(panel);
  layout->addLayout(row);
  layout->addWidget(view, 1);
  layout->addWidget(legend);
  Follow(session, panel, { &Session::materialChanged, &Session::comparedChanged },
    [=]()
    {
      const std::vector<ShownMaterial> materials = session->GetChartedMaterials();
      QStringList lines;
      for (std::size_t k = 0; k < materials.size() && materials.size() > 1; ++k)
      {
        lines << QString("<span style='color:%1'>&#9632;</span>&nbsp;%2")
                   .arg(GetMaterialColor(k).name(),
                     QString::fromStdString(materials[k].Material.Name).toHtmlEscaped());
      }
      legend->setText(
        lines.isEmpty() ? QString() : QObject::tr("Luminance: ") + lines.join("&ensp; "));
      legend->setVisible(!lines.isEmpty());
    });
  return panel;
}

namespace
{
constexpr int ImageSize = 256; // pixels
constexpr int ShownSize = 384;

//------------------------------------------------------------------------------
// A perfectly white matte surface, f = 1/pi, is white.
QImage DrawSlice(vtkBRDF* brdf, double phiD, double stops, bool isSquared)
{
  vtkNew<vtkBRDFImageSource> source;
  source->SetBRDF(brdf);
  source->SetResolution(ImageSize);
  source->SetPhiD(phiD);
  source->SetUseThetaHSquared(isSquared);
  source->Update();
  const double factor = vtkMath::Pi() * std::exp2(stops);
  tool::Picture picture(ImageSize, ImageSize);
  for (int k = 0; k < 3 * ImageSize * ImageSize; ++k)
  {
    const int x = k / 3 % ImageSize;
    const int y = k / 3 / ImageSize;
    picture.At(x, y)[k % 3] = float(
      tool::RollOff(factor * source->GetOutput()->GetScalarComponentAsDouble(x, y, 0, k % 3)));
  }
  return MakeQImage(picture);
}

}

//------------------------------------------------------------------------------
QWidget* MakeImagePanel(Session* session, Jobs* jobs)
{
  auto* panel = new QWidget;
  auto* slice = new QLabel(QObject::tr("Being drawn …"));
  slice->setFixedSize(ShownSize, ShownSize);
  slice->setScaledContents(true);
  slice->setAccessibleName(QObject::tr("Image slice"));
  auto* axes = new QLabel;
  axes->setWordWrap(true);
  auto* phiD = MakeField(
    0.0, 180.0, 1, 15.0, "°", QObject::tr("Azimuth of the difference at which the image is cut"));
  phiD->setValue(90.0);
  auto* stops = MakeField(-10.0, 10.0, 1, 1.0, QObject::tr(" stops"),
    QObject::tr("Exposure; at 0 a perfectly white matte surface is white"));
  stops->setKeyboardTracking(true);
  auto* squared =
    MakeBox(QObject::tr("√θ&h"), QObject::tr("Stretch small theta_h, as MERL's files do"));
  auto* row = new QHBoxLayout;
  AddNamed(row, QObject::tr("&φd"), phiD);
  AddNamed(row, QObject::tr("E&xposure"), stops);
  row->addWidget(squared);
  row->addStretch(1);
  auto* layout = MakeColumn(panel);
  layout->addLayout(row);
  layout->addWidget(slice);
  layout->addWidget(axes);
  layout->addStretch(1);
  const auto draw = [=]()
  {
    if (!session->GetMaterial().BRDF)
    {
      return;
    }
    jobs->Compute(
      "image slice", QObject::tr("drawing the image slice"),
      [material = MakeSnapshot(session->GetMaterial()), angle = phiD->value(),
        exposure = stops->value(), isSquared = squared->isChecked()]()
      { return DrawSlice(material.BRDF, angle, exposure, isSquared); },
      [=](const QImage& drawn) { slice->setPixmap(QPixmap::fromImage(drawn)); });
    axes->setText(
      QObject::tr(
        "f (Burley 2012): upwards θd from 0° to 90°, to the right %1. The left edge "
        "is the highlight, the top its Fresnel reflection, the right edge grazing retroreflection.")
        .arg(squared->isChecked() ? QObject::tr("the root of θh, 30° at 0.58 and 60° at 0.82")
                                  : QObject::tr("θh from 0° to 90°")));
  };
  OnChange(phiD, draw);
  OnChange(stops, draw);
  OnChange(squared, draw);
  QObject::connect(session, &Session::materialChanged, panel, draw);
  return panel;
}
} // namespace explorer
