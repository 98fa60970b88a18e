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

#include <map>
#include <string>

class QCheckBox;
class QComboBox;
class QLineEdit;
class QTreeWidget;

namespace explorer
{
class Comparison;

class ListPanel : public QWidget
{
  Q_OBJECT

public:
  ListPanel(Session* session, Comparison* comparison, QWidget* parent = nullptr);

  QTreeWidget* GetMaterials() const { return this->Materials; }

  /// The box that takes a material into the charts; null where there is no such material.
  QCheckBox* GetCompareBox(const std::string& file) const;

signals:
  /// The button for files of that kind: "materials", "environments", "meshes".
  void openRequested(const QString& kind);

private:
  void Update();
  void Filter();
  void AddCompareBoxes();
  void UpdateCompareBoxes();

  Session* Model;
  Comparison* Compared;
  QLineEdit* Search;
  QTreeWidget* Materials;
  QTreeWidget* Environments;
  QComboBox* Meshes;
  std::map<std::string, QCheckBox*> CompareBoxes; // of the material's file
  bool IsUpdating = false;
};
} // namespace explorer

#endif
