// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Controls.h"

namespace explorer
{
//------------------------------------------------------------------------------
QDoubleSpinBox* MakeField(double least, double largest, int decimals, double step,
  const QString& suffix, const QString& toolTip)
{
  auto* field = new QDoubleSpinBox;
  field->setRange(least, largest);
  field->setDecimals(decimals);
  field->setSingleStep(step);
  field->setSuffix(suffix);
  field->setKeyboardTracking(false);
  field->setToolTip(toolTip);
  return field;
}

//------------------------------------------------------------------------------
QCheckBox* MakeBox(const QString& text, const QString& toolTip)
{
  auto* box = new QCheckBox(text);
  box->setToolTip(toolTip);
  return box;
}

//------------------------------------------------------------------------------
QVBoxLayout* MakeColumn(QWidget* panel)
{
  auto* layout = new QVBoxLayout(panel);
  layout->setContentsMargins(6, 6, 6, 6);
  return layout;
}

//------------------------------------------------------------------------------
void AddNamed(QLayout* row, const QString& name, QWidget* widget)
{
  auto* label = new QLabel(name);
  label->setBuddy(widget);
  row->addWidget(label);
  row->addWidget(widget);
}
} // namespace explorer
