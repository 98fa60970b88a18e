// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanPanel.h"

#include "Measuring.h"

#include "vtkRadiancePlanner.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QGroupBox>
#include <QHeaderView>
#include <QLabel>
#include <QSlider>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace
{
constexpr int StepsPerDecade = 40; // of the slider, from 0.1 % to 100 %
constexpr int Steps = 3 * StepsPerDecade;
constexpr int SizesColumn = 5; // words, not figures

//------------------------------------------------------------------------------
QTableWidget* MakeTable(const QStringList& columns, const QString& name)
{
  auto* table = new QTableWidget(0, columns.size());
  table->setHorizontalHeaderLabels(columns);
  table->setAccessibleName(name);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setWordWrap(false);
  table->verticalHeader()->hide();
  table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table->verticalHeader()->setDefaultSectionSize(table->fontMetrics().height() + 8);
  return table;
}

//------------------------------------------------------------------------------
void SetCell(QTableWidget* table, int row, int column, const QString& text, bool bold = false)
{
  QTableWidgetItem* item = table->item(row, column);
  if (!item)
  {
    item = new QTableWidgetItem;
    table->setItem(row, column, item);
  }
  if (column > 0 && column != SizesColumn)
  {
    item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  }
  QFont font = table->font();
  font.setBold(bold);
  item->setFont(font);
  item->setText(text);
  item->setToolTip(text);
}

//------------------------------------------------------------------------------
// As high as its rows: it needs no scroll bar of its own.
void FitHeight(QTableWidget* table, int mostRows)
{
  const int rows = std::min(table->rowCount(), mostRows);
  table->setFixedHeight(table->horizontalHeader()->sizeHint().height() +
                        rows * table->verticalHeader()->defaultSectionSize() +
                        2 * table->frameWidth() + 2);
}

//------------------------------------------------------------------------------
QString Percent(double share)
{
  return share < 0.0 ? QString("–") : QString::fromStdString(tool::FormatPercent(share));
}

//------------------------------------------------------------------------------
QString Milliseconds(double value)
{
  return QString::fromStdString(tool::FormatMilliseconds(value));
}

//------------------------------------------------------------------------------
// Of a pixel, times a table's.
QString Cost(double value) { return QString::number(value, 'f', 2); }
}

namespace explorer
{
//------------------------------------------------------------------------------
PlanPanel::PlanPanel(
  Session* session, std::array<Side*, 2> sides, Evaluation* evaluation, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , Sides(sides)
  , Measured(evaluation)
  , Slider(new QSlider(Qt::Horizontal))
  , Percent(new QDoubleSpinBox)
  , Frame(new QLabel(QString("–")))
  , Figures(MakeTable({ "", tr("A"), tr("B") }, tr("Figures of both sides")))
  , Plan(new QLabel)
  , Candidates(
      MakeTable({ tr("Method"), tr("Error"), tr("Cost"), tr("MB"), tr("Set-up"), tr("Sizes") },
        tr("Candidates of the plan")))
{
  this->SetUpWidgets();
  auto* tolerance = new QHBoxLayout;
  auto* label = new QLabel(tr("&Tolerance "));
  label->setBuddy(this->Slider);
  tolerance->addWidget(label);
  tolerance->addWidget(this->Slider, 1);
  tolerance->addWidget(this->Percent);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addLayout(tolerance);
  layout->addWidget(this->Figures);
  layout->addWidget(this->Plan);
  layout->addWidget(this->Candidates, 1);
  layout->addWidget(this->Frame);
  const QStringList rows = { tr("Error, predicted"), tr("Error, measured"), tr("Cost, predicted"),
    tr("Frame, measured") };
  this->Figures->setRowCount(rows.size());
  for (int k = 0; k < rows.size(); ++k)
  {
    SetCell(this->Figures, k, 0, rows[k]);
  }
  FitHeight(this->Figures, rows.size());

  connect(this->Slider, &QSlider::valueChanged, this,
    [this](int value)
    {
      if (!this->IsUpdating)
      {
        this->Model->SetTolerance(
          std::pow(10.0, -3.0 + static_cast<double>(value) / StepsPerDecade));
      }
    });
  connect(this->Percent, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double value)
    {
      if (!this->IsUpdating)
      {
        this->Model->SetTolerance(value / 100.0);
      }
    });
  connect(session, &Session::toleranceChanged, this, &PlanPanel::UpdateTolerance);
  for (Side* side : sides)
  {
    connect(side, &Side::changed, this, &PlanPanel::UpdatePlan);
  }
  connect(evaluation, &Evaluation::changed, this, &PlanPanel::UpdatePlan);
  this->UpdateTolerance();
  this->UpdatePlan();
}

//------------------------------------------------------------------------------
void PlanPanel::SetUpWidgets()
{
  this->Slider->setRange(0, Steps);
  this->Slider->setPageStep(StepsPerDecade / 4);
  this->Slider->setTickInterval(StepsPerDecade);
  this->Slider->setTickPosition(QSlider::TicksBelow);
  this->Slider->setToolTip(
    tr("Error that a plan has to stay below, relative to the mean radiance"));
  this->Slider->setAccessibleName(tr("Tolerance"));
  this->Percent->setRange(0.1, 100.0);
  this->Percent->setDecimals(2);
  this->Percent->setSuffix(" %");
  this->Percent->setKeyboardTracking(false);
  this->Percent->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  this->Plan->setWordWrap(true);
  this->Plan->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  this->Plan->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  this->Candidates->horizontalHeader()->setStretchLastSection(true);
  this->Figures->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  this->Figures->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
}

//------------------------------------------------------------------------------
void PlanPanel::UpdateTolerance()
{
  this->IsUpdating = true;
  const double tolerance = this->Model->GetState().Tolerance;
  this->Slider->setValue(
    static_cast<int>(std::lround((std::log10(tolerance) + 3.0) * StepsPerDecade)));
  this->Percent->setValue(100.0 * tolerance);
  this->IsUpdating = false;
}

//------------------------------------------------------------------------------
// Of the first side that is planned.
void PlanPanel::UpdatePlan()
{
  this->UpdateFigures();
  const auto planned = std::find_if(this->Sides.begin(), this->Sides.end(),
    [](Side* side) { return side->GetPlanner() && side->GetPlanner()->GetChoice() >= 0; });
  if (planned == this->Sides.end())
  {
    this->Candidates->setRowCount(0);
    this->Plan->setText(
      this->Model->IsDirectional()
        ? tr("No plan: under one directional light there is nothing to integrate.")
        : tr("No plan: neither side is planned, or the plan is being made."));
    return;
  }
  vtkRadiancePlanner* planner = (*planned)->GetPlanner();
  this->Plan->setText(QString("%1%2").arg(
    (*planned)->IsReady() ? QString() : tr("(a new plan, or its picture, is being made) "),
    QString::fromStdString(planner->GetReason())));
  this->Candidates->setRowCount(planner->GetNumberOfCandidates());
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    const bool chosen = k == planner->GetChoice();
    const QString name = QString::fromStdString(planner->GetMethodName(k));
    SetCell(this->Candidates, k, 0, (chosen ? QString("▸ ") : QString()) + name, chosen);
    SetCell(this->Candidates, k, 1, ::Percent(planner->GetPredictedError(k)), chosen);
    SetCell(this->Candidates, k, 2, Cost(planner->GetPredictedCost(k)), chosen);
    SetCell(this->Candidates, k, 3,
      QString::number(1e-6 * static_cast<double>(planner->GetTextureBytes(k)), 'f', 2), chosen);
    SetCell(this->Candidates, k, 4, Milliseconds(planner->GetSetUpMilliseconds(k)), chosen);
    SetCell(this->Candidates, k, 5, QString::fromStdString(planner->GetDescription(k)), chosen);
    if (chosen)
    {
      this->Candidates->scrollToItem(this->Candidates->item(k, 0));
    }
  }
  this->Candidates->setToolTip(
    tr("Candidates that were tried, the cheapest first. Cost: of a pixel, times a table's"));
}

//------------------------------------------------------------------------------
void PlanPanel::UpdateFigures()
{
  for (int k = 0; k < 2; ++k)
  {
    const Side* side = this->Sides[static_cast<std::size_t>(k)];
    vtkRadiancePlanner* planner = side->IsReference() ? nullptr : side->GetPlanner();
    const int choice = planner && side->IsReady() ? planner->GetChoice() : -1;
    const SideFigures& figures = this->Measured->GetFigures(k);
    SetCell(
      this->Figures, 0, k + 1, ::Percent(choice < 0 ? -1.0 : planner->GetPredictedError(choice)));
    SetCell(this->Figures, 1, k + 1,
      side->IsReference()    ? tr("exact")
      : figures.Error >= 0.0 ? ::Percent(figures.Error)
                             : tr("…"));
    SetCell(
      this->Figures, 2, k + 1, choice < 0 ? QString("–") : Cost(planner->GetPredictedCost(choice)));
    SetCell(
      this->Figures, 3, k + 1, figures.Frame > 0.0 ? Milliseconds(figures.Frame) : QString("–"));
  }
  const tool::Size& size = this->Measured->GetSize();
  this->Figures->setToolTip(
    tr("Errors are relative L1: mean |x - r| / mean r. Predicted: over a sphere seen from "
       "everywhere. Measured: "
       "of this view in %1 x %2 pixels, where the exact picture and the frame are made")
      .arg(size.Width)
      .arg(size.Height));
}

//------------------------------------------------------------------------------
void PlanPanel::SetFrameTime(double milliseconds)
{
  this->Frame->setText(tr("Last frame of the window: %1").arg(Milliseconds(milliseconds)));
}
} // namespace explorer
