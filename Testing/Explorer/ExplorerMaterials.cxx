// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The explorer's parts without a window that make light and materials: the directional light,
// models with parameters, tables of samples.
#include "DirectionalLight.h"
#include "MadeMaterial.h"
#include "ModelMaterials.h"
#include "SampleTable.h"
#include "State.h"
#include "Tool.h"

#include "vtkBRDFData.h"
#include "vtkBRDFModels.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <QCoreApplication>
#include <QtTest>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace explorer;

namespace
{
constexpr int Dimensions[3] = { 6, 4, 5 }; // phi_d, theta_d, theta_h

//------------------------------------------------------------------------------
// Cell k holds k, 2 k and 3 k.
vtkSmartPointer<vtkTabulatedBRDF> MakeTable(int parameterization)
{
  std::vector<float> rgb;
  for (int k = 0; k < Dimensions[0] * Dimensions[1] * Dimensions[2]; ++k)
  {
    rgb.insert(rgb.end(), { 1.0f * k, 2.0f * k, 3.0f * k });
  }
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  table->SetVolume(parameterization, vtkTabulatedBRDF::HALF_TURN, Dimensions, rgb);
  return table;
}

//------------------------------------------------------------------------------
tool::Material MakeMaterial(vtkBRDF* brdf)
{
  tool::Material material;
  material.BRDF = brdf;
  material.File = "table.exr";
  material.Name = "table";
  return material;
}
}

class ExplorerMaterials : public QObject
{
  Q_OBJECT

private slots:
  void lightsComeFromTheirAngles();
  void lambertUnderOneLight();
  void anisotropicUnderOneLight();
  void modelsHaveTheirParameters();
  void modelsAreMaterials();
  void samplesAreTheTables();
  void samplesAreFound();
  void otherMaterialsAreSampled();
  void editsAreInACopy();
  void editsThatDoNotFitAreLeftOut();
  void oddSamplesStayReadable();
};

//------------------------------------------------------------------------------
void ExplorerMaterials::lightsComeFromTheirAngles()
{
  const auto check = [](double theta, double phi, const std::array<double, 3>& expected)
  {
    const std::array<double, 3> direction = GetDirection({ theta, phi, 1.0 });
    for (std::size_t c = 0; c < 3; ++c)
    {
      QVERIFY(std::abs(direction[c] - expected[c]) < 1e-12);
    }
  };
  check(0.0, 77.0, { 0.0, 1.0, 0.0 });
  check(90.0, 0.0, { 0.0, 0.0, 1.0 });
  check(90.0, 90.0, { 1.0, 0.0, 0.0 });
  LightState light;
  SetDirection(light, GetDirection({ 130.0, -170.0, 1.0 }).data());
  QVERIFY(std::abs(light.Theta - 130.0) < 1e-9 && std::abs(light.Phi + 170.0) < 1e-9);
  const double up[3] = { 0.0, 2.0, 0.0 };
  SetDirection(light, up);
  QCOMPARE(light.Theta, 0.0);
  QVERIFY(std::abs(light.Phi + 170.0) < 1e-9);
  vtkNew<vtkLight> lamp;
  PlaceLight(lamp, { 90.0, 90.0, 2.5 });
  QCOMPARE(lamp->GetIntensity(), 2.5);
  QCOMPARE(lamp->GetPosition()[0], 1.0);
  QVERIFY(!lamp->GetPositional());
}

//------------------------------------------------------------------------------
// albedo / pi E cos: the formula by itself.
void ExplorerMaterials::lambertUnderOneLight()
{
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(0.8, 0.4, 0.2);
  tool::Surface surface;
  const double s = std::sqrt(0.5);
  surface.Normals = { 0.0, 0.0, 1.0, s, 0.0, s, 0.0, 0.0, -1.0 };
  surface.Views = { 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0 };
  const std::vector<double> radiance = DrawDirectional(brdf, surface, { 90.0, 0.0, 3.0 });
  const double expected[9] = { 2.4, 1.2, 0.6, 2.4 * s, 1.2 * s, 0.6 * s, 0.0, 0.0, 0.0 };
  for (std::size_t k = 0; k < 9; ++k)
  {
    QVERIFY2(std::abs(radiance[k] - expected[k] / vtkMath::Pi()) < 1e-12,
      qPrintable(QString::number(radiance[k])));
  }
}

//------------------------------------------------------------------------------
// The tangent goes about the up axis: at the normal +z it is +x.
void ExplorerMaterials::anisotropicUnderOneLight()
{
  const ParametricModel* model = FindModel("model:AshikhminShirley");
  ModelValues values = GetValues(*model, {});
  values["exponent_u"] = { 10.0 };
  values["exponent_v"] = { 1000.0 };
  const auto brdf = MakeModel(*model, values);
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
    const std::vector<double> radiance = DrawDirectional(brdf, surface, { 90.0, phi, 1.0 });
    QVERIFY(f[0] > 0.0 && std::abs(radiance[0] - f[0] * i[2]) < 1e-12);
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
void ExplorerMaterials::modelsHaveTheirParameters()
{
  const double s = std::sin(0.4);
  const double c = std::cos(0.4);
  const double i[3] = { s, 0.0, c };
  const double o[3] = { -0.2 * s, 0.98 * s, std::sqrt(1.0 - s * s) };
  QCOMPARE(GetModels().size(), std::size_t(4));
  for (const ParametricModel& model : GetModels())
  {
    ModelValues base = GetValues(model, {});
    if (model.Key == "AshikhminShirley")
    {
      base["fresnel"] = { 1.0 }; // so that all of them count
    }
    double f[3];
    MakeModel(model, base)->Evaluate(i, o, f);
    for (const ModelParameter& parameter : model.Parameters)
    {
      ModelValues other = base;
      QVERIFY(parameter.Default[0] >= parameter.Least && parameter.Default[0] <= parameter.Largest);
      for (double& value : other[parameter.Key])
      {
        value = !parameter.Choices.empty() ? 0.0 : value * 0.7 + 0.01;
      }
      const auto brdf = MakeModel(model, other);
      double g[3];
      brdf->Evaluate(i, o, g);
      QVERIFY2(g[2] != f[2], (model.Key + " " + parameter.Key).c_str());
      vtkBRDFData data;
      QCOMPARE(vtkBRDFModels::Save(brdf, data), std::string());
    }
  }
}

//------------------------------------------------------------------------------
void ExplorerMaterials::modelsAreMaterials()
{
  ModelStates states;
  states["Lambert"]["albedo"] = { 0.5, 0.25, 0.125 };
  const tool::Material material = LoadMaterial("model:Lambert", states);
  const double up[3] = { 0.0, 0.0, 1.0 };
  double f[3];
  material.BRDF->Evaluate(up, up, f);
  QVERIFY(std::abs(f[2] - 0.125 / vtkMath::Pi()) < 1e-12);
  QCOMPARE(material.Name, std::string("Lambert"));
  QVERIFY(!FindModel("Lambert") && !FindModel("model:Phong"));
  QVERIFY_EXCEPTION_THROWN(LoadMaterial("model:Phong", states), tool::Error);
  MadeMaterial made = explorer::MakeMaterial("model:Lambert", { states, {} });
  QVERIFY(!made.IsAnother({ states, {} }));
  states["Lambert"]["albedo"][0] = 0.6;
  QVERIFY(made.IsAnother({ states, {} }));
  made = RemakeMaterialOf(made.Original, { states, {} });
  made.Shown.BRDF->Evaluate(up, up, f);
  QVERIFY(std::abs(f[0] - 0.6 / vtkMath::Pi()) < 1e-12);
}

//------------------------------------------------------------------------------
// Where a row's angles are, the table gives the row's values.
void ExplorerMaterials::samplesAreTheTables()
{
  for (const int parameterization :
    { vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::INCIDENT_OUTGOING })
  {
    const auto brdf = MakeTable(parameterization);
    const SampleTable table(brdf);
    QCOMPARE(table.GetNumberOfRows(), 120);
    QVERIFY(table.IsStored());
    int above = 0;
    for (int row = 0; row < 120; ++row)
    {
      std::array<float, 3> rgb;
      QCOMPARE(table.GetValue(row, rgb), table.IsAbove(row));
      if (!table.IsAbove(row))
      {
        continue;
      }
      ++above;
      QCOMPARE(rgb[1], 2.0f * row);
      const std::array<double, 3> degrees = table.GetAngles(row);
      double a[3];
      for (std::size_t c = 0; c < 3; ++c)
      {
        a[c] = vtkMath::RadiansFromDegrees(degrees[c]);
      }
      double i[3] = { std::sin(a[0]), 0.0, std::cos(a[0]) };
      double o[3] = { std::sin(a[1]) * std::cos(a[2]), std::sin(a[1]) * std::sin(a[2]),
        std::cos(a[1]) };
      if (parameterization == vtkTabulatedBRDF::HALF_DIFFERENCE)
      {
        const double h[3] = { i[0], 0.0, i[2] };
        const double d[3] = { o[0], o[1], o[2] };
        i[0] = h[2] * d[0] + h[0] * d[2];
        i[1] = d[1];
        i[2] = h[2] * d[2] - h[0] * d[0];
        for (int c = 0; c < 3; ++c)
        {
          o[c] = 2.0 * d[2] * h[c] - i[c];
        }
      }
      double f[3];
      brdf->Evaluate(i, o, f);
      QVERIFY2(std::abs(f[1] - 2.0 * row) < 1e-3 * (row + 1.0),
        qPrintable(QString("row %1: %2").arg(row).arg(f[1])));
    }
    QVERIFY(above > 60);
  }
}

//------------------------------------------------------------------------------
void ExplorerMaterials::samplesAreFound()
{
  const auto brdf = MakeTable(vtkTabulatedBRDF::HALF_DIFFERENCE);
  const SampleTable table(brdf);
  for (int row = 0; row < 120; ++row)
  {
    QCOMPARE(table.FindRow(table.GetAngles(row)), row);
  }
  QCOMPARE(table.FindRow({ 0.0, 0.0, 0.0 }), 0);
  QCOMPARE(table.FindRow({ 90.0, 90.0, 180.0 }), 119);
  // theta_h = 0: both at theta_d, on opposite sides.
  const auto other = MakeTable(vtkTabulatedBRDF::INCIDENT_OUTGOING);
  const SampleTable angles(other);
  const std::array<double, 3> mirror = angles.GetAngles(angles.FindRow({ 0.0, 50.0, 90.0 }));
  QCOMPARE(mirror[0], 45.0);  // 5 samples, the nearest to 50
  QCOMPARE(mirror[1], 56.25); // 4 samples
  QCOMPARE(mirror[2], 165.0); // the last of 6
}

//------------------------------------------------------------------------------
void ExplorerMaterials::otherMaterialsAreSampled()
{
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(vtkMath::Pi(), 0.0, 0.0);
  const SampleTable table(brdf);
  QVERIFY(!table.IsStored());
  QCOMPARE(table.GetNumberOfRows(), 180 * 90 * 90);
  std::array<float, 3> rgb;
  QVERIFY(table.GetValue(0, rgb));
  QVERIFY(std::abs(rgb[0] - 1.0f) < 1e-6f);
  QVERIFY(!table.GetValue(table.GetNumberOfRows() - 1, rgb)); // theta_h and theta_d near 90
  QVERIFY(table.GetNote().find("cannot be edited") != std::string::npos);
  QCOMPARE(SampleTable().GetNumberOfRows(), 0);
}

//------------------------------------------------------------------------------
void ExplorerMaterials::editsAreInACopy()
{
  const auto brdf = MakeTable(vtkTabulatedBRDF::HALF_DIFFERENCE);
  const std::vector<float> before = brdf->GetVolume();
  const tool::Material original = MakeMaterial(brdf);
  QVERIFY(ApplyEdits(original, {}).BRDF == brdf);
  SampleEdits edits;
  edits[7] = { 100.0f, 200.0f, 300.0f };
  const tool::Material edited = ApplyEdits(original, edits);
  QVERIFY(edited.BRDF != brdf);
  QCOMPARE(edited.Name, std::string("table (edited)"));
  QVERIFY(brdf->GetVolume() == before);
  auto* table = vtkTabulatedBRDF::SafeDownCast(edited.BRDF);
  QVERIFY(table);
  for (std::size_t k = 0; k < before.size(); ++k)
  {
    QCOMPARE(table->GetVolume()[k], k / 3 == 7 ? 100.0f * (1 + k % 3) : before[k]);
  }
}

//------------------------------------------------------------------------------
void ExplorerMaterials::editsThatDoNotFitAreLeftOut()
{
  SampleEdits edits;
  edits[120] = { 1.0f, 1.0f, 1.0f }; // the table ends at 119
  const auto brdf = MakeTable(vtkTabulatedBRDF::HALF_DIFFERENCE);
  vtkNew<vtkLambertBRDF> lambert;
  for (vtkBRDF* one : { static_cast<vtkBRDF*>(brdf), static_cast<vtkBRDF*>(lambert) })
  {
    const tool::Material edited = ApplyEdits(MakeMaterial(one), edits);
    QVERIFY(edited.BRDF == one);
    QVERIFY(edited.Notes.find("table.exr: 1 of its edits") != std::string::npos);
  }
  edits[7] = { 100.0f, 200.0f, 300.0f }; // the others stay
  const tool::Material edited = ApplyEdits(MakeMaterial(brdf), edits);
  QVERIFY(edited.Notes.find("table.exr: 1 of its edits") != std::string::npos);
  auto* table = vtkTabulatedBRDF::SafeDownCast(edited.BRDF);
  QVERIFY(table && table->GetVolume()[3 * 7 + 2] == 300.0f);
}

//------------------------------------------------------------------------------
// Of a sample that was not measured nothing is taken; beside an edited channel negative ones stay.
void ExplorerMaterials::oddSamplesStayReadable()
{
  const auto brdf = MakeTable(vtkTabulatedBRDF::HALF_DIFFERENCE);
  std::vector<float> volume = brdf->GetVolume();
  volume[3 * 7 + 1] = std::numeric_limits<float>::quiet_NaN();
  const int dimensions[3] = { brdf->GetDimensions()[0], brdf->GetDimensions()[1],
    brdf->GetDimensions()[2] };
  QVERIFY(brdf->SetVolume(
    brdf->GetParameterization(), brdf->GetAzimuthRange(), dimensions, std::move(volume)));
  std::array<float, 3> rgb = { 1.0f, 2.0f, 3.0f };
  QVERIFY(!SampleTable(brdf).GetValue(7, rgb));
  QVERIFY((rgb == std::array<float, 3>{ 1.0f, 2.0f, 3.0f }));
  State state;
  state.Edits["table.exr"][7] = { 0.5f, -0.01f, 2e6f };
  QVERIFY(ReadState(WriteState(state), "s").Edits == state.Edits);
}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  tool::RedirectMessages();
  QCoreApplication application(argc, argv);
  ExplorerMaterials test;
  return QTest::qExec(&test, argc, argv);
}

#include "ExplorerMaterials.moc"
