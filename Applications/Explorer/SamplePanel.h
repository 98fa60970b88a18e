// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The rows of a material's samples in a table, with undo, and the way to the angles that others
 * show.
 */

#ifndef SamplePanel_h
#define SamplePanel_h

#include "SampleTable.h"
#include "Session.h"

#include <QAbstractTableModel>
#include <QWidget>

class QLabel;
class QPushButton;
class QTableView;
class QUndoStack;

namespace explorer
{
/// The rows of a SampleTable, with the session's edits over them. What is edited goes through an
/// undo stack into the session's edits of that material.
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

/// The table with its buttons.
class SamplePanel : public QWidget
{
  Q_OBJECT

public:
  explicit SamplePanel(Session* session, QWidget* parent = nullptr);

  QTableView* GetView() const { return this->View; }
  SampleModel* GetModel() const { return this->Samples; }
  QUndoStack* GetUndoStack() const { return this->Undo; }

  /// What the values are.
  QString GetNote() const;

public slots:
  ///@{
  /// Show the sample that is nearest to the lobe's light and its mirror direction, or to where the
  /// slices cut.
  void GoToLobe();
  void GoToSlices();
  ///@}

  /// Take back all edits of this material; that can be undone.
  void Revert();

private:
  void GoTo(const std::array<double, 3>& degrees);
  void Update();

  Session* Model;
  QUndoStack* Undo;
  SampleModel* Samples;
  QTableView* View;
  QLabel* Note;
  QPushButton* RevertButton;
};
} // namespace explorer

#endif
