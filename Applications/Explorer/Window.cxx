// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Window.h"

#include "Files.h"
#include "Inspection.h"
#include "JsonReport.h"
#include "LightPanel.h"
#include "LobePanel.h"
#include "Materials.h"
#include "MeasuredBRDFToolVersion.h"
#include "Measuring.h"
#include "Meshes.h"
#include "Panels.h"
#include "ParallelFor.h"
#include "SlicePanel.h"
#include "Tool.h"

#include "vtkBRDFReader.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkRadianceMetrics.h"
#include "vtkRadiancePlanner.h"

#include <QAction>
#include <QBuffer>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QProgressBar>
#include <QProxyStyle>
#include <QStatusBar>
#include <QSurfaceFormat>
#include <QTabBar>
#include <QTabWidget>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>
#include <clocale>
#include <functional>

using nlohmann::ordered_json;

namespace explorer
{
namespace
{
constexpr int PollTime = 50;        // ms
constexpr int NoteTime = 10000;     // ms
constexpr int MostCharacters = 600; // of a message

//------------------------------------------------------------------------------
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

/// All that a report is made of, so that a thread can make it: a page (.html, one
/// file with its pictures) or figures (.json).
struct ReportData
{
  ordered_json Figures; // all but the errors of its "sides"
  tool::Size Size{ 1, 1 };
  std::shared_ptr<const tool::Surface> Visible;
  std::vector<double> Reference;
  std::array<std::vector<double>, 2> Radiance; // of the sides, 3 doubles a pixel of the surface
  std::vector<std::pair<QString, QImage>> Pictures; // with titles
};

namespace
{
//------------------------------------------------------------------------------
QString Escape(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); }

//------------------------------------------------------------------------------
QString Embed(const QImage& image)
{
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, "PNG");
  return "data:image/png;base64," + QString::fromLatin1(bytes.toBase64());
}

//------------------------------------------------------------------------------
// The pictures, and the figures as `measured-brdf info` prints its own.
QString MakePage(const ReportData& data, ordered_json report)
{
  const QString title = Escape(report["material"]) + " under " + Escape(report["environment"]);
  QString page = "<!DOCTYPE html><html><head><meta charset='utf-8'><title>" + title +
                 "</title><style>body{font-family:sans-serif;max-width:60em;margin:2em auto}"
                 "img{max-width:100%}pre{overflow:auto}</style></head><body><h1>" +
                 title + "</h1>";
  for (const auto& [name, image] : data.Pictures)
  {
    page += "<h2>" + name.toHtmlEscaped() + "</h2><img alt='" + name.toHtmlEscaped() + "' src='" +
            Embed(image) + "'>";
  }
  const std::string state = report["state"].dump(2);
  report["A"] = ordered_json(report["sides"][0]);
  report["B"] = ordered_json(report["sides"][1]);
  report.erase("sides");
  report.erase("state");
  return page +
         "<h2>Figures</h2><p>Errors are of this view against the exact picture. A frame is one of "
         "that size, in milliseconds.</p><pre>" +
         Escape(tool::FormatReport(report)) + "</pre><h2>State</h2><pre>" + Escape(state) +
         "</pre><p>measured-brdf " MEASUREDBRDF_VERSION "</p></body></html>\n";
}

//------------------------------------------------------------------------------
// As the path's ending says, .html or .json; whole or not at all: the figures with the sides'
// errors by every metric of `compare`, and the page with its pictures. Throws tool::Error.
void WriteReport(const ReportData& data, const std::string& path)
{
  const std::string ending = tool::Extension(path);
  if (ending != ".html" && ending != ".json")
  {
    throw tool::Error(path + ": a report's name ends in .html or .json");
  }
  tool::CheckWritable(path);
  ordered_json report = data.Figures;
  for (std::size_t k = 0; k < 2; ++k)
  {
    if (!data.Reference.empty() && data.Radiance[k].size() == data.Reference.size())
    {
      vtkNew<vtkRadianceMetrics> metrics;
      tool::Measure(
        metrics, tool::Grid(*data.Visible, data.Size), data.Radiance[k], data.Reference);
      for (const tool::Metric& metric : tool::GetMetrics())
      {
        report["sides"][k]["errors"][metric.Name] = metric.Get(metrics); // NaN becomes null
      }
    }
  }
  tool::WriteWhole(path,
    ending == ".html" ? MakePage(data, report).toStdString()
                      : report.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}
}

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

//------------------------------------------------------------------------------
Window::Window(const State& state, QWidget* parent)
  : QMainWindow(parent)
  , Background(new Jobs)
  , Model(new Session(Background, this))
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

  connect(this->Model, &Session::messaged, this, &Window::ShowMessage);
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
  this->Messages = new QLabel;
  this->Messages->setMargin(6);
  this->Messages->setWordWrap(true);
  this->Messages->setTextFormat(Qt::RichText);
  this->Messages->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // words may be long
  this->Messages->setTextInteractionFlags(Qt::TextBrowserInteraction);
  this->Messages->hide();
  this->MessageTimer.setSingleShot(true);
  connect(this->Messages, &QLabel::linkActivated, this->Messages, &QWidget::hide);
  connect(&this->MessageTimer, &QTimer::timeout, this->Messages, &QWidget::hide);
  auto* middle = new QWidget;
  auto* layout = new QVBoxLayout(middle);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(MakePictureBar(this->Model));
  layout->addWidget(this->Messages);
  layout->addWidget(this->View, 1);
  this->setCentralWidget(middle);

  this->Tabs = new QTabWidget;
  this->Tabs->setDocumentMode(true);
  auto* narrow = new NarrowTabs;
  narrow->setParent(this->Tabs);
  this->Tabs->tabBar()->setStyle(narrow);
  this->Tabs->setUsesScrollButtons(false); // the panel is as wide as its tabs: none is hidden
  const std::pair<QString, QWidget*> tabs[] = {
    { tr("Plan"), MakePlanPanel(this->Model, this->Sides, this->Measured) },
    { tr("Lobe"), MakeLobePanel(this->Model) }, { tr("Slices"), MakeSlicePanel(this->Model) },
    { tr("Image"), MakeImagePanel(this->Model, this->Background) },
    { tr("Light"), MakeLightPanel(this->Model, this->Background) },
    { tr("Material"), MakeFindingsPanel(this->Model) }, { tr("Model"), MakeModelPanel(this->Model) }
  };
  for (const auto& [title, panel] : tabs)
  {
    this->Tabs->addTab(panel, title);
  }
  connect(this->Tabs, &QTabWidget::currentChanged, this,
    [this]()
    {
      for (RenderView* view : this->Tabs->findChildren<RenderView*>())
      {
        view->RequestRender();
      }
    });

  const auto dock = [this](const QString& title, const QString& name, QWidget* panel, auto area)
  {
    auto* made = new QDockWidget(title);
    made->setObjectName(name);
    made->setWidget(panel);
    this->addDockWidget(area, made);
    return made;
  };
  QDockWidget* left =
    dock(tr("Scene"), "scene", MakeListPanel(this->Model), Qt::LeftDockWidgetArea);
  QDockWidget* right = dock(tr("Analysis"), "analysis", this->Tabs, Qt::RightDockWidgetArea);
  this->resizeDocks({ left, right }, { 230, 460 }, Qt::Horizontal);
}

//------------------------------------------------------------------------------
void Window::MakeMenus()
{
  QMenu* menu = this->menuBar()->addMenu(tr("&File"));
  const auto add = [&](const QString& text, const QKeySequence& key, const auto& what)
  {
    QAction* action = menu->addAction(text, this, what);
    action->setShortcut(key);
    return action;
  };
  add(tr("&Open…"), QKeySequence::Open, [this]() { this->OpenFiles(); });
  menu->addSeparator();
  const auto addSave = [&](const QString& text, const QKeySequence& key, const QString& name,
                         const QString& filter, const std::function<void(const QString&)>& save)
  {
    add(text, key,
      [=]()
      {
        const QString path = QFileDialog::getSaveFileName(this, tr("Save"), name, filter);
        if (!path.isEmpty())
        {
          save(path);
        }
      });
  };
  addSave(tr("&Save state…"), QKeySequence::Save, "explorer.json", tr("States (*.json)"),
    [this](const QString& path) { this->Model->Save(path.toStdString()); });
  addSave(tr("Save &picture…"), Qt::CTRL | Qt::SHIFT | Qt::Key_P, "explorer.png",
    tr("Pictures (*.png)"), [this](const QString& path) { this->SavePicture(path); });
  addSave(tr("Save &report…"), Qt::CTRL | Qt::Key_R, "explorer.html", tr("Reports (*.html *.json)"),
    [this](const QString& path) { this->SaveReport(path); });
  addSave(tr("Save &material…"), Qt::CTRL | Qt::Key_M, "material.exr", tr("Materials (*.exr)"),
    [this](const QString& path) { this->Model->SaveMaterial(path.toStdString()); });
  menu->addSeparator();
  add(tr("&Quit"), QKeySequence::Quit, [this]() { this->close(); });

  menu = this->menuBar()->addMenu(tr("&View"));
  add(tr("&Reset camera"), Qt::Key_Home, [this]() { this->View->ResetCamera(); });
  QAction* backdrop = add(tr("&Backdrop"), Qt::CTRL | Qt::Key_B,
    [this](bool on) { this->Model->Set(&State::Backdrop, on, &Session::pictureChanged); });
  backdrop->setCheckable(true);
  connect(this->Model, &Session::pictureChanged, this,
    [this, backdrop]() { backdrop->setChecked(this->Model->GetState().Backdrop); });
  add(tr("&Compare this material"), Qt::CTRL | Qt::Key_T,
    [this]()
    {
      const std::string& file = this->Model->GetState().Material;
      this->Model->SetCompared(file, !this->Model->IsCompared(file));
    });
  QMenu* heights = menu->addMenu(tr("Exact &picture"));
  for (const int height : { 128, 256, 512, 1024 })
  {
    heights->addAction(tr("%1 pixels high").arg(height), this,
      [this, height]()
      { this->Model->Set(&State::ReferenceHeight, height, &Session::referenceHeightChanged); });
  }
  menu->addSeparator();
  for (QDockWidget* dock : this->findChildren<QDockWidget*>())
  {
    menu->addAction(dock->toggleViewAction());
  }

  menu = this->menuBar()->addMenu(tr("&Help"));
  add(tr("&About"), QKeySequence(),
    [this]()
    {
      QMessageBox::about(this, tr("About"),
        tr("<b>vtkMeasuredBRDF explorer</b><p>Measured materials in VTK scenes in real time.</p>"
           "<p>Drag in the picture to turn the mesh, drag the line to compare both methods; drop "
           "files into the window to open them.</p>"));
    });
}

//------------------------------------------------------------------------------
void Window::MakeStatusBar()
{
  auto* working = new QLabel;
  auto* progress = new QProgressBar;
  progress->setMaximumWidth(160);
  progress->setMaximumHeight(16);
  progress->setRange(0, 100);
  this->statusBar()->addWidget(working, 1);
  this->statusBar()->addPermanentWidget(progress);
  progress->hide();
  connect(this->Background, &Jobs::progressed, this,
    [=](const QString& line, double share)
    {
      working->setText(line.isEmpty() ? QString() : line.left(1).toUpper() + line.mid(1) + " …");
      progress->setVisible(!line.isEmpty());
      progress->setValue(int(100.0 * share));
    });
}

//------------------------------------------------------------------------------
// Errors stay until they are closed or another message comes; notes go after a while.
void Window::ShowMessage(const QString& text, bool isError)
{
  if (text.isEmpty() || (!isError && !this->Messages->isHidden() && !this->MessageTimer.isActive()))
  {
    return; // a note does not hide an error
  }
  this->Message = QString::fromStdString(vtkBRDFReader::GetPrintable(text.toStdString()));
  const QString shown = this->Message.size() > MostCharacters
                          ? this->Message.left(MostCharacters) + "…"
                          : this->Message;
  this->Messages->setText(
    shown.toHtmlEscaped().replace('\n', "<br>") + tr(" <a href='#' style='color: white'>Hide</a>"));
  this->Messages->setToolTip(shown == this->Message ? QString() : this->Message.toHtmlEscaped());
  this->Messages->setStyleSheet(
    isError ? "background: #7a251f; color: white" : "background: #2d4a66; color: white");
  isError ? this->MessageTimer.stop() : this->MessageTimer.start(NoteTime);
  this->Messages->show();
}

//------------------------------------------------------------------------------
void Window::OpenFiles()
{
  const QStringList filters = { tr("All files (*)"),
    MakeFilter(tr("Materials"), GetMaterialExtensions()),
    MakeFilter(tr("Environments"), GetEnvironmentExtensions()),
    MakeFilter(tr("Meshes"), tool::GetMeshExtensions()), tr("States (*.json)") };
  this->Model->Open(QFileDialog::getOpenFileNames(this, tr("Open"), QString(), filters.join(";;")));
}

//------------------------------------------------------------------------------
bool Window::SavePicture(const QString& path)
{
  const QImage image = this->View->Grab();
  return this->Model->Try(
    [&]()
    {
      const std::string file = path.toStdString();
      if (tool::Extension(file) != ".png")
      {
        throw tool::Error(file + ": a picture's name ends in .png");
      }
      QByteArray bytes;
      QBuffer buffer(&bytes);
      buffer.open(QIODevice::WriteOnly);
      if (!image.save(&buffer, "PNG"))
      {
        throw tool::Error(file + ": no PNG was made");
      }
      tool::WriteWhole(file, { bytes.constData(), std::size_t(bytes.size()) });
      this->Model->Say(tr("Saved: %1").arg(path), false);
    });
}

//------------------------------------------------------------------------------
QWidget* Window::ShowTab(const QString& title)
{
  for (int k = 0; k < this->Tabs->count(); ++k)
  {
    if (this->Tabs->tabText(k) == title)
    {
      this->Tabs->setCurrentIndex(k);
    }
  }
  return this->Tabs->currentWidget();
}

//------------------------------------------------------------------------------
// Panels that are not in front have drawn nothing yet: each comes to the front for its picture.
ReportData Window::CollectReport()
{
  const State& state = this->Model->GetState();
  ReportData data;
  data.Size = this->Measured->GetSize();
  data.Visible = this->Measured->GetSurface();
  if (this->Measured->IsComplete())
  {
    data.Reference = this->Measured->GetReferenceRadiance();
  }
  data.Figures = { { "format", "measured-brdf explorer report" },
    { "material", this->Model->GetMaterial().Name }, { "environment", state.Environment },
    { "width", data.Size.Width }, { "height", data.Size.Height },
    { "sides", ordered_json::array() }, { "plan", "" },
    { "state", ordered_json::parse(WriteState(state)) } };
  if (this->Model->IsDirectional())
  {
    data.Figures["light"] = { { "theta", state.Light.Theta }, { "phi", state.Light.Phi },
      { "irradiance", state.Light.Irradiance } };
  }
  if (!this->Model->GetInspection().is_null())
  {
    data.Figures["info"] = this->Model->GetInspection();
  }
  for (int k = 0; k < 2; ++k)
  {
    const Side* side = this->GetSide(k);
    ordered_json entry = { { "description", side->Describe().toStdString() } };
    vtkRadiancePlanner* planner = side->IsReference() ? nullptr : side->GetPlanner();
    if (planner && planner->GetChoice() >= 0)
    {
      entry["predicted_error"] = planner->GetPredictedError(planner->GetChoice());
      data.Figures["plan"] = planner->GetPlan();
    }
    if (this->Measured->GetFigures(k).Frame > 0.0)
    {
      entry["frame_ms"] = this->Measured->GetFigures(k).Frame;
    }
    if (!side->IsReference())
    {
      data.Radiance[k] = this->Measured->GetRadiance(k);
    }
    data.Figures["sides"].push_back(entry);
  }
  data.Pictures.emplace_back(tr("Picture: A left, B right"), this->View->Grab());
  const int shown = this->Tabs->currentIndex();
  const std::pair<QString, QString> panels[] = { { tr("Lobe"), tr("Lobe") },
    { tr("Slices and albedo"), tr("Slices") }, { tr("Environment"), tr("Light") } };
  for (const auto& [title, tab] : panels)
  {
    QWidget* panel = this->ShowTab(tab);
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
  this->Background->Start("report", tr("writing the report"),
    [this, data, path](const Jobs::Post& post)
    {
      WriteReport(*data, path.toStdString());
      post([this, path]() { this->Model->Say(tr("Saved: %1").arg(path), false); });
    });
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
  this->Model->Open(files);
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
    const bool isReference = this->Sides[k]->IsReference();
    this->View->SetPicture(k, isReference ? this->Measured->GetReference() : nullptr);
    QString text = this->Sides[k]->Describe();
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
QString Window::GetMessage() const
{
  return this->Messages->isHidden() ? QString() : this->Message;
}

//------------------------------------------------------------------------------
bool Window::IsSettled() const
{
  return this->Background->IsIdle() && !this->Model->IsWaiting() && this->Measured->IsSettled();
}
} // namespace explorer
