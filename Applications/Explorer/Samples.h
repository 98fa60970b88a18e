// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material as rows of samples: those that its table holds, or f at the angles of MERL's tables;
 * and the panel that shows them.
 */

#ifndef Samples_h
#define Samples_h

#include "Session.h"

#include "vtkTabulatedBRDF.h"

#include <QAbstractTableModel>
#include <QLabel>
#include <QTableView>

#include <array>
#include <optional>
#include <string>

namespace explorer
{
/**
 * Nothing is copied: a row is read, or evaluated, when it is asked for. Rows are in the order of
 * vtkTabulatedBRDF's volume.
 */
class SampleTable
{
public:
  using Value = std::array<float, 3>;

  /// brdf: prepared, and not changed while this is used; null: no rows.
  explicit SampleTable(vtkBRDF* brdf = nullptr);

  int GetNumberOfRows() const;

  /// Columns: three angles in degrees, then red, green and blue.
  std::array<const char*, 6> GetNames() const;

  /// Of GetNames' first three.
  std::array<double, 3> GetAngles(int row) const;

  /// Nothing below the horizon, or where nothing was measured.
  std::optional<Value> GetValue(int row) const;

  /// The nearest row to theta_h, theta_d, phi_d in degrees, whatever the table's own angles are.
  int FindRow(const std::array<double, 3>& degrees) const;

  /// What a reader should know: what the values are.
  std::string GetNote() const;

private:
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkTabulatedBRDF* Table = nullptr; // BRDF, or null
  std::array<int, 3> Dimensions = { 0, 0, 0 };
  int Parameterization = vtkTabulatedBRDF::HALF_DIFFERENCE;
  int AzimuthRange = vtkTabulatedBRDF::HALF_TURN;
};

/// The rows of the SampleTable of the material that is shown.
class SampleModel : public QAbstractTableModel
{
  Q_OBJECT

public:
  SampleModel(Session* session, QObject* parent);

  const SampleTable& GetTable() const { return this->Table; }

  int rowCount(const QModelIndex& parent = QModelIndex()) const override;
  int columnCount(const QModelIndex& parent = QModelIndex()) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  /// Nothing: typing in the view would search millions of rows.
  QModelIndexList match(
    const QModelIndex&, int, const QVariant&, int, Qt::MatchFlags) const override
  {
    return {};
  }

private:
  SampleTable Table;
};

/// The table with its buttons.
class SamplePanel : public QWidget
{
  Q_OBJECT

public:
  explicit SamplePanel(Session* session);

  QTableView* GetView() const { return this->View; }
  SampleModel* GetModel() const { return this->Samples; }

  /// What the values are.
  QString GetNote() const { return this->Note->text(); }

  ///@{
  /// Show the sample that is nearest to the lobe's light and its mirror direction, or to where the
  /// slices cut.
  void GoToLobe() { this->GoTo({ 0.0, this->Model->GetState().LobeThetaI, 90.0 }); }
  void GoToSlices();
  ///@}

private:
  void GoTo(const std::array<double, 3>& degrees);

  Session* Model;
  SampleModel* Samples;
  QTableView* View;
  QLabel* Note;
};
} // namespace explorer

#endif
