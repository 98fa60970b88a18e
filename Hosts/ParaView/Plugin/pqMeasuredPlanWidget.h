// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   pqMeasuredPlanWidget
 * @brief   shows what the last picture of a measured material was drawn by
 *
 * ParaView asks for information properties when data change; a plan is made while the view renders.
 * The text is therefore asked for after each render.
 */

#ifndef pqMeasuredPlanWidget_h
#define pqMeasuredPlanWidget_h

#include "pqPropertyWidget.h"
#include "pqView.h"

#include <QPointer>

class QLabel;

class pqMeasuredPlanWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqMeasuredPlanWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

private Q_SLOTS:
  void watch(pqView* view);
  void refresh();

private:
  Q_DISABLE_COPY(pqMeasuredPlanWidget)

  QLabel* Label;
  QPointer<pqView> Watched;
};

#endif
