// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Controls.h"
#include "Panels.h"
#include "Sheets.h"

#include <QHBoxLayout>
#include <QToolButton>

#include <cmath>

namespace explorer
{
QWidget* MakePictureBar(Session* session)
{
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(6, 3, 6, 3);
  std::array<QComboBox*, 2> methods;
  for (int k = 0; k < 2; ++k)
  {
    auto* list = new QComboBox;
    for (const MethodName& name : GetMethodNames())
    {
      list->addItem(QString::fromStdString(name.Name), QString::fromStdString(name.Key));
      list->setItemData(
        list->count() - 1, QString::fromStdString(name.Description), Qt::ToolTipRole);
    }
    list->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    list->setMinimumContentsLength(10);
    list->setToolTip(k == 0 ? QObject::tr("What the left side is drawn by")
                            : QObject::tr("What the right side is drawn by"));
    list->setAccessibleName(k == 0 ? QObject::tr("Method A") : QObject::tr("Method B"));
    list->setObjectName(k == 0 ? "method A" : "method B");
    AddNamed(row, k == 0 ? QObject::tr("&A") : QObject::tr("&B"), list);
    OnChange(
      list, [=](const QVariant& key) { session->SetMethod(k, key.toString().toStdString()); });
    methods[static_cast<std::size_t>(k)] = list;
  }
  auto* lights = new QComboBox;
  for (int count = 1; count <= MostLights; count *= 2)
  {
    lights->addItem(QString::number(count), count);
  }
  lights->setToolTip(QObject::tr(
    "How many lights stand for the environment: of the light set, soft lights and the thesis"));
  lights->setAccessibleName(QObject::tr("Number of lights"));
  auto* difference = new QToolButton;
  difference->setText(QObject::tr("Difference"));
  difference->setCheckable(true);
  difference->setToolTip(QObject::tr("Show |A - B| instead of the pictures (Ctrl+D)"));
  auto* exposure = MakeField(-MostStops, MostStops, 1, 0.5, "",
    QObject::tr("Exposure of both sides in stops; at 0 the picture is that of the mapper"));
  exposure->setKeyboardTracking(true);
  exposure->setAccessibleName(QObject::tr("Exposure"));
  auto* fit = new QToolButton;
  fit->setText(QObject::tr("Fit"));
  fit->setToolTip(QObject::tr(
    "The exposure that shows a white matte surface as 70 % of white in this environment"));
  AddNamed(row, QObject::tr("&Lights"), lights);
  row->addWidget(difference);
  AddNamed(row, QObject::tr("E&xposure"), exposure);
  row->addWidget(fit);
  row->addStretch(1);

  OnChange(lights, [=](const QVariant& count) { session->SetLights(count.toInt()); });
  OnChange(difference, [=](bool on) { session->SetShown(on ? Shown::Difference : Shown::Split); });
  OnChange(exposure, [=](double stops) { session->SetExposure(stops); });
  QObject::connect(fit, &QToolButton::clicked, session,
    [=]() { session->SetExposure(std::log2(tool::ChooseExposure(session->GetEnvironment()))); });
  const auto update = [=]()
  {
    const State& state = session->GetState();
    for (std::size_t k = 0; k < 2; ++k)
    {
      Show(methods[k], QString::fromStdString(state.Methods[k]));
    }
    Show(lights, state.Lights);
    lights->setEnabled(!session->IsDirectional()); // there is one, whatever is chosen
    Show(difference, state.Show == Shown::Difference);
    Show(exposure, state.Exposure);
    fit->setEnabled(session->GetEnvironment() != nullptr);
  };
  for (const auto signal :
    { &Session::methodsChanged, &Session::pictureChanged, &Session::environmentChanged })
  {
    QObject::connect(session, signal, bar, update);
  }
  update();
  return bar;
}
} // namespace explorer
