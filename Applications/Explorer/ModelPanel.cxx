// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ModelPanel.h"

#include "ParameterRow.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace explorer
{
//------------------------------------------------------------------------------
ModelPanel::ModelPanel(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , Models(new QComboBox)
  , Text(new QLabel)
  , Layout(new QVBoxLayout)
{
  this->Models->addItem(tr("None"), QString());
  for (const ParametricModel& model : explorer::GetModels())
  {
    this->Models->addItem(
      QString::fromStdString(model.Name), QString::fromStdString(GetModelFile(model)));
  }
  this->Models->setAccessibleName(tr("Model"));
  auto* label = new QLabel(tr("&Model"));
  label->setBuddy(this->Models);
  auto* save = new QPushButton(tr("&Save as…"));
  save->setToolTip(tr("Write the material with these parameters to a file (.exr)"));
  auto* row = new QHBoxLayout;
  row->addWidget(label);
  row->addWidget(this->Models, 1);
  row->addWidget(save);
  this->Text->setWordWrap(true);
  this->Layout->setContentsMargins(6, 6, 6, 6);
  this->Layout->addLayout(row);
  this->Layout->addWidget(this->Text);
  this->Layout->addStretch(1);
  this->setLayout(this->Layout);
  connect(save, &QPushButton::clicked, this, &ModelPanel::saveRequested);
  connect(this->Models, QOverload<int>::of(&QComboBox::activated), this,
    [this](int index)
    {
      const QString file = this->Models->itemData(index).toString();
      if (!file.isEmpty())
      {
        this->Model->SetMaterial(file.toStdString());
      }
      else
      {
        this->Show(); // "none" is no choice
      }
    });
  connect(session, &Session::listsChanged, this, &ModelPanel::Show);
  connect(session, &Session::modelsChanged, this, &ModelPanel::Update);
  this->Show();
}

//------------------------------------------------------------------------------
void ModelPanel::Show()
{
  const std::string& file = this->Model->GetState().Material;
  const ParametricModel* model = FindModel(file);
  this->Models->setCurrentIndex(model ? this->Models->findData(QString::fromStdString(file)) : 0);
  if (this->Rows && model == this->Shown)
  {
    return;
  }
  delete this->Rows;
  this->All.clear();
  this->Rows = new QWidget;
  this->Shown = model;
  this->Layout->insertWidget(2, this->Rows);
  this->Text->setText(model ? QString::fromStdString(model->Description)
                            : tr("The material that is shown is no model. Choose one here or in "
                                 "the list of materials."));
  if (model)
  {
    this->Fill(*model);
    this->Update();
  }
}

//------------------------------------------------------------------------------
void ModelPanel::Fill(const ParametricModel& model)
{
  auto* layout = new QVBoxLayout(this->Rows);
  layout->setContentsMargins(0, 0, 0, 0);
  const QString channels[3] = { tr("red"), tr("green"), tr("blue") };
  for (const ModelParameter& parameter : model.Parameters)
  {
    const int count = static_cast<int>(parameter.Default.size());
    for (int k = 0; k < count; ++k)
    {
      const QString name = QString::fromStdString(parameter.Name);
      auto* row = new ParameterRow(parameter, count > 1 ? name + ", " + channels[k] : name);
      layout->addWidget(row);
      this->All[{ parameter.Key, k }] = row;
      connect(row, &ParameterRow::changed, this,
        [this, &model, key = parameter.Key, k](double value)
        {
          std::vector<double> values = GetValues(model, this->Model->GetState().Models).at(key);
          values[static_cast<std::size_t>(k)] = value;
          this->Model->SetModelValues(model.Key, key, values);
        });
    }
  }
}

//------------------------------------------------------------------------------
void ModelPanel::Update()
{
  if (!this->Shown)
  {
    return;
  }
  const ModelValues values = GetValues(*this->Shown, this->Model->GetState().Models);
  for (const auto& [key, row] : this->All)
  {
    row->SetValue(values.at(key.first)[static_cast<std::size_t>(key.second)]);
  }
}

//------------------------------------------------------------------------------
ParameterRow* ModelPanel::GetRow(const std::string& parameter, int channel) const
{
  const auto found = this->All.find({ parameter, channel });
  return found == this->All.end() ? nullptr : found->second;
}
} // namespace explorer
