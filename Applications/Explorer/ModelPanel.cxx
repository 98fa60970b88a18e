// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Controls.h"
#include "Panels.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QSlider>

#include <cmath>

namespace explorer
{
namespace
{
constexpr int SliderSteps = 400;
constexpr int TitleWidth = 130; // pixels

//------------------------------------------------------------------------------
// The slider's steps are equal, or, where the parameter says so, equal in log(1 + x).
double ToScale(const ModelParameter& parameter, double value)
{
  return parameter.IsLogarithmic ? std::log1p(value) : value;
}

//------------------------------------------------------------------------------
double ToValue(const ModelParameter& parameter, int step)
{
  const double least = ToScale(parameter, parameter.Least);
  const double largest = ToScale(parameter, parameter.Largest);
  const double place = least + (largest - least) * step / SliderSteps;
  return parameter.IsLogarithmic ? std::expm1(place) : place;
}

//------------------------------------------------------------------------------
double ToStep(const ModelParameter& parameter, double value)
{
  const double least = ToScale(parameter, parameter.Least);
  const double largest = ToScale(parameter, parameter.Largest);
  return std::round(SliderSteps * (ToScale(parameter, value) - least) / (largest - least));
}

//------------------------------------------------------------------------------
// A number of a model by a slider and a field, or one of a few choices.
QWidget* MakeParameterRow(
  Session* session, const ParametricModel& model, const ModelParameter& parameter, std::size_t k)
{
  const bool isColor = parameter.Default.size() > 1;
  const QString channels[3] = { QObject::tr(", red"), QObject::tr(", green"),
    QObject::tr(", blue") };
  const QString title =
    QString::fromStdString(parameter.Name) + (isColor ? channels[k] : QString());
  const QString name =
    QString::fromStdString(parameter.Key) + (isColor ? QString(" %1").arg(k) : QString());
  const auto get = [=, &model]()
  { return GetValues(model, session->GetState().Models).at(parameter.Key)[k]; };
  const auto set = [=, &model](double value)
  {
    std::vector<double> values = GetValues(model, session->GetState().Models).at(parameter.Key);
    values[k] = value;
    session->SetModelValues(model.Key, parameter.Key, values);
  };
  auto* row = new QWidget;
  row->setToolTip(QString::fromStdString(parameter.Description));
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(title);
  label->setMinimumWidth(TitleWidth);
  layout->addWidget(label);
  if (!parameter.Choices.empty())
  {
    auto* choices = new QComboBox;
    for (std::size_t j = 0; j < parameter.Choices.size(); ++j)
    {
      choices->addItem(QString::fromStdString(parameter.Choices[j]), static_cast<double>(j));
    }
    choices->setAccessibleName(title);
    choices->setObjectName(name);
    layout->addWidget(choices);
    layout->addStretch(1);
    OnChange(choices, [=](const QVariant& choice) { set(choice.toDouble()); });
    const auto update = [=]() { Show(choices, get()); };
    QObject::connect(session, &Session::modelsChanged, row, update);
    update();
    return row;
  }
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setRange(0, SliderSteps);
  slider->setPageStep(SliderSteps / 20);
  auto* field =
    MakeField(parameter.Least, parameter.Largest, parameter.Largest > 100.0 ? 1 : 3, 1.0, "", "");
  field->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  layout->addWidget(slider, 1);
  layout->addWidget(field);
  for (QWidget* widget : { static_cast<QWidget*>(slider), static_cast<QWidget*>(field) })
  {
    widget->setAccessibleName(title);
    widget->setObjectName(name);
  }
  QObject::connect(
    slider, &QSlider::valueChanged, row, [=](int step) { set(ToValue(parameter, step)); });
  OnChange(field, set);
  const auto update = [=]()
  {
    Show(field, get());
    Show(slider, ToStep(parameter, get()));
  };
  QObject::connect(session, &Session::modelsChanged, row, update);
  update();
  return row;
}
}

//------------------------------------------------------------------------------
QWidget* MakeModelPanel(Session* session, const std::function<void()>& save)
{
  auto* panel = new QWidget;
  auto* models = new QComboBox;
  models->addItem(QObject::tr("None"), QString());
  for (const ParametricModel& model : GetModels())
  {
    models->addItem(
      QString::fromStdString(model.Name), QString::fromStdString(GetModelFile(model)));
  }
  models->setAccessibleName(QObject::tr("Model"));
  models->setObjectName("models");
  auto* button = new QPushButton(QObject::tr("&Save as…"));
  button->setToolTip(QObject::tr("Write the material with these parameters to a file (.exr)"));
  auto* text = new QLabel;
  text->setWordWrap(true);
  auto* row = new QHBoxLayout;
  AddNamed(row, QObject::tr("&Model"), models);
  row->addWidget(button);
  row->setStretchFactor(models, 1);
  auto* layout = MakeColumn(panel);
  layout->addLayout(row);
  layout->addWidget(text);
  layout->addStretch(1);

  const auto update = [=]()
  {
    const std::string& file = session->GetState().Material;
    const ParametricModel* model = FindModel(file);
    Show(models, model ? QString::fromStdString(file) : QString());
    auto* before = panel->findChild<QWidget*>("parameters", Qt::FindDirectChildrenOnly);
    if (before && before->property("model").toString() == models->currentData().toString())
    {
      return;
    }
    delete before;
    auto* rows = new QWidget;
    rows->setObjectName("parameters");
    rows->setProperty("model", models->currentData());
    layout->insertWidget(2, rows);
    text->setText(model ? QString::fromStdString(model->Description)
                        : QObject::tr("The material that is shown is no model. Choose one here or "
                                      "in the list of materials."));
    auto* column = new QVBoxLayout(rows);
    column->setContentsMargins(0, 0, 0, 0);
    for (const ModelParameter& parameter :
      model ? model->Parameters : std::vector<ModelParameter>())
    {
      for (std::size_t k = 0; k < parameter.Default.size(); ++k)
      {
        column->addWidget(MakeParameterRow(session, *model, parameter, k));
      }
    }
  };
  QObject::connect(button, &QPushButton::clicked, panel, [save]() { save(); });
  OnChange(models,
    [=](const QVariant& file)
    {
      if (!file.toString().isEmpty())
      {
        session->SetMaterial(file.toString().toStdString());
      }
      else
      {
        update(); // "none" is no choice
      }
    });
  QObject::connect(session, &Session::listsChanged, panel, update);
  update();
  return panel;
}
} // namespace explorer
