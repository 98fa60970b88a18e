// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SlicePanel.h"

#include "SliceView.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace explorer
{
//------------------------------------------------------------------------------
SlicePanel::SlicePanel(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , View(new SliceView(session))
  , Logarithmic(new QCheckBox(tr("Lo&g")))
{
  auto* row = new QHBoxLayout;
  const QString names[3] = { tr("θ&h"), tr("θ&d"), tr("&φd") };
  for (int k = 0; k < 3; ++k)
  {
    auto* box = new QDoubleSpinBox;
    box->setRange(0.0, k < 2 ? 90.0 : 180.0);
    box->setDecimals(1);
    box->setSingleStep(5.0);
    box->setSuffix("°");
    box->setKeyboardTracking(false);
    box->setToolTip(tr("The other two slices are cut at this angle (Rusinkiewicz 1998)"));
    auto* label = new QLabel(names[k]);
    label->setBuddy(box);
    row->addWidget(label);
    row->addWidget(box);
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &SlicePanel::Set);
    this->Angles[static_cast<std::size_t>(k)] = box;
  }
  this->Logarithmic->setToolTip(tr("Draw f on a logarithmic axis"));
  row->addWidget(this->Logarithmic);
  row->addStretch(1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addLayout(row);
  layout->addWidget(this->View, 1);
  connect(this->Logarithmic, &QCheckBox::toggled, this, &SlicePanel::Set);
  connect(session, &Session::slicesChanged, this, &SlicePanel::Update);
  this->Update();
}

//------------------------------------------------------------------------------
void SlicePanel::Set()
{
  if (!this->IsUpdating)
  {
    this->Model->SetSlices(this->Angles[0]->value(), this->Angles[1]->value(),
      this->Angles[2]->value(), this->Logarithmic->isChecked());
  }
}

//------------------------------------------------------------------------------
void SlicePanel::Update()
{
  this->IsUpdating = true;
  const State& state = this->Model->GetState();
  const double values[3] = { state.SliceThetaH, state.SliceThetaD, state.SlicePhiD };
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->Angles[k]->setValue(values[k]);
  }
  this->Logarithmic->setChecked(state.SliceLogarithmic);
  this->IsUpdating = false;
}
} // namespace explorer
