// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The explorer's parts that need no window: states, jobs, kinds of files, transmission, charts, the
// directional light, models with parameters.
#include "Display.h"
#include "Inspection.h"
#include "Jobs.h"
#include "JsonReport.h"
#include "LightPanel.h"
#include "Materials.h"
#include "Progress.h"
#include "Session.h"
#include "SlicePanel.h"
#include "State.h"
#include "Tool.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFData.h"
#include "vtkBRDFModels.h"
#include "vtkBTDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <QCoreApplication>
#include <QTemporaryDir>
#include <QtTest>

#include <array>
#include <atomic>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <vector>

using namespace explorer;

class ExplorerParts : public QObject
{
  Q_OBJECT

private Q_SLOTS:
  void stateRoundTrip();
  void stateDefaults();
  void badStates_data();
  void badStates();
  void stateFindsFilesBesideIt();
  void fileKinds();
  void newestJobWins();
  void jobsStopAndReport();
  void failedJobsSaySo();
  void environmentShowsDirections();
  void planeOfIncidence();
  void transmissionBelowTheSurface();
  void transmissionIsFound();
  void transmissionOfGrooves();
  void chartScales();
  void comparedMaterials();
  void lightsComeFromTheirAngles();
  void anisotropicUnderOneLight();
  void modelsHaveTheirParameters();
  void modelsAreMaterials();
};

//------------------------------------------------------------------------------
void ExplorerParts::stateRoundTrip()
{
  State state;
  state.MaterialFiles = { "/a/b.binary", "/c d.bsdf#name" };
  state.EnvironmentFiles = { "/e.hdr" };
  state.Material = "/a/b.binary";
  state.Environment = "sky";
  state.Rotation = -12.25;
  state.Mesh = "ball-on-foot";
  state.Tolerance = 0.07;
  state.Methods = { method::PBR, method::Thesis };
  state.Lights = 256;
  state.Show = Shown::Difference;
  state.Split = 0.25;
  state.Exposure = -1.5;
  state.Backdrop = false;
  state.ReferenceHeight = 64;
  state.Camera = { { 1.0, 2.0, 3.0 }, { 0.5, 0.25, 0.125 }, { 0.0, 0.0, 1.0 }, 45.0 };
  state.LobeThetaI = 10.0;
  state.LobePhiI = 20.0;
  state.LobeLogarithmic = false;
  state.SliceThetaH = 30.0;
  state.SliceThetaD = 40.0;
  state.SlicePhiD = 50.0;
  state.SliceLogarithmic = false;
  state.SlicePolar = true;
  state.Light = { 30.0, -75.0, 2.5 };
  state.Compared = { "chrome", "/a/b.binary" };
  const std::string text = WriteState(state);
  const State again = ReadState(text, "state");
  QCOMPARE(WriteState(again), text);
  QCOMPARE(again.Tolerance, 0.07);
  QCOMPARE(again.Compared, state.Compared);
  QVERIFY(again.SlicePolar);
  QCOMPARE(again.Light.Phi, -75.0);
  QCOMPARE(again.Methods[1], std::string("thesis"));
  QCOMPARE(again.Camera.ViewUp[2], 1.0);
  QVERIFY(again.Show == Shown::Difference);
  QVERIFY(WriteState(State()) != text);
}

//------------------------------------------------------------------------------
void ExplorerParts::stateDefaults()
{
  const std::atomic<bool> stop{ false };
  const tool::BackgroundWork work(stop, [](const std::string&, double) {});
  const State state = ReadState(R"({"format": "measured-brdf explorer state", "version": 1,
    "exposure": 3, "lights": 16, "methods": ["factored", "basis"], "edits": {"a.exr": [[1, 0, 0, 0]]},
    "material": "model:AshikhminShirley", "models": {"AshikhminShirley": {"fresnel": [1], "exponent_u": [7]}}})",
    "s");
  QVERIFY(work.Notes.find("s: \"edits\" are left out") == 0);
  QCOMPARE(state.Lights, 16);
  State expected;
  expected.Lights = 16;
  expected.Methods = { method::Planned, method::Planned };
  expected.Material = "model:AshikhminShirley exponent_u=7 index_of_refraction=1.5";
  QCOMPARE(WriteState(state), WriteState(expected));
}

//------------------------------------------------------------------------------
void ExplorerParts::badStates_data()
{
  QTest::addColumn<QString>("field");
  QTest::addColumn<QString>("said");
  const std::pair<QString, const char*> cases[] = {
    { R"("tolerance": 7)", "tolerance" },
    { R"("tolerance": null)", "from 0.001 to 1" },
    { R"("split": "half")", "split" },
    { R"("lights": 63)", "power of two" },
    { R"("lights": 2.5)", "whole number" },
    { R"("methods": ["planned", "magic"])", "two of planned" },
    { R"("methods": ["planned"])", "two of" },
    { R"("material_files": [1])", "material_files" },
    { R"("compared": ["a", "b", "c", "d", "e", "f", "g", "h", "i"])", "at most 8" },
    { R"("compared": ["a", "a"])", "different" },
    { R"("split": )" + QString(200000, '[') + QString(200000, ']'), "nested deeper" },
    { R"("slice_polar": 1)", "slice_polar" },
    { R"("light_theta": 181)", "light_theta" },
    { R"("light_phi": "west")", "light_phi" },
    { R"("light_irradiance": -1)", "light_irradiance" },
    { R"("models": {"Lambert": {"albedo": 1}}, "material": "model:Lambert")", "models" },
    { R"("camera": 3)", "an object" },
    { R"("camera": {"position": [0, 0, 0], "focal_point": [0, 0, 0]})", "position" },
    { R"("camera": {"view_up": [0, 0, 0]})", "view_up" },
    { R"("camera": {"position": [0, 0, 1e31]})", "position" },
    { R"("camera": {"view_up": [0, 1]})", "three numbers" },
    { R"("show": "all")", "difference" },
    { R"("version": 3)", "version" },
    { R"("format": "another")", "format" },
    { "}", "JSON" },
  };
  for (const auto& [field, said] : cases)
  {
    QTest::newRow(qPrintable(field.left(60))) << field << said;
  }
}

//------------------------------------------------------------------------------
void ExplorerParts::badStates()
{
  QFETCH(QString, field);
  QFETCH(QString, said);
  QString text = R"({"format": "measured-brdf explorer state", "version": 1, )" + field + "}";
  if (field.startsWith("\"version\"") || field.startsWith("\"format\""))
  {
    text = "{" +
           QString(field.startsWith("\"version\"") ? R"("format": "measured-brdf explorer state", )"
                                                   : R"("version": 1, )") +
           field + "}";
  }
  try
  {
    ReadState(text.toStdString(), "file.json");
    QFAIL("it was read");
  }
  catch (const tool::Error& error)
  {
    QVERIFY2(QString(error.what()).contains("file.json"), error.what());
    QVERIFY2(QString(error.what()).contains(said), error.what());
  }
}

//------------------------------------------------------------------------------
void ExplorerParts::stateFindsFilesBesideIt()
{
  const QTemporaryDir folder;
  const std::string path = folder.path().toStdString();
  std::ofstream(path + "/metal.binary") << "x";
  State state;
  state.Material = "metal.binary";
  state.Mesh = "missing.ply";
  std::ofstream(path + "/state.json") << WriteState(state);
  const State read = LoadState(path + "/state.json");
  QCOMPARE(read.Material, path + "/metal.binary");
  QCOMPARE(read.Mesh, std::string("missing.ply"));
  QVERIFY_EXCEPTION_THROWN(LoadState(path + "/none.json"), tool::Error);
  std::ofstream(path + "/large.json") << std::string(2 << 20, ' ');
  QVERIFY_EXCEPTION_THROWN(LoadState(path + "/large.json"), tool::Error);
}

//------------------------------------------------------------------------------
void ExplorerParts::fileKinds()
{
  QVERIFY(FindFileKind("a.binary") == FileKind::Material);
  QVERIFY(FindFileKind("gold-paint") == FileKind::Material);
  QVERIFY(FindFileKind("a.HDR") == FileKind::Environment);
  QVERIFY(FindFileKind("a.ply") == FileKind::Mesh);
  QVERIFY(FindFileKind("a.json") == FileKind::State);
  QVERIFY(FindFileKind("a.unknown") == FileKind::Material);
}

//------------------------------------------------------------------------------
// A job that is replaced stops, and what it posts no longer arrives.
void ExplorerParts::newestJobWins()
{
  Jobs jobs;
  std::vector<int> arrived;
  std::atomic<bool> stopped{ false };
  jobs.Start("a", "first",
    [&](const Jobs::Post& post)
    {
      while (!tool::BackgroundWork::Get()->IsStopped())
      {
        QThread::msleep(1);
      }
      stopped = true;
      post([&]() { arrived.push_back(1); });
    });
  QVERIFY(jobs.IsRunning("a"));
  jobs.Start("a", "second", [&](const Jobs::Post& post) { post([&]() { arrived.push_back(2); }); });
  QTRY_VERIFY(jobs.IsIdle() && stopped);
  QCOMPARE(arrived, std::vector<int>{ 2 });
}

//------------------------------------------------------------------------------
// The destructor waits for threads that work.
void ExplorerParts::jobsStopAndReport()
{
  std::atomic<int> ended{ 0 };
  QStringList lines;
  {
    Jobs jobs;
    QObject::connect(
      &jobs, &Jobs::progressed, &jobs, [&](const QString& line, double) { lines << line; });
    for (const char* key : { "a", "b" })
    {
      jobs.Start(key, key,
        [&](const Jobs::Post&)
        {
          while (!tool::BackgroundWork::Get()->IsStopped())
          {
            QThread::msleep(1);
          }
          QThread::msleep(20);
          ++ended;
        });
    }
  }
  QCOMPARE(ended.load(), 2);
  QCOMPARE(lines.last(), QString("a, b"));
}

//------------------------------------------------------------------------------
void ExplorerParts::failedJobsSaySo()
{
  Jobs jobs;
  QString said;
  QString noted;
  QObject::connect(&jobs, &Jobs::noted, &jobs, [&](const QString& text) { noted = text; });
  jobs.Start(
    "a", "a",
    [](const Jobs::Post&)
    {
      tool::PrintNote("a note");
      throw std::runtime_error("it broke");
    },
    [&](const QString& text) { said = text; });
  QTRY_COMPARE(said, QString("it broke"));
  QTRY_COMPARE(noted, QString("a note"));
  QVERIFY(jobs.IsIdle());
}

//------------------------------------------------------------------------------
// A direction of the world is shown where the turned environment has it.
void ExplorerParts::environmentShowsDirections()
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  for (const double degrees : { 0.0, 30.0, -100.0, 179.0 })
  {
    environment->SetRotationY(degrees);
    double rows[9];
    environment->GetWorldToEnvironment(rows);
    const double world[3] = { 0.6, 0.0, 0.8 };
    double own[3];
    for (int r = 0; r < 3; ++r)
    {
      own[r] = rows[3 * r] * world[0] + rows[3 * r + 1] * world[1] + rows[3 * r + 2] * world[2];
    }
    double u[2];
    double v;
    vtkEnvironment::GetCoordinates(world, u[0], v);
    vtkEnvironment::GetCoordinates(own, u[1], v);
    const double shown = SkyView::FindShown(u[1], degrees);
    QVERIFY2(std::abs(shown - u[0]) < 1e-9, qPrintable(QString::number(degrees)));
  }
}

//------------------------------------------------------------------------------
// Light on the left, so the mirror direction is theta_i; nothing is seen from below.
void ExplorerParts::planeOfIncidence()
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  brdf->Prepare();
  const double thetaI = 40.0;
  const double phiI = 70.0;
  const Curve curve = SamplePlaneOfIncidence(brdf, thetaI, phiI);
  QCOMPARE(curve.Degrees.size(), curve.Values.size());
  QVERIFY(curve.Degrees.front() > -90.0 && curve.Degrees.back() < 90.0);
  QVERIFY(std::is_sorted(curve.Degrees.begin(), curve.Degrees.end()));
  const auto direction = [&](double theta, double phi)
  {
    const double t = vtkMath::RadiansFromDegrees(theta);
    const double p = vtkMath::RadiansFromDegrees(phi);
    return std::array<double, 3>{ std::sin(t) * std::cos(p), std::sin(t) * std::sin(p),
      std::cos(t) };
  };
  const auto at = std::find(curve.Degrees.begin(), curve.Degrees.end(), thetaI);
  QVERIFY(at != curve.Degrees.end());
  double f[3];
  brdf->Evaluate(direction(thetaI, phiI).data(), direction(thetaI, phiI + 180.0).data(), f);
  const auto& mirror = curve.Values[static_cast<std::size_t>(at - curve.Degrees.begin())];
  QVERIFY2(std::abs(mirror[0] - f[0]) < 1e-6 * f[0], qPrintable(QString::number(mirror[0])));
  const double back = curve.Degrees.front(); // on the light's side
  brdf->Evaluate(direction(thetaI, phiI).data(), direction(-back, phiI).data(), f);
  QVERIFY(std::abs(curve.Values.front()[1] - f[1]) < 1e-6 * f[1]);
}

//------------------------------------------------------------------------------
// Diffuse sheets: 0.3 / pi of light on the front, 0.2 / pi on the back.
static vtkSmartPointer<vtkBTDF> MakeSheet()
{
  auto sheet = vtkSmartPointer<vtkBTDF>::New();
  for (const auto& [side, albedo] :
    { std::pair<int, double>{ vtkBTDF::FRONT, 0.3 }, { vtkBTDF::BACK, 0.2 } })
  {
    vtkNew<vtkLambertBRDF> diffuse;
    diffuse->SetAlbedo(albedo, 0.5 * albedo, 0.0);
    sheet->SetFolded(side, diffuse);
  }
  return sheet;
}

//------------------------------------------------------------------------------
void ExplorerParts::transmissionBelowTheSurface()
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  brdf->Prepare();
  const auto sheet = MakeSheet();
  const Curve upper = SamplePlaneOfIncidence(brdf, 40.0, 70.0);
  const Curve curve = SamplePlaneOfIncidence(brdf, 40.0, 70.0, sheet);
  QCOMPARE(curve.Degrees.size(), 2 * upper.Degrees.size());
  QVERIFY(std::is_sorted(curve.Degrees.begin(), curve.Degrees.end()));
  QVERIFY(curve.Degrees.front() >= -180.0 && curve.Degrees.back() <= 180.0);
  bool hasStraight = false;
  std::size_t above = 0;
  for (std::size_t k = 0; k < curve.Degrees.size(); ++k)
  {
    const double degrees = std::abs(curve.Degrees[k]);
    const double red = curve.Values[k][0];
    if (degrees < 90.0)
    {
      QCOMPARE(curve.Degrees[k], upper.Degrees[above]);
      QCOMPARE(red, upper.Values[above++][0]);
    }
    else
    {
      QVERIFY(std::abs(red - 0.3 / vtkMath::Pi()) < 1e-9);
    }
    hasStraight = hasStraight || curve.Degrees[k] == 140.0;
  }
  QCOMPARE(above, upper.Degrees.size());
  QVERIFY(hasStraight);
}

//------------------------------------------------------------------------------
void ExplorerParts::transmissionIsFound()
{
  nlohmann::ordered_json info;
  for (const double reflectance : { 0.6, 0.8 })
  {
    info["reflectance_per_angle"] = { { { "degrees", 0.0 }, { "rgb", { 0.1, 0.1, 0.1 } } },
      { { "degrees", 60.0 }, { "rgb", { reflectance, 0.1, 0.1 } } } };
    info["transmission"] = tool::InspectTransmission(MakeSheet(), info);
    const auto& transmission = info["transmission"];
    QVERIFY(transmission["both_sides"]);
    QVERIFY(std::abs(transmission["reciprocity_error"].get<double>() - 1.0 / 3.0) < 1e-9);
    QVERIFY(std::abs(transmission["per_angle"][1]["view"][0].get<double>() - 0.2) < 1e-9);
    QVERIFY(std::abs(transmission["per_angle"][1]["light"][0].get<double>() - 0.3) < 1e-9);
    QVERIFY(std::abs(transmission["per_angle"][1]["back_light"][0].get<double>() - 0.2) < 1e-9);
    const double total = transmission["largest_reflectance_and_transmittance"];
    QVERIFY(std::abs(total - reflectance - 0.3) < 1e-9);
    QCOMPARE(transmission["gains_energy"].get<bool>(), reflectance > 0.7);
    const std::string text = tool::FormatReport(transmission);
    QVERIFY2(
      text.find("60    0.2000    0.1000    0.0000    0.3000") != std::string::npos, text.c_str());
  }
}

//------------------------------------------------------------------------------
// Of an anisotropic sheet the mean over azimuths counts, from either side.
void ExplorerParts::transmissionOfGrooves()
{
  vtkNew<vtkBTDF> sheet;
  for (int side : { vtkBTDF::FRONT, vtkBTDF::BACK })
  {
    vtkNew<vtkAshikhminShirleyBRDF> grooves;
    grooves->SetExponents(4.0, side == vtkBTDF::FRONT ? 40.0 : 80.0);
    sheet->SetFolded(side, grooves);
  }
  const nlohmann::ordered_json info = { { "reflectance_per_angle",
    { { { "degrees", 60.0 }, { "rgb", { 0.0, 0.0, 0.0 } } } } } };
  const auto row = tool::InspectTransmission(sheet, info)["per_angle"][0];
  for (const bool back : { false, true })
  {
    double mean = 0.0;
    double first = 0.0;
    for (int k = 0; k < 8; ++k)
    {
      const double phi = k * vtkMath::Pi() / 4.0;
      const double sine = std::sqrt(0.75);
      const double i[3] = { sine * std::cos(phi), sine * std::sin(phi), back ? -0.5 : 0.5 };
      double rgb[3];
      sheet->GetTransmittance(i, rgb);
      mean += rgb[0] / 8.0;
      first = k == 0 ? rgb[0] : first;
    }
    QVERIFY(std::abs(first / mean - 1.0) > 0.02);
    const double found = row[back ? "back_light" : "light"][0];
    QVERIFY2(std::abs(found - mean) < 1e-6, qPrintable(QString::number(found - mean)));
  }
}

//------------------------------------------------------------------------------
void ExplorerParts::chartScales()
{
  const std::vector<ChartLine> lines = { { {}, { 0.0, 1.0, 2.0 }, { 0.0, 0.5, 20.0 } } };
  const ChartScale linear(lines, false);
  QCOMPARE(linear.Find(0.0), 0.0);
  QVERIFY(linear.Find(20.0) <= 1.0);
  QVERIFY(std::abs(linear.Find(0.5) / linear.Find(20.0) - 0.025) < 1e-12);
  QVERIFY(linear.Ticks.size() >= 3);
  const ChartScale logarithmic(lines, true);
  const double decade = logarithmic.Find(10.0) - logarithmic.Find(1.0);
  QVERIFY(decade > 0.1 && logarithmic.Find(20.0) <= 1.0);
  QVERIFY(std::abs(logarithmic.Find(1.0) - logarithmic.Find(0.1) - decade) < 1e-9);
  QCOMPARE(logarithmic.Find(0.0), logarithmic.Find(20e-6)); // no infinity
  const ChartScale nothing({ { {}, { 0.0, 1.0 }, { 0.0, 0.0 } } }, true);
  QVERIFY(std::isfinite(nothing.Find(0.0)));
}

//------------------------------------------------------------------------------
// One material in its colors; several by luminance, each in a color of its own.
void ExplorerParts::comparedMaterials()
{
  const Curve red = { { 0.0, 1.0 }, { { 1.0, 0.0, 0.0 }, { 0.5, 0.0, 0.0 } } };
  const Curve gray = { { 0.0, 2.0 }, { { 0.3, 0.3, 0.3 }, { 0.1, 0.1, 0.1 } } };
  const std::vector<ChartLine> channels = MakeLines({ red });
  QCOMPARE(channels.size(), std::size_t(3));
  QCOMPARE(channels[0].Values, (std::vector<double>{ 1.0, 0.5 }));
  QCOMPARE(channels[1].Values, (std::vector<double>{ 0.0, 0.0 }));
  const std::vector<ChartLine> materials = MakeLines({ red, gray });
  QCOMPARE(materials.size(), std::size_t(2));
  QVERIFY(std::abs(materials[1].Values[0] - 0.3) < 1e-3);
  QVERIFY(materials[0].Values[0] < 0.3); // luminance of red
  for (std::size_t a = 0; a <= MostCompared; ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      QVERIFY(GetMaterialColor(a) != GetMaterialColor(b));
    }
  }
}

//------------------------------------------------------------------------------
void ExplorerParts::lightsComeFromTheirAngles()
{
  const auto check = [](double theta, double phi, const glm::dvec3& expected) {
    QVERIFY(glm::distance(GetDirection({ theta, phi, 1.0 }), expected) < 1e-12);
  };
  check(0.0, 77.0, { 0.0, 1.0, 0.0 });
  check(90.0, 0.0, { 0.0, 0.0, 1.0 });
  check(90.0, 90.0, { 1.0, 0.0, 0.0 });
  vtkNew<vtkLight> lamp;
  PlaceLight(lamp, { 90.0, 90.0, 2.5 });
  QCOMPARE(lamp->GetIntensity(), 2.5);
  QCOMPARE(lamp->GetPosition()[0], 1.0);
  QVERIFY(!lamp->GetPositional());
}

//------------------------------------------------------------------------------
// The tangent goes about the up axis: at the normal +z it is +x.
void ExplorerParts::anisotropicUnderOneLight()
{
  const ParametricModel* model = FindModel("model:AshikhminShirley");
  const auto brdf = model->Make(GetValues("model:AshikhminShirley exponent_u=10 exponent_v=1000"));
  tool::Surface surface;
  surface.Normals = { 0.0, 0.0, 1.0 };
  surface.Views = { 0.0, 0.0, 1.0 };
  for (const double phi : { 30.0, -30.0 })
  {
    const double angle = vtkMath::RadiansFromDegrees(phi);
    const double i[3] = { std::sin(angle), 0.0, std::cos(angle) };
    const double o[3] = { 0.0, 0.0, 1.0 };
    double f[3];
    brdf->Evaluate(i, o, f);
    const std::vector<double> radiance = DrawDirectional(brdf, surface, { 90.0, phi, 3.0 });
    QVERIFY(f[0] > 0.0 && std::abs(radiance[0] - 3.0 * f[0] * i[2]) < 1e-12);
  }
  // From above, 30 degrees off: across the tangent the lobe is narrow.
  double narrow[3];
  const double j[3] = { 0.0, 0.5, std::sqrt(0.75) };
  const double o[3] = { 0.0, 0.0, 1.0 };
  brdf->Evaluate(j, o, narrow);
  const std::vector<double> radiance = DrawDirectional(brdf, surface, { 60.0, 0.0, 1.0 });
  QVERIFY(std::abs(radiance[0] - narrow[0] * j[2]) < 1e-12);
}

//------------------------------------------------------------------------------
// Each parameter changes its model, its default is in range, and what is made can be stored.
void ExplorerParts::modelsHaveTheirParameters()
{
  const double s = std::sin(0.4);
  const double c = std::cos(0.4);
  const double i[3] = { s, 0.0, c };
  const double o[3] = { -0.2 * s, 0.98 * s, std::sqrt(1.0 - s * s) };
  QCOMPARE(GetModels().size(), std::size_t(4));
  for (const ParametricModel& model : GetModels())
  {
    ModelValues base = GetValues("model:" + model.Key);
    if (model.Key == "AshikhminShirley")
    {
      base["index_of_refraction"] = { 1.5 }; // so that all of them count
    }
    double f[3];
    model.Make(base)->Evaluate(i, o, f);
    for (const ModelParameter& parameter : model.Parameters)
    {
      ModelValues other = base;
      QVERIFY(parameter.Default[0] >= parameter.Least && parameter.Default[0] <= parameter.Largest);
      for (double& value : other[parameter.Key])
      {
        value = value * 0.7 + 0.01;
      }
      const auto brdf = model.Make(other);
      double g[3];
      brdf->Evaluate(i, o, g);
      QVERIFY2(g[2] != f[2], (model.Key + " " + parameter.Key).c_str());
      vtkBRDFData data;
      QCOMPARE(vtkBRDFModels::Save(brdf, data), std::string());
    }
  }
}

//------------------------------------------------------------------------------
void ExplorerParts::modelsAreMaterials()
{
  const std::string name = "model:Lambert albedo=0.5,0.25,0.125";
  const tool::Material material = ReadMaterial(name).Material;
  const double up[3] = { 0.0, 0.0, 1.0 };
  double f[3];
  material.BRDF->Evaluate(up, up, f);
  QVERIFY(std::abs(f[2] - 0.125 / vtkMath::Pi()) < 1e-12);
  QCOMPARE(material.Name, std::string("Lambert albedo=0.5,0.25,0.125"));
  QCOMPARE(NameModel(*FindModel(name), GetValues(name)), name);
  QVERIFY(!FindModel("Lambert") && !FindModel("model:Phong"));
  const std::pair<const char*, const char*> bad[] = { { "model:Phong", "Phong" },
    { "model:Lambert exponent=1", "\"exponent\": expected a parameter of this model" },
    { "model:Lambert albedo=1,1", "\"albedo\": expected 3 numbers from 0 to 1" },
    { "model:Lambert albedo=1,1,x", "expected 3 numbers" },
    { "model:Lambert albedo=1,1,1,1", "expected 3 numbers" },
    { "model:BlinnPhong exponent=1e7", "expected 1 number from 0 to 1000000" } };
  for (const auto& [file, said] : bad)
  {
    try
    {
      ReadMaterial(file);
      QFAIL(file);
    }
    catch (const tool::Error& error)
    {
      QVERIFY2(QString(error.what()).contains(said), error.what());
    }
  }
}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  tool::RedirectMessages();
  QCoreApplication application(argc, argv);
  ExplorerParts test;
  return QTest::qExec(&test, argc, argv);
}

#include "ExplorerParts.moc"
