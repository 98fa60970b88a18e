// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The image slice of a material: its values over theta_h and theta_d as a picture.
 */

#ifndef ImagePanel_h
#define ImagePanel_h

#include "Session.h"

#include <QImage>
#include <QWidget>

class QCheckBox;
class QDoubleSpinBox;

namespace explorer
{
/// The picture with its axes.
class ImageSlice : public QWidget
{
  Q_OBJECT

public:
  explicit ImageSlice(QWidget* parent = nullptr);

  void SetImage(const QImage& image, bool isSquared);
  const QImage& GetImage() const { return this->Image; }

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  QImage Image;
  bool IsSquared = false;
};

class ImagePanel : public QWidget
{
  Q_OBJECT

public:
  ImagePanel(Session* session, Jobs* jobs, QWidget* parent = nullptr);

  ImageSlice* GetSlice() const { return this->Slice; }

private:
  void Start();

  Session* Model;
  Jobs* Background;
  ImageSlice* Slice;
  QDoubleSpinBox* PhiD;
  QDoubleSpinBox* Stops;
  QCheckBox* Squared;
};
} // namespace explorer

#endif
