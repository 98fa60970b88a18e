// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What `info` says of the material, with what is remarkable first.
 */

#ifndef FindingsPanel_h
#define FindingsPanel_h

#include "Session.h"

#include <QWidget>

#include <nlohmann/json.hpp>

class QLabel;
class QPlainTextEdit;

namespace explorer
{
class FindingsPanel : public QWidget
{
  Q_OBJECT

public:
  FindingsPanel(Session* session, Jobs* jobs, QWidget* parent = nullptr);

  /// Null before it was measured.
  const nlohmann::ordered_json& GetInspection() const { return this->Info; }

signals:
  void inspected();

private:
  void Start();
  void Show(const nlohmann::ordered_json& info);

  Session* Model;
  Jobs* Background;
  QLabel* Findings;
  QPlainTextEdit* Text;
  nlohmann::ordered_json Info;
};
} // namespace explorer

#endif
