// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobePanel.h"

#include "LobeView.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace explorer
{
//------------------------------------------------------------------------------
LobePanel::LobePanel(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , View(new LobeView(session))
  , Theta(new QDoubleSpinBox)
  , Phi(new QDoubleSpinBox)
  , Logarithmic(new QCheckBox(tr("Lo&garithmic")))
  , Note(new QLabel(tr("Above: reflected. Below, green: transmitted, on the same scale.")))
{
  auto* row = new QHBoxLayout;
  const auto add =
    [&](const QString& text, QDoubleSpinBox* box, double largest, const QString& toolTip)
  {
    box->setRange(0.0, largest);
    box->setDecimals(1);
    box->setSingleStep(5.0);
    box->setSuffix("°");
    box->setKeyboardTracking(false);
    box->setToolTip(toolTip);
    auto* label = new QLabel(text);
    label->setBuddy(box);
    row->addWidget(label);
    row->addWidget(box);
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &LobePanel::Set);
  };
  add(tr("θ&i"), this->Theta, 89.0, tr("Angle between the light and the normal (blue)"));
  add(tr("&φi"), this->Phi, 360.0, tr("Azimuth of the light from the tangent (red)"));
  this->Phi->setWrapping(true);
  this->Logarithmic->setToolTip(
    tr("Lengths by ln(1 + 100 L), which shows the matte part beside a highlight"));
  row->addWidget(this->Logarithmic);
  row->addStretch(1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addLayout(row);
  layout->addWidget(this->View, 1);
  this->Note->setWordWrap(true);
  layout->addWidget(this->Note);
  connect(this->Logarithmic, &QCheckBox::toggled, this, &LobePanel::Set);
  connect(session, &Session::lobeChanged, this, &LobePanel::Update);
  connect(session, &Session::materialChanged, this, &LobePanel::Update);
  this->Update();
}

//------------------------------------------------------------------------------
void LobePanel::Set()
{
  if (!this->IsUpdating)
  {
    this->Model->SetLobe(this->Theta->value(), this->Phi->value(), this->Logarithmic->isChecked());
  }
}

//------------------------------------------------------------------------------
void LobePanel::Update()
{
  this->IsUpdating = true;
  this->Note->setVisible(this->Model->GetMaterial().Transmission != nullptr);
  this->Theta->setValue(this->Model->GetState().LobeThetaI);
  this->Phi->setValue(this->Model->GetState().LobePhiI);
  this->Logarithmic->setChecked(this->Model->GetState().LobeLogarithmic);
  this->IsUpdating = false;
}
} // namespace explorer
