// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The explorer's window: the picture in the middle, panels around it, menus.
 */

#ifndef Window_h
#define Window_h

#include "Evaluation.h"
#include "Jobs.h"
#include "Session.h"
#include "Side.h"
#include "SplitView.h"

#include <QMainWindow>
#include <QTimer>

#include <array>
#include <functional>

class QLabel;
class QProgressBar;
class QTabWidget;

namespace explorer
{
class Comparison;
class EnvironmentPanel;
class FindingsPanel;
class ImagePanel;
class ListPanel;
class LobePanel;
class MessageBar;
class ModelPanel;
class PictureBar;
class PlanPanel;
class SamplePanel;
class SlicePanel;
struct ReportData;

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
  Side* GetSide(int k) { return this->Sides[static_cast<std::size_t>(k)]; }
  PlanPanel* GetPlanPanel() { return this->Plan; }
  PictureBar* GetPictureBar() { return this->Bar; }
  Comparison* GetComparison() { return this->Compared; }
  ListPanel* GetListPanel() { return this->Lists; }

  LobePanel* GetLobePanel() { return this->Lobe; }
  ImagePanel* GetImagePanel() { return this->Image; }
  SlicePanel* GetSlicePanel() { return this->Slices; }
  EnvironmentPanel* GetEnvironmentPanel() { return this->Light; }
  FindingsPanel* GetFindingsPanel() { return this->Findings; }
  ModelPanel* GetModelPanel() { return this->Models; }
  SamplePanel* GetSamplePanel() { return this->Samples; }
  QTabWidget* GetTabs() { return this->Tabs; }

  ///@{
  /// Files by their endings: .png; .html or .json. Errors become messages. The report is made in
  /// the background.
  bool SavePicture(const QString& path);
  void SaveReport(const QString& path);
  ///@}

  /// What the message bar says; "" where it is hidden.
  QString GetMessage() const;

  /// Whether everything has been read, planned, prepared and measured.
  bool IsSettled() const;

protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  void MakePanels();
  void MakeMenus();
  void MakeFileMenu();
  void MakeEditMenu();
  void MakeViewMenu();
  void MakeStatusBar();
  void OpenFiles(const QString& kind);
  void AskForMaterial();
  void Poll();
  void UpdateOverlays();
  void UpdateTitle();
  void Ask(const QString& title, const QString& name, const QString& filter,
    const std::function<void(const QString&)>& save);
  ReportData CollectReport();

  Jobs* Background; // the first to be deleted: no job finds anything gone
  Session* Model;
  Comparison* Compared;
  std::array<Side*, 2> Sides;
  SplitView* View;
  Evaluation* Measured;
  MessageBar* Messages;
  PictureBar* Bar;
  ListPanel* Lists;
  PlanPanel* Plan;
  LobePanel* Lobe;
  SlicePanel* Slices;
  ImagePanel* Image;
  EnvironmentPanel* Light;
  FindingsPanel* Findings;
  ModelPanel* Models;
  SamplePanel* Samples;
  QTabWidget* Tabs;
  QLabel* Working;
  QProgressBar* Progress;
  QTimer Poller;
};
} // namespace explorer

#endif
