// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The tolerance, what is planned for it, and what was measured of both sides.
 */

#ifndef PlanPanel_h
#define PlanPanel_h

#include "Evaluation.h"
#include "Session.h"
#include "Side.h"

#include <QWidget>

#include <array>

class QDoubleSpinBox;
class QLabel;
class QSlider;
class QTableWidget;

namespace explorer
{
class PlanPanel : public QWidget
{
  Q_OBJECT

public:
  PlanPanel(Session* session, std::array<Side*, 2> sides, Evaluation* evaluation,
    QWidget* parent = nullptr);

  QSlider* GetSlider() const { return this->Slider; }

  /// Time of a frame of the window.
  void SetFrameTime(double milliseconds);

private:
  void SetUpWidgets();
  void UpdateTolerance();
  void UpdatePlan();
  void UpdateFigures();

  Session* Model;
  std::array<Side*, 2> Sides;
  Evaluation* Measured;
  QSlider* Slider;
  QDoubleSpinBox* Percent;
  QLabel* Frame;
  QTableWidget* Figures;
  QLabel* Plan;
  QTableWidget* Candidates;
  bool IsUpdating = false;
};
} // namespace explorer

#endif
