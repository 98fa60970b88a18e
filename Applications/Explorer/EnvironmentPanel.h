// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The environment with the lights that stand for it.
 */

#ifndef EnvironmentPanel_h
#define EnvironmentPanel_h

#include "Session.h"

#include <QWidget>

class QCheckBox;
class QDoubleSpinBox;
class QLabel;

namespace explorer
{
class EnvironmentView;

class EnvironmentPanel : public QWidget
{
  Q_OBJECT

public:
  EnvironmentPanel(Session* session, Jobs* jobs, QWidget* parent = nullptr);

  EnvironmentView* GetView() const { return this->View; }

private:
  void Start();
  void UpdateRotation();

  Session* Model;
  Jobs* Background;
  EnvironmentView* View;
  QDoubleSpinBox* Rotation;
  QCheckBox* Lights;
  QCheckBox* Regions;
  QLabel* Text;
  int Drawn = 0; // number of lights
  bool IsUpdating = false;
};
} // namespace explorer

#endif
