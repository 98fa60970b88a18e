// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What people set in the explorer's window beside its methods, under an X server: the directional
// light, the parameters of models; and the samples of tables.
#include "DirectionalLight.h"
#include "ExplorerTest.h"
#include "Files.h"
#include "LightPanel.h"
#include "Samples.h"
#include "SlicePanel.h"
#include "Tool.h"

#include "vtkMath.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkTabulatedBRDF.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QSlider>
#include <QTableView>
#include <QTemporaryDir>

#include <cmath>
#include <string>
#include <vector>

using namespace explorer;

namespace
{
//------------------------------------------------------------------------------
// Under one light nothing is planned, so that it is there at once.
State MakeState()
{
  State state;
  state.Material = "model:BlinnPhong";
  state.Environment = DirectionalLightName;
  state.ReferenceHeight = 48;
  return state;
}

//------------------------------------------------------------------------------
double GetMean(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
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
}

class ExplorerEditing : public WindowTest
{
  Q_OBJECT

private Q_SLOTS:
  void initTestCase() { this->Shared = MakeWindow(MakeState()); }
  void cleanupTestCase() { this->Shared.reset(); }
  void oneLightOnBothSides();
  void oneLightIsTurned();
  void oneLightInReportAndState();
  void environmentComesBack();
  void slidersSetAModel();
  void modelsAreCompared();
  void modelIsSaved();
  void samplesOfATable();
  void otherMaterialsAreEvaluated();

private:
  /// A table of 6 x 4 x 5 samples, all 0.25, in a file.
  std::string WriteTable();

  QTemporaryDir Folder;
};

//------------------------------------------------------------------------------
std::string ExplorerEditing::WriteTable()
{
  const int dimensions[3] = { 6, 4, 5 };
  vtkNew<vtkTabulatedBRDF> table;
  table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions,
    std::vector<float>(3 * 6 * 4 * 5, 0.25f));
  const std::string path = this->Folder.filePath("table.exr").toStdString();
  tool::WriteMaterial(table, path);
  return path;
}

//------------------------------------------------------------------------------
// The graphics card's picture is the exact one but for rounding; VTK's own shading is near.
void ExplorerEditing::oneLightOnBothSides()
{
  Window* window = this->Show(MakeState());
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  Evaluation* evaluation = window->GetEvaluation();
  QVERIFY(evaluation->IsComplete());
  const double error = evaluation->GetFigures(0).Error;
  QVERIFY2(error >= 0.0 && error < 2e-3, qPrintable(QString::number(error)));
  QVERIFY(!window->GetSide(0)->GetPlanner());
  QVERIFY(window->GetSide(0)->Describe().contains("no plan"));
  QVERIFY(window->GetSide(1)->Describe().contains("cos"));
  QVERIFY2(window->GetMessage().isEmpty(), qPrintable(window->GetMessage()));
  // By hand: the pixels' normals and views, the formula, the mean.
  const auto surface = evaluation->GetSurface();
  const State& state = window->GetSession()->GetState();
  const std::array<double, 3> light = GetDirection(state.Light);
  const std::vector<double> exact = evaluation->GetRadiance(1);
  QCOMPARE(exact.size(), surface->Normals.size());
  for (std::size_t k = 0; k < exact.size(); k += 3)
  {
    const double* n = &surface->Normals[k];
    const double* v = &surface->Views[k];
    const double cosine = vtkMath::Dot(n, light.data());
    double h[3];
    vtkMath::Add(light.data(), v, h);
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
void ExplorerEditing::oneLightIsTurned()
{
  Window* window = this->Show(MakeState());
  Session* session = window->GetSession();
  window->ShowTab("Light");
  QVERIFY(this->Find<QWidget>("light fields")->isVisible());
  auto* view = this->Find<SkyView>();
  QTest::qWait(100);
  const QPoint begin = view->GetHandlePosition().toPoint();
  QVERIFY(view->rect().contains(begin));
  const QPoint end = begin + QPoint(-30, 20);
  Drag(view, begin, end);
  const QPoint rest = view->GetHandlePosition().toPoint() - end;
  QVERIFY(rest.manhattanLength() <= 1);
  QVERIFY(session->GetState().Light.Theta > 40.0);
  const LightState before = session->GetState().Light;
  QTest::keyClick(view, Qt::Key_Up);
  QTest::keyClick(view, Qt::Key_Left, Qt::ShiftModifier);
  QVERIFY(std::abs(session->GetState().Light.Theta - before.Theta + 1.0) < 1e-9);
  QVERIFY(std::abs(session->GetState().Light.Phi - before.Phi - 15.0) < 1e-9);
  this->Find<QDoubleSpinBox>("polar angle")->setValue(60.0);
  this->Find<QDoubleSpinBox>("azimuth")->setValue(-45.0);
  this->Find<QDoubleSpinBox>("irradiance")->setValue(0.5);
  QCOMPARE(session->GetState().Light.Theta, 60.0);
  QCOMPARE(session->GetState().Light.Phi, -45.0);
  QCOMPARE(session->GetState().Light.Irradiance, 0.5);
  // In the picture: to the right of the camera, which stays.
  SplitView* picture = window->GetView();
  const double right[3] = { std::cos(vtkMath::RadiansFromDegrees(30.0)), 0.0, -0.5 };
  const auto getRight = [&]()
  { return vtkMath::Dot(GetDirection(session->GetState().Light).data(), right); };
  const double share = getRight();
  const double camera = session->GetState().Camera.Position[0];
  const QPoint middle(picture->width() / 4, picture->height() / 2);
  Drag(picture, middle, middle + QPoint(40, 0), Qt::ControlModifier);
  QVERIFY(getRight() > share + 0.05);
  QCOMPARE(session->GetState().Camera.Position[0], camera);
  const double theta = session->GetState().Light.Theta;
  QTest::keyClick(picture, Qt::Key_Up, Qt::ControlModifier);
  QVERIFY(session->GetState().Light.Theta < theta - 1.0);
}

//------------------------------------------------------------------------------
void ExplorerEditing::oneLightInReportAndState()
{
  State state = MakeState();
  state.Light = { 55.0, 20.0, 3.0 };
  Window* window = this->Show(state);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  const State again = ReadState(WriteState(window->GetSession()->GetState()), "s");
  QCOMPARE(again.Environment, std::string(DirectionalLightName));
  QCOMPARE(again.Light.Theta, 55.0);
  const QString path = this->Folder.filePath("report.json");
  window->SaveReport(path);
  QTRY_VERIFY_WITH_TIMEOUT(
    QFile::exists(path) && !window->GetJobs()->IsRunning("report"), Patience);
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const auto report = nlohmann::ordered_json::parse(file.readAll().toStdString());
  QCOMPARE(report["light"]["irradiance"].get<double>(), 3.0);
  QVERIFY(report["sides"][0]["errors"]["relative_l1"].get<double>() < 2e-3);
  QVERIFY(!report["sides"][0].contains("predicted_error"));
}

//------------------------------------------------------------------------------
void ExplorerEditing::environmentComesBack()
{
  State state = MakeState();
  state.Environment = "sky";
  Window* window = this->Show(state);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  QVERIFY(window->GetSide(0)->Describe().startsWith("Planned: "));
  QVERIFY(window->GetSide(0)->GetPlanner());
  window->ShowTab("Light");
  QVERIFY(!this->Find<QWidget>("light fields")->isVisible());
  window->GetSession()->SetEnvironment(DirectionalLightName);
  QVERIFY(window->GetSession()->IsDirectional());
  QVERIFY(!window->GetSession()->GetEnvironment());
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  QVERIFY(window->GetEvaluation()->GetFigures(0).Error < 2e-3);
}

//------------------------------------------------------------------------------
void ExplorerEditing::slidersSetAModel()
{
  Window* window = this->Show(MakeState());
  Session* session = window->GetSession();
  window->ShowTab("Model");
  auto* exponent = this->Find<QDoubleSpinBox>("exponent");
  auto* slider = this->Find<QSlider>("exponent");
  QVERIFY(exponent && slider && !this->Find<QSlider>("f0 0"));
  QCOMPARE(exponent->value(), 50.0);
  slider->setFocus();
  QTest::keyClick(slider, Qt::Key_End);
  QCOMPARE(session->GetState().Models.at("BlinnPhong").at("exponent")[0], 1e6);
  QTest::keyClick(slider, Qt::Key_Home);
  QCOMPARE(exponent->value(), 0.0);
  this->Find<QDoubleSpinBox>("specular 0")->setValue(0.75);
  QCOMPARE(session->GetState().Models.at("BlinnPhong").at("specular"),
    (std::vector<double>{ 0.75, 0.1, 0.1 }));
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(Evaluate(*window) - 0.95 / vtkMath::Pi()) < 1e-9, Patience);
  QTRY_VERIFY_WITH_TIMEOUT(window->IsSettled(), Patience);
  QVERIFY(window->GetEvaluation()->GetFigures(0).Error < 2e-3);
  // Another model has its own rows, and the first keeps its values.
  auto* models = this->Find<QComboBox>("models");
  models->setCurrentIndex(models->findData("model:AshikhminShirley"));
  Q_EMIT models->activated(models->currentIndex());
  QTRY_VERIFY_WITH_TIMEOUT(this->Find<QComboBox>("fresnel"), Patience);
  auto* fresnel = this->Find<QComboBox>("fresnel");
  fresnel->setCurrentIndex(1);
  Q_EMIT fresnel->activated(1);
  QCOMPARE(session->GetState().Models.at("AshikhminShirley").at("fresnel")[0], 1.0);
  session->SetMaterial("model:BlinnPhong");
  QTRY_VERIFY_WITH_TIMEOUT(this->Find<QDoubleSpinBox>("specular 0"), Patience);
  QCOMPARE(this->Find<QDoubleSpinBox>("specular 0")->value(), 0.75);
}

//------------------------------------------------------------------------------
// Beside a measured material, with new parameters as soon as they are set.
void ExplorerEditing::modelsAreCompared()
{
  State state = MakeState();
  state.Material = "pink-felt";
  Window* window = this->Show(state);
  window->ShowTab("Slices");
  auto* view = this->Find<SliceView>();
  auto* box = this->Find<QCheckBox>("compare model:Lambert");
  QVERIFY(box);
  box->click();
  QTRY_VERIFY_WITH_TIMEOUT(view->GetCurves(SliceView::ThetaH).size() == 2, Patience);
  const auto getValue = [&]() { return view->GetCurves(SliceView::ThetaH)[1].Values[0][0]; };
  QVERIFY(std::abs(getValue() - 0.8 / vtkMath::Pi()) < 1e-6);
  window->GetSession()->SetModelValues("Lambert", "albedo", { 0.4, 0.4, 0.4 });
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(getValue() - 0.4 / vtkMath::Pi()) < 1e-6, Patience);
}

//------------------------------------------------------------------------------
void ExplorerEditing::modelIsSaved()
{
#if !MEASUREDBRDF_WITH_OPENEXR
  QSKIP("without OpenEXR no material is written");
#endif
  State state = MakeState();
  state.Models["BlinnPhong"]["specular"] = { 0.5, 0.5, 0.5 };
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
void ExplorerEditing::samplesOfATable()
{
#if !MEASUREDBRDF_WITH_OPENEXR
  QSKIP("without OpenEXR there is no small file of a table to write");
#endif
  State state = MakeState();
  state.Material = this->WriteTable();
  state.LobeThetaI = 60.0;
  Window* window = this->Show(state);
  SamplePanel* panel = window->GetSamplePanel();
  window->ShowTab("Samples");
  SampleModel* model = panel->GetModel();
  QCOMPARE(model->rowCount(), 120);
  QCOMPARE(model->data(model->index(0, 3)).toString(), QString("0.25"));
  QCOMPARE(model->headerData(1, Qt::Horizontal, Qt::DisplayRole).toString(), QString("θd"));
  QCOMPARE(model->data(model->index(119, 3)).toString(), QString("–")); // below the horizon
  panel->GoToLobe();
  const int row = panel->GetView()->currentIndex().row();
  QCOMPARE(model->GetTable().GetAngles(row)[0], 90.0 * 0.01); // the first of 5
  QCOMPARE(model->GetTable().GetAngles(row)[1], 56.25);       // of 4, the nearest to 60
  window->GetSession()->Edit(&Session::slicesChanged,
    [](State& now)
    {
      now.SliceThetaH = 40.0;
      now.SliceThetaD = 10.0;
      now.SlicePhiD = 20.0;
    });
  panel->GoToSlices();
  const std::array<double, 3> cut =
    model->GetTable().GetAngles(panel->GetView()->currentIndex().row());
  QVERIFY(std::abs(cut[0] - 44.1) < 1e-9 && std::abs(cut[1] - 11.25) < 1e-9);
}

//------------------------------------------------------------------------------
void ExplorerEditing::otherMaterialsAreEvaluated()
{
  Window* window = this->Show(MakeState());
  SamplePanel* panel = window->GetSamplePanel();
  SampleModel* model = panel->GetModel();
  QTRY_COMPARE(model->rowCount(), 180 * 90 * 90);
  QVERIFY(panel->GetNote().contains("no table"));
  const double shown = model->data(model->index(0, 3)).toDouble();
  QVERIFY(std::abs(shown - Evaluate(*window)) < 1e-3);
}

//------------------------------------------------------------------------------
int main(int argc, char* argv[]) { return RunTest<ExplorerEditing>(argc, argv); }

#include "ExplorerEditing.moc"
