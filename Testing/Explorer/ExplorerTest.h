// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the tests of the explorer's window share: one window, which is driven as people do.
 */

#ifndef ExplorerTest_h
#define ExplorerTest_h

#include "Window.h"

#include <QMouseEvent>
#include <QtTest>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace explorer
{
constexpr int Patience = 120000; // ms, for a busy machine

inline std::unique_ptr<Window> MakeWindow(const State& state)
{
  auto window = std::make_unique<Window>(state);
  window->resize(960, 480);
  window->show();
  return window;
}

/// Presses the left button, moves the mouse and lets go.
inline void Drag(QWidget* view, const QPoint& begin, const QPoint& end,
  Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
  QTest::mousePress(view, Qt::LeftButton, modifiers, begin);
  QMouseEvent move(
    QEvent::MouseMove, end, view->mapToGlobal(end), Qt::NoButton, Qt::LeftButton, modifiers);
  QApplication::sendEvent(view, &move);
  QTest::mouseRelease(view, Qt::LeftButton, modifiers, end);
}

class WindowTest : public QObject
{
protected:
  /// The one window of most tests, whose shaders have been compiled, with another state.
  Window* Show(const State& state)
  {
    Session* session = this->Shared->GetSession();
    this->Shared->ShowTab("Plan");
    session->Replace(state, false);
    const bool read = QTest::qWaitFor(
      [&]()
      {
        const State& now = session->GetState();
        return session->GetMaterial().BRDF && session->IsLit() && session->GetMesh() &&
               now.Material == state.Material && now.Environment == state.Environment &&
               now.Mesh == state.Mesh && !session->IsWaiting() &&
               !this->Shared->GetJobs()->IsRunning("remake");
      },
      Patience);
    if (!read)
    {
      qWarning("the state's files were not read");
    }
    this->Shared->GetView()->ResetCamera();
    return this->Shared.get();
  }

  template <typename Widget>
  Widget* Find(const QString& name = QString()) const
  {
    return this->Shared->findChild<Widget*>(name);
  }

  std::unique_ptr<Window> Shared;
};

template <typename Test>
int RunTest(int argc, char* argv[])
{
  if (!std::getenv("DISPLAY"))
  {
    std::puts("Skipped: the explorer's window needs an X server");
    return 125;
  }
  const Application application(argc, argv);
  Test test;
  return QTest::qExec(&test, argc, argv);
}
} // namespace explorer

#endif
