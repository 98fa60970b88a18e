// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderView.h"

#include <QMouseEvent>
#include <QTimer>

namespace explorer
{
//------------------------------------------------------------------------------
RenderView::RenderView(const QString& name, QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
{
  this->setRenderWindow(this->Window);
  this->setAcceptDrops(false); // the window's
  this->setAccessibleName(name);
  this->Window->SetMultiSamples(0);
}

//------------------------------------------------------------------------------
void RenderView::RequestRender()
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
        this->PrepareFrame();
        this->Window->Render();
      }
    });
}

//------------------------------------------------------------------------------
bool RenderView::HandleMouse(QMouseEvent* mouse)
{
  switch (mouse->type())
  {
    case QEvent::MouseButtonPress:
      this->IsDragging = mouse->button() == Qt::LeftButton && this->IsOverHandle(mouse);
      return this->IsDragging;
    case QEvent::MouseMove:
      if (this->IsDragging)
      {
        this->DragTo(mouse->pos());
      }
      else if (mouse->buttons() == Qt::NoButton)
      {
        this->IsOverHandle(mouse) ? this->setCursor(this->HandleCursor) : this->unsetCursor();
      }
      return this->IsDragging;
    default:
      if (!this->IsDragging)
      {
        return false;
      }
      this->IsDragging = false;
      this->EndDrag();
      return true;
  }
}

//------------------------------------------------------------------------------
bool RenderView::event(QEvent* event)
{
  switch (event->type())
  {
    case QEvent::MouseButtonPress:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease:
      if (this->HandleMouse(static_cast<QMouseEvent*>(event)))
      {
        event->accept();
        return true;
      }
      break;
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
      return QOpenGLWidget::event(event);
    default:
      break;
  }
  return QVTKOpenGLNativeWidget::event(event);
}
} // namespace explorer
