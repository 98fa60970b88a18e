// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The QApplication, with what has to be set before and after it is made.
 */

#ifndef Application_h
#define Application_h

#include <QApplication>

namespace explorer
{
class Application : public QApplication
{
public:
  /// Contexts that views share, high-DPI displays, VTK's messages for tool::TakeErrorText; numbers
  /// in files have points, whatever the user's locale.
  Application(int& argc, char* argv[]);

  /// Qt catches nothing: what an event's handler or a slot throws is shown by the windows.
  bool notify(QObject* receiver, QEvent* event) override;
};
} // namespace explorer

#endif
