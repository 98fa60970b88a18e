// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The environment, all directions in one picture, to be turned by dragging.
 */

#ifndef EnvironmentView_h
#define EnvironmentView_h

#include "Session.h"

#include <QImage>
#include <QWidget>

namespace explorer
{
/// Left and right keys turn it, too: by a degree, with Shift by 15.
class EnvironmentView : public QWidget
{
  Q_OBJECT

public:
  explicit EnvironmentView(Session* session, QWidget* parent = nullptr);

  /// In the environment's own frame, u from left to right.
  void SetImage(const QImage& image);
  const QImage& GetImage() const { return this->Image; }

  /// Where a place of the picture is shown, for a rotation in degrees: shares of the width.
  static double FindShown(double u, double rotation);

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

  Session* Model;
  QImage Image;
  int Last = 0;
};
} // namespace explorer

#endif
