// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SlicePanel.h"

#include "Controls.h"
#include "Display.h"

#include "vtkBRDFImageSource.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <string>

namespace explorer
{
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

//------------------------------------------------------------------------------
// A frame with ticks and their texts below it and left of it.
void DrawAxes(
  QPainter& painter, const QRectF& frame, const ChartTicks& across, const ChartTicks& upwards)
{
  const double line = painter.fontMetrics().height();
  for (const auto& [share, text] : across)
  {
    const QPointF at(frame.left() + share * frame.width(), frame.bottom());
    painter.drawLine(at, at + QPointF(0.0, 4.0));
    DrawCentered(painter, at + QPointF(0.0, 4.0 + 0.5 * line), QString::fromStdString(text));
  }
  for (const auto& [share, text] : upwards)
  {
    const QPointF at(frame.left(), frame.bottom() - share * frame.height());
    painter.drawLine(at, at - QPointF(4.0, 0.0));
    painter.drawText(QRectF(0.0, at.y() - line, at.x() - 6.0, 2.0 * line),
      Qt::AlignRight | Qt::AlignVCenter, QString::fromStdString(text));
  }
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(frame);
}

//------------------------------------------------------------------------------
// Lines through the places that a function finds of their angles and values.
template <typename Function>
void DrawLines(QPainter& painter, const std::vector<ChartLine>& lines, bool dashed, Function place)
{
  for (const ChartLine& line : lines)
  {
    QPolygonF points;
    for (std::size_t k = 0; k < line.Values.size(); ++k)
    {
      points << place(line.Degrees[k], line.Values[k]);
    }
    painter.setPen(MakePen(line.Color, 2.0, dashed));
    painter.drawPolyline(points);
  }
}
}

//------------------------------------------------------------------------------
SliceView::SliceView(Session* session)
  : Model(session)
{
  this->setMinimumSize(260, 260);
  this->setAccessibleName(tr("Slices and albedo"));
  connect(session, &Session::materialChanged, this,
    [this]()
    {
      this->Albedos = this->Transmittances = Curve();
      this->Update();
    });
  for (const auto signal :
    { &Session::slicesChanged, &Session::lobeChanged, &Session::comparedChanged })
  {
    connect(session, signal, this, &SliceView::Update);
  }
}

//------------------------------------------------------------------------------
void SliceView::SetInspection(const nlohmann::ordered_json& info)
{
  const auto take = [](const nlohmann::ordered_json& rows, const char* key)
  {
    Curve curve;
    for (const auto& row : rows)
    {
      curve.Degrees.push_back(row["degrees"]);
      curve.Values.push_back(row[key]);
    }
    return curve;
  };
  this->Albedos = take(info["albedo"], "rgb");
  this->Transmittances =
    info.contains("transmission") ? take(info["transmission"]["per_angle"], "view") : Curve();
  this->Update();
}

//------------------------------------------------------------------------------
std::vector<ChartedMaterial> SliceView::GetMaterials() const
{
  const tool::Material& shown = this->Model->GetMaterial();
  std::vector<ChartedMaterial> materials = { { shown.File, shown.Name, shown.BRDF, this->Albedos,
    {}, shown.Transmission, this->Transmittances } };
  for (const ChartedMaterial& material : this->Model->GetComparedMaterials())
  {
    if (material.File != shown.File)
    {
      materials.push_back(material);
    }
  }
  return materials;
}

//------------------------------------------------------------------------------
Curve SliceView::Sample(int chart, const ChartedMaterial& material) const
{
  const State& state = this->Model->GetState();
  return chart == Albedo  ? material.Albedo
         : chart == Plane ? SamplePlaneOfIncidence(material.BRDF, state.LobeThetaI, state.LobePhiI,
                              material.Transmission)
                          : SampleSlice(material.BRDF, chart,
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
  for (const ChartedMaterial& material : this->GetMaterials())
  {
    this->Transmitted.push_back(material.Transmittance);
    for (int chart = 0; chart < NumberOfCharts; ++chart)
    {
      if ((chart == Plane) == this->Model->GetState().SlicePolar)
      {
        this->Curves[static_cast<std::size_t>(chart)].push_back(this->Sample(chart, material));
      }
    }
  }
  this->update();
  Q_EMIT this->updated();
}

//------------------------------------------------------------------------------
void SliceView::DrawChart(QPainter& painter, int chart, const QRectF& area) const
{
  const char* const titles[] = { "f (1/sr) over θh", "f (1/sr) over θd", "f (1/sr) over φd",
    "albedo over θo", "f (1/sr) over θo, negative towards the light" };
  const State& state = this->Model->GetState();
  const std::vector<ChartLine> lines = MakeLines(this->Curves[static_cast<std::size_t>(chart)]);
  const std::vector<ChartLine> dashed =
    chart == Albedo ? MakeLines(this->Transmitted) : std::vector<ChartLine>();
  std::vector<ChartLine> all = lines;
  all.insert(all.end(), dashed.begin(), dashed.end());
  const ChartScale scale(all, state.SliceLogarithmic && chart != Albedo);
  const bool allAround = chart == Plane && this->IsAllAround();
  const bool transmits = std::any_of(
    dashed.begin(), dashed.end(), [](const ChartLine& line) { return !line.Values.empty(); });
  const double last = allAround || chart == PhiD ? 180.0 : 90.0;
  const double first = chart == Plane ? -last : 0.0;
  const double line = painter.fontMetrics().height();
  const double left = painter.fontMetrics().horizontalAdvance("0.0001") + 10.0;
  const QRectF frame =
    area.adjusted(left, 1.5 * line, -line, -1.3 * line - 4.0); // beside the texts of its axes
  const auto place = [&](double degrees, double value)
  {
    return QPointF(frame.left() + (degrees - first) / (last - first) * frame.width(),
      frame.bottom() - scale.Find(value) * frame.height());
  };
  ChartTicks across;
  for (double at = first; at <= last; at += last > 90.0 ? 60.0 : 30.0)
  {
    across.emplace_back((at - first) / (last - first), std::to_string(static_cast<int>(at)));
  }
  painter.setPen(GridColor);
  for (const auto& [share, text] : across)
  {
    const double x = frame.left() + share * frame.width();
    painter.drawLine(QPointF(x, frame.top()), QPointF(x, frame.bottom()));
  }
  for (const auto& [share, text] : scale.GetTicks())
  {
    const double y = frame.bottom() - share * frame.height();
    painter.drawLine(QPointF(frame.left(), y), QPointF(frame.right(), y));
  }
  painter.save();
  painter.setClipRect(frame);
  if (chart == Plane) // the light and its mirror direction
  {
    for (const double sign : { -1.0, 1.0 })
    {
      const double x = place(sign * state.LobeThetaI, 0.0).x();
      painter.setPen(MakePen(LightColor, sign < 0.0 ? 3.0 : 1.0, sign > 0.0));
      painter.drawLine(QPointF(x, frame.top()), QPointF(x, frame.bottom()));
    }
  }
  DrawLines(painter, lines, false, place);
  DrawLines(painter, dashed, true, place);
  painter.restore();
  painter.setPen(Qt::black);
  DrawAxes(painter, frame, across, scale.GetTicks());
  DrawCentered(painter, { frame.center().x(), area.top() + 0.8 * line },
    allAround   ? "the same over θo; beyond 90: transmitted"
    : transmits ? "albedo; dashed: transmitted"
                : titles[chart]);
}

//------------------------------------------------------------------------------
// Upwards is the normal, the mirror's side is right; below the surface is what is transmitted. The
// distance from the origin is the value, and circles have constant values.
void SliceView::DrawPolar(QPainter& painter, const QRectF& area) const
{
  const State& state = this->Model->GetState();
  const std::vector<ChartLine> lines = MakeLines(this->Curves[Plane]);
  const ChartScale scale(lines, state.SliceLogarithmic);
  const bool allAround = this->IsAllAround();
  const double line = painter.fontMetrics().height();
  const double radius = std::min(0.5 * area.width() - 2.0 * line,
    (area.height() - (allAround ? 4.5 : 4.0) * line) / (allAround ? 2.0 : 1.0));
  const QPointF center(area.center().x(), area.top() + 2.7 * line + radius);
  const auto place = [&](double share, double degrees)
  {
    const double angle = vtkMath::RadiansFromDegrees(degrees);
    return center + share * radius * QPointF(std::sin(angle), -std::cos(angle));
  };
  const auto drawCircle = [&](double share)
  {
    const double r = share * radius;
    painter.drawArc(
      QRectF(center.x() - r, center.y() - r, 2.0 * r, 2.0 * r), 0, 16 * (allAround ? 360 : 180));
  };
  const auto drawRay = [&](double degrees, const QPen& pen)
  {
    painter.setPen(pen);
    painter.drawLine(center, place(1.0, degrees));
  };
  for (int degrees = -150; degrees <= 180; degrees += 30)
  {
    if (std::abs(degrees) < 90 || (allAround && std::abs(degrees) > 90))
    {
      drawRay(degrees, MakePen(GridColor, 1.0));
      painter.setPen(Qt::darkGray);
      DrawCentered(painter, place(1.0 + 0.8 * line / radius, degrees), QString::number(degrees));
    }
  }
  painter.setPen(GridColor);
  drawCircle(1.0);
  const std::size_t step =
    1 + scale.GetTicks().size() / (allAround ? 4 : 5); // as fit beside each other
  for (std::size_t k = 0; k < scale.GetTicks().size(); k += step)
  {
    const auto& [share, text] = scale.GetTicks()[scale.GetTicks().size() - 1 - k];
    painter.setPen(GridColor);
    drawCircle(share);
    painter.setPen(Qt::darkGray);
    DrawCentered(
      painter, place(share, 90.0) + QPointF(0.0, 0.6 * line), QString::fromStdString(text));
  }
  painter.setPen(MakePen(Qt::darkGray, allAround ? 2.0 : 1.0)); // the surface
  painter.drawLine(place(1.0, -90.0), place(1.0, 90.0));
  drawRay(-state.LobeThetaI, MakePen(LightColor, 3.0));
  drawRay(state.LobeThetaI, MakePen(LightColor, 1.0, true)); // the mirror direction
  if (allAround)
  {
    drawRay(180.0 - state.LobeThetaI, MakePen(LightColor, 1.0, true)); // straight on
  }
  DrawLines(painter, lines, false,
    [&](double degrees, double value) { return place(scale.Find(value), degrees); });
  painter.setPen(Qt::black);
  DrawCentered(
    painter, { center.x(), area.top() + 0.8 * line }, tr("f (1/sr) in the plane of incidence"));
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
    this->DrawPolar(painter, QRectF(0.0, 0.0, w, polar));
    this->DrawChart(painter, Plane, QRectF(0.0, polar, w, h - polar));
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    this->DrawChart(
      painter, k, QRectF(k % 2 == 0 ? 0.0 : 0.5 * w, k < 2 ? 0.0 : 0.5 * h, 0.5 * w, 0.5 * h));
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
  add(
    QObject::tr("θ&h"), 90.0, [](auto& state) -> auto& { return state.SliceThetaH; });
  add(
    QObject::tr("θ&d"), 90.0, [](auto& state) -> auto& { return state.SliceThetaD; });
  add(
    QObject::tr("&φd"), 180.0, [](auto& state) -> auto& { return state.SlicePhiD; });
  row->addWidget(Bind(
    MakeBox(QObject::tr("Lo&g"), QObject::tr("Draw f on a logarithmic axis")), session,
    &Session::slicesChanged, [](auto& state) -> auto& { return state.SliceLogarithmic; }));
  auto* polar = Bind(
    MakeBox(
      QObject::tr("&Polar"), QObject::tr("f in the plane of incidence of the lobe's light, whose "
                                         "direction is yellow")),
    session, &Session::slicesChanged, [](auto& state) -> auto& { return state.SlicePolar; });
  polar->setObjectName("polar");
  row->addWidget(polar);
  row->addStretch(1);
  auto* layout = MakeColumn(panel);
  layout->addLayout(row);
  layout->addWidget(view, 1);
  layout->addWidget(legend);
  QObject::connect(view, &SliceView::updated, panel,
    [=]()
    {
      const std::vector<ChartedMaterial> materials = view->GetMaterials();
      QStringList lines;
      for (std::size_t k = 0; k < materials.size() && materials.size() > 1; ++k)
      {
        lines << QString("<span style='color:%1'>&#9632;</span>&nbsp;%2")
                   .arg(GetMaterialColor(k).name(),
                     QString::fromStdString(materials[k].Name).toHtmlEscaped());
      }
      legend->setText(
        lines.isEmpty() ? QString() : QObject::tr("Luminance: ") + lines.join("&ensp; "));
      legend->setVisible(!lines.isEmpty());
    });
  return panel;
}

namespace
{
constexpr int ImageSize = 256;

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
  vtkImageData* slice = source->GetOutput();
  const double factor = vtkMath::Pi() * std::exp2(stops);
  tool::Picture picture(ImageSize, ImageSize);
  for (int k = 0; k < 3 * ImageSize * ImageSize; ++k)
  {
    const int x = k / 3 % ImageSize;
    const int y = k / 3 / ImageSize;
    picture.At(x, y)[k % 3] =
      static_cast<float>(tool::RollOff(factor * slice->GetScalarComponentAsDouble(x, y, 0, k % 3)));
  }
  return MakeQImage(picture);
}

/// The picture with its axes.
class ImageSlice : public QWidget
{
public:
  QImage Image;
  bool IsSquared = false;

  ImageSlice()
  {
    this->setMinimumSize(200, 200);
    this->setAccessibleName(QObject::tr("Image slice"));
    this->setToolTip(QObject::tr(
      "f over theta_h and theta_d (Burley 2012): the left edge is the highlight, the top its "
      "Fresnel reflection, the right edge grazing retroreflection"));
  }

protected:
  void paintEvent(QPaintEvent*) override
  {
    QPainter painter(this);
    if (this->Image.isNull())
    {
      painter.drawText(this->rect(), Qt::AlignCenter, QObject::tr("Being drawn …"));
      return;
    }
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const double line = this->fontMetrics().height();
    const double left = this->fontMetrics().horizontalAdvance("90 θd") + 8.0;
    const double size = std::min(this->width() - left - line, this->height() - 3.0 * line - 6.0);
    const QRectF frame(left, 1.5 * line, size, size);
    ChartTicks across, upwards;
    for (const int degrees : { 0, 30, 60, 90 })
    {
      const double share = degrees / 90.0;
      across.emplace_back(this->IsSquared ? std::sqrt(share) : share, std::to_string(degrees));
      upwards.emplace_back(share, std::to_string(degrees));
    }
    across.back().second += " θh";
    upwards.back().second += " θd";
    painter.drawImage(frame, this->Image);
    DrawAxes(painter, frame, across, upwards);
  }
};
}

//------------------------------------------------------------------------------
QWidget* MakeImagePanel(Session* session, Jobs* jobs)
{
  auto* panel = new QWidget;
  auto* slice = new ImageSlice;
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
  layout->addWidget(slice, 1);
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
      { return std::pair(DrawSlice(material.BRDF, angle, exposure, isSquared), isSquared); },
      [=](const std::pair<QImage, bool>& drawn)
      {
        slice->Image = drawn.first;
        slice->IsSquared = drawn.second;
        slice->update();
      });
  };
  OnChange(phiD, draw);
  OnChange(stops, draw);
  OnChange(squared, draw);
  QObject::connect(session, &Session::materialChanged, panel, draw);
  return panel;
}
} // namespace explorer
