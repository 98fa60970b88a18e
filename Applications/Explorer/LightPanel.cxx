// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightPanel.h"

#include "Controls.h"
#include "DirectionalLight.h"
#include "Display.h"
#include "RenderView.h"
#include "Sheets.h"

#include "vtkEnvironment.h"
#include "vtkLightSet.h"

#include <QFormLayout>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace explorer
{
namespace
{
constexpr int MapWidth = 800;     // pixels of the environment's picture
constexpr double SunRadius = 7.0; // pixels
}

//------------------------------------------------------------------------------
SkyView::SkyView(Session* session)
  : Model(session)
{
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMinimumSize(200, 100);
  QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  this->setSizePolicy(policy);
  Follow(session, this,
    { &Session::environmentChanged, &Session::rotationChanged, &Session::lightChanged },
    [this]()
    {
      const bool isLight = this->Model->IsDirectional();
      this->setCursor(isLight ? Qt::CrossCursor : Qt::SizeHorCursor);
      this->setAccessibleName(isLight ? tr("Direction of the light") : tr("Environment"));
      this->setToolTip(
        isLight
          ? tr("Drag the light; arrow keys move it by 1°, with Shift by 15°")
          : tr("Drag to turn the environment; Left and Right turn it by 1°, with Shift by 15°"));
      this->update();
    });
}

//------------------------------------------------------------------------------
// The world's picture: a direction's u falls by what the environment turns (counterclockwise seen
// from above).
double SkyView::FindShown(double u, double rotation)
{
  const double shown = u - rotation / 360.0;
  return shown - std::floor(shown);
}

//------------------------------------------------------------------------------
void SkyView::SetImage(const QImage& image)
{
  this->Image = image;
  this->update();
}

//------------------------------------------------------------------------------
QRectF SkyView::GetFrame() const
{
  const int width = std::min(this->width(), 2 * this->height());
  return QRect((this->width() - width) / 2, 0, width, width / 2);
}

//------------------------------------------------------------------------------
QPointF SkyView::Find(double theta, double phi) const
{
  double u = 0.0;
  double v = 0.0;
  vtkEnvironment::GetCoordinates(GetDirection({ theta, phi, 1.0 }).data(), u, v);
  const QRectF frame = this->GetFrame();
  return { frame.left() + u * frame.width(), frame.top() + (1.0 - v) * frame.height() };
}

//------------------------------------------------------------------------------
QPointF SkyView::GetHandlePosition() const
{
  const LightState& light = this->Model->GetState().Light;
  return this->Find(light.Theta, light.Phi);
}

//------------------------------------------------------------------------------
void SkyView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  const QRectF frame = this->GetFrame();
  painter.setClipRect(frame);
  painter.setRenderHints(QPainter::SmoothPixmapTransform | QPainter::Antialiasing);
  if (this->Model->IsDirectional())
  {
    const QColor grid(85, 87, 92);
    painter.fillRect(frame, QColor(40, 41, 44));
    painter.setPen(grid);
    for (const double theta : { 30.0, 60.0, 90.0, 120.0, 150.0 })
    {
      const double y = this->Find(theta, 0.0).y();
      painter.drawLine(QPointF(frame.left(), y), QPointF(frame.right(), y));
    }
    const std::pair<double, const char*> axes[] = { { 0.0, "+z" }, { 90.0, "+x" }, { 180.0, "-z" },
      { -90.0, "-x" } };
    for (const auto& [phi, name] : axes)
    {
      const QPointF place = this->Find(90.0, phi);
      painter.setPen(grid);
      painter.drawLine(QPointF(place.x(), frame.top()), QPointF(place.x(), frame.bottom()));
      painter.setPen(Qt::lightGray);
      painter.drawText(place + QPointF(4.0, -4.0), name);
    }
    painter.setPen(Qt::black);
    painter.setBrush(QColor(255, 209, 51));
    painter.drawEllipse(this->GetHandlePosition(), SunRadius, SunRadius);
    painter.setBrush(Qt::NoBrush);
  }
  else if (this->Image.isNull())
  {
    painter.drawText(frame, Qt::AlignCenter, tr("Being drawn …"));
  }
  else
  {
    const double shift =
      frame.width() * FindShown(0.0, this->Model->GetState().Rotation); // of the left edge
    painter.drawImage(frame.translated(shift - frame.width(), 0.0), this->Image);
    painter.drawImage(frame.translated(shift, 0.0), this->Image);
  }
  if (this->hasFocus())
  {
    painter.setPen(this->palette().color(QPalette::Highlight));
    painter.drawRect(frame.adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

//------------------------------------------------------------------------------
void SkyView::MoveLight(const QPointF& place)
{
  const QRectF frame = this->GetFrame();
  const double u = (place.x() - frame.left()) / std::max(1.0, frame.width());
  const double v = 1.0 - (place.y() - frame.top()) / std::max(1.0, frame.height());
  double direction[3];
  vtkEnvironment::GetDirection(u, std::clamp(v, 0.0, 1.0), direction);
  LightState light = this->Model->GetState().Light;
  SetDirection(light, direction);
  this->Model->SetLight(light);
}

//------------------------------------------------------------------------------
void SkyView::mousePressEvent(QMouseEvent* event)
{
  this->Last = event->pos().x();
  this->mouseMoveEvent(event);
  event->accept();
}

//------------------------------------------------------------------------------
void SkyView::mouseMoveEvent(QMouseEvent* event)
{
  const int way = event->pos().x() - std::exchange(this->Last, event->pos().x());
  if (!(event->buttons() & Qt::LeftButton))
  {
    return;
  }
  if (this->Model->IsDirectional())
  {
    this->MoveLight(event->pos());
  }
  else if (way != 0) // what is under the mouse stays there
  {
    this->Model->SetRotation(
      this->Model->GetState().Rotation - 360.0 * way / std::max(1.0, this->GetFrame().width()));
  }
}

//------------------------------------------------------------------------------
void SkyView::mouseReleaseEvent(QMouseEvent* event) { event->accept(); }

//------------------------------------------------------------------------------
// u falls as phi grows: what is left in the map comes from a larger azimuth.
void SkyView::keyPressEvent(QKeyEvent* event)
{
  const QPointF arrow =
    ((event->modifiers() & Qt::ShiftModifier) ? 15.0 : 1.0) * QPointF(GetArrow(event));
  LightState light = this->Model->GetState().Light;
  if (this->Model->IsDirectional() && !arrow.isNull())
  {
    light.Phi -= arrow.x();
    light.Theta += arrow.y();
    this->Model->SetLight(light);
  }
  else if (arrow.x() != 0.0)
  {
    this->Model->SetRotation(this->Model->GetState().Rotation - arrow.x());
  }
  else
  {
    QWidget::keyPressEvent(event);
  }
}

//------------------------------------------------------------------------------
QWidget* MakeLightPanel(Session* session, Jobs* jobs)
{
  auto* panel = new QWidget;
  auto* view = new SkyView(session);
  auto* text = new QLabel;
  text->setWordWrap(true);
  auto* light = new QWidget;
  light->setObjectName("light fields");
  auto* rows = new QFormLayout(light); // beside each other they are wider than the panel
  rows->setContentsMargins(0, 0, 0, 0);
  const auto add = [&](const QString& title, const QString& name, QDoubleSpinBox* field, auto value)
  {
    field->setObjectName(name);
    rows->addRow(title, Bind(field, session, &Session::lightChanged, value));
    return field;
  };
  add(
    QObject::tr("&Polar angle"), "polar angle",
    MakeField(0.0, 180.0, 1, 5.0, "°", QObject::tr("Between the light and +y, which is up")),
    [](auto& state) -> auto& { return state.Light.Theta; });
  add(
    QObject::tr("&Azimuth"), "azimuth",
    MakeField(-180.0, 179.9, 1, 5.0, "°", QObject::tr("About +y, from +z to +x")),
    [](auto& state) -> auto& { return state.Light.Phi; })
    ->setWrapping(true);
  add(
    QObject::tr("I&rradiance"), "irradiance",
    MakeField(0.0, LargestIrradiance, 3, 1.0, "",
      QObject::tr("Of a surface that faces the light: a white diffuse one then has this over π as "
                  "its radiance")),
    [](auto& state) -> auto& { return state.Light.Irradiance; })
    ->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);

  auto* environment = new QWidget;
  auto* rotation = MakeField(
    -180.0, 180.0, 1, 1.0, "°", QObject::tr("How far the environment is turned about the up axis"));
  rotation->setWrapping(true);
  auto* lights = MakeBox(QObject::tr("Li&ghts"),
    QObject::tr("The median-cut lights, as many as the picture's light sets have"));
  lights->setChecked(true);
  auto* regions = MakeBox(
    QObject::tr("Re&gions"), QObject::tr("The part of the environment that each light stands for"));
  auto* row = new QHBoxLayout(environment);
  row->setContentsMargins(0, 0, 0, 0);
  AddNamed(row, QObject::tr("&Rotation"),
    Bind(
      rotation, session, &Session::rotationChanged,
      [](auto& state) -> auto& { return state.Rotation; }));
  row->addWidget(lights);
  row->addWidget(regions);
  row->addStretch(1);
  auto* layout = MakeColumn(panel);
  layout->addWidget(environment);
  layout->addWidget(light);
  layout->addWidget(view);
  layout->addWidget(text);
  layout->addStretch(1);

  const auto draw = [=]()
  {
    light->setVisible(session->IsDirectional());
    environment->setVisible(!session->IsDirectional());
    if (session->IsDirectional())
    {
      text->setText(
        QObject::tr("One directional light, without shadows. Nothing is planned: the picture is f "
                    "E cos θ, on the graphics card or exactly. In the picture, Ctrl and the mouse "
                    "or the arrow keys turn the light."));
    }
    if (!session->GetEnvironment())
    {
      jobs->Stop("light map");
      return;
    }
    const auto map =
      vtkSmartPointer<vtkEnvironment>::Take(session->GetEnvironment()->NewSnapshot());
    map->SetRotationY(0.0); // the view turns the picture
    tool::LightSetOptions options;
    options.Count = session->GetState().Lights;
    const bool withLights = lights->isChecked();
    const bool withRegions = withLights && regions->isChecked();
    regions->setEnabled(withLights);
    jobs->Compute(
      "light map", QObject::tr("drawing the environment"),
      [=]()
      {
        const auto set =
          withLights ? tool::MakeLightSet(map, options) : vtkSmartPointer<vtkLightSet>::New();
        const QString size =
          QObject::tr("%1 x %2 pixels").arg(map->GetWidth()).arg(map->GetHeight());
        return std::pair(
          MakeQImage(tool::DrawLightMap(map, set, withRegions, MapWidth, MapWidth / 2)),
          size + (withLights ? QObject::tr("; %1 median-cut lights").arg(set->GetNumberOfLights())
                             : QString()));
      },
      [=](const std::pair<QImage, QString>& drawn)
      {
        view->SetImage(drawn.first);
        text->setText(drawn.second);
      });
  };
  OnChange(lights, draw);
  OnChange(regions, draw);
  Follow(session, panel, { &Session::environmentChanged }, draw);
  QObject::connect(session, &Session::methodsChanged, panel,
    [=, drawn = 0]() mutable
    {
      if (session->GetState().Lights != std::exchange(drawn, session->GetState().Lights))
      {
        draw();
      }
    });
  return panel;
}
} // namespace explorer
