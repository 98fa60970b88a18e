// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The explorer's window: the picture in the middle, panels around it, menus; and its application.
 */

#ifndef Window_h
#define Window_h

#include "Evaluation.h"
#include "Jobs.h"
#include "Session.h"
#include "Side.h"
#include "SplitView.h"

#include <QApplication>
#include <QMainWindow>
#include <QTimer>

#include <array>

class QLabel;
class QTabWidget;

namespace explorer
{
struct ReportData;

/// The QApplication, with what has to be set before and after it is made.
class Application : public QApplication
{
public:
  /// Contexts that views share, high-DPI displays, VTK's messages for tool::TakeErrorText; numbers
  /// in files have points, whatever the user's locale.
  Application(int& argc, char* argv[]);

  /// Qt catches nothing: what an event's handler or a slot throws is shown by the windows.
  bool notify(QObject* receiver, QEvent* event) override;
};

class Window : public QMainWindow
{
  Q_OBJECT

public:
  explicit Window(const State& state, QWidget* parent = nullptr);
  ~Window() override;

  Session* GetSession() { return this->Model; }
  Jobs* GetJobs() { return this->Background; }
  Evaluation* GetEvaluation() { return this->Measured; }
  SplitView* GetView() { return this->View; }
  Side* GetSide(int k) { return this->Sides[k]; }

  /// Brings the tab of that title to the front; the panel in it.
  QWidget* ShowTab(const QString& title);

  ///@{
  /// Files by their endings: .png; .html or .json. Errors become messages. The report is made in
  /// the background.
  bool SavePicture(const QString& path);
  void SaveReport(const QString& path);
  ///@}

  /// What the line above the picture says; "" where it is hidden.
  QString GetMessage() const;

  /// Whether everything has been read, planned, prepared and measured.
  bool IsSettled() const;

protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  void MakePanels();
  void MakeMenus();
  void MakeStatusBar();
  void ShowMessage(const QString& text, bool isError);
  void OpenFiles();
  void Poll();
  void UpdateOverlays();
  void UpdateTitle();
  ReportData CollectReport();

  Jobs* Background; // the first to be deleted: no job finds anything gone
  Session* Model;
  std::array<Side*, 2> Sides;
  SplitView* View;
  Evaluation* Measured;
  QLabel* Messages; // above the picture: errors and notes, which stop nothing
  QString Message;  // what it says
  QTimer MessageTimer;
  QTabWidget* Tabs;
  QTimer Poller;
};
} // namespace explorer

#endif
