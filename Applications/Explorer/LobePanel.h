// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The lobe with its settings.
 */

#ifndef LobePanel_h
#define LobePanel_h

#include "Session.h"

#include <QWidget>

class QCheckBox;
class QDoubleSpinBox;
class QLabel;

namespace explorer
{
class LobeView;

class LobePanel : public QWidget
{
  Q_OBJECT

public:
  explicit LobePanel(Session* session, QWidget* parent = nullptr);

  LobeView* GetView() const { return this->View; }

  /// What is below the surface; hidden where nothing is transmitted.
  QLabel* GetNote() const { return this->Note; }

private:
  void Update();
  void Set();

  Session* Model;
  LobeView* View;
  QDoubleSpinBox* Theta;
  QDoubleSpinBox* Phi;
  QCheckBox* Logarithmic;
  QLabel* Note;
  bool IsUpdating = false;
};
} // namespace explorer

#endif
