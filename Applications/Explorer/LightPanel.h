// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where light comes from: the environment with the lights that stand for it, or the one directional
 * light, with their settings.
 */

#ifndef LightPanel_h
#define LightPanel_h

#include "Session.h"

#include <QImage>
#include <QWidget>

namespace explorer
{
/// The environment as a lat-long picture, which is turned by dragging it.
class SkyView : public QWidget
{
  Q_OBJECT

public:
  explicit SkyView(Session* session);

  /// The environment in its own frame, u from left to right.
  void SetImage(const QImage& image);
  const QImage& GetImage() const { return this->Image; }

  /// Where a place of that picture is shown, for a rotation in degrees: shares of the width.
  static double FindShown(double u, double rotation);

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  QSize sizeHint() const override { return { 440, 220 }; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return width / 2; }

private:
  QRectF GetFrame() const;

  Session* Model;
  QImage Image;
  int Last = 0; // where the mouse was
};

/// The view with the fields "polar angle", "azimuth" and "irradiance" (in the widget "light
/// fields") of the directional light, and those of an environment.
QWidget* MakeLightPanel(Session* session, Jobs* jobs);
} // namespace explorer

#endif
