// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SlicePanel.h"

#include "ChartLines.h"
#include "SliceView.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace explorer
{
//------------------------------------------------------------------------------
SlicePanel::SlicePanel(Session* session, Comparison* comparison, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , View(new SliceView(session, comparison))
  , Logarithmic(new QCheckBox(tr("Lo&g")))
  , Polar(new QCheckBox(tr("&Polar")))
  , Legend(new QLabel)
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
  this->Polar->setToolTip(
    tr("f in the plane of incidence of the lobe's light, whose direction is yellow"));
  this->Legend->setTextFormat(Qt::RichText);
  this->Legend->setWordWrap(true);
  row->addWidget(this->Logarithmic);
  row->addWidget(this->Polar);
  row->addStretch(1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addLayout(row);
  layout->addWidget(this->View, 1);
  layout->addWidget(this->Legend);
  connect(this->Logarithmic, &QCheckBox::toggled, this, &SlicePanel::Set);
  connect(this->Polar, &QCheckBox::toggled, this,
    [this](bool on)
    {
      if (!this->IsUpdating)
      {
        this->Model->SetSlicePolar(on);
      }
    });
  connect(this->View, &SliceView::updated, this, &SlicePanel::UpdateLegend);
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
  this->Polar->setChecked(state.SlicePolar);
  this->IsUpdating = false;
}

//------------------------------------------------------------------------------
void SlicePanel::UpdateLegend()
{
  const std::vector<ComparedMaterial> materials = this->View->GetMaterials();
  QStringList names;
  for (std::size_t k = 0; k < materials.size() && materials.size() > 1; ++k)
  {
    const Color color = GetMaterialColor(k);
    names << QString("<span style='color:%1'>&#9632;</span>&nbsp;%2")
               .arg(QColor(color[0], color[1], color[2]).name(),
                 QString::fromStdString(materials[k].Name).toHtmlEscaped());
  }
  this->Legend->setText(names.isEmpty() ? QString() : tr("Luminance: ") + names.join("&ensp; "));
  this->Legend->setVisible(!names.isEmpty());
}

//------------------------------------------------------------------------------
QString SlicePanel::GetLegend() const { return this->Legend->text(); }
} // namespace explorer
