// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How the panels make their fields and boxes, and set them without a signal.
 */

#ifndef Controls_h
#define Controls_h

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>

#include <utility>

namespace explorer
{
/// A field for a number, which changes when the number has been typed to its end.
QDoubleSpinBox* MakeField(double least, double largest, int decimals, double step,
  const QString& suffix, const QString& toolTip);

/// A box to be ticked.
QCheckBox* MakeBox(const QString& text, const QString& toolTip);

/// A panel's own layout, from top to bottom.
QVBoxLayout* MakeColumn(QWidget* panel);

/// Adds a widget with its name before it; Alt and the letter after '&' lead to the widget.
void AddNamed(QLayout* row, const QString& name, QWidget* widget);

///@{
/// Calls a function with what people choose, by keys or the mouse.
template <typename Function>
void OnChange(QDoubleSpinBox* field, Function function)
{
  QObject::connect(
    field, QOverload<double>::of(&QDoubleSpinBox::valueChanged), field, std::move(function));
}
template <typename Function>
void OnChange(QAbstractButton* box, Function function)
{
  QObject::connect(box, &QAbstractButton::toggled, box, std::move(function));
}
template <typename Function>
void OnChange(QComboBox* list, Function function)
{
  QObject::connect(list, QOverload<int>::of(&QComboBox::activated), list,
    [list, function](int index) { function(list->itemData(index)); });
}
///@}

///@{
/// Shows a value; nobody is told.
inline void Show(QDoubleSpinBox* field, double value)
{
  const QSignalBlocker blocker(field);
  field->setValue(value);
}
inline void Show(QSlider* slider, double step)
{
  const QSignalBlocker blocker(slider);
  slider->setValue(static_cast<int>(step));
}
inline void Show(QAbstractButton* box, bool on)
{
  const QSignalBlocker blocker(box);
  box->setChecked(on);
}
inline void Show(QComboBox* list, const QVariant& data)
{
  const QSignalBlocker blocker(list);
  list->setCurrentIndex(list->findData(data));
}
///@}
} // namespace explorer

#endif
