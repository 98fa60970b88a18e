// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightPanel.h"

#include "Controls.h"
#include "Display.h"
#include "Sheets.h"

#include "vtkEnvironment.h"
#include "vtkLightSet.h"

#include <QFormLayout>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace explorer
{
constexpr int MapWidth = 800; // pixels of the environment's picture

//------------------------------------------------------------------------------
SkyView::SkyView(Session* session)
  : Model(session)
{
  this->setMinimumSize(200, 100);
  QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  this->setSizePolicy(policy);
  this->setCursor(Qt::SizeHorCursor);
  this->setAccessibleName(tr("Environment"));
  this->setToolTip(tr("Drag to turn the environment"));
  connect(session, &Session::rotationChanged, this, QOverload<>::of(&QWidget::update));
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
void SkyView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  const QRectF frame = this->GetFrame();
  painter.setClipRect(frame);
  painter.setRenderHints(QPainter::SmoothPixmapTransform | QPainter::Antialiasing);
  if (this->Image.isNull())
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
  if (way != 0 && (event->buttons() & Qt::LeftButton)) // what is under the mouse stays there
  {
    this->Model->SetRotation(
      this->Model->GetState().Rotation - 360.0 * way / std::max(1.0, this->GetFrame().width()));
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
  auto* regions = MakeBox(
    QObject::tr("Re&gions"), QObject::tr("The part of the environment that each light stands for"));
  auto* row = new QHBoxLayout(environment);
  row->setContentsMargins(0, 0, 0, 0);
  AddNamed(row, QObject::tr("&Rotation"),
    Bind(rotation, session, &Session::rotationChanged, &State::Rotation));
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
    view->setVisible(!session->IsDirectional());
    if (session->IsDirectional())
    {
      text->setText(
        QObject::tr("One directional light, without shadows. Nothing is planned: the picture is f "
                    "E cos θ, on the graphics card or exactly."));
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
    const bool withRegions = regions->isChecked();
    jobs->Compute(
      "light map", QObject::tr("drawing the environment"),
      [=]()
      {
        const auto set = tool::MakeLightSet(map, options);
        return std::pair(
          MakeQImage(tool::DrawLightMap(map, set, withRegions, MapWidth, MapWidth / 2)),
          QObject::tr("%1 x %2 pixels; %3 median-cut lights")
            .arg(map->GetWidth())
            .arg(map->GetHeight())
            .arg(set->GetNumberOfLights()));
      },
      [=](const std::pair<QImage, QString>& drawn)
      {
        view->SetImage(drawn.first);
        text->setText(drawn.second);
      });
  };
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
