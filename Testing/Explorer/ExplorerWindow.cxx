// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The explorer's window, driven as people do, under an X server.
#include "Display.h"
#include "Files.h"
#include "LightPanel.h"
#include "LobePanel.h"
#include "Panels.h"
#include "SlicePanel.h"
#include "SmallBsdfXml.h"
#include "Tool.h"
#include "Window.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkBRDFLobeSource.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPBRLUTTexture.h"
#include "vtkPBRPrefilterTexture.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderer.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFile>
#include <QLabel>
#include <QMimeData>
#include <QMouseEvent>
#include <QPlainTextEdit>
#include <QSlider>
#include <QTabBar>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTimer>
#include <QUrl>
#include <QtTest>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <new>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

using namespace explorer;

namespace
{
constexpr int Patience = 120000; // ms, for a busy machine

//------------------------------------------------------------------------------
std::unique_ptr<Window> MakeWindow(const State& state)
{
  auto window = std::make_unique<Window>(state);
  window->resize(960, 320);
  window->show();
  return window;
}

//------------------------------------------------------------------------------
// Presses the left button, moves the mouse and lets go.
void Drag(QWidget* view, const QPoint& begin, const QPoint& end)
{
  QTest::mousePress(view, Qt::LeftButton, Qt::NoModifier, begin);
  QMouseEvent move(
    QEvent::MouseMove, end, view->mapToGlobal(end), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(view, &move);
  QTest::mouseRelease(view, Qt::LeftButton, Qt::NoModifier, end);
}

//------------------------------------------------------------------------------
// Small and quickly planned.
State MakeState()
{
  State state;
  state.Material = "pink-felt";
  state.Environment = "sky";
  state.ReferenceHeight = 32;
  state.Backdrop = false;
  state.Lights = 4;
  return state;
}

//------------------------------------------------------------------------------
// Under one light nothing is planned, so that it is there at once.
State MakeLightState()
{
  State state = MakeState();
  state.Material = "model:BlinnPhong";
  state.Environment = DirectionalLightName;
  return state;
}

//------------------------------------------------------------------------------
double GetMean(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

//------------------------------------------------------------------------------
// f of the material that is shown, light and view at the normal.
double Evaluate(Window& window)
{
  const double up[3] = { 0.0, 0.0, 1.0 };
  double f[3];
  window.GetSession()->GetMaterial().BRDF->Evaluate(up, up, f);
  return f[0];
}

//------------------------------------------------------------------------------
void Drop(Window& window, const QString& file)
{
  QMimeData data;
  data.setUrls({ QUrl::fromLocalFile(file) });
  // Qt delivers a drop to what accepted the drag before.
  QDragEnterEvent enter(QPoint(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window, &enter);
  QDropEvent event(QPoint(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window, &event);
}
}

class ExplorerWindow : public QObject
{
  Q_OBJECT

private Q_SLOTS:
  void initTestCase();
  void cleanupTestCase() { this->Shared.reset(); }
  void allTabsFit();
  void settlesWithinTheTolerance();
  void toleranceGivesANewPlan();
  void lineIsDragged();
  void sidesContinueEachOther();
  void screenShowsRadiance_data();
  void screenShowsRadiance();
  void sameMethodsDoNotDiffer();
  void likeIsComparedWithLike();
  void badFilesChangeNothing();
  void filesAreOpened();
  void stateComesBack();
  void environmentIsDragged();
  void lightIsDragged();
  void slicesAndFindings();
  void materialsAreCompared();
  void transmissionIsShown();
  void pictureAndReport();
  void oneLightOnBothSides();
  void slidersSetAModel();
  void modelIsSaved();
  void exceptionsAreMessages();
  void closesWhileWorking();

private:
  /// The one window of most tests, whose shaders have been compiled, with another state.
  Window* Show(const State& state);

  template <typename Widget>
  Widget* Find(const QString& name = QString()) const
  {
    return this->Shared->findChild<Widget*>(name);
  }

  std::unique_ptr<Window> Shared;
  QTemporaryDir Folder;
};

//------------------------------------------------------------------------------
void ExplorerWindow::initTestCase()
{
  this->Shared = MakeWindow(MakeState());
  for (const int k : { 0, 1 })
  {
    // VTK's 1024 samples take long on a software renderer.
    auto* renderer = vtkOpenGLRenderer::SafeDownCast(this->Shared->GetSide(k)->GetRenderer());
    QVERIFY(renderer);
    renderer->GetEnvMapLookupTable()->SetLUTSamples(64);
    renderer->GetEnvMapPrefiltered()->SetPrefilterMaxSamples(64);
  }
}

//------------------------------------------------------------------------------
Window* ExplorerWindow::Show(const State& state)
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
             now.Mesh == state.Mesh;
    },
    Patience);
  if (!read)
  {
    qWarning("the state's files were not read");
  }
  QTest::qWait(1); // the boxes of lists that were made anew are deleted by then
  this->Shared->GetView()->ResetCamera();
  return this->Shared.get();
}

//------------------------------------------------------------------------------
void ExplorerWindow::allTabsFit()
{
  const QTabBar* bar = this->Find<QTabWidget>()->tabBar();
  QCOMPARE(bar->count(), 7);
  for (int k = 0; k < bar->count(); ++k)
  {
    const QRect tab = bar->tabRect(k);
    QVERIFY2(bar->rect().contains(tab), qPrintable(bar->tabText(k)));
    const int text = bar->fontMetrics().horizontalAdvance(bar->tabText(k));
    QVERIFY2(tab.width() >= text + 8, qPrintable(bar->tabText(k)));
  }
  const auto* light = this->Find<QWidget>("light fields");
  QVERIFY2(light->minimumSizeHint().width() <= bar->width() - 12, // of margins
    qPrintable(QString::number(light->minimumSizeHint().width())));
  const int width = this->Shared->minimumSizeHint().width();
  QVERIFY2(width <= 1366, qPrintable(QString::number(width))); // a small laptop's screen
}

//------------------------------------------------------------------------------
void ExplorerWindow::settlesWithinTheTolerance()
{
  Window* window = this->Show(MakeState());
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  Evaluation* evaluation = window->GetEvaluation();
  QVERIFY(evaluation->IsComplete());
  // The plan's tolerance is a mean over all views; one view may have more.
  const double error = evaluation->GetFigures(0).Error;
  QVERIFY2(error > 0.0 && error < 3.0 * 0.02, qPrintable(QString::number(error)));
  QVERIFY(evaluation->GetFigures(0).Frame > 0.0);
  QCOMPARE(evaluation->GetFigures(1).Error, 0.0); // the reference
  QVERIFY(window->GetMessage().isEmpty());
  QVERIFY(window->GetSide(0)->Describe().startsWith("Planned: "));
  QVERIFY(window->GetSide(0)->GetPlanner());
  // One light in the environment's place.
  window->ShowTab("Light");
  QVERIFY(!this->Find<QWidget>("light fields")->isVisible());
  window->GetSession()->SetEnvironment(DirectionalLightName);
  QTRY_VERIFY(window->GetSession()->IsDirectional());
  QVERIFY(!window->GetSession()->GetEnvironment());
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  QVERIFY(window->GetEvaluation()->GetFigures(0).Error < 2e-3);
  QVERIFY(this->Find<QWidget>("light fields")->isVisible());
  QVERIFY(!this->Find<SkyView>()->isVisible());
  const std::pair<const char*, double> fields[] = { { "polar angle", 60.0 }, { "azimuth", -45.0 },
    { "irradiance", 0.5 } };
  for (const auto& [name, value] : fields)
  {
    this->Find<QDoubleSpinBox>(name)->setValue(value);
  }
  const LightState& light = window->GetSession()->GetState().Light;
  QVERIFY(light.Theta == 60.0 && light.Phi == -45.0 && light.Irradiance == 0.5);
}

//------------------------------------------------------------------------------
void ExplorerWindow::toleranceGivesANewPlan()
{
  Window* window = this->Show(MakeState());
  Side* side = window->GetSide(0);
  QTRY_VERIFY_WITH_TIMEOUT(side->IsReady(), Patience);
  QCOMPARE(side->GetPlanner()->GetErrorTolerance(), 0.02);
  QSlider* slider = this->Find<QSlider>("tolerance");
  slider->setFocus();
  QTest::keyClick(slider, Qt::Key_End); // 100 %
  QCOMPARE(window->GetSession()->GetState().Tolerance, 1.0);
  QTRY_VERIFY_WITH_TIMEOUT(
    side->IsReady() && side->GetPlanner()->GetErrorTolerance() == 1.0, Patience);
  slider->setValue(40);
  QTRY_VERIFY_WITH_TIMEOUT(
    side->IsReady() && std::abs(side->GetPlanner()->GetErrorTolerance() - 0.01) < 1e-9, Patience);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  QVERIFY(window->GetEvaluation()->GetFigures(0).Error < 0.03);
}

//------------------------------------------------------------------------------
void ExplorerWindow::lineIsDragged()
{
  Window* window = this->Show(MakeLightState());
  QTRY_VERIFY_WITH_TIMEOUT(window->GetSide(0)->IsReady(), Patience);
  SplitView* view = window->GetView();
  Session* session = window->GetSession();
  const QString camera = QString::number(session->GetState().Camera.Position[0], 'g', 17);
  const QPoint begin(view->GetLinePosition(), view->height() / 2);
  const QPoint end(view->width() / 4, view->height() / 3);
  Drag(view, begin, end);
  QVERIFY(std::abs(view->GetLinePosition() - end.x()) <= 1);
  QCOMPARE(QString::number(session->GetState().Camera.Position[0], 'g', 17), camera);
  // Beside the line the mesh turns and the line stays.
  const double split = session->GetState().Split;
  const QPoint beside(3 * view->width() / 4, view->height() / 2);
  const QPoint later = beside + QPoint(40, 10);
  Drag(view, beside, later);
  QTRY_VERIFY(QString::number(session->GetState().Camera.Position[0], 'g', 17) != camera);
  QCOMPARE(session->GetState().Split, split);
  // Keys move it, and those that would close VTK's own windows do nothing.
  QTest::keyClick(view, Qt::Key_Right);
  QVERIFY(std::abs(session->GetState().Split - split - 0.01) < 1e-12);
  QTest::keyClick(view, Qt::Key_Q);
  QVERIFY(window->isVisible());
}

//------------------------------------------------------------------------------
// With one method on both sides the line must not be seen in the picture.
void ExplorerWindow::sidesContinueEachOther()
{
  State state = MakeLightState();
  state.Methods = { method::Planned, method::Planned };
  Window* window = this->Show(state);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  SplitView* view = window->GetView();
  QImage pictures[2];
  for (const int k : { 0, 1 })
  {
    window->GetSession()->SetSplit(k == 0 ? 0.37 : 1.0);
    QTest::qWait(200);
    pictures[k] = view->grabFramebuffer().convertToFormat(QImage::Format_RGB32);
  }
  const int line = static_cast<int>(0.37 * pictures[0].width());
  int different = 0;
  int compared = 0;
  for (int y = pictures[0].height() / 4; y < pictures[0].height() * 3 / 4;
       ++y) // without the labels
  {
    for (int x = 0; x < pictures[0].width() - 8; ++x)
    {
      if (std::abs(x - line) < 5)
      {
        continue;
      }
      const QColor a(pictures[0].pixel(x, y));
      const QColor b(pictures[1].pixel(x, y));
      ++compared;
      different += std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) +
                     std::abs(a.blue() - b.blue()) >
                   6;
    }
  }
  // The edge of the mesh is smoothed in each part by itself.
  QVERIFY2(
    different < compared / 100, qPrintable(QString("%1 of %2").arg(different).arg(compared)));
}

//------------------------------------------------------------------------------
void ExplorerWindow::screenShowsRadiance_data()
{
  QTest::addColumn<QString>("method");
  QTest::addColumn<int>("power"); // of two, that a sky's radiance is times
  QTest::newRow("planned") << method::Planned << 0;
  QTest::newRow("planned, bright map") << method::Planned << 20;
  QTest::newRow("stock, bright map") << method::PBR << 20;
}

//------------------------------------------------------------------------------
// Without exposure, the screen shows what the mapper shows in a program of one's own:
// radiance^(1/2.2). Stops are powers of two of radiance. The shader and the exact pictures do the
// same.
void ExplorerWindow::screenShowsRadiance()
{
  QFETCH(QString, method);
  QFETCH(int, power);
  State state = MakeState();
  const QTemporaryDir folder;
  if (power > 0) // as Radiance RGBE: brighter above
  {
    constexpr int half = 64 * 16;
    state.Environment = folder.filePath("bright.hdr").toStdString();
    state.EnvironmentFiles = { state.Environment };
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
    for (int k = 0; k < 2 * half; ++k)
    {
      bytes += { char(128), char(128), char(160), char((k < half ? 129 : 127) + power) };
    }
    std::ofstream(state.Environment, std::ios::binary) << bytes;
  }
  state.Methods = { method.toStdString(), method::LightSet };
  state.Split = 1.0;
  state.Exposure = -power;
  Window* window = this->Show(state);
  QTRY_VERIFY_WITH_TIMEOUT(window->GetSide(0)->IsReady(), Patience);
  QTest::qWait(200);
  SplitView* view = window->GetView();
  const QImage shown = view->grabFramebuffer();
  double frame = 0.0;
  const tool::Picture radiance =
    window->GetSide(0)->Capture(view->GetCamera(), { shown.width(), shown.height() }, frame);
  const double factor = std::exp2(-power);
  const auto expected =
    MakeImage(radiance, FindExposure(window->GetSession()->GetEnvironment(), -power));
  int brightest = 0;
  for (const int dx : { -60, -20, 0, 20, 60 })
  {
    const int x = shown.width() / 2 + dx;
    const int y = shown.height() / 2;
    const QColor pixel(shown.pixel(x, y));
    const auto* bytes =
      static_cast<unsigned char*>(expected->GetScalarPointer(x, shown.height() - 1 - y, 0));
    const int shownRgb[3] = { pixel.red(), pixel.green(), pixel.blue() };
    for (int c = 0; c < 3; ++c)
    {
      QVERIFY2(std::abs(shownRgb[c] - bytes[c]) <= 2, qPrintable(QString::number(shownRgb[c])));
    }
    const double red = factor * radiance.At(x, shown.height() - 1 - y)[0];
    QVERIFY(std::abs(bytes[0] - 255.0 * std::min(1.0, std::pow(red, 1.0 / 2.2))) < 0.51);
    brightest = std::max(brightest, pixel.red());
  }
  QVERIFY(brightest > 100);
}

//------------------------------------------------------------------------------
// What a mesh hides is drawn as by every mapper, but not beside the exact picture.
void ExplorerWindow::likeIsComparedWithLike()
{
  Window* window = this->Show(MakeState());
  const auto getMode = [window]()
  {
    vtkActorCollection* actors = window->GetSide(0)->GetRenderer()->GetActors();
    actors->InitTraversal();
    auto* mapper = vtkMeasuredBRDFMapper::SafeDownCast(actors->GetNextActor()->GetMapper());
    return mapper ? mapper->GetOcclusionMode() : -1;
  };
  QCOMPARE(getMode(), int(vtkMeasuredBRDFMapper::OCCLUSION_OFF));
  window->GetSession()->SetMethod(1, method::LightSet);
  QCOMPARE(getMode(), int(vtkMeasuredBRDFMapper::OCCLUSION_AUTO));
  window->GetSession()->SetMethod(1, method::Reference);
  QCOMPARE(getMode(), int(vtkMeasuredBRDFMapper::OCCLUSION_OFF));
}

//------------------------------------------------------------------------------
void ExplorerWindow::sameMethodsDoNotDiffer()
{
  State state = MakeState();
  state.Methods = { method::Planned, method::Planned };
  Window* window = this->Show(state);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  double mean = -1.0;
  QVERIFY(window->GetEvaluation()->MakeDifference(mean));
  QCOMPARE(mean, 0.0);
  for (const char* key : { method::PBR, method::Thesis })
  {
    window->GetSession()->SetMethod(1, key);
    QVERIFY(!window->IsSettled());
    QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
    QVERIFY(window->GetEvaluation()->MakeDifference(mean));
    QVERIFY2(mean > 0.0 && mean < 1.5, key);
    const double error = window->GetEvaluation()->GetFigures(1).Error;
    QVERIFY2(error > 0.0 && error < 1.5, key);
  }
}

//------------------------------------------------------------------------------
void ExplorerWindow::badFilesChangeNothing()
{
  Window* window = this->Show(MakeLightState());
  QTRY_VERIFY_WITH_TIMEOUT(window->GetSide(0)->IsReady(), Patience);
  const std::string before = WriteState(window->GetSession()->GetState());
  const QTemporaryDir folder;
  const auto brdf = window->GetSession()->GetMaterial().BRDF;
  for (const char* name : { "bad.binary", "bad.hdr", "bad.ply", "bad.json", "bad.xyz" })
  {
    const QString path = folder.filePath(name);
    std::ofstream(path.toStdString()) << "no such thing";
    Drop(*window, path);
    QTRY_VERIFY_WITH_TIMEOUT(window->GetMessage().contains(name), Patience);
    QTRY_VERIFY(window->GetJobs()->IsIdle());
    QCOMPARE(WriteState(window->GetSession()->GetState()), before);
    QVERIFY(window->GetSession()->GetMaterial().BRDF == brdf);
  }
  Drop(*window, folder.filePath("none.bsdf"));
  QTRY_VERIFY_WITH_TIMEOUT(window->GetMessage().contains("none.bsdf"), Patience);
  QCOMPARE(WriteState(window->GetSession()->GetState()), before);
}

//------------------------------------------------------------------------------
void ExplorerWindow::filesAreOpened()
{
  Window* window = this->Show(MakeLightState());
  QTRY_VERIFY_WITH_TIMEOUT(window->GetSide(0)->IsReady(), Patience);
  const QTemporaryDir folder;
  const QString path = folder.filePath("gold.exr"); // which could be an environment, too
  const auto gold = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  try
  {
    tool::WriteMaterial(gold, path.toStdString());
  }
  catch (const tool::Error& error)
  {
    QFAIL(error.what());
  }
  Drop(*window, path);
  Session* session = window->GetSession();
  QTRY_COMPARE_WITH_TIMEOUT(session->GetState().Material, path.toStdString(), Patience);
  QCOMPARE(session->GetState().MaterialFiles, std::vector<std::string>{ path.toStdString() });
  QTRY_VERIFY_WITH_TIMEOUT(window->GetSide(0)->IsReady(), Patience);
  QVERIFY(window->windowTitle().contains("under directional-light"));
  session->SetMesh("ball-on-foot");
  QTRY_COMPARE_WITH_TIMEOUT(session->GetState().Mesh, std::string("ball-on-foot"), Patience);
  // Others while some are read.
  session->Open({ path, "silver-metallic-paint", "hall" });
  session->Open({ folder.filePath("none.hdr") });
  QTRY_VERIFY_WITH_TIMEOUT(window->GetMessage().contains("none.hdr"), Patience);
  QCOMPARE(session->GetState().Environment, std::string("hall")); // one after the other
}

//------------------------------------------------------------------------------
void ExplorerWindow::stateComesBack()
{
  const QTemporaryDir folder;
  const QString path = folder.filePath("state.json");
  std::string saved;
  {
    State state = MakeLightState(); // nothing to be planned, or traced
    state.Methods = { method::LightSet, method::SoftLights };
    Session* session = this->Show(state)->GetSession();
    session->SetSplit(0.3);
    session->SetTolerance(0.05);
    session->SetRotation(33.0);
    session->SetLights(16);
    session->SetMesh("ball-on-foot");
    QTRY_COMPARE_WITH_TIMEOUT(session->GetState().Mesh, std::string("ball-on-foot"), Patience);
    CameraState camera = session->GetState().Camera;
    camera.Position[0] += 0.5;
    session->Set(&State::Camera, camera, &Session::cameraChanged);
    QVERIFY(session->Save(path.toStdString()));
    saved = WriteState(session->GetState());
  }
  Window* window = this->Show(MakeState());
  Drop(*window, path);
  QTRY_COMPARE_WITH_TIMEOUT(WriteState(window->GetSession()->GetState()), saved, Patience);
  QCOMPARE(this->Find<QComboBox>("method B")->currentData().toString(), QString("soft-lights"));
  // What a state names but is not there leaves what is shown.
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QByteArray text = file.readAll().replace("model:BlinnPhong", "no-such-felt");
  const QString other = folder.filePath("other.json");
  std::ofstream(other.toStdString()) << text.toStdString();
  QVERIFY(window->GetSession()->Load(other.toStdString()));
  QTRY_VERIFY_WITH_TIMEOUT(window->GetMessage().contains("no-such-felt"), Patience);
  QCOMPARE(window->GetSession()->GetState().Material, std::string("model:BlinnPhong"));
}

//------------------------------------------------------------------------------
void ExplorerWindow::environmentIsDragged()
{
  Window* window = this->Show(MakeState());
  window->ShowTab("Light");
  auto* view = this->Find<SkyView>();
  QTRY_VERIFY_WITH_TIMEOUT(!view->GetImage().isNull(), Patience);
  const int width = std::min(view->width(), 2 * view->height());
  const QPoint begin(view->width() / 2, view->height() / 2);
  const QPoint end = begin + QPoint(width / 8, 0);
  Drag(view, begin, end);
  const double rotation = window->GetSession()->GetState().Rotation;
  QVERIFY2(
    std::abs(rotation + 360.0 * (width / 8) / width) < 1e-9, qPrintable(QString::number(rotation)));
}

//------------------------------------------------------------------------------
void ExplorerWindow::lightIsDragged()
{
  Window* window = this->Show(MakeState());
  window->ShowTab("Lobe");
  auto* view = this->Find<LobeView>();
  Session* session = window->GetSession();
  QTRY_VERIFY_WITH_TIMEOUT(session->GetMaterial().BRDF, Patience);
  QTest::qWait(300);
  const QPoint begin = view->GetHandlePosition();
  QVERIFY(view->rect().contains(begin));
  const QPoint end = begin + QPoint(30, 20);
  Drag(view, begin, end);
  QTest::qWait(300);
  const QPoint distance = view->GetHandlePosition() - end;
  QVERIFY2(distance.manhattanLength() <= 3,
    qPrintable(QString("%1 %2").arg(distance.x()).arg(distance.y())));
}

//------------------------------------------------------------------------------
void ExplorerWindow::slicesAndFindings()
{
  Window* window = this->Show(MakeState());
  window->ShowTab("Slices");
  auto* view = this->Find<SliceView>();
  QTRY_VERIFY_WITH_TIMEOUT(!window->GetSession()->GetInspection().is_null(), Patience);
  QTRY_VERIFY(view->GetCurves(SliceView::Albedo).front().Degrees.size() == 10);
  // theta_h = 90 degrees may be below the horizon
  QVERIFY(view->GetCurves(SliceView::ThetaH).front().Degrees.size() >= 360);
  // Half vector 0, difference 30 degrees: light from there, seen from the mirror direction.
  window->GetSession()->Set(&State::SliceThetaD, 30.0, &Session::slicesChanged);
  const double s = 0.5;
  const double c = std::sqrt(0.75);
  const double i[3] = { 0.0, s, c };
  const double o[3] = { 0.0, -s, c };
  double f[3];
  window->GetSession()->GetMaterial().BRDF->Evaluate(i, o, f);
  const double drawn = view->GetCurves(SliceView::ThetaH).front().Values[0][1];
  QVERIFY2(std::abs(drawn - f[1]) < 1e-3 * f[1], qPrintable(QString::number(drawn)));
}

//------------------------------------------------------------------------------
// Ticked materials are in all charts, the polar one too, until they are taken out.
void ExplorerWindow::materialsAreCompared()
{
  Window* window = this->Show(MakeState());
  window->ShowTab("Slices");
  auto* view = this->Find<SliceView>();
  const auto* legend = this->Find<QLabel>("slice legend");
  QTRY_VERIFY_WITH_TIMEOUT(window->GetSession()->GetMaterial().BRDF, Patience);
  QVERIFY(legend->text().isEmpty());
  auto* box = this->Find<QCheckBox>("compare nickel");
  QVERIFY(box);
  box->click();
  QTRY_VERIFY_WITH_TIMEOUT(window->GetSession()->GetChartedMaterials().size() == 2, Patience);
  QTRY_VERIFY(view->GetCurves(SliceView::ThetaH).size() == 2);
  QTRY_VERIFY(legend->text().contains("nickel"));
  window->GetSession()->Set(&State::SlicePolar, true, &Session::slicesChanged);
  QTRY_VERIFY(view->GetCurves(SliceView::Plane).size() == 2);
  QCOMPARE(window->GetSession()->GetState().Compared, std::vector<std::string>{ "nickel" });
  box->click();
  QTRY_VERIFY(view->GetCurves(SliceView::Plane).size() == 1);
  QVERIFY(legend->text().isEmpty());
  // A model with its parameters.
  window->GetSession()->Set(&State::SlicePolar, false, &Session::slicesChanged);
  window->GetSession()->SetCompared("model:Lambert albedo=0.4,0.4,0.4", true);
  QTRY_VERIFY_WITH_TIMEOUT(view->GetCurves(SliceView::ThetaH).size() == 2, Patience);
  QVERIFY(
    std::abs(view->GetCurves(SliceView::ThetaH)[1].Values[0][0] - 0.4 / vtkMath::Pi()) < 1e-6);
  this->Find<QCheckBox>("compare model:Lambert albedo=0.4,0.4,0.4")->click();
  QTRY_VERIFY(view->GetCurves(SliceView::ThetaH).size() == 1);
}

//------------------------------------------------------------------------------
// Below the surface in the lobe and the polar chart, dashed beside the albedo, in the findings; and
// gone with the material.
void ExplorerWindow::transmissionIsShown()
{
  const QTemporaryDir folder;
  const QString file = folder.filePath("shade.xml");
  {
    std::ofstream stream(file.toStdString());
    stream << MakeBsdfXmlTree(3, "{0.1}",
      MakeBsdfXmlTreeBlock("Transmission Front", "{0.2}") +
        MakeBsdfXmlTreeBlock("Transmission Back", "{0.15}"));
  }
  State state = MakeLightState();
  state.Methods = { method::PBR,
    method::PBR }; // others would prepare it for shaders, which takes long
  Window* window = this->Show(state);
  Session* session = window->GetSession();
  auto* view = this->Find<LobeView>();
  const auto* note = this->Find<QLabel>("lobe note");
  vtkBRDFLobeSource* lobe = view->GetSource();
  window->ShowTab("Lobe");
  QVERIFY(!lobe->GetTransmission());
  QVERIFY(!note->isVisible());
  int saidOfPictures = 0;
  const auto connection = connect(session, &Session::messaged, session,
    [&](const QString& text) { saidOfPictures += text.contains("show reflection only") ? 1 : 0; });
  Drop(*window, file);
  QTRY_VERIFY_WITH_TIMEOUT(lobe->GetTransmission() != nullptr, Patience);
  QVERIFY(note->isVisible());
  session->Set(&State::LobeLogarithmic, false, &Session::lobeChanged);
  session->SetLobe(40.0, 30.0);
  lobe->Update();
  QVERIFY(lobe->GetOutput()->GetBounds()[4] < -0.5);
  QTest::qWait(300);
  const QImage image = view->grabFramebuffer();
  int green = 0;
  for (int y = 0; y < image.height(); ++y)
  {
    for (int x = 0; x < image.width(); ++x)
    {
      const QColor color = image.pixelColor(x, y);
      green += color.green() > color.red() + 25 ? 1 : 0;
    }
  }
  QVERIFY2(green > 200, qPrintable(QString::number(green)));

  window->ShowTab("Slices");
  auto* charts = this->Find<SliceView>();
  QTRY_VERIFY_WITH_TIMEOUT(charts->GetTransmittances().front().Degrees.size() == 10, Patience);
  const Curve& shown = charts->GetTransmittances().front();
  QVERIFY(std::abs(shown.Values[0][1] - 0.15 * vtkMath::Pi()) < 0.01); // the file's other side
  session->Set(&State::SlicePolar, true, &Session::slicesChanged);
  const Curve& plane = charts->GetCurves(SliceView::Plane).front();
  QVERIFY(plane.Degrees.front() < -90.0 && plane.Degrees.back() > 90.0);
  const QString findings = this->Find<QPlainTextEdit>("findings")->toPlainText();
  QVERIFY(findings.contains("reciprocity") && findings.contains("transmission"));
  QCOMPARE(saidOfPictures, 1);
  disconnect(connection);

  this->Show(state);
  QVERIFY(!lobe->GetTransmission());
  session->Set(&State::SlicePolar, true, &Session::slicesChanged);
  QVERIFY(charts->GetCurves(SliceView::Plane).front().Degrees.back() < 90.0);
  QVERIFY(charts->GetTransmittances().front().Degrees.empty());
  window->ShowTab("Lobe");
  QVERIFY(!note->isVisible());
}

//------------------------------------------------------------------------------
void ExplorerWindow::pictureAndReport()
{
  State state = MakeState();
  state.Methods = { method::Planned, method::LightSet };
  Window* window = this->Show(state);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  const QTemporaryDir folder;
  const int height = window->GetView()->height(); // a message above it takes some of it
  QVERIFY(window->SavePicture(folder.filePath("picture.png")));
  QCOMPARE(QImage(folder.filePath("picture.png")).height(), height);
  QVERIFY(!window->SavePicture(folder.filePath("none/picture.png")));
  QVERIFY(window->GetMessage().contains("none"));

  // Samples add up until then.
  vtkActorCollection* actors = window->GetSide(0)->GetRenderer()->GetActors();
  actors->InitTraversal();
  auto* mapper = vtkMeasuredBRDFMapper::SafeDownCast(actors->GetNextActor()->GetMapper());
  vtkNew<vtkFilteredRadianceIntegrator> samples;
  mapper->SetIntegrator(samples);
  vtkRenderWindow* shown = window->GetView()->renderWindow();
  shown->SetDesiredUpdateRate(1e9);
  shown->Render();
  QVERIFY(mapper->GetPlanPending());
  QVERIFY(window->SavePicture(folder.filePath("samples.png")));
  QVERIFY(!mapper->GetPlanPending());
  mapper->SetIntegrator(nullptr);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience); // at its new size
  const double errors[2] = { window->GetEvaluation()->GetFigures(0).Error,
    window->GetEvaluation()->GetFigures(1).Error };
  window->SaveReport(folder.filePath("report.json"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.filePath("report.json")), Patience);
  QTRY_VERIFY_WITH_TIMEOUT(!window->GetJobs()->IsRunning("report"), Patience);
  QFile file(folder.filePath("report.json"));
  QVERIFY(file.open(QIODevice::ReadOnly));
  const auto report = nlohmann::ordered_json::parse(file.readAll().toStdString());
  for (int k = 0; k < 2; ++k)
  {
    const double error = report["sides"][static_cast<std::size_t>(k)]["errors"]["relative_l1"];
    QVERIFY2(std::abs(error - errors[k]) < 1e-6, qPrintable(QString::number(error - errors[k])));
  }
  // Of the directional light, as a page.
  this->Show(MakeLightState());
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  window->SaveReport(folder.filePath("report.html"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.filePath("report.html")), Patience);
  QFile page(folder.filePath("report.html"));
  QVERIFY(page.open(QIODevice::ReadOnly));
  const QByteArray text = page.readAll();
  QCOMPARE(static_cast<int>(text.count("data:image/png;base64,")), 4);
  QVERIFY(text.contains("reciprocity") && text.contains("irradiance"));
  QVERIFY(text.contains("relative l1") && !text.contains("predicted error"));
  window->SaveReport(folder.filePath("report.doc"));
  QTRY_VERIFY_WITH_TIMEOUT(window->GetMessage().contains("report.doc"), Patience);
}

//------------------------------------------------------------------------------
// Of an event, Qt's or a timer's, on the window's thread.
void ExplorerWindow::exceptionsAreMessages()
{
  QTimer::singleShot(0, this->Shared.get(), []() { throw std::bad_alloc(); });
  QTRY_VERIFY_WITH_TIMEOUT(this->Shared->GetMessage().contains("bad_alloc"), Patience);
}

//------------------------------------------------------------------------------
// A plan that takes long, a fit and an exact picture run when the window goes.
void ExplorerWindow::closesWhileWorking()
{
  State planning = MakeState();
  planning.Material = "gold-paint";
  planning.Tolerance = 0.001;
  planning.Methods = { method::Planned, method::Reference };
  State fitting = planning;
  fitting.Methods = { method::Thesis, method::Reference };
  State integrating = MakeState();
  integrating.ReferenceHeight = 512;
  integrating.Methods = { method::Planned, method::Reference };
  const std::vector<std::pair<State, std::function<bool(Window*)>>> cases = {
    { planning,
      [](Window* window)
      {
        return window->GetSession()->GetMesh() &&
               window->GetSide(0)->Describe().endsWith(": planning");
      } },
    { fitting, [](Window* window) { return window->GetJobs()->IsRunning("method 0"); } },
    { integrating, [](Window* window) { return window->GetJobs()->IsRunning("reference"); } }
  };
  for (const auto& [state, isWorking] : cases)
  {
    const auto window = MakeWindow(state);
    QTRY_VERIFY_WITH_TIMEOUT(isWorking(window.get()), Patience);
    QTest::qWait(100);
    QVERIFY(!window->IsSettled());
    window->close();
  }
}

//------------------------------------------------------------------------------
// The graphics card's picture is the exact one but for rounding; VTK's own shading is near.
void ExplorerWindow::oneLightOnBothSides()
{
  Window* window = this->Show(MakeLightState());
  const QString message = window->GetMessage();
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  Evaluation* evaluation = window->GetEvaluation();
  QVERIFY(evaluation->IsComplete());
  const double error = evaluation->GetFigures(0).Error;
  QVERIFY2(error >= 0.0 && error < 2e-3, qPrintable(QString::number(error)));
  QVERIFY(!window->GetSide(0)->GetPlanner());
  QVERIFY(window->GetSide(0)->Describe().contains("no plan"));
  QVERIFY(window->GetSide(1)->Describe().contains("cos"));
  QCOMPARE(window->GetMessage(), message);
  // By hand: the pixels' normals and views, the formula, the mean.
  const auto surface = evaluation->GetSurface();
  const State& state = window->GetSession()->GetState();
  const glm::dvec3 light = GetDirection(state.Light);
  const std::vector<double> exact = evaluation->GetRadiance(1);
  QCOMPARE(exact.size(), surface->Normals.size());
  for (std::size_t k = 0; k < exact.size(); k += 3)
  {
    const double* n = &surface->Normals[k];
    const double* v = &surface->Views[k];
    const double cosine = vtkMath::Dot(n, &light.x);
    double h[3];
    vtkMath::Add(&light.x, v, h);
    vtkMath::Normalize(h);
    const double lobe = std::pow(std::max(0.0, vtkMath::Dot(n, h)), 50.0);
    const double f = (0.2 + 0.1 * 26.0 * lobe) / vtkMath::Pi(); // (50 + 2) / (2 pi)
    const double expected = cosine > 0.0 ? f * cosine : 0.0;
    QVERIFY2(std::abs(exact[k] - expected) < 1e-5, qPrintable(QString::number(exact[k])));
  }
  // Twice the light is twice the picture.
  const double mean = GetMean(evaluation->GetRadiance(0));
  LightState brighter = state.Light;
  brighter.Irradiance = 2.0;
  window->GetSession()->SetLight(brighter);
  QVERIFY(!window->IsSettled());
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  QVERIFY(std::abs(GetMean(evaluation->GetRadiance(0)) / mean - 2.0) < 1e-3);
  window->GetSession()->SetMethod(1, method::PBR);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  const double fitted = evaluation->GetFigures(1).Error;
  QVERIFY2(fitted > 0.0 && fitted < 0.5, qPrintable(QString::number(fitted)));
}

//------------------------------------------------------------------------------
void ExplorerWindow::slidersSetAModel()
{
  Window* window = this->Show(MakeLightState());
  Session* session = window->GetSession();
  window->ShowTab("Model");
  auto* exponent = this->Find<QDoubleSpinBox>("exponent");
  auto* slider = this->Find<QSlider>("exponent");
  QVERIFY(exponent && slider && !this->Find<QSlider>("f0 0"));
  QCOMPARE(exponent->value(), 50.0);
  slider->setFocus();
  QTest::keyClick(slider, Qt::Key_End);
  QCOMPARE(session->GetEdited(), std::string("model:BlinnPhong exponent=1000000"));
  QTest::keyClick(slider, Qt::Key_Home);
  QCOMPARE(exponent->value(), 0.0);
  this->Find<QDoubleSpinBox>("specular 0")->setValue(0.75);
  QCOMPARE(session->GetEdited(), std::string("model:BlinnPhong specular=0.75,0.1,0.1 exponent=0"));
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(Evaluate(*window) - 0.95 / vtkMath::Pi()) < 1e-9, Patience);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  QVERIFY(window->GetEvaluation()->GetFigures(0).Error < 2e-3);
  // Another model has its own rows.
  session->SetMaterial("model:AshikhminShirley");
  QTRY_VERIFY_WITH_TIMEOUT(this->Find<QDoubleSpinBox>("index_of_refraction"), Patience);
  this->Find<QDoubleSpinBox>("index_of_refraction")->setValue(1.5);
  QTRY_COMPARE_WITH_TIMEOUT(session->GetState().Material,
    std::string("model:AshikhminShirley index_of_refraction=1.5"), Patience);
}

//------------------------------------------------------------------------------
void ExplorerWindow::modelIsSaved()
{
  State state = MakeLightState();
  state.Material = "model:BlinnPhong specular=0.5,0.5,0.5";
  Window* window = this->Show(state);
  const QString path = this->Folder.filePath("model.exr");
  window->GetSession()->SaveMaterial(path.toStdString());
  QTRY_VERIFY_WITH_TIMEOUT(
    QFile::exists(path) && !window->GetJobs()->IsRunning("save material"), Patience);
  const tool::Material read = tool::LoadMaterial(path.toStdString());
  const double up[3] = { 0.0, 0.0, 1.0 };
  double f[3];
  read.BRDF->Evaluate(up, up, f);
  QVERIFY(std::abs(f[0] - Evaluate(*window)) < 1e-9);
  window->GetSession()->SaveMaterial(this->Folder.filePath("none/model.exr").toStdString());
  QTRY_VERIFY_WITH_TIMEOUT(window->GetMessage().contains("none"), Patience);
}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  if (!std::getenv("DISPLAY"))
  {
    std::puts("Skipped: the explorer's window needs an X server");
    return 125;
  }
  const Application application(argc, argv);
  ExplorerWindow test;
  return QTest::qExec(&test, argc, argv);
}

#include "ExplorerWindow.moc"
