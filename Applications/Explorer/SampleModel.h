// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The rows of a SampleTable, with the session's edits over them, for a table view.
 */

#ifndef SampleModel_h
#define SampleModel_h

#include "SampleTable.h"
#include "Session.h"

#include <QAbstractTableModel>

class QUndoStack;

namespace explorer
{
/// What is edited goes through an undo stack into the session's edits of that material.
class SampleModel : public QAbstractTableModel
{
  Q_OBJECT

public:
  static constexpr int FirstColor = 3; ///< of the columns; those before it are angles

  SampleModel(Session* session, QUndoStack* undo, QObject* parent = nullptr);

  const SampleTable& GetTable() const { return this->Table; }

  int rowCount(const QModelIndex& parent = QModelIndex()) const override;
  int columnCount(const QModelIndex& parent = QModelIndex()) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;

  /// Refuses, with a message of the session, what is no number from 0 to LargestSample.
  bool setData(const QModelIndex& index, const QVariant& value, int role = Qt::EditRole) override;

  /// Nothing: typing in the view would search millions of rows.
  QModelIndexList match(
    const QModelIndex&, int, const QVariant&, int, Qt::MatchFlags) const override
  {
    return {};
  }

private:
  void TakeMaterial();
  bool Find(int row, std::array<float, 3>& rgb) const;
  const SampleEdits* FindEdits() const;

  Session* Model;
  QUndoStack* Undo;
  SampleTable Table;
  vtkSmartPointer<vtkBRDF> Shown; // what Table reads
};
} // namespace explorer

#endif
