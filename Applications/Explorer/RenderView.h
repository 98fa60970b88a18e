// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the explorer's views of VTK have in common: frames on request, a handle to be dragged, and
 * none of the keys of VTK's own windows, which would close the program.
 */

#ifndef RenderView_h
#define RenderView_h

#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkNew.h"

#include <QVTKOpenGLNativeWidget.h>

class QMouseEvent;

namespace explorer
{
class RenderView : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  /// name: for those who hear what is on the screen.
  explicit RenderView(const QString& name, QWidget* parent = nullptr);

  /// Renders soon; many calls make one frame.
  void RequestRender();

protected:
  bool event(QEvent* event) override;

  ///@{
  /// Whether the mouse is over what can be dragged; the drag, and its end.
  virtual bool IsOverHandle(QMouseEvent*) { return false; }
  virtual void DragTo(const QPoint&) {}
  virtual void EndDrag() {}
  ///@}

  /// What is to be done before a frame that was requested.
  virtual void PrepareFrame() {}

  vtkNew<vtkGenericOpenGLRenderWindow> Window;
  Qt::CursorShape HandleCursor = Qt::OpenHandCursor;
  bool IsDragging = false;

private:
  bool HandleMouse(QMouseEvent* mouse);

  bool IsRequested = false;
};
} // namespace explorer

#endif
