// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureBar.h"

#include "Sheets.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include <cmath>

namespace explorer
{
//------------------------------------------------------------------------------
PictureBar::PictureBar(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , Lights(new QComboBox)
  , Difference(new QToolButton)
  , Exposure(new QDoubleSpinBox)
  , Fit(new QToolButton)
{
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(6, 3, 6, 3);
  for (int k = 0; k < 2; ++k)
  {
    auto* methods = new QComboBox;
    for (const MethodName& name : GetMethodNames())
    {
      methods->addItem(QString::fromStdString(name.Name), QString::fromStdString(name.Key));
      methods->setItemData(
        methods->count() - 1, QString::fromStdString(name.Description), Qt::ToolTipRole);
    }
    methods->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    methods->setMinimumContentsLength(10);
    methods->setToolTip(
      k == 0 ? tr("What the left side is drawn by") : tr("What the right side is drawn by"));
    methods->setAccessibleName(k == 0 ? tr("Method A") : tr("Method B"));
    auto* label = new QLabel(k == 0 ? tr("&A") : tr("&B"));
    label->setBuddy(methods);
    layout->addWidget(label);
    layout->addWidget(methods);
    connect(methods, QOverload<int>::of(&QComboBox::activated), this,
      [this, k, methods](int index)
      { this->Model->SetMethod(k, methods->itemData(index).toString().toStdString()); });
    this->Methods[static_cast<std::size_t>(k)] = methods;
  }
  for (int count = 1; count <= 4096; count *= 2)
  {
    this->Lights->addItem(QString::number(count), count);
  }
  this->Lights->setToolTip(
    tr("How many lights stand for the environment: of the light set, soft lights and the thesis"));
  this->Lights->setAccessibleName(tr("Number of lights"));
  auto* lights = new QLabel(tr("&Lights"));
  lights->setBuddy(this->Lights);
  this->Difference->setText(tr("Difference"));
  this->Difference->setCheckable(true);
  this->Difference->setToolTip(tr("Show |A - B| instead of the pictures (Ctrl+D)"));
  this->Exposure->setRange(-MostStops, MostStops);
  this->Exposure->setDecimals(1);
  this->Exposure->setSingleStep(0.5);
  this->Exposure->setToolTip(
    tr("Exposure of both sides in stops; at 0 the picture is that of the mapper"));
  this->Exposure->setAccessibleName(tr("Exposure"));
  this->Fit->setText(tr("Fit"));
  this->Fit->setToolTip(
    tr("The exposure that shows a white matte surface as 70 % of white in this environment"));
  auto* exposure = new QLabel(tr("E&xposure"));
  exposure->setBuddy(this->Exposure);
  layout->addWidget(lights);
  layout->addWidget(this->Lights);
  layout->addWidget(this->Difference);
  layout->addWidget(exposure);
  layout->addWidget(this->Exposure);
  layout->addWidget(this->Fit);
  layout->addStretch(1);

  connect(this->Lights, QOverload<int>::of(&QComboBox::activated), this,
    [this](int index) { this->Model->SetLights(this->Lights->itemData(index).toInt()); });
  connect(this->Difference, &QToolButton::clicked, this,
    [this](bool on) { this->Model->SetShown(on ? Shown::Difference : Shown::Split); });
  connect(this->Exposure, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double stops)
    {
      if (!this->IsUpdating)
      {
        this->Model->SetExposure(stops);
      }
    });
  connect(this->Fit, &QToolButton::clicked, this,
    [this]()
    { this->Model->SetExposure(std::log2(tool::ChooseExposure(this->Model->GetEnvironment()))); });
  connect(session, &Session::methodsChanged, this, &PictureBar::Update);
  connect(session, &Session::pictureChanged, this, &PictureBar::Update);
  connect(session, &Session::environmentChanged, this, &PictureBar::Update);
  this->Update();
}

//------------------------------------------------------------------------------
void PictureBar::Update()
{
  this->IsUpdating = true;
  const State& state = this->Model->GetState();
  for (std::size_t k = 0; k < 2; ++k)
  {
    this->Methods[k]->setCurrentIndex(
      this->Methods[k]->findData(QString::fromStdString(state.Methods[k])));
  }
  this->Lights->setCurrentIndex(this->Lights->findData(state.Lights));
  this->Lights->setEnabled(!this->Model->IsDirectional()); // there is one, whatever is chosen
  this->Difference->setChecked(state.Show == Shown::Difference);
  this->Exposure->setValue(state.Exposure);
  this->Fit->setEnabled(this->Model->GetEnvironment() != nullptr);
  this->IsUpdating = false;
}
} // namespace explorer
