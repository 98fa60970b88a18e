// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqMeasuredPlanWidget.h"

#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QLabel>
#include <QVBoxLayout>

//------------------------------------------------------------------------------
pqMeasuredPlanWidget::pqMeasuredPlanWidget(
  vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
  , Label(new QLabel(this))
{
  this->setProperty(property);
  this->setShowLabel(true);
  this->Label->setObjectName("Plan");
  this->Label->setWordWrap(true);
  this->Label->setTextFormat(Qt::PlainText);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Label);
  QObject::connect(this, &pqPropertyWidget::viewChanged, this, &pqMeasuredPlanWidget::watch);
  this->refresh();
}

//------------------------------------------------------------------------------
void pqMeasuredPlanWidget::watch(pqView* view)
{
  if (this->Watched)
  {
    QObject::disconnect(this->Watched, nullptr, this, nullptr);
  }
  this->Watched = view;
  if (view)
  {
    QObject::connect(view, &pqView::endRender, this, &pqMeasuredPlanWidget::refresh);
    this->refresh();
  }
}

//------------------------------------------------------------------------------
void pqMeasuredPlanWidget::refresh()
{
  this->proxy()->UpdatePropertyInformation();
  const char* text = vtkSMPropertyHelper(this->property()).GetAsString();
  this->Label->setText(QString::fromUtf8(text ? text : ""));
}
