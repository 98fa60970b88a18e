// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parameters of a model, by sliders and fields.
 */

#ifndef ModelPanel_h
#define ModelPanel_h

#include "ModelMaterials.h"
#include "Session.h"

#include <QWidget>

#include <map>
#include <string>
#include <utility>

class QComboBox;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace explorer
{
class ParameterRow;

class ModelPanel : public QWidget
{
  Q_OBJECT

public:
  explicit ModelPanel(Session* session, QWidget* parent = nullptr);

  /// Of the model that is shown: a parameter's row of a channel; null where there is none.
  ParameterRow* GetRow(const std::string& parameter, int channel = 0) const;

  QComboBox* GetModels() const { return this->Models; }

signals:
  void saveRequested();

private:
  void Show();
  void Fill(const ParametricModel& model);
  void Update();

  Session* Model;
  QComboBox* Models;
  QLabel* Text;
  QWidget* Rows = nullptr;
  QVBoxLayout* Layout;
  const ParametricModel* Shown = nullptr;
  std::map<std::pair<std::string, int>, ParameterRow*> All;
};
} // namespace explorer

#endif
