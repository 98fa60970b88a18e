// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The lists of materials, environments and meshes.
 */

#ifndef ListPanel_h
#define ListPanel_h

#include "Session.h"

#include <QWidget>

#include <functional>

class QComboBox;
class QLineEdit;
class QTreeWidget;

namespace explorer
{
class ListPanel : public QWidget
{
  Q_OBJECT

public:
  explicit ListPanel(Session* session, QWidget* parent = nullptr);

  QTreeWidget* GetMaterials() const { return this->Materials; }

signals:
  /// The button for files of that kind: "materials", "environments", "meshes".
  void openRequested(const QString& kind);

private:
  void Update();
  void Filter();

  Session* Model;
  QLineEdit* Search;
  QTreeWidget* Materials;
  QTreeWidget* Environments;
  QComboBox* Meshes;
  bool IsUpdating = false;
};
} // namespace explorer

#endif
