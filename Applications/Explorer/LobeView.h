// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The lobe of a material for a direction of light that can be dragged.
 */

#ifndef LobeView_h
#define LobeView_h

#include "Session.h"

#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkNew.h"

#include <QVTKOpenGLNativeWidget.h>

class vtkActor;
class vtkBRDFLobeSource;
class vtkLineSource;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkSphereSource;

namespace explorer
{
/// z is the normal, x the tangent. The yellow ball is where the light comes from; the arrow keys
/// move it, too. Below the surface is what the material transmits, in another color, on the same
/// scale.
class LobeView : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  explicit LobeView(Session* session, QWidget* parent = nullptr);
  ~LobeView() override;

  /// What is drawn.
  vtkBRDFLobeSource* GetSource() const { return this->Source; }

  /// Where the ball is, in the widget's pixels.
  QPoint GetHandlePosition();

  void RequestRender();

protected:
  bool event(QEvent* event) override;

private:
  void Update();
  void MakeScene();
  void MakeLobe();
  void PlaceCamera();
  void MoveHandle(const QPoint& place);
  bool DragHandle(QEvent* event);

  Session* Model;
  vtkNew<vtkGenericOpenGLRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkBRDFLobeSource> Source;
  vtkNew<vtkPolyDataMapper> LobeMapper;
  vtkNew<vtkActor> Lobe;
  vtkNew<vtkLineSource> Ray;
  vtkNew<vtkLineSource> Mirror;
  vtkNew<vtkLineSource> Through;
  vtkNew<vtkSphereSource> Handle;
  bool IsDragging = false;
  bool IsRequested = false;
  bool IsTransmitting = false;
};
} // namespace explorer

#endif
