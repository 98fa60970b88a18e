// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The slices with the angles at which they cut.
 */

#ifndef SlicePanel_h
#define SlicePanel_h

#include "Session.h"

#include <QWidget>

#include <array>

class QCheckBox;
class QDoubleSpinBox;
class QLabel;

namespace explorer
{
class Comparison;
class SliceView;

class SlicePanel : public QWidget
{
  Q_OBJECT

public:
  SlicePanel(Session* session, Comparison* comparison, QWidget* parent = nullptr);

  SliceView* GetView() const { return this->View; }
  QCheckBox* GetPolar() const { return this->Polar; }

  /// Names of materials in the colors of their curves; "" of one material.
  QString GetLegend() const;

private:
  void Update();
  void Set();
  void UpdateLegend();

  Session* Model;
  SliceView* View;
  std::array<QDoubleSpinBox*, 3> Angles;
  QCheckBox* Logarithmic;
  QCheckBox* Polar;
  QLabel* Legend;
  bool IsUpdating = false;
};
} // namespace explorer

#endif
