// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The table of a material's samples, with undo, and the way to the angles that others show.
 */

#ifndef SamplePanel_h
#define SamplePanel_h

#include "Session.h"

#include <QWidget>

class QLabel;
class QPushButton;
class QTableView;
class QUndoStack;

namespace explorer
{
class SampleModel;

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
