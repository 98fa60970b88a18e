// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightPanel.h"

#include "DirectionView.h"

#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace explorer
{
//------------------------------------------------------------------------------
LightPanel::LightPanel(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , View(new DirectionView(session))
  , Theta(new QDoubleSpinBox)
  , Phi(new QDoubleSpinBox)
  , Irradiance(new QDoubleSpinBox)
{
  auto* rows = new QFormLayout; // beside each other they are wider than the panel
  const auto add = [&](const QString& text, QDoubleSpinBox* box, double LightState::*field,
                     double least, double largest, const QString& toolTip)
  {
    box->setRange(least, largest);
    box->setKeyboardTracking(false);
    box->setToolTip(toolTip);
    rows->addRow(text, box);
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
      [this, field](double value)
      {
        if (!this->IsUpdating)
        {
          LightState light = this->Model->GetState().Light;
          light.*field = value;
          this->Model->SetLight(light);
        }
      });
  };
  add(tr("&Polar angle"), this->Theta, &LightState::Theta, 0.0, 180.0,
    tr("Between the light and +y, which is up"));
  add(tr("&Azimuth"), this->Phi, &LightState::Phi, -180.0, 179.9, tr("About +y, from +z to +x"));
  add(tr("I&rradiance"), this->Irradiance, &LightState::Irradiance, 0.0, LargestIrradiance,
    tr("Of a surface that faces the light: a white diffuse one then has this over π as its "
       "radiance"));
  for (QDoubleSpinBox* box : { this->Theta, this->Phi })
  {
    box->setDecimals(1);
    box->setSingleStep(5.0);
    box->setSuffix("°");
  }
  this->Phi->setWrapping(true);
  this->Irradiance->setDecimals(3);
  this->Irradiance->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  auto* text = new QLabel(tr("One directional light, without shadows. Nothing is planned: the "
                             "picture is f E cos θ, on the graphics card or exactly. In the "
                             "picture, Ctrl and the mouse or the arrow keys turn the light."));
  text->setWordWrap(true);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addLayout(rows);
  layout->addWidget(this->View);
  layout->addWidget(text);
  connect(session, &Session::lightChanged, this, &LightPanel::Update);
  this->Update();
}

//------------------------------------------------------------------------------
void LightPanel::Update()
{
  this->IsUpdating = true;
  const LightState& light = this->Model->GetState().Light;
  this->Theta->setValue(light.Theta);
  this->Phi->setValue(light.Phi);
  this->Irradiance->setValue(light.Irradiance);
  this->IsUpdating = false;
}
} // namespace explorer
