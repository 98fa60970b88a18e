// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Turns the directional light in the picture: by the mouse with Ctrl, and by Ctrl and arrow keys.
 */

#ifndef LightDrag_h
#define LightDrag_h

#include "Session.h"

#include <QPoint>

class QEvent;
class vtkCamera;

namespace explorer
{
class LightDrag
{
public:
  explicit LightDrag(Session* session)
    : Model(session)
  {
  }

  /// Whether the event is one of these; the light has been turned then. Without a directional light
  /// none is.
  bool Handle(QEvent* event, vtkCamera* camera);

  /// Turn the light as the camera sees it, in degrees to its right and down.
  void Turn(vtkCamera* camera, double right, double down);

private:
  Session* Model;
  QPoint Last;
  bool IsDragging = false;
};
} // namespace explorer

#endif
