// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightDrag.h"

#include "DirectionalLight.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkTransform.h"

#include <QKeyEvent>
#include <QMouseEvent>

namespace
{
constexpr double DegreesPerPixel = 0.5;
constexpr double KeyStep = 5.0; // degrees
}

namespace explorer
{
//------------------------------------------------------------------------------
void LightDrag::Turn(vtkCamera* camera, double right, double down)
{
  double forward[3];
  double across[3];
  camera->GetDirectionOfProjection(forward);
  vtkMath::Cross(forward, camera->GetViewUp(), across);
  double up[3];
  vtkMath::Cross(across, forward, up);
  vtkNew<vtkTransform> turn;
  turn->RotateWXYZ(right, up);
  turn->RotateWXYZ(down, across);
  double direction[3];
  turn->TransformVector(GetDirection(this->Model->GetState().Light).data(), direction);
  LightState light = this->Model->GetState().Light;
  SetDirection(light, direction);
  this->Model->SetLight(light);
}

//------------------------------------------------------------------------------
bool LightDrag::Handle(QEvent* event, vtkCamera* camera)
{
  if (!this->Model->IsDirectional())
  {
    this->IsDragging = false;
    return false;
  }
  switch (event->type())
  {
    case QEvent::MouseButtonPress:
    {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      this->IsDragging =
        mouse->button() == Qt::LeftButton && (mouse->modifiers() & Qt::ControlModifier);
      this->Last = mouse->pos();
      return this->IsDragging;
    }
    case QEvent::MouseMove:
      if (this->IsDragging)
      {
        const QPoint place = static_cast<QMouseEvent*>(event)->pos();
        const QPoint way = place - this->Last;
        this->Last = place;
        this->Turn(camera, DegreesPerPixel * way.x(), DegreesPerPixel * way.y());
      }
      return this->IsDragging;
    case QEvent::MouseButtonRelease:
    {
      const bool was = this->IsDragging;
      this->IsDragging = false;
      return was;
    }
    case QEvent::KeyPress:
    {
      const auto* press = static_cast<QKeyEvent*>(event);
      const int key = press->key();
      const double right = key == Qt::Key_Right ? KeyStep : key == Qt::Key_Left ? -KeyStep : 0.0;
      const double down = key == Qt::Key_Down ? KeyStep : key == Qt::Key_Up ? -KeyStep : 0.0;
      if (!(press->modifiers() & Qt::ControlModifier) || (right == 0.0 && down == 0.0))
      {
        return false;
      }
      this->Turn(camera, right, down);
      return true;
    }
    default:
      return false;
  }
}
} // namespace explorer
