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

#include <cmath>
#include <functional>
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

/// Adds a name and then its widget; Alt and the letter after '&' lead to the widget.
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

/// Puts a slider before a field that is as wide, both of that name, into a row. The slider's steps
/// are equal in scale(value), whose inverse is unscale; get and set are the value's, whose changes
/// the session's signal tells.
template <typename Get, typename Set>
void AddSlider(QBoxLayout* row, const QString& name, QDoubleSpinBox* field, int steps,
  double (*scale)(double), double (*unscale)(double), Session* session, Session::Signal changed,
  Get get, Set set)
{
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setRange(0, steps);
  slider->setPageStep(steps / 12);
  slider->setToolTip(field->toolTip());
  slider->setAccessibleName(field->accessibleName());
  slider->setObjectName(name);
  field->setObjectName(name);
  field->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  row->addWidget(slider, 1);
  row->addWidget(field);
  const double least = scale(field->minimum());
  const double step = (scale(field->maximum()) - least) / steps;
  OnChange(field, set);
  QObject::connect(
    slider, &QSlider::valueChanged, row, [=](int value) { set(unscale(least + step * value)); });
  Follow(session, field, { changed },
    [=]()
    {
      Show(field, get());
      Show(slider, std::round((scale(get()) - least) / step));
    });
}

/// Ties a field or a box to a value of the state: each follows the other. value is a member of
/// State or a function from a state to a reference into it.
template <typename Control, typename Member>
Control* Bind(Control* control, Session* session, Session::Signal changed, Member value)
{
  OnChange(control, [=](auto given)
    { session->Edit(changed, [=](State& state) { std::invoke(value, state) = given; }); });
  Follow(session, control, { changed },
    [=]() { Show(control, std::invoke(value, session->GetState())); });
  return control;
}
} // namespace explorer

#endif
