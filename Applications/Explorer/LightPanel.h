// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The directional light's direction and irradiance.
 */

#ifndef LightPanel_h
#define LightPanel_h

#include "Session.h"

#include <QWidget>

class QDoubleSpinBox;

namespace explorer
{
class DirectionView;

class LightPanel : public QWidget
{
  Q_OBJECT

public:
  explicit LightPanel(Session* session, QWidget* parent = nullptr);

  DirectionView* GetView() const { return this->View; }

  ///@{
  /// Fields of State::Light.
  QDoubleSpinBox* GetTheta() const { return this->Theta; }
  QDoubleSpinBox* GetPhi() const { return this->Phi; }
  QDoubleSpinBox* GetIrradiance() const { return this->Irradiance; }
  ///@}

private:
  void Update();

  Session* Model;
  DirectionView* View;
  QDoubleSpinBox* Theta;
  QDoubleSpinBox* Phi;
  QDoubleSpinBox* Irradiance;
  bool IsUpdating = false;
};
} // namespace explorer

#endif
