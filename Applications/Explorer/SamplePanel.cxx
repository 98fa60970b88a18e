// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SamplePanel.h"

#include "Controls.h"

#include <QFont>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <QUndoCommand>
#include <QUndoStack>

#include <filesystem>
#include <map>
#include <numeric>
#include <optional>

namespace explorer
{
namespace
{
constexpr int Columns = 6;

using Value = std::array<float, 3>;

/// Sets samples of a material; nothing in a value's place: as the material has it.
class EditSamples : public QUndoCommand
{
public:
  using Values = std::map<int, std::optional<Value>>; // by row

  EditSamples(Session* session, const QString& title, const Values& after)
    : QUndoCommand(title.arg(QString::fromStdString(
        std::filesystem::path(session->GetOriginal().File).filename().string())))
    , Model(session)
    , File(session->GetOriginal().File)
    , After(after)
  {
    const SampleEdits edits = FindEdits(session->GetState().Edits, this->File);
    for (const auto& [row, rgb] : after)
    {
      const auto found = edits.find(row);
      this->Before[row] = found == edits.end() ? std::optional<Value>() : found->second;
    }
  }

  void redo() override { this->Set(this->After); }
  void undo() override { this->Set(this->Before); }

private:
  void Set(const Values& values)
  {
    SampleEdits edits = FindEdits(this->Model->GetState().Edits, this->File);
    for (const auto& [row, rgb] : values)
    {
      edits.erase(row);
      if (rgb)
      {
        edits[row] = *rgb;
      }
    }
    this->Model->SetEdits(this->File, edits);
  }

  Session* Model;
  std::string File;
  Values Before;
  Values After;
};

//------------------------------------------------------------------------------
std::size_t CountEdits(const State& state)
{
  return std::accumulate(state.Edits.begin(), state.Edits.end(), std::size_t(0),
    [](std::size_t count, const auto& edits) { return count + edits.second.size(); });
}
}

//------------------------------------------------------------------------------
SampleModel::SampleModel(Session* session, QUndoStack* undo, QObject* parent)
  : QAbstractTableModel(parent)
  , Model(session)
  , Undo(undo)
{
  connect(session, &Session::materialChanged, this, &SampleModel::TakeMaterial);
  connect(session, &Session::editsChanged, this,
    [this]()
    {
      if (this->rowCount() > 0)
      {
        emit this->dataChanged(
          this->index(0, FirstColor), this->index(this->rowCount() - 1, Columns - 1));
      }
    });
}

//------------------------------------------------------------------------------
void SampleModel::TakeMaterial()
{
  const tool::Material& material = this->Model->GetOriginal();
  if (material.BRDF == this->Shown)
  {
    return; // its edits only
  }
  this->beginResetModel();
  this->Shown = material.BRDF;
  this->Table = SampleTable(material.BRDF);
  this->endResetModel();
}

//------------------------------------------------------------------------------
int SampleModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : this->Table.GetNumberOfRows();
}

//------------------------------------------------------------------------------
int SampleModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : Columns;
}

//------------------------------------------------------------------------------
const SampleEdits* SampleModel::FindEdits() const
{
  const auto& all = this->Model->GetState().Edits;
  const auto found = all.find(this->Model->GetOriginal().File);
  return this->Table.IsStored() && found != all.end() ? &found->second : nullptr;
}

//------------------------------------------------------------------------------
bool SampleModel::Find(int row, std::array<float, 3>& rgb) const
{
  const SampleEdits* edits = this->FindEdits();
  if (edits && edits->count(row) != 0)
  {
    rgb = edits->at(row);
    return true;
  }
  return this->Table.GetValue(row, rgb);
}

//------------------------------------------------------------------------------
QVariant SampleModel::data(const QModelIndex& index, int role) const
{
  if (!index.isValid())
  {
    return {};
  }
  const auto column = static_cast<std::size_t>(index.column());
  const bool isColor = index.column() >= FirstColor;
  if (role == Qt::TextAlignmentRole)
  {
    return static_cast<int>(Qt::AlignRight | Qt::AlignVCenter);
  }
  if (role == Qt::FontRole)
  {
    const SampleEdits* edits = this->FindEdits();
    QFont font;
    font.setBold(isColor && edits && edits->count(index.row()) != 0);
    return font;
  }
  if (role != Qt::DisplayRole && role != Qt::EditRole)
  {
    return {};
  }
  if (!isColor)
  {
    const double degrees = this->Table.GetAngles(index.row())[column];
    return QString::number(degrees, 'f', degrees < 10.0 ? 2 : 1) + "°";
  }
  Value rgb;
  if (!this->Find(index.row(), rgb))
  {
    return role == Qt::DisplayRole ? QString("–") : QString();
  }
  // Texts, so that the editor is a line that takes numbers of any size.
  const double value = rgb[column - FirstColor];
  return role == Qt::DisplayRole ? QString::number(value, 'g', 4) : QString::number(value, 'g', 9);
}

//------------------------------------------------------------------------------
QVariant SampleModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (role != Qt::DisplayRole)
  {
    return {};
  }
  return orientation == Qt::Horizontal
           ? QVariant(
               QString::fromStdString(this->Table.GetNames()[static_cast<std::size_t>(section)]))
           : QVariant(section + 1);
}

//------------------------------------------------------------------------------
Qt::ItemFlags SampleModel::flags(const QModelIndex& index) const
{
  Qt::ItemFlags flags = QAbstractTableModel::flags(index);
  if (index.isValid() && index.column() >= FirstColor && this->Table.IsStored() &&
      this->Table.IsAbove(index.row()))
  {
    flags |= Qt::ItemIsEditable;
  }
  return flags;
}

//------------------------------------------------------------------------------
bool SampleModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  if (role != Qt::EditRole || !(this->flags(index) & Qt::ItemIsEditable))
  {
    return false;
  }
  bool isNumber = false;
  const double number = value.toString().trimmed().toDouble(&isNumber);
  if (!isNumber || !(number >= 0.0 && number <= LargestSample))
  {
    this->Model->Say(tr("Row %1: found \"%2\", expected a number from 0 to %3")
                       .arg(index.row() + 1)
                       .arg(value.toString())
                       .arg(LargestSample, 0, 'g', 3),
      true);
    return false;
  }
  Value rgb = { 0.0f, 0.0f, 0.0f };
  this->Find(index.row(), rgb); // a sample that was not measured becomes one
  float& channel = rgb[static_cast<std::size_t>(index.column() - FirstColor)];
  if (channel == static_cast<float>(number))
  {
    return true;
  }
  const SampleEdits* edits = this->FindEdits();
  if (!(edits && edits->count(index.row()) != 0) &&
      CountEdits(this->Model->GetState()) >= MostEdits)
  {
    this->Model->Say(tr("At most %1 samples are edited; save the material and go on with its copy")
                       .arg(static_cast<int>(MostEdits)),
      true);
    return false;
  }
  channel = static_cast<float>(number);
  this->Undo->push(new EditSamples(
    this->Model, tr("row %1 of %2").arg(index.row() + 1), { { index.row(), rgb } }));
  return true;
}

//------------------------------------------------------------------------------
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
  auto* layout = MakeColumn(this);
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
  const auto count = static_cast<int>(
    FindEdits(this->Model->GetState().Edits, this->Model->GetOriginal().File).size());
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
  EditSamples::Values none;
  for (const auto& [row, rgb] :
    FindEdits(this->Model->GetState().Edits, this->Model->GetOriginal().File))
  {
    none[row] = std::nullopt;
  }
  if (!none.empty())
  {
    this->Undo->push(new EditSamples(this->Model, tr("all edits of %1"), none));
  }
}
} // namespace explorer
