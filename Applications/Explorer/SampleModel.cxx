// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SampleModel.h"

#include "EditCommands.h"

#include <QFont>
#include <QUndoStack>

namespace
{
constexpr int Columns = 6;

using Value = std::array<float, 3>;

//------------------------------------------------------------------------------
std::size_t CountEdits(const explorer::State& state)
{
  std::size_t count = 0;
  for (const auto& [file, edits] : state.Edits)
  {
    count += edits.size();
  }
  return count;
}
}

namespace explorer
{
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
  this->Undo->push(new EditSample(this->Model, this->Model->GetOriginal().File, index.row(), rgb));
  return true;
}
} // namespace explorer
