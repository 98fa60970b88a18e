// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Samples.h"

#include "Controls.h"
#include "HalfVector.h"

#include <QHeaderView>
#include <QPushButton>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace explorer
{
namespace
{
constexpr std::int64_t MostRows = 20000000; // that a view can scroll through
constexpr std::array<int, 3> MerlDimensions = { 180, 90, 90 };
constexpr int Columns = 6;
constexpr int FirstColor = 3; // of the columns; those before it are angles
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
std::optional<SampleTable::Value> SampleTable::GetValue(int row) const
{
  double i[3], o[3], f[3];
  const auto& n = this->Dimensions;
  if (!vtkTabulatedBRDF::GetCellDirections(this->Parameterization, this->AzimuthRange, n.data(),
        row % n[0], row / n[0] % n[1], row / n[0] / n[1], i, o))
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
           (this->BRDF->IsIsotropic() ? "." : ", with the half vector over the tangent.");
  }
  return this->Table->GetCosineWeighted() ? "The table holds f cos(theta_o), in 1/sr."
                                          : "The table holds f, in 1/sr.";
}

//------------------------------------------------------------------------------
SampleModel::SampleModel(Session* session, QObject* parent)
  : QAbstractTableModel(parent)
{
  connect(session, &Session::materialChanged, this,
    [this, session]()
    {
      this->beginResetModel();
      this->Table = SampleTable(session->GetMaterial().BRDF);
      this->endResetModel();
    });
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
  if (role == Qt::TextAlignmentRole)
  {
    return static_cast<int>(Qt::AlignRight | Qt::AlignVCenter);
  }
  if (!index.isValid() || role != Qt::DisplayRole)
  {
    return {};
  }
  const auto column = static_cast<std::size_t>(index.column());
  if (column < FirstColor)
  {
    const double degrees = this->Table.GetAngles(index.row())[column];
    return QString::number(degrees, 'f', degrees < 10.0 ? 2 : 1) + "°";
  }
  const auto rgb = this->Table.GetValue(index.row());
  return rgb ? QString::number((*rgb)[column - FirstColor], 'g', 4) : QString("–");
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
SamplePanel::SamplePanel(Session* session)
  : Model(session)
  , Samples(new SampleModel(session, this))
  , View(new QTableView)
  , Note(new QLabel)
{
  this->View->setModel(this->Samples);
  this->View->setAccessibleName(tr("Samples"));
  this->View->setWordWrap(false);
  QHeaderView* header = this->View->horizontalHeader();
  header->setSectionResizeMode(QHeaderView::Stretch);
  for (int column = 0; column < FirstColor; ++column) // what is left is the colors'
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
  };
  add(tr("Go to &lobe"), tr("The sample of the lobe's light and its mirror direction"),
    [this]() { this->GoToLobe(); });
  add(tr("Go to &slices"), tr("The sample where the slices cut"), [this]() { this->GoToSlices(); });
  row->addStretch(1);
  auto* layout = MakeColumn(this);
  layout->addLayout(row);
  layout->addWidget(this->View, 1);
  layout->addWidget(this->Note);
  Follow(session, this, { &Session::materialChanged },
    [this]() { this->Note->setText(QString::fromStdString(this->Samples->GetTable().GetNote())); });
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
