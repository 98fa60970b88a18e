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

namespace explorer
{
class SliceView;

class SlicePanel : public QWidget
{
  Q_OBJECT

public:
  explicit SlicePanel(Session* session, QWidget* parent = nullptr);

  SliceView* GetView() const { return this->View; }

private:
  void Update();
  void Set();

  Session* Model;
  SliceView* View;
  std::array<QDoubleSpinBox*, 3> Angles;
  QCheckBox* Logarithmic;
  bool IsUpdating = false;
};
} // namespace explorer

#endif
