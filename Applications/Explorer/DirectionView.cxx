// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DirectionView.h"

#include "DirectionalLight.h"

#include "vtkEnvironment.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <array>

namespace
{
constexpr double HandlePixels = 7.0; // pixels
const QColor Ground(40, 41, 44);
const QColor Grid(85, 87, 92);
const QColor Sun(255, 209, 51);
}

namespace explorer
{
//------------------------------------------------------------------------------
DirectionView::DirectionView(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
{
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMinimumSize(200, 100);
  this->setCursor(Qt::CrossCursor);
  this->setAccessibleName(tr("Direction of the light"));
  this->setToolTip(tr("Drag the light; arrow keys move it by 1°, with Shift by 15°"));
  QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  this->setSizePolicy(policy);
  connect(session, &Session::lightChanged, this, QOverload<>::of(&QWidget::update));
}

//------------------------------------------------------------------------------
QRect DirectionView::GetFrame() const
{
  const int width = std::min(this->width(), 2 * this->height());
  return { (this->width() - width) / 2, 0, width, width / 2 };
}

//------------------------------------------------------------------------------
QPointF DirectionView::Find(double theta, double phi) const
{
  LightState light;
  light.Theta = theta;
  light.Phi = phi;
  double u = 0.0;
  double v = 0.0;
  vtkEnvironment::GetCoordinates(GetDirection(light).data(), u, v);
  const QRect frame = this->GetFrame();
  return { frame.left() + u * frame.width(), frame.top() + (1.0 - v) * frame.height() };
}

//------------------------------------------------------------------------------
QPointF DirectionView::GetHandlePosition() const
{
  const LightState& light = this->Model->GetState().Light;
  return this->Find(light.Theta, light.Phi);
}

//------------------------------------------------------------------------------
void DirectionView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  const QRect frame = this->GetFrame();
  painter.fillRect(frame, Ground);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto drawVertical = [&](double phi, const QString& name)
  {
    const double x = this->Find(90.0, phi).x();
    painter.setPen(Grid);
    painter.drawLine(QPointF(x, frame.top()), QPointF(x, frame.bottom()));
    painter.setPen(Qt::lightGray);
    painter.drawText(QPointF(x + 4.0, this->Find(90.0, phi).y() - 4.0), name);
  };
  for (const double theta : { 30.0, 60.0, 90.0, 120.0, 150.0 })
  {
    const double y = this->Find(theta, 0.0).y();
    painter.setPen(Grid);
    painter.drawLine(QPointF(frame.left(), y), QPointF(frame.right(), y));
  }
  drawVertical(0.0, "+z");
  drawVertical(90.0, "+x");
  drawVertical(180.0, "-z");
  drawVertical(-90.0, "-x");
  painter.setPen(Qt::black);
  painter.setBrush(Sun);
  painter.drawEllipse(this->GetHandlePosition(), HandlePixels, HandlePixels);
  if (this->hasFocus())
  {
    painter.setPen(this->palette().color(QPalette::Highlight));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(frame.adjusted(0, 0, -1, -1));
  }
}

//------------------------------------------------------------------------------
void DirectionView::MoveTo(const QPoint& place)
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
void DirectionView::mousePressEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton)
  {
    this->MoveTo(event->pos());
  }
  event->accept();
}

//------------------------------------------------------------------------------
void DirectionView::mouseMoveEvent(QMouseEvent* event)
{
  if (event->buttons() & Qt::LeftButton)
  {
    this->MoveTo(event->pos());
  }
}

//------------------------------------------------------------------------------
void DirectionView::mouseReleaseEvent(QMouseEvent* event) { event->accept(); }

//------------------------------------------------------------------------------
// u falls as phi grows: what is left in the map comes from a larger azimuth.
void DirectionView::keyPressEvent(QKeyEvent* event)
{
  const double step = (event->modifiers() & Qt::ShiftModifier) ? 15.0 : 1.0;
  LightState light = this->Model->GetState().Light;
  switch (event->key())
  {
    case Qt::Key_Left:
      light.Phi += step;
      break;
    case Qt::Key_Right:
      light.Phi -= step;
      break;
    case Qt::Key_Up:
      light.Theta -= step;
      break;
    case Qt::Key_Down:
      light.Theta += step;
      break;
    default:
      QWidget::keyPressEvent(event);
      return;
  }
  this->Model->SetLight(light);
}
} // namespace explorer
