// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterRow.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>

#include <cmath>

namespace
{
constexpr int SliderSteps = 400;
constexpr int TitleWidth = 130; // pixels
}

namespace explorer
{
//------------------------------------------------------------------------------
ParameterRow::ParameterRow(const ModelParameter& parameter, const QString& title, QWidget* parent)
  : QWidget(parent)
  , Parameter(parameter)
{
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(title);
  label->setMinimumWidth(TitleWidth);
  layout->addWidget(label);
  this->setToolTip(QString::fromStdString(parameter.Description));
  if (!parameter.Choices.empty())
  {
    this->MakeChoices();
    layout->addWidget(this->Choices);
    layout->addStretch(1);
    return;
  }
  this->MakeSlider(title);
  layout->addWidget(this->Slider, 1);
  layout->addWidget(this->Field);
}

//------------------------------------------------------------------------------
void ParameterRow::MakeChoices()
{
  this->Choices = new QComboBox;
  for (const std::string& choice : this->Parameter.Choices)
  {
    this->Choices->addItem(QString::fromStdString(choice));
  }
  this->Choices->setAccessibleName(QString::fromStdString(this->Parameter.Name));
  connect(this->Choices, QOverload<int>::of(&QComboBox::activated), this,
    [this](int index) { emit this->changed(index); });
}

//------------------------------------------------------------------------------
void ParameterRow::MakeSlider(const QString& title)
{
  this->Slider = new QSlider(Qt::Horizontal);
  this->Slider->setRange(0, SliderSteps);
  this->Slider->setPageStep(SliderSteps / 20);
  this->Slider->setAccessibleName(title);
  this->Field = new QDoubleSpinBox;
  this->Field->setRange(this->Parameter.Least, this->Parameter.Largest);
  this->Field->setDecimals(this->Parameter.Largest > 100.0 ? 1 : 3);
  this->Field->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  this->Field->setKeyboardTracking(false);
  this->Field->setAccessibleName(title);
  connect(this->Slider, &QSlider::valueChanged, this,
    [this](int step)
    {
      if (!this->IsUpdating)
      {
        const double value = this->ToValue(step);
        this->IsUpdating = true;
        this->Field->setValue(value);
        this->IsUpdating = false;
        emit this->changed(value);
      }
    });
  connect(this->Field, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double value)
    {
      if (!this->IsUpdating)
      {
        this->IsUpdating = true;
        this->Slider->setValue(this->ToStep(value));
        this->IsUpdating = false;
        emit this->changed(value);
      }
    });
}

//------------------------------------------------------------------------------
double ParameterRow::ToValue(int step) const
{
  const double share = static_cast<double>(step) / SliderSteps;
  const double least = this->Parameter.Least;
  const double largest = this->Parameter.Largest;
  return this->Parameter.IsLogarithmic
           ? std::expm1(std::log1p(least) + share * (std::log1p(largest) - std::log1p(least)))
           : least + share * (largest - least);
}

//------------------------------------------------------------------------------
int ParameterRow::ToStep(double value) const
{
  const double least = this->Parameter.Least;
  const double largest = this->Parameter.Largest;
  const double share = this->Parameter.IsLogarithmic ? (std::log1p(value) - std::log1p(least)) /
                                                         (std::log1p(largest) - std::log1p(least))
                                                     : (value - least) / (largest - least);
  return static_cast<int>(std::lround(SliderSteps * share));
}

//------------------------------------------------------------------------------
double ParameterRow::GetValue() const
{
  return this->Choices ? this->Choices->currentIndex() : this->Field->value();
}

//------------------------------------------------------------------------------
void ParameterRow::SetValue(double value)
{
  this->IsUpdating = true;
  if (this->Choices)
  {
    this->Choices->setCurrentIndex(static_cast<int>(value));
  }
  else
  {
    this->Field->setValue(value);
    this->Slider->setValue(this->ToStep(value));
  }
  this->IsUpdating = false;
}
} // namespace explorer
