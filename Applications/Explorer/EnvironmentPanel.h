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
class QLayout;

namespace explorer
{
class EnvironmentView;
class LightPanel;

class EnvironmentPanel : public QWidget
{
  Q_OBJECT

public:
  EnvironmentPanel(Session* session, Jobs* jobs, QWidget* parent = nullptr);

  EnvironmentView* GetView() const { return this->View; }
  LightPanel* GetLightPanel() const { return this->Directional; }

private:
  void Start();
  void UpdateRotation();
  QLayout* MakeRow();

  Session* Model;
  Jobs* Background;
  EnvironmentView* View;
  QDoubleSpinBox* Rotation;
  QCheckBox* Lights;
  QCheckBox* Regions;
  QLabel* Text;
  QWidget* Surroundings; // all of the above
  LightPanel* Directional;
  int Drawn = 0; // number of lights
  bool IsUpdating = false;
};
} // namespace explorer

#endif
