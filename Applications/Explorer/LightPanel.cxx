// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightPanel.h"

#include "Controls.h"
#include "DirectionalLight.h"
#include "Display.h"
#include "Sheets.h"

#include "vtkEnvironment.h"
#include "vtkLightSet.h"

#include <QFormLayout>
#include <QHBoxLayout>
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
SkyView::SkyView(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
{
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMinimumSize(200, 100);
  QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  this->setSizePolicy(policy);
  const auto adapt = [this]()
  {
    const bool isLight = this->Model->IsDirectional();
    this->setCursor(isLight ? Qt::CrossCursor : Qt::SizeHorCursor);
    this->setAccessibleName(isLight ? tr("Direction of the light") : tr("Environment"));
    this->setToolTip(
      isLight
        ? tr("Drag the light; arrow keys move it by 1°, with Shift by 15°")
        : tr("Drag to turn the environment; Left and Right turn it by 1°, with Shift by 15°"));
    this->update();
  };
  connect(session, &Session::environmentChanged, this, adapt);
  for (const auto signal : { &Session::rotationChanged, &Session::lightChanged })
  {
    connect(session, signal, this, QOverload<>::of(&QWidget::update));
  }
  adapt();
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
QRect SkyView::GetFrame() const
{
  const int width = std::min(this->width(), 2 * this->height());
  return { (this->width() - width) / 2, 0, width, width / 2 };
}

//------------------------------------------------------------------------------
QPointF SkyView::Find(double theta, double phi) const
{
  double u = 0.0;
  double v = 0.0;
  vtkEnvironment::GetCoordinates(GetDirection({ theta, phi, 1.0 }).data(), u, v);
  const QRect frame = this->GetFrame();
  return { frame.left() + u * frame.width(), frame.top() + (1.0 - v) * frame.height() };
}

//------------------------------------------------------------------------------
QPointF SkyView::GetHandlePosition() const
{
  const LightState& light = this->Model->GetState().Light;
  return this->Find(light.Theta, light.Phi);
}

//------------------------------------------------------------------------------
void SkyView::DrawEnvironment(QPainter& painter) const
{
  const QRect frame = this->GetFrame();
  if (this->Image.isNull())
  {
    painter.drawText(frame, Qt::AlignCenter, tr("Being drawn …"));
    return;
  }
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const double shift =
    frame.width() * FindShown(0.0, this->Model->GetState().Rotation); // of the left edge
  for (const double left : { shift - frame.width(), shift })
  {
    painter.drawImage(
      QRectF(frame.left() + left, frame.top(), frame.width(), frame.height()), this->Image);
  }
}

//------------------------------------------------------------------------------
void SkyView::DrawLight(QPainter& painter) const
{
  const QColor grid(85, 87, 92);
  const QRect frame = this->GetFrame();
  painter.fillRect(frame, QColor(40, 41, 44));
  painter.setRenderHint(QPainter::Antialiasing);
  for (const double theta : { 30.0, 60.0, 90.0, 120.0, 150.0 })
  {
    const double y = this->Find(theta, 0.0).y();
    painter.setPen(grid);
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

//------------------------------------------------------------------------------
void SkyView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.setClipRect(this->GetFrame());
  this->Model->IsDirectional() ? this->DrawLight(painter) : this->DrawEnvironment(painter);
  if (this->hasFocus())
  {
    painter.setPen(this->palette().color(QPalette::Highlight));
    painter.drawRect(this->GetFrame().adjusted(0, 0, -1, -1));
  }
}

//------------------------------------------------------------------------------
void SkyView::MoveLight(const QPoint& place)
{
  const QRect frame = this->GetFrame();
  const double u = static_cast<double>(place.x() - frame.left()) / std::max(1, frame.width());
  const double v = 1.0 - static_cast<double>(place.y() - frame.top()) / std::max(1, frame.height());
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
  if (this->Model->IsDirectional() && event->button() == Qt::LeftButton)
  {
    this->MoveLight(event->pos());
  }
  event->accept();
}

//------------------------------------------------------------------------------
void SkyView::mouseMoveEvent(QMouseEvent* event)
{
  if (!(event->buttons() & Qt::LeftButton))
  {
    return;
  }
  if (this->Model->IsDirectional())
  {
    this->MoveLight(event->pos());
    return;
  }
  // What is under the mouse stays there.
  const double share =
    static_cast<double>(event->pos().x() - this->Last) / std::max(1, this->GetFrame().width());
  this->Last = event->pos().x();
  this->Model->SetRotation(this->Model->GetState().Rotation - 360.0 * share);
}

//------------------------------------------------------------------------------
void SkyView::mouseReleaseEvent(QMouseEvent* event) { event->accept(); }

//------------------------------------------------------------------------------
// u falls as phi grows: what is left in the map comes from a larger azimuth.
void SkyView::keyPressEvent(QKeyEvent* event)
{
  const double step = (event->modifiers() & Qt::ShiftModifier) ? 15.0 : 1.0;
  const int key = event->key();
  const double left = key == Qt::Key_Left ? step : key == Qt::Key_Right ? -step : 0.0;
  const double down = key == Qt::Key_Down ? step : key == Qt::Key_Up ? -step : 0.0;
  if (this->Model->IsDirectional() && (left != 0.0 || down != 0.0))
  {
    LightState light = this->Model->GetState().Light;
    light.Phi += left;
    light.Theta += down;
    this->Model->SetLight(light);
  }
  else if (left != 0.0)
  {
    this->Model->SetRotation(this->Model->GetState().Rotation + left);
  }
  else
  {
    QWidget::keyPressEvent(event);
  }
}

namespace
{
//------------------------------------------------------------------------------
QWidget* MakeLightFields(Session* session)
{
  auto* fields = new QWidget;
  fields->setObjectName("light fields");
  auto* theta =
    MakeField(0.0, 180.0, 1, 5.0, "°", QObject::tr("Between the light and +y, which is up"));
  auto* phi = MakeField(-180.0, 179.9, 1, 5.0, "°", QObject::tr("About +y, from +z to +x"));
  auto* irradiance = MakeField(0.0, LargestIrradiance, 3, 1.0, "",
    QObject::tr("Of a surface that faces the light: a white diffuse one then has this over π as "
                "its radiance"));
  phi->setWrapping(true);
  irradiance->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  theta->setObjectName("polar angle");
  phi->setObjectName("azimuth");
  irradiance->setObjectName("irradiance");
  auto* rows = new QFormLayout(fields); // beside each other they are wider than the panel
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addRow(QObject::tr("&Polar angle"), theta);
  rows->addRow(QObject::tr("&Azimuth"), phi);
  rows->addRow(QObject::tr("I&rradiance"), irradiance);
  for (QDoubleSpinBox* field : { theta, phi, irradiance })
  {
    OnChange(field,
      [=]() {
        session->SetLight({ theta->value(), phi->value(), irradiance->value() });
      });
  }
  const auto update = [=]()
  {
    const LightState& light = session->GetState().Light;
    Show(theta, light.Theta);
    Show(phi, light.Phi);
    Show(irradiance, light.Irradiance);
  };
  QObject::connect(session, &Session::lightChanged, fields, update);
  update();
  return fields;
}
}

//------------------------------------------------------------------------------
QWidget* MakeLightPanel(Session* session, Jobs* jobs)
{
  auto* panel = new QWidget;
  auto* view = new SkyView(session);
  auto* text = new QLabel;
  auto* light = MakeLightFields(session);
  auto* environment = new QWidget;
  auto* rotation = MakeField(
    -180.0, 180.0, 1, 1.0, "°", QObject::tr("How far the environment is turned about the up axis"));
  auto* lights = MakeBox(QObject::tr("Li&ghts"),
    QObject::tr("The median-cut lights, as many as the picture's light sets have"));
  auto* regions = MakeBox(
    QObject::tr("Re&gions"), QObject::tr("The part of the environment that each light stands for"));
  text->setWordWrap(true);
  rotation->setWrapping(true);
  lights->setChecked(true);
  auto* row = new QHBoxLayout(environment);
  row->setContentsMargins(0, 0, 0, 0);
  AddNamed(row, QObject::tr("&Rotation"), rotation);
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
  OnChange(rotation, [=](double degrees) { session->SetRotation(degrees); });
  OnChange(lights, draw);
  OnChange(regions, draw);
  QObject::connect(session, &Session::rotationChanged, panel,
    [=]() { Show(rotation, session->GetState().Rotation); });
  QObject::connect(session, &Session::environmentChanged, panel, draw);
  QObject::connect(session, &Session::methodsChanged, panel,
    [=, drawn = 0]() mutable
    {
      if (session->GetState().Lights != std::exchange(drawn, session->GetState().Lights))
      {
        draw();
      }
    });
  draw();
  return panel;
}
} // namespace explorer
