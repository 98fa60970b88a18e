// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentView.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace explorer
{
//------------------------------------------------------------------------------
EnvironmentView::EnvironmentView(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
{
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMinimumSize(200, 100);
  this->setCursor(Qt::SizeHorCursor);
  this->setAccessibleName(tr("Environment"));
  this->setToolTip(
    tr("Drag to turn the environment; Left and Right turn it by 1°, with Shift by 15°"));
  QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  this->setSizePolicy(policy);
  connect(session, &Session::rotationChanged, this, QOverload<>::of(&QWidget::update));
}

//------------------------------------------------------------------------------
// The world's picture: a direction's u falls by what the environment turns (counterclockwise seen
// from above).
double EnvironmentView::FindShown(double u, double rotation)
{
  const double shown = u - rotation / 360.0;
  return shown - std::floor(shown);
}

//------------------------------------------------------------------------------
void EnvironmentView::SetImage(const QImage& image)
{
  this->Image = image;
  this->update();
}

//------------------------------------------------------------------------------
QRect EnvironmentView::GetFrame() const
{
  const int width = std::min(this->width(), 2 * this->height());
  return { (this->width() - width) / 2, 0, width, width / 2 };
}

//------------------------------------------------------------------------------
void EnvironmentView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const QRect frame = this->GetFrame();
  if (this->Image.isNull())
  {
    painter.drawText(frame, Qt::AlignCenter, tr("Being drawn …"));
    return;
  }
  painter.setClipRect(frame);
  const double shift =
    frame.width() * FindShown(0.0, this->Model->GetState().Rotation); // of the left edge
  for (const double left : { shift - frame.width(), shift })
  {
    painter.drawImage(
      QRectF(frame.left() + left, frame.top(), frame.width(), frame.height()), this->Image);
  }
  if (this->hasFocus())
  {
    painter.setPen(this->palette().color(QPalette::Highlight));
    painter.drawRect(frame.adjusted(0, 0, -1, -1));
  }
}

//------------------------------------------------------------------------------
void EnvironmentView::mousePressEvent(QMouseEvent* event)
{
  this->Last = event->pos().x();
  event->accept();
}

//------------------------------------------------------------------------------
// What is under the mouse stays there.
void EnvironmentView::mouseMoveEvent(QMouseEvent* event)
{
  if (event->buttons() & Qt::LeftButton)
  {
    const double share =
      static_cast<double>(event->pos().x() - this->Last) / std::max(1, this->GetFrame().width());
    this->Last = event->pos().x();
    this->Model->SetRotation(this->Model->GetState().Rotation - 360.0 * share);
  }
}

//------------------------------------------------------------------------------
void EnvironmentView::mouseReleaseEvent(QMouseEvent* event) { event->accept(); }

//------------------------------------------------------------------------------
void EnvironmentView::keyPressEvent(QKeyEvent* event)
{
  const double step = (event->modifiers() & Qt::ShiftModifier) ? 15.0 : 1.0;
  if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right)
  {
    this->Model->SetRotation(
      this->Model->GetState().Rotation + (event->key() == Qt::Key_Left ? step : -step));
    return;
  }
  QWidget::keyPressEvent(event);
}
} // namespace explorer
