// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How the panels make their fields and boxes, tie them to the session's state, and set them without
 * a signal.
 */

#ifndef Controls_h
#define Controls_h

#include "Session.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>

#include <utility>

namespace explorer
{
/// A field for a number, which changes when the number has been typed to its end.
inline QDoubleSpinBox* MakeField(double least, double largest, int decimals, double step,
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

/// A box to be ticked.
inline QCheckBox* MakeBox(const QString& text, const QString& toolTip)
{
  auto* box = new QCheckBox(text);
  box->setToolTip(toolTip);
  return box;
}

/// A list to choose from: of an item's text, what it stands for, and its tool tip.
inline void AddItem(QComboBox* list, const std::string& text, const QVariant& data,
  const std::string& toolTip = std::string())
{
  list->addItem(QString::fromStdString(text), data);
  list->setItemData(list->count() - 1, QString::fromStdString(toolTip), Qt::ToolTipRole);
}

/// A panel's own layout, from top to bottom.
inline QVBoxLayout* MakeColumn(QWidget* panel)
{
  auto* layout = new QVBoxLayout(panel);
  layout->setContentsMargins(6, 6, 6, 6);
  return layout;
}

/// Adds a widget with its name before it; Alt and the letter after '&' lead to the widget.
inline void AddNamed(QLayout* row, const QString& name, QWidget* widget)
{
  auto* label = new QLabel(name);
  label->setBuddy(widget);
  row->addWidget(label);
  row->addWidget(widget);
}

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

/// Calls a function now and whenever the session emits one of the signals.
template <typename Function>
void Follow(Session* session, QObject* receiver, std::initializer_list<Session::Signal> signals_,
  Function function)
{
  for (const Session::Signal signal : signals_)
  {
    QObject::connect(session, signal, receiver, function);
  }
  function();
}

/// Ties a field or a box to a value of the state: each follows the other. value is a generic lambda
/// that returns a reference into the state.
template <typename Control, typename Reference>
Control* Bind(Control* control, Session* session, Session::Signal changed, Reference value)
{
  OnChange(control,
    [=](auto given) { session->Edit(changed, [=](State& state) { value(state) = given; }); });
  Follow(session, control, { changed }, [=]() { Show(control, value(session->GetState())); });
  return control;
}
} // namespace explorer

#endif
