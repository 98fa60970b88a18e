// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SamplePanel.h"

#include "EditCommands.h"
#include "SampleModel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <QUndoStack>
#include <QVBoxLayout>

namespace explorer
{
//------------------------------------------------------------------------------
SamplePanel::SamplePanel(Session* session, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , Undo(new QUndoStack(this))
  , Samples(new SampleModel(session, Undo, this))
  , View(new QTableView)
  , Note(new QLabel)
  , RevertButton(new QPushButton(tr("Re&vert")))
{
  this->View->setModel(this->Samples);
  this->View->setAccessibleName(tr("Samples"));
  this->View->setWordWrap(false);
  QHeaderView* header = this->View->horizontalHeader();
  header->setSectionResizeMode(QHeaderView::Stretch);
  for (int column = 0; column < SampleModel::FirstColor; ++column) // what is left is the colors'
  {
    header->setSectionResizeMode(column, QHeaderView::Fixed);
    header->resizeSection(column, this->fontMetrics().horizontalAdvance("180.0°") + 8);
  }
  this->View->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed); // rows are not measured
  this->View->verticalHeader()->setDefaultSectionSize(this->fontMetrics().height() + 8);
  this->Note->setWordWrap(true);
  auto* lobe = new QPushButton(tr("Go to &lobe"));
  lobe->setToolTip(tr("The sample of the lobe's light and its mirror direction"));
  auto* slices = new QPushButton(tr("Go to &slices"));
  slices->setToolTip(tr("The sample where the slices cut"));
  this->RevertButton->setToolTip(tr("Take back all edits of this material"));
  auto* row = new QHBoxLayout;
  row->addWidget(lobe);
  row->addWidget(slices);
  row->addStretch(1);
  row->addWidget(this->RevertButton);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addLayout(row);
  layout->addWidget(this->View, 1);
  layout->addWidget(this->Note);
  connect(lobe, &QPushButton::clicked, this, &SamplePanel::GoToLobe);
  connect(slices, &QPushButton::clicked, this, &SamplePanel::GoToSlices);
  connect(this->RevertButton, &QPushButton::clicked, this, &SamplePanel::Revert);
  connect(session, &Session::materialChanged, this, &SamplePanel::Update);
  connect(session, &Session::editsChanged, this, &SamplePanel::Update);
  connect(session, &Session::replaced, this->Undo, &QUndoStack::clear); // its edits are others
  this->Update();
}

//------------------------------------------------------------------------------
void SamplePanel::Update()
{
  const State& state = this->Model->GetState();
  const auto edits = state.Edits.find(this->Model->GetOriginal().File);
  const int count = edits == state.Edits.end() ? 0 : static_cast<int>(edits->second.size());
  this->RevertButton->setEnabled(count > 0);
  this->Note->setText(QString::fromStdString(this->Samples->GetTable().GetNote()) +
                      (count > 0 ? tr(" Edited rows: %1.").arg(count) : QString()));
}

//------------------------------------------------------------------------------
QString SamplePanel::GetNote() const { return this->Note->text(); }

//------------------------------------------------------------------------------
void SamplePanel::GoToLobe() { this->GoTo({ 0.0, this->Model->GetState().LobeThetaI, 90.0 }); }

//------------------------------------------------------------------------------
void SamplePanel::GoToSlices()
{
  const State& state = this->Model->GetState();
  this->GoTo({ state.SliceThetaH, state.SliceThetaD, state.SlicePhiD });
}

//------------------------------------------------------------------------------
void SamplePanel::GoTo(const std::array<double, 3>& degrees)
{
  if (this->Samples->rowCount() == 0)
  {
    return;
  }
  const QModelIndex index = this->Samples->index(this->Samples->GetTable().FindRow(degrees), 3);
  this->View->setCurrentIndex(index);
  this->View->scrollTo(index, QAbstractItemView::PositionAtCenter);
  this->View->setFocus();
}

//------------------------------------------------------------------------------
void SamplePanel::Revert()
{
  if (this->RevertButton->isEnabled()) // else there is nothing to take back
  {
    this->Undo->push(new SetEdits(this->Model, this->Model->GetOriginal().File, {}));
  }
}
} // namespace explorer
