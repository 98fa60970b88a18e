// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A number by a slider and a field, or one of a few choices.
 */

#ifndef ParameterRow_h
#define ParameterRow_h

#include "ModelMaterials.h"

#include <QString>
#include <QWidget>

class QComboBox;
class QDoubleSpinBox;
class QSlider;

namespace explorer
{
/// The slider's steps are equal, or, where the parameter says so, equal in log(1 + x).
class ParameterRow : public QWidget
{
  Q_OBJECT

public:
  ParameterRow(const ModelParameter& parameter, const QString& title, QWidget* parent = nullptr);

  double GetValue() const;
  void SetValue(double value); // without a signal

  ///@{
  /// Null in a row of choices, or of none.
  QSlider* GetSlider() const { return this->Slider; }
  QDoubleSpinBox* GetField() const { return this->Field; }
  QComboBox* GetChoices() const { return this->Choices; }
  ///@}

signals:
  void changed(double value); // by people

private:
  void MakeChoices();
  void MakeSlider(const QString& title);
  double ToValue(int step) const;
  int ToStep(double value) const;

  ModelParameter Parameter;
  QSlider* Slider = nullptr;
  QDoubleSpinBox* Field = nullptr;
  QComboBox* Choices = nullptr;
  bool IsUpdating = false;
};
} // namespace explorer

#endif
