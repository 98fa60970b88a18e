// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The lobe of a material for a direction of light that can be dragged, and its settings.
 */

#ifndef LobePanel_h
#define LobePanel_h

#include "RenderView.h"
#include "Session.h"

class vtkActor;
class vtkBRDFLobeSource;
class vtkLineSource;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkSphereSource;

namespace explorer
{
/// z is the normal, x the tangent. The yellow ball is where the light comes from. Below the surface
/// is what the material transmits, in another color, on the same scale.
class LobeView : public RenderView
{
  Q_OBJECT

public:
  explicit LobeView(Session* session);
  ~LobeView() override;

  /// What is drawn.
  vtkBRDFLobeSource* GetSource() const { return this->Source; }

  /// Where the ball is, in the widget's pixels.
  QPoint GetHandlePosition();

protected:
  bool IsOverHandle(QMouseEvent* mouse) override;
  void DragTo(const QPoint& place) override;
  void EndDrag() override { this->Update(); } // finely
  void PrepareFrame() override;

private:
  void Update();
  void PlaceCamera();

  Session* Model;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkBRDFLobeSource> Source;
  vtkNew<vtkPolyDataMapper> LobeMapper;
  vtkNew<vtkActor> Lobe;
  vtkNew<vtkLineSource> Ray, Mirror, Through; // of the light
  vtkNew<vtkSphereSource> Handle;
  bool IsTransmitting = false;
};

/// The view with its fields; the label "lobe note" tells what is below the surface, where there is.
QWidget* MakeLobePanel(Session* session);
} // namespace explorer

#endif
