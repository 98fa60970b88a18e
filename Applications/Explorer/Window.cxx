// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Window.h"

#include "Comparison.h"
#include "EnvironmentPanel.h"
#include "EnvironmentView.h"
#include "FileKinds.h"
#include "Files.h"
#include "FindingsPanel.h"
#include "ImagePanel.h"
#include "ListPanel.h"
#include "LobePanel.h"
#include "LobeView.h"
#include "Meshes.h"
#include "MessageBar.h"
#include "ModelPanel.h"
#include "PictureBar.h"
#include "PlanPanel.h"
#include "Report.h"
#include "SamplePanel.h"
#include "SlicePanel.h"
#include "SliceView.h"
#include "Tool.h"

#include "vtkImageData.h"
#include "vtkRadiancePlanner.h"

#include <QApplication>
#include <QBuffer>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QMimeData>
#include <QProgressBar>
#include <QProxyStyle>
#include <QStatusBar>
#include <QTabBar>
#include <QTabWidget>
#include <QTimer>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>

namespace
{
constexpr int PollTime = 50; // ms

//------------------------------------------------------------------------------
// Tabs with less beside their names, so that all of them fit above a panel.
class NarrowTabs : public QProxyStyle
{
public:
  int pixelMetric(
    PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override
  {
    constexpr int Space = 12; // logical pixels; Fusion has 24
    const int usual = this->QProxyStyle::pixelMetric(metric, option, widget);
    return metric == PM_TabBarTabHSpace ? std::min(usual, Space) : usual;
  }
};

//------------------------------------------------------------------------------
QString MakeFilter(const QString& name, const std::vector<std::string>& endings)
{
  QStringList patterns;
  for (const std::string& ending : endings)
  {
    patterns << "*" + QString::fromStdString(ending);
  }
  return name + " (" + patterns.join(' ') + ")";
}
}

namespace explorer
{
//------------------------------------------------------------------------------
Window::Window(const State& state, QWidget* parent)
  : QMainWindow(parent)
  , Background(new Jobs)
  , Model(new Session(Background, this))
  , Compared(new Comparison(Model, Background, this))
  , Sides{ new Side(0, Model, Background, this), new Side(1, Model, Background, this) }
  , View(new SplitView(Model, Background, Sides))
  , Measured(new Evaluation(Model, Background, Sides, View->GetCamera(), this))
{
  this->setAcceptDrops(true);
  this->resize(1440, 900); // the docks take their shares of it
  this->MakePanels();
  this->MakeStatusBar();
  this->MakeMenus();
  this->UpdateTitle();

  connect(this->Model, &Session::messaged, this,
    [this](const QString& text, bool isError) { this->Messages->Show(text, isError); });
  for (const auto signal : { &Session::materialChanged, &Session::environmentChanged })
  {
    connect(this->Model, signal, this, &Window::UpdateTitle);
  }
  connect(this->Measured, &Evaluation::changed, this, &Window::UpdateOverlays);
  connect(this->Model, &Session::methodsChanged, this, &Window::UpdateOverlays);
  connect(this->Model, &Session::pictureChanged, this,
    [this]()
    {
      if (this->Model->GetState().Show == Shown::Difference)
      {
        this->UpdateOverlays();
      }
    });
  connect(this->View, &SplitView::framed, this,
    [this](double milliseconds) { this->Plan->SetFrameTime(milliseconds); });
  connect(&this->Poller, &QTimer::timeout, this, &Window::Poll);
  this->Poller.start(PollTime);
  this->Model->Replace(state, false);
}

//------------------------------------------------------------------------------
Window::~Window()
{
  this->Poller.stop();
  delete this->Background;
  delete this->View; // while the sides, whose renderers it has, are there
}

//------------------------------------------------------------------------------
void Window::MakePanels()
{
  this->Messages = new MessageBar;
  this->Bar = new PictureBar(this->Model);
  auto* middle = new QWidget;
  auto* layout = new QVBoxLayout(middle);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(this->Bar);
  layout->addWidget(this->Messages);
  layout->addWidget(this->View, 1);
  this->setCentralWidget(middle);

  this->Lists = new ListPanel(this->Model, this->Compared);
  auto* left = new QDockWidget(tr("Scene"));
  left->setObjectName("scene");
  left->setWidget(this->Lists);
  this->addDockWidget(Qt::LeftDockWidgetArea, left);
  connect(this->Lists, &ListPanel::openRequested, this, &Window::OpenFiles);

  this->Plan = new PlanPanel(this->Model, this->Sides, this->Measured);
  this->Tabs = new QTabWidget;
  this->Tabs->setDocumentMode(true);
  auto* narrow = new NarrowTabs;
  narrow->setParent(this->Tabs);
  this->Tabs->tabBar()->setStyle(narrow);
  this->Tabs->setUsesScrollButtons(false); // the panel is as wide as its tabs: none is hidden
  this->Tabs->addTab(this->Plan, tr("Plan"));
  this->Lobe = new LobePanel(this->Model);
  this->Slices = new SlicePanel(this->Model, this->Compared);
  this->Image = new ImagePanel(this->Model, this->Background);
  this->Light = new EnvironmentPanel(this->Model, this->Background);
  this->Findings = new FindingsPanel(this->Model, this->Background);
  this->Tabs->addTab(this->Lobe, tr("Lobe"));
  this->Tabs->addTab(this->Slices, tr("Slices"));
  this->Tabs->addTab(this->Image, tr("Image"));
  this->Tabs->addTab(this->Light, tr("Light"));
  this->Tabs->addTab(this->Findings, tr("Material"));
  this->Models = new ModelPanel(this->Model);
  this->Samples = new SamplePanel(this->Model);
  this->Tabs->addTab(this->Models, tr("Model"));
  this->Tabs->addTab(this->Samples, tr("Samples"));
  connect(this->Models, &ModelPanel::saveRequested, this, &Window::AskForMaterial);
  connect(this->Findings, &FindingsPanel::inspected, this,
    [this]() { this->Slices->GetView()->SetInspection(this->Findings->GetInspection()); });
  connect(this->Tabs, &QTabWidget::currentChanged, this,
    [this]()
    {
      this->Lobe->GetView()->RequestRender();
      this->Slices->GetView()->RequestRender();
    });
  auto* right = new QDockWidget(tr("Analysis"));
  right->setObjectName("analysis");
  right->setWidget(this->Tabs);
  this->addDockWidget(Qt::RightDockWidgetArea, right);
  this->resizeDocks({ left, right }, { 230, 460 }, Qt::Horizontal);
}

//------------------------------------------------------------------------------
void Window::MakeStatusBar()
{
  this->Working = new QLabel;
  this->Progress = new QProgressBar;
  this->Progress->setMaximumWidth(160);
  this->Progress->setMaximumHeight(16);
  this->Progress->setRange(0, 100);
  this->statusBar()->addWidget(this->Working, 1);
  this->statusBar()->addPermanentWidget(this->Progress);
  this->Progress->hide();
  connect(this->Background, &Jobs::progressed, this,
    [this](const QString& line, double share)
    {
      this->Working->setText(
        line.isEmpty() ? QString() : line.left(1).toUpper() + line.mid(1) + " …");
      this->Progress->setVisible(!line.isEmpty());
      this->Progress->setValue(static_cast<int>(100.0 * share));
    });
}

//------------------------------------------------------------------------------
void Window::OpenFiles(const QString& kind)
{
  std::vector<std::string> endings = GetMaterialExtensions();
  const QString materials = MakeFilter(tr("Materials"), endings);
  const QString environments = MakeFilter(tr("Environments"), GetEnvironmentExtensions());
  const QString meshes = MakeFilter(tr("Meshes"), tool::GetMeshExtensions());
  const QString states = tr("States (*.json)");
  const QString all = tr("All files (*)");
  const QStringList filters = kind == "materials"      ? QStringList{ materials, all }
                              : kind == "environments" ? QStringList{ environments, all }
                              : kind == "meshes"
                                ? QStringList{ meshes, all }
                                : QStringList{ all, materials, environments, meshes, states };
  this->Open(QFileDialog::getOpenFileNames(this, tr("Open"), QString(), filters.join(";;")));
}

//------------------------------------------------------------------------------
void Window::Open(const QStringList& files)
{
  const bool isState = std::any_of(files.begin(), files.end(),
    [](const QString& file) { return file.endsWith(".json", Qt::CaseInsensitive); });
  if (!isState || this->MayDropEdits())
  {
    this->Model->Open(files);
  }
}

//------------------------------------------------------------------------------
// Asks where samples were edited and are in no file.
bool Window::MayDropEdits()
{
  if (!this->Model->HasUnsavedEdits())
  {
    return true;
  }
  const auto answer = QMessageBox::question(this, tr("Edited samples"),
    tr("Samples were edited and are not saved. Save them in a state?"),
    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  if (answer == QMessageBox::Save)
  {
    this->AskForState();
    return !this->Model->HasUnsavedEdits();
  }
  return answer == QMessageBox::Discard;
}

//------------------------------------------------------------------------------
void Window::closeEvent(QCloseEvent* event) { event->setAccepted(this->MayDropEdits()); }

//------------------------------------------------------------------------------
void Window::Ask(const QString& title, const QString& name, const QString& filter,
  const std::function<void(const QString&)>& save)
{
  const QString path = QFileDialog::getSaveFileName(this, title, name, filter);
  if (!path.isEmpty())
  {
    save(path);
  }
}

//------------------------------------------------------------------------------
void Window::AskForMaterial()
{
  this->Ask(tr("Save material"), "material.exr", tr("Materials (*.exr)"),
    [this](const QString& path) { this->Model->SaveMaterial(path.toStdString()); });
}

//------------------------------------------------------------------------------
void Window::AskForState()
{
  this->Ask(tr("Save state"), "explorer.json", tr("States (*.json)"),
    [this](const QString& path) { this->Model->Save(path.toStdString()); });
}

//------------------------------------------------------------------------------
bool Window::SavePicture(const QString& path)
{
  const QImage image = this->View->Grab();
  try
  {
    if (tool::Extension(path.toStdString()) != ".png")
    {
      throw tool::Error(path.toStdString() + ": a picture's name ends in .png");
    }
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (!image.save(&buffer, "PNG"))
    {
      throw tool::Error(path.toStdString() + ": no PNG was made");
    }
    tool::WriteWhole(path.toStdString(), { bytes.constData(), std::size_t(bytes.size()) });
    this->Model->Say(tr("Saved: %1").arg(path), false);
    return true;
  }
  catch (const std::exception& error)
  {
    this->Model->Say(QString::fromUtf8(error.what()), true);
    return false;
  }
}

//------------------------------------------------------------------------------
// Panels that are not in front have drawn nothing yet: each comes to the front for its picture.
ReportData Window::CollectReport()
{
  ReportData data;
  data.Explored = this->Model->GetState();
  data.Material = this->Model->GetMaterial().Name;
  data.Inspection = this->Findings->GetInspection();
  data.Size = this->Measured->GetSize();
  data.Visible = this->Measured->GetSurface();
  data.Reference =
    this->Measured->IsComplete() ? this->Measured->GetReferenceRadiance() : std::vector<double>();
  for (int k = 0; k < 2; ++k)
  {
    const Side* side = this->Sides[static_cast<std::size_t>(k)];
    ReportSide& entry = data.Sides[static_cast<std::size_t>(k)];
    entry.Description = side->Describe().toStdString();
    entry.IsReference = side->IsReference();
    entry.Radiance = this->Measured->GetRadiance(k);
    entry.Frame = this->Measured->GetFigures(k).Frame;
    vtkRadiancePlanner* planner = entry.IsReference ? nullptr : side->GetPlanner();
    if (planner && planner->GetChoice() >= 0)
    {
      entry.PredictedError = planner->GetPredictedError(planner->GetChoice());
      data.Plan = planner->GetPlan();
    }
  }
  data.Pictures.emplace_back(tr("Picture: A left, B right"), this->View->Grab());
  const int shown = this->Tabs->currentIndex();
  const std::pair<QString, QWidget*> panels[] = { { tr("Lobe"), this->Lobe },
    { tr("Slices and albedo"), this->Slices }, { tr("Environment"), this->Light } };
  for (const auto& [title, panel] : panels)
  {
    this->Tabs->setCurrentWidget(panel);
    QCoreApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
    data.Pictures.emplace_back(title, panel->grab().toImage());
  }
  this->Tabs->setCurrentIndex(shown);
  return data;
}

//------------------------------------------------------------------------------
void Window::SaveReport(const QString& path)
{
  const auto data = std::make_shared<const ReportData>(this->CollectReport());
  this->Background->Start(
    "report", tr("writing the report"),
    [this, data, path](JobThread& thread)
    {
      WriteReport(*data, path.toStdString());
      thread.Post([this, path]() { this->Model->Say(tr("Saved: %1").arg(path), false); });
    },
    [this](const QString& text) { this->Model->Say(text, true); });
}

//------------------------------------------------------------------------------
void Window::dragEnterEvent(QDragEnterEvent* event)
{
  if (event->mimeData()->hasUrls())
  {
    event->acceptProposedAction();
  }
}

//------------------------------------------------------------------------------
void Window::dropEvent(QDropEvent* event)
{
  QStringList files;
  for (const QUrl& url : event->mimeData()->urls())
  {
    if (url.isLocalFile())
    {
      files << url.toLocalFile();
    }
    else
    {
      this->Model->Say(tr("%1: is no file of this machine").arg(url.toString()), true);
    }
  }
  event->acceptProposedAction();
  // Afterwards: a question must not keep the program waiting that the files come from.
  QTimer::singleShot(0, this, [this, files]() { this->Open(files); });
}

//------------------------------------------------------------------------------
void Window::Poll()
{
  const bool ready = this->Sides[0]->PollPlan() || this->Sides[1]->PollPlan();
  if (ready)
  {
    this->View->RequestRender();
  }
  const std::string errors = tool::TakeErrorText();
  if (!errors.empty())
  {
    this->Model->Say(QString::fromStdString(errors), true);
  }
  this->Measured->SetAspect(
    static_cast<double>(this->View->width()) / std::max(1, this->View->height()));
}

//------------------------------------------------------------------------------
void Window::UpdateOverlays()
{
  for (int k = 0; k < 2; ++k)
  {
    const bool isReference = this->Sides[static_cast<std::size_t>(k)]->IsReference();
    this->View->SetPicture(k, isReference ? this->Measured->GetReference() : nullptr);
    QString text = this->Sides[static_cast<std::size_t>(k)]->Describe();
    if (isReference && !this->Measured->IsComplete())
    {
      text += this->Measured->GetReference() ? tr(" (becoming exact)")
              : this->Model->IsDirectional() ? tr(" (soon; the graphics card's is shown)")
                                             : tr(" (soon; planned picture shown)");
    }
    this->View->SetLabel(k, text);
  }
  double mean = 0.0;
  this->View->SetDifference(this->Model->GetState().Show == Shown::Difference
                              ? this->Measured->MakeDifference(mean).Get()
                              : nullptr);
}

//------------------------------------------------------------------------------
void Window::UpdateTitle()
{
  this->setWindowTitle(tr("%1 under %2 – measured-brdf")
                         .arg(QString::fromStdString(this->Model->GetMaterial().Name),
                           QString::fromStdString(this->Model->GetState().Environment)));
}

//------------------------------------------------------------------------------
QString Window::GetMessage() const { return this->Messages->GetText(); }

//------------------------------------------------------------------------------
bool Window::IsSettled() const
{
  return this->Background->IsIdle() && !this->Model->IsWaiting() && this->Measured->IsSettled();
}
} // namespace explorer
