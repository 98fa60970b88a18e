// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Controls.h"
#include "Measuring.h"
#include "Panels.h"
#include "SplitView.h"

#include "vtkRadiancePlanner.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QSlider>
#include <QTableWidget>

#include <algorithm>
#include <cmath>

namespace explorer
{
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
QString FormatError(double share)
{
  return share < 0.0 ? QString("–") : QString::fromStdString(tool::FormatPercent(share));
}

//------------------------------------------------------------------------------
QString FormatTime(double value) { return QString::fromStdString(tool::FormatMilliseconds(value)); }

//------------------------------------------------------------------------------
// Of a pixel, times a table's.
QString FormatCost(double value) { return QString::number(value, 'f', 2); }

//------------------------------------------------------------------------------
// The tolerance, in percent, by a slider and a field.
QLayout* MakeToleranceRow(Session* session)
{
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName("tolerance");
  slider->setRange(0, Steps);
  slider->setPageStep(StepsPerDecade / 4);
  slider->setTickInterval(StepsPerDecade);
  slider->setTickPosition(QSlider::TicksBelow);
  slider->setToolTip(
    QObject::tr("Error that a plan has to stay below, relative to the mean radiance"));
  slider->setAccessibleName(QObject::tr("Tolerance"));
  auto* percent = MakeField(0.1, 100.0, 2, 1.0, " %", "");
  percent->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  auto* row = new QHBoxLayout;
  AddNamed(row, QObject::tr("&Tolerance "), slider);
  row->addWidget(percent);
  row->setStretchFactor(slider, 1);
  QObject::connect(slider, &QSlider::valueChanged, session,
    [=](int value)
    { session->SetTolerance(std::pow(10.0, -3.0 + static_cast<double>(value) / StepsPerDecade)); });
  OnChange(percent, [=](double value) { session->SetTolerance(value / 100.0); });
  const auto update = [=]()
  {
    const double tolerance = session->GetState().Tolerance;
    Show(slider, std::round((std::log10(tolerance) + 3.0) * StepsPerDecade));
    Show(percent, 100.0 * tolerance);
  };
  QObject::connect(session, &Session::toleranceChanged, slider, update);
  update();
  return row;
}

//------------------------------------------------------------------------------
// What was predicted and measured of both sides.
void ShowFigures(
  QTableWidget* table, const std::array<Side*, 2>& sides, const Evaluation& evaluation)
{
  for (int k = 0; k < 2; ++k)
  {
    const Side* side = sides[static_cast<std::size_t>(k)];
    vtkRadiancePlanner* planner = side->IsReference() ? nullptr : side->GetPlanner();
    const int choice = planner && side->IsReady() ? planner->GetChoice() : -1;
    const SideFigures& figures = evaluation.GetFigures(k);
    SetCell(table, 0, k + 1, FormatError(choice < 0 ? -1.0 : planner->GetPredictedError(choice)));
    SetCell(table, 1, k + 1,
      side->IsReference()    ? QObject::tr("exact")
      : figures.Error >= 0.0 ? FormatError(figures.Error)
                             : QObject::tr("…"));
    SetCell(
      table, 2, k + 1, choice < 0 ? QString("–") : FormatCost(planner->GetPredictedCost(choice)));
    SetCell(table, 3, k + 1, figures.Frame > 0.0 ? FormatTime(figures.Frame) : QString("–"));
  }
  const tool::Size& size = evaluation.GetSize();
  table->setToolTip(
    QObject::tr("Errors are relative L1: mean |x - r| / mean r. Predicted: over a sphere seen from "
                "everywhere. Measured: of this view in %1 x %2 pixels, where the exact picture and "
                "the frame are made")
      .arg(size.Width)
      .arg(size.Height));
}

//------------------------------------------------------------------------------
void ShowCandidates(QTableWidget* table, vtkRadiancePlanner* planner)
{
  table->setRowCount(planner->GetNumberOfCandidates());
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    const bool chosen = k == planner->GetChoice();
    const double megabytes = 1e-6 * static_cast<double>(planner->GetTextureBytes(k));
    const QString texts[] = { (chosen ? QString("▸ ") : QString()) +
                                QString::fromStdString(planner->GetMethodName(k)),
      FormatError(planner->GetPredictedError(k)), FormatCost(planner->GetPredictedCost(k)),
      QString::number(megabytes, 'f', 2), FormatTime(planner->GetSetUpMilliseconds(k)),
      QString::fromStdString(planner->GetDescription(k)) };
    for (int column = 0; column <= SizesColumn; ++column)
    {
      SetCell(table, k, column, texts[column], chosen);
    }
    if (chosen)
    {
      table->scrollToItem(table->item(k, 0));
    }
  }
  table->setToolTip(QObject::tr(
    "Candidates that were tried, the cheapest first. Cost: of a pixel, times a table's"));
}
}

//------------------------------------------------------------------------------
QWidget* MakePlanPanel(
  Session* session, std::array<Side*, 2> sides, Evaluation* evaluation, SplitView* view)
{
  auto* panel = new QWidget;
  auto* figures =
    MakeTable({ "", QObject::tr("A"), QObject::tr("B") }, QObject::tr("Figures of both sides"));
  figures->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  figures->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  const QStringList rows = { QObject::tr("Error, predicted"), QObject::tr("Error, measured"),
    QObject::tr("Cost, predicted"), QObject::tr("Frame, measured") };
  figures->setRowCount(rows.size());
  for (int k = 0; k < rows.size(); ++k)
  {
    SetCell(figures, k, 0, rows[k]);
  }
  FitHeight(figures, rows.size());
  auto* plan = new QLabel;
  plan->setWordWrap(true);
  plan->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  plan->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  auto* candidates = MakeTable({ QObject::tr("Method"), QObject::tr("Error"), QObject::tr("Cost"),
                                 QObject::tr("MB"), QObject::tr("Set-up"), QObject::tr("Sizes") },
    QObject::tr("Candidates of the plan"));
  candidates->horizontalHeader()->setStretchLastSection(true);
  auto* frame = new QLabel(QString("–"));
  auto* layout = MakeColumn(panel);
  layout->addLayout(MakeToleranceRow(session));
  layout->addWidget(figures);
  layout->addWidget(plan);
  layout->addWidget(candidates, 1);
  layout->addWidget(frame);

  const auto update = [=]()
  {
    ShowFigures(figures, sides, *evaluation);
    const auto planned = std::find_if(sides.begin(), sides.end(),
      [](Side* side) { return side->GetPlanner() && side->GetPlanner()->GetChoice() >= 0; });
    if (planned == sides.end())
    {
      candidates->setRowCount(0);
      plan->setText(
        session->IsDirectional()
          ? QObject::tr("No plan: under one directional light there is nothing to integrate.")
          : QObject::tr("No plan: neither side is planned, or the plan is being made."));
      return;
    }
    vtkRadiancePlanner* planner = (*planned)->GetPlanner();
    plan->setText(
      ((*planned)->IsReady() ? QString()
                             : QObject::tr("(a new plan, or its picture, is being made) ")) +
      QString::fromStdString(planner->GetReason()));
    ShowCandidates(candidates, planner);
  };
  for (Side* side : sides)
  {
    QObject::connect(side, &Side::changed, panel, update);
  }
  QObject::connect(evaluation, &Evaluation::changed, panel, update);
  QObject::connect(view, &SplitView::framed, panel,
    [=](double milliseconds)
    { frame->setText(QObject::tr("Last frame of the window: %1").arg(FormatTime(milliseconds))); });
  update();
  return panel;
}
} // namespace explorer
