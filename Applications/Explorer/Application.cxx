// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Application.h"

#include "Tool.h"

#include <QApplication>
#include <QSurfaceFormat>
#include <QVTKOpenGLNativeWidget.h>

#include <clocale>

namespace explorer
{
//------------------------------------------------------------------------------
void PrepareApplication()
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
}

//------------------------------------------------------------------------------
void PrepareLocale() { std::setlocale(LC_NUMERIC, "C"); }
} // namespace explorer
