// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Application.h"

#include "RunGuarded.h"
#include "Tool.h"
#include "Window.h"

#include <QSurfaceFormat>
#include <QVTKOpenGLNativeWidget.h>

#include <clocale>

namespace
{
// Before there is a QApplication.
int& Prepare(int& argc)
{
  tool::RedirectMessages();
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0); // VTK's own framebuffers have theirs
  QSurfaceFormat::setDefaultFormat(format);
#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0) // later versions always do
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
#endif
  QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  return argc;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
Application::Application(int& argc, char* argv[])
  : QApplication(Prepare(argc), argv)
{
  std::setlocale(LC_NUMERIC, "C"); // QApplication sets the user's
}

//------------------------------------------------------------------------------
bool Application::notify(QObject* receiver, QEvent* event)
{
  bool handled = false;
  if (const auto problem =
        measuredbrdf::FindThrown([&]() { handled = this->QApplication::notify(receiver, event); }))
  {
    for (QWidget* widget : topLevelWidgets())
    {
      if (auto* window = qobject_cast<Window*>(widget))
      {
        window->GetSession()->Say(tr("This failed: %1").arg(problem->c_str()), true);
      }
    }
  }
  return handled;
}
} // namespace explorer
