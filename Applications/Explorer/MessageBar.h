// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A line above the picture for errors and notes, which does not stop anything.
 */

#ifndef MessageBar_h
#define MessageBar_h

#include <QFrame>
#include <QString>
#include <QTimer>

class QLabel;

namespace explorer
{
class MessageBar : public QFrame
{
  Q_OBJECT

public:
  explicit MessageBar(QWidget* parent = nullptr);

  /// Errors stay until they are closed or another message comes; notes go after a while.
  void Show(const QString& text, bool isError);

  QString GetText() const;

private:
  QLabel* Text;
  QTimer Timer;
};
} // namespace explorer

#endif
