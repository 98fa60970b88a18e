// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Above the picture: what each side is drawn by, and how the picture is shown.
 */

#ifndef PictureBar_h
#define PictureBar_h

#include "Session.h"

#include <QWidget>

#include <array>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QToolButton;

namespace explorer
{
class PictureBar : public QWidget
{
  Q_OBJECT

public:
  explicit PictureBar(Session* session, QWidget* parent = nullptr);

  QComboBox* GetMethods(int side) const { return this->Methods[static_cast<std::size_t>(side)]; }

private:
  void Update();

  Session* Model;
  std::array<QComboBox*, 2> Methods;
  QComboBox* Lights;
  QToolButton* Difference;
  QDoubleSpinBox* Exposure;
  QToolButton* Fit;
  bool IsUpdating = false;
};
} // namespace explorer

#endif
