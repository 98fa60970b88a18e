// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Samples.h"

#include "Controls.h"
#include "HalfVector.h"
#include "Tool.h"

#include <QFont>
#include <QHeaderView>
#include <QPushButton>
#include <QUndoCommand>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

namespace explorer
{
namespace
{
constexpr std::int64_t MostRows = 20000000; // that a view can scroll through
constexpr std::array<int, 3> MerlDimensions = { 180, 90, 90 };
constexpr int Columns = 6;
constexpr int MostUndone = 500; // each keeps all edits of its material

/// Sets the edits of a material.
class EditSamples : public QUndoCommand
{
public:
  EditSamples(Session* session, const QString& title, SampleEdits after)
    : QUndoCommand(title)
    , Model(session)
    , File(session->GetOriginal().File)
    , Before(FindEdits(session->GetState().Edits, this->File))
    , After(std::move(after))
  {
  }

  void redo() override { this->Model->SetEdits(this->File, this->After); }
  void undo() override { this->Model->SetEdits(this->File, this->Before); }

private:
  Session* Model;
  std::string File;
  SampleEdits Before, After;
};
}

//------------------------------------------------------------------------------
SampleTable::SampleTable(vtkBRDF* brdf)
  : BRDF(brdf)
  , Table(vtkTabulatedBRDF::SafeDownCast(brdf))
{
  if (this->Table)
  {
    std::copy_n(this->Table->GetDimensions(), 3, this->Dimensions.begin());
    this->Parameterization = this->Table->GetParameterization();
    this->AzimuthRange = this->Table->GetAzimuthRange();
  }
  else if (brdf)
  {
    this->Dimensions = MerlDimensions;
  }
}

//------------------------------------------------------------------------------
int SampleTable::GetNumberOfRows() const
{
  const auto& n = this->Dimensions;
  return static_cast<int>(std::min(static_cast<std::int64_t>(n[0]) * n[1] * n[2], MostRows));
}

//------------------------------------------------------------------------------
std::array<const char*, 6> SampleTable::GetNames() const
{
  return this->Parameterization == vtkTabulatedBRDF::HALF_DIFFERENCE
           ? std::array<const char*, 6>{ "θh", "θd", "φd", "Red", "Green", "Blue" }
           : std::array<const char*, 6>{ "θi", "θo", "Δφ", "Red", "Green", "Blue" };
}

//------------------------------------------------------------------------------
// As vtkTabulatedBRDF places its samples.
std::array<double, 3> SampleTable::GetAngles(int row) const
{
  const auto& n = this->Dimensions;
  const double azimuth = (row % n[0] + 0.5) / n[0];
  const double second = (row / n[0] % n[1] + 0.5) / n[1];
  const double first = (row / n[0] / n[1] + 0.5) / n[2];
  const bool isHalf = this->Parameterization == vtkTabulatedBRDF::HALF_DIFFERENCE;
  const double turn = this->AzimuthRange == vtkTabulatedBRDF::HALF_TURN ? 180.0 : 360.0;
  return { 90.0 * (isHalf ? first * first : first), 90.0 * second, turn * azimuth };
}

//------------------------------------------------------------------------------
bool SampleTable::GetDirections(int row, double i[3], double o[3]) const
{
  const auto& n = this->Dimensions;
  return vtkTabulatedBRDF::GetCellDirections(this->Parameterization, this->AzimuthRange, n.data(),
    row % n[0], row / n[0] % n[1], row / n[0] / n[1], i, o);
}

//------------------------------------------------------------------------------
bool SampleTable::IsAbove(int row) const
{
  double i[3], o[3];
  return this->GetDirections(row, i, o);
}

//------------------------------------------------------------------------------
std::optional<SampleTable::Value> SampleTable::GetValue(int row) const
{
  double i[3], o[3], f[3];
  if (!this->GetDirections(row, i, o))
  {
    return std::nullopt;
  }
  if (this->Table)
  {
    std::copy_n(&this->Table->GetVolume()[3 * static_cast<std::size_t>(row)], 3, f);
  }
  else
  {
    this->BRDF->Evaluate(i, o, f);
  }
  if (!std::isfinite(f[0] + f[1] + f[2])) // not measured
  {
    return std::nullopt;
  }
  return Value{ static_cast<float>(f[0]), static_cast<float>(f[1]), static_cast<float>(f[2]) };
}

//------------------------------------------------------------------------------
int SampleTable::FindRow(const std::array<double, 3>& degrees) const
{
  using namespace measuredbrdf;
  const double turn = this->AzimuthRange == vtkTabulatedBRDF::HALF_TURN ? 180.0 : 360.0;
  double shares[3] = { degrees[2] / turn, degrees[1] / 90.0, std::sqrt(degrees[0] / 90.0) };
  if (this->Parameterization != vtkTabulatedBRDF::HALF_DIFFERENCE)
  {
    glm::dvec3 i, o;
    FromHalfDifference(
      { ToRadians(degrees[0]), ToRadians(degrees[1]), ToRadians(degrees[2]) }, i, o);
    const auto theta = [](const glm::dvec3& direction)
    { return ToDegrees(std::acos(std::clamp(direction.z, -1.0, 1.0))); };
    shares[0] = // of half a turn
      ToDegrees(std::abs(std::atan2(i.x * o.y - i.y * o.x, i.x * o.x + i.y * o.y))) / turn;
    shares[1] = theta(o) / 90.0;
    shares[2] = theta(i) / 90.0;
  }
  std::int64_t row = 0;
  for (const int k : { 2, 1, 0 })
  {
    const std::int64_t count = this->Dimensions[static_cast<std::size_t>(k)];
    row = row * count + std::clamp<std::int64_t>(
                          std::llround(shares[k] * static_cast<double>(count) - 0.5), 0, count - 1);
  }
  return static_cast<int>(std::min<std::int64_t>(row, this->GetNumberOfRows() - 1));
}

//------------------------------------------------------------------------------
std::string SampleTable::GetNote() const
{
  if (!this->BRDF)
  {
    return "";
  }
  if (!this->Table)
  {
    return std::string("This material is no table of theta_h, theta_d and phi_d, or of theta_i, "
                       "theta_o and phi: f is evaluated at the angles of MERL's tables") +
           (this->BRDF->IsIsotropic() ? "" : ", with the half vector over the tangent") +
           ". It cannot be edited.";
  }
  return std::string(this->Table->GetCosineWeighted() ? "The table holds f cos(theta_o), in 1/sr."
                                                      : "The table holds f, in 1/sr.") +
         " Edits are made in a copy; the file stays as it is.";
}

//------------------------------------------------------------------------------
tool::Material ApplyEdits(const tool::Material& original, const SampleEdits& edits)
{
  if (edits.empty())
  {
    return original;
  }
  tool::Material edited = original;
  auto copy = vtkSmartPointer<vtkBRDF>::Take(original.BRDF->NewSnapshot());
  auto* table = vtkTabulatedBRDF::SafeDownCast(copy);
  const int count = table ? SampleTable(table).GetNumberOfRows() : 0;
  const auto last = edits.lower_bound(count);
  if (last != edits.end())
  {
    edited.Notes += (edited.Notes.empty() ? "" : " ") + original.File + ": " +
                    std::to_string(std::distance(last, edits.end())) +
                    " of its edits are for no row of its table, which has " +
                    std::to_string(count) + ", and are left out.";
  }
  if (last == edits.begin())
  {
    return edited;
  }
  std::vector<float> volume = table->GetVolume();
  for (auto edit = edits.begin(); edit != last; ++edit)
  {
    std::copy_n(edit->second.begin(), 3, &volume[3 * static_cast<std::size_t>(edit->first)]);
  }
  int dimensions[3];
  std::copy_n(table->GetDimensions(), 3, dimensions);
  if (!table->SetVolume(
        table->GetParameterization(), table->GetAzimuthRange(), dimensions, std::move(volume)))
  {
    throw tool::Error(original.File + ": editing: " + tool::TakeErrorText());
  }
  edited.Name += " (edited)";
  table->SetName(edited.Name);
  edited.BRDF = table;
  return edited;
}

//------------------------------------------------------------------------------
SampleModel::SampleModel(Session* session, QUndoStack* undo, QObject* parent)
  : QAbstractTableModel(parent)
  , Model(session)
  , Undo(undo)
{
  connect(session, &Session::materialChanged, this,
    [this]()
    {
      vtkBRDF* brdf = this->Model->GetOriginal().BRDF;
      if (brdf != this->Shown) // not its edits only
      {
        this->beginResetModel();
        this->Shown = brdf;
        this->Table = SampleTable(brdf);
        this->endResetModel();
      }
    });
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
const SampleEdits& SampleModel::GetEdits() const
{
  return FindEdits(this->Model->GetState().Edits, this->Model->GetOriginal().File);
}

//------------------------------------------------------------------------------
void SampleModel::Push(const QString& title, const SampleEdits& edits)
{
  const std::filesystem::path file(this->Model->GetOriginal().File);
  this->Undo->push(new EditSamples(
    this->Model, title.arg(QString::fromStdString(file.filename().string())), edits));
}

//------------------------------------------------------------------------------
void SampleModel::Revert()
{
  if (!this->GetEdits().empty())
  {
    this->Push(tr("all edits of %1"), {});
  }
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
  const SampleEdits& edits = this->GetEdits();
  const auto edit = this->Table.IsStored() ? edits.find(index.row()) : edits.end();
  if (role == Qt::FontRole)
  {
    QFont font;
    font.setBold(isColor && edit != edits.end());
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
  const auto rgb =
    edit != edits.end() ? std::optional(edit->second) : this->Table.GetValue(index.row());
  // Texts, so that the editor is a line that takes numbers of any size.
  const int digits = role == Qt::DisplayRole ? 4 : 9;
  return rgb                       ? QString::number((*rgb)[column - FirstColor], 'g', digits)
         : role == Qt::DisplayRole ? QString("–")
                                   : QString();
}

//------------------------------------------------------------------------------
QVariant SampleModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (role != Qt::DisplayRole)
  {
    return {};
  }
  return orientation == Qt::Horizontal
           ? QVariant(this->Table.GetNames()[static_cast<std::size_t>(section)])
           : QVariant(section + 1);
}

//------------------------------------------------------------------------------
Qt::ItemFlags SampleModel::flags(const QModelIndex& index) const
{
  const bool isEditable = index.isValid() && index.column() >= FirstColor &&
                          this->Table.IsStored() && this->Table.IsAbove(index.row());
  return QAbstractTableModel::flags(index) | (isEditable ? Qt::ItemIsEditable : Qt::NoItemFlags);
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
  SampleEdits edits = this->GetEdits();
  const bool isNew = edits.count(index.row()) == 0;
  // A sample that was not measured becomes one.
  auto& rgb =
    edits.emplace(index.row(), this->Table.GetValue(index.row()).value_or(SampleTable::Value{}))
      .first->second;
  float& channel = rgb[static_cast<std::size_t>(index.column() - FirstColor)];
  if (channel == static_cast<float>(number))
  {
    return true;
  }
  std::size_t count = 0;
  for (const auto& [file, list] : this->Model->GetState().Edits)
  {
    count += list.size();
  }
  if (isNew && count >= MostEdits)
  {
    this->Model->Say(tr("At most %1 samples are edited; save the material and go on with its copy")
                       .arg(static_cast<int>(MostEdits)),
      true);
    return false;
  }
  channel = static_cast<float>(number);
  this->Push(tr("row %1 of %2").arg(index.row() + 1), edits);
  return true;
}

//------------------------------------------------------------------------------
SamplePanel::SamplePanel(Session* session)
  : Model(session)
  , Undo(new QUndoStack(this))
  , Samples(new SampleModel(session, Undo, this))
  , View(new QTableView)
  , Note(new QLabel)
{
  this->Undo->setUndoLimit(MostUndone);
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
  auto* row = new QHBoxLayout;
  const auto add = [&](const QString& text, const QString& toolTip, const auto& what)
  {
    auto* button = new QPushButton(text);
    button->setToolTip(toolTip);
    row->addWidget(button);
    connect(button, &QPushButton::clicked, this, what);
    return button;
  };
  add(tr("Go to &lobe"), tr("The sample of the lobe's light and its mirror direction"),
    [this]() { this->GoToLobe(); });
  add(tr("Go to &slices"), tr("The sample where the slices cut"), [this]() { this->GoToSlices(); });
  row->addStretch(1);
  auto* revert = add(tr("Re&vert"), tr("Take back all edits of this material"),
    [this]() { this->Samples->Revert(); });
  auto* layout = MakeColumn(this);
  layout->addLayout(row);
  layout->addWidget(this->View, 1);
  layout->addWidget(this->Note);
  Follow(session, this, { &Session::materialChanged, &Session::editsChanged },
    [this, revert]()
    {
      const auto count = static_cast<int>(this->Samples->GetEdits().size());
      revert->setEnabled(count > 0);
      this->Note->setText(QString::fromStdString(this->Samples->GetTable().GetNote()) +
                          (count > 0 ? tr(" Edited rows: %1.").arg(count) : QString()));
    });
  connect(session, &Session::replaced, this->Undo, &QUndoStack::clear); // its edits are others
}

//------------------------------------------------------------------------------
void SamplePanel::GoToSlices()
{
  const State& state = this->Model->GetState();
  this->GoTo({ state.SliceThetaH, state.SliceThetaD, state.SlicePhiD });
}

//------------------------------------------------------------------------------
void SamplePanel::GoTo(const std::array<double, 3>& degrees)
{
  if (this->Samples->rowCount() > 0)
  {
    const QModelIndex index = this->Samples->index(this->Samples->GetTable().FindRow(degrees), 3);
    this->View->setCurrentIndex(index);
    this->View->scrollTo(index, QAbstractItemView::PositionAtCenter);
    this->View->setFocus();
  }
}
} // namespace explorer
