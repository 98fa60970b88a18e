// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPanel.h"

#include "Display.h"
#include "EnvironmentView.h"
#include "LightPanel.h"
#include "Sheets.h"

#include "vtkEnvironment.h"
#include "vtkLightSet.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace
{
constexpr int PictureWidth = 800;
}

namespace explorer
{
//------------------------------------------------------------------------------
EnvironmentPanel::EnvironmentPanel(Session* session, Jobs* jobs, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , Background(jobs)
  , View(new EnvironmentView(session))
  , Rotation(new QDoubleSpinBox)
  , Lights(new QCheckBox(tr("Li&ghts")))
  , Regions(new QCheckBox(tr("Re&gions")))
  , Text(new QLabel)
  , Surroundings(new QWidget)
  , Directional(new LightPanel(session))
{
  this->Rotation->setRange(-180.0, 180.0);
  this->Rotation->setWrapping(true);
  this->Rotation->setDecimals(1);
  this->Rotation->setSuffix("°");
  this->Rotation->setKeyboardTracking(false);
  this->Rotation->setToolTip(tr("How far the environment is turned about the up axis"));
  this->Lights->setChecked(true);
  this->Lights->setToolTip(tr("The median-cut lights, as many as the picture's light sets have"));
  this->Regions->setToolTip(tr("The part of the environment that each light stands for"));
  this->Text->setWordWrap(true);
  auto* inner = new QVBoxLayout(this->Surroundings);
  inner->setContentsMargins(0, 0, 0, 0);
  inner->addLayout(this->MakeRow());
  inner->addWidget(this->View);
  inner->addWidget(this->Text);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addWidget(this->Surroundings);
  layout->addWidget(this->Directional);
  layout->addStretch(1);
  this->Directional->hide();

  connect(this->Rotation, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double degrees)
    {
      if (!this->IsUpdating)
      {
        this->Model->SetRotation(degrees);
      }
    });
  connect(this->Lights, &QCheckBox::toggled, this, &EnvironmentPanel::Start);
  connect(this->Regions, &QCheckBox::toggled, this, &EnvironmentPanel::Start);
  connect(session, &Session::environmentChanged, this, &EnvironmentPanel::Start);
  connect(session, &Session::methodsChanged, this,
    [this]()
    {
      if (this->Model->GetState().Lights != this->Drawn)
      {
        this->Start();
      }
    });
  connect(session, &Session::rotationChanged, this, &EnvironmentPanel::UpdateRotation);
  this->UpdateRotation();
}

//------------------------------------------------------------------------------
QLayout* EnvironmentPanel::MakeRow()
{
  auto* row = new QHBoxLayout;
  auto* label = new QLabel(tr("&Rotation"));
  label->setBuddy(this->Rotation);
  row->addWidget(label);
  row->addWidget(this->Rotation);
  row->addWidget(this->Lights);
  row->addWidget(this->Regions);
  row->addStretch(1);
  return row;
}

//------------------------------------------------------------------------------
void EnvironmentPanel::Start()
{
  this->Surroundings->setVisible(!this->Model->IsDirectional());
  this->Directional->setVisible(this->Model->IsDirectional());
  if (!this->Model->GetEnvironment())
  {
    this->Background->Stop("light map");
    return;
  }
  const auto environment =
    vtkSmartPointer<vtkEnvironment>::Take(this->Model->GetEnvironment()->NewSnapshot());
  environment->SetRotationY(0.0); // the view turns the picture
  tool::LightSetOptions options;
  options.Count = this->Drawn = this->Model->GetState().Lights;
  const bool withLights = this->Lights->isChecked();
  const bool withRegions = withLights && this->Regions->isChecked();
  this->Regions->setEnabled(withLights);
  this->Background->Start(
    "light map", tr("drawing the environment"),
    [this, environment, options, withLights, withRegions](JobThread& thread)
    {
      const auto lights =
        withLights ? tool::MakeLightSet(environment, options) : vtkSmartPointer<vtkLightSet>::New();
      const QImage image = MakeQImage(
        tool::DrawLightMap(environment, lights, withRegions, PictureWidth, PictureWidth / 2));
      const QString text =
        tr("%1 x %2 pixels").arg(environment->GetWidth()).arg(environment->GetHeight()) +
        (withLights ? tr("; %1 median-cut lights").arg(lights->GetNumberOfLights()) : QString());
      thread.Post(
        [this, image, text]()
        {
          this->View->SetImage(image);
          this->Text->setText(text);
        });
    },
    [this](const QString& text) { this->Model->Say(text, true); });
}

//------------------------------------------------------------------------------
void EnvironmentPanel::UpdateRotation()
{
  this->IsUpdating = true;
  this->Rotation->setValue(this->Model->GetState().Rotation);
  this->IsUpdating = false;
}
} // namespace explorer
