// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * All directions as a lat-long map, as environments are shown, with the directional light in it.
 */

#ifndef DirectionView_h
#define DirectionView_h

#include "Session.h"

#include <QWidget>

namespace explorer
{
/// The light can be dragged; arrow keys move it by a degree, with Shift by 15.
class DirectionView : public QWidget
{
  Q_OBJECT

public:
  explicit DirectionView(Session* session, QWidget* parent = nullptr);

  /// Where the light is drawn, in the widget's pixels.
  QPointF GetHandlePosition() const;

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  QSize sizeHint() const override { return { 440, 220 }; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return width / 2; }

private:
  QRect GetFrame() const;
  QPointF Find(double theta, double phi) const;
  void MoveTo(const QPoint& place);

  Session* Model;
};
} // namespace explorer

#endif
