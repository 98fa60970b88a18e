// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What `measured-brdf export` is made of: shading models, the lit sphere, the fit, the files.
#include "ExportCases.h"
#include "ExportFiles.h"
#include "LitSphere.h"
#include "SpherePairs.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCell.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkGLTFImporter.h"
#include "vtkLambertBRDF.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <stdexcept>

#include <unistd.h>

namespace
{
const std::string Folder = MEASUREDBRDF_EXPORT_TESTS;
const glm::dvec3 Front(0.0, 0.0, 1.0);

//------------------------------------------------------------------------------
const ExportCase& FindCase(const std::string& name)
{
  static const std::vector<ExportCase> cases = ReadExportCases(Folder + "/cases.json");
  for (const ExportCase& made : cases)
  {
    if (made.Name == name)
    {
      return made;
    }
  }
  throw std::invalid_argument(name);
}

//------------------------------------------------------------------------------
std::array<double, 3> Evaluate(vtkBRDF* brdf, const double i[3], const double o[3])
{
  std::array<double, 3> f{};
  brdf->Evaluate(i, o, f.data());
  return f;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> MakeSky()
{
  auto sky = vtkSmartPointer<vtkEnvironment>::New();
  sky->SetToProceduralSky();
  return sky;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> MakeHall()
{
  auto hall = vtkSmartPointer<vtkEnvironment>::New();
  hall->SetToProceduralHall();
  return hall;
}

//------------------------------------------------------------------------------
// The exact radiance of a lit sphere's pixels, in its order.
Eigen::ArrayXXd SumExactly(
  const tool::LitSphere& sphere, vtkBRDF* brdf, vtkEnvironment* environment)
{
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> tangents;
  vtkNew<vtkDoubleArray> radiance;
  for (vtkDoubleArray* array : { normals.Get(), views.Get(), tangents.Get() })
  {
    array->SetNumberOfComponents(3);
  }
  for (const glm::dvec3& n : sphere.GetNormals())
  {
    normals->InsertNextTuple(&n.x);
    views->InsertNextTuple(&Front.x);
    tangents->InsertNextTuple3(n.z, 0.0, -n.x);
  }
  EXPECT_TRUE(NewExactSum(brdf, environment)->Integrate(normals, views, radiance, tangents));
  return Eigen::Map<const Eigen::ArrayXd>(radiance->GetPointer(0), radiance->GetNumberOfValues());
}
}

//------------------------------------------------------------------------------
// Relative: single precision where OpenGL has calculated, else the digits of the record; glTF's
// sheen takes a table of its albedo.
double GetTolerance(const ExportCase& made)
{
  if (made.Fit.Model->HasFeature(tool::Feature::Sheen) && made.Model == "gltf")
  {
    return 4e-3;
  }
  return made.Model == "gltf" || made.Model == "vtk_pbr" ? 1e-6
         : made.Model == "preview_surface"               ? 1e-4
                                                         : 1e-5;
}

//------------------------------------------------------------------------------
TEST(ExportModels, AgreeWithOtherImplementations)
{
  const nlohmann::json record = ReadJson(Folder + "/shading.json");
  ASSERT_EQ(record.at("format"), "measured-brdf shading models");
  int compared = 0;
  for (const nlohmann::json& result : record.at("results"))
  {
    const ExportCase& made = FindCase(result.at("name"));
    const double tolerance = GetTolerance(made);
    double worst = 0.0;
    for (std::size_t k = 0; k < record.at("pairs").size(); ++k)
    {
      const std::array<double, 3> i = record.at("pairs")[k].at("i");
      const std::array<double, 3> o = record.at("pairs")[k].at("o");
      const std::array<double, 3> expected = result.at("f")[k];
      const std::array<double, 3> f = Evaluate(made.Fit.Model, i.data(), o.data());
      for (std::size_t c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(f[c], expected[c], tolerance * expected[c])
          << made.Name << ", pair " << k << ", channel " << c;
        worst = std::max(worst, std::abs(f[c] / expected[c] - 1.0));
        ++compared;
      }
    }
    std::printf("%s: off by at most %.1e\n", made.Name.c_str(), worst);
  }
  EXPECT_GE(compared, 3 * 12 * 20);
}

//------------------------------------------------------------------------------
// A part that is left out is the same as a weight of zero, whatever its other values.
TEST(ExportModels, PartsOfNoWeightHaveNoEffect)
{
  const double i[3] = { 0.48, 0.36, 0.8 };
  const double o[3] = { -0.6, 0.0, 0.8 };
  for (const char* name : { "gltf", "standard_surface", "open_pbr", "preview_surface", "vtk_pbr" })
  {
    const auto model = tool::SurfaceModel::Make(name);
    const std::array<double, 3> neutral = Evaluate(model, i, o);
    EXPECT_GT(neutral[0], 0.0) << name;
    std::vector<double> values = model->GetValues();
    for (std::size_t at = 0; at < values.size(); ++at)
    {
      // Base indices relative to the coat's: of no weight only where that has none.
      const tool::ModelParameter& parameter = *model->GetNumbers()[at].Parameter;
      const bool weighs = parameter.Neutral == 0.0 || parameter.Part == tool::Feature::Core ||
                          parameter.Part == tool::Feature::Specular;
      values[at] = weighs ? values[at] : 0.5 * (parameter.Least + parameter.Most);
    }
    model->SetValues(values);
    const std::array<double, 3> same = Evaluate(model, i, o);
    EXPECT_NEAR(same[0], neutral[0], 1e-12) << name;
  }
}

//------------------------------------------------------------------------------
// Bilinear shares of the light among the nodes: some tenths of a percent of it are elsewhere.
TEST(ExportLitSphere, IsNearTheExactSum)
{
  vtkNew<vtkLambertBRDF> lambert;
  const vtkSmartPointer<vtkEnvironment> sky = MakeSky();
  const struct
  {
    vtkBRDF* BRDF;
    double Tolerance;
  } materials[] = { { lambert, 2e-3 }, { FindCase("gltf-coat").Fit.Model, 0.02 },
    { FindCase("gltf-all").Fit.Model, 0.03 } };
  for (const auto& material : materials)
  {
    tool::LitSphere sphere(Front, material.BRDF->IsIsotropic());
    sphere.AddLight(sky);
    const Eigen::ArrayXXd exact = SumExactly(sphere, material.BRDF, sky);
    const double error = tool::GetMeanError(sphere.Sum(material.BRDF), exact);
    EXPECT_LT(error, material.Tolerance);
    std::printf("lit sphere: relative L1 %.3g %%\n", 100.0 * error);
  }
}

//------------------------------------------------------------------------------
TEST(ExportLitSphere, KeepsAllLight)
{
  vtkNew<vtkEnvironment> white;
  ASSERT_TRUE(white->SetPixels(64, 32, std::vector<float>(3 * 64 * 32, 2.0f)));
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.25, 0.5, 1.0);
  for (const bool isotropic : { true, false })
  {
    tool::LitSphere sphere(Front, isotropic);
    sphere.AddLight(white);
    const Eigen::ArrayXXd radiance = sphere.Sum(lambert);
    ASSERT_EQ(radiance.size(), 3 * sphere.GetNormals().size());
    for (Eigen::Index k = 0; k < radiance.size(); ++k)
    {
      EXPECT_NEAR(radiance(k), 0.5 * (1 << k % 3), 1e-3);
    }
  }
}

namespace
{
class Throwing : public vtkLambertBRDF
{
public:
  static Throwing* New();
  vtkTypeMacro(Throwing, vtkLambertBRDF);

protected:
  void EvaluateAbove(const double[3], const double[3], double[3]) override
  {
    throw std::bad_alloc();
  }
};
vtkStandardNewMacro(Throwing);
}

//------------------------------------------------------------------------------
TEST(ExportLitSphere, ThrowsWhatAMaterialThrowsOnAnyThread)
{
  vtkNew<Throwing> brdf;
  tool::LitSphere sphere(Front, true); // without light it is thrown all the same
  const std::string usual = vtkSMPTools::GetBackend();
  ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
  EXPECT_THROW(sphere.Sum(brdf), std::bad_alloc);
  vtkSMPTools::SetBackend(usual.c_str());
}

//------------------------------------------------------------------------------
TEST(ExportSphere, NormalsAndViews)
{
  const tool::Surface surface = tool::MakeSphereSurface(16, { 90.0, 0.0 });
  EXPECT_NEAR(surface.NumberOfCovered, 256 * vtkMath::Pi() / 4.0, 12.0);
  double mean[3] = {};
  for (std::size_t k = 0; k < surface.Normals.size(); k += 3)
  {
    EXPECT_NEAR(vtkMath::Norm(&surface.Normals[k]), 1.0, 1e-12);
    EXPECT_NEAR(surface.Views[k], 1.0, 1e-12); // from +x
    EXPECT_GT(vtkMath::Dot(&surface.Normals[k], &surface.Views[k]), 0.0);
    vtkMath::Add(mean, &surface.Normals[k], mean);
  }
  EXPECT_NEAR(mean[1], 0.0, 1e-9);
  EXPECT_NEAR(mean[2], 0.0, 1e-9);
  // The picture's right is the world's -z, its top +y.
  const double* last = &surface.Normals[surface.Normals.size() - 3];
  EXPECT_GT(last[1], 0.9);
  EXPECT_NEAR(tool::GetViewDirection({ 0.0, 90.0 }).y, 1.0, 1e-12);
}

//------------------------------------------------------------------------------
TEST(ExportFit, FindsWhatIsThere)
{
  const ExportCase& coated = FindCase("gltf-coat");
  tool::LitSphere sphere(Front, true);
  sphere.AddLight(MakeSky());
  sphere.AddLight(MakeHall());
  int calls = 0;
  const auto proceed = [&calls](double share)
  {
    EXPECT_TRUE(share >= 0.0 && share <= 1.0);
    ++calls;
  };
  const tool::ModelFit fit = tool::FitModel("gltf", coated.Fit.Model, sphere, false, proceed);
  EXPECT_GT(calls, 3);
  EXPECT_LT(fit.Error, 0.005);
  ASSERT_EQ(fit.Features.size(), 1u);
  EXPECT_EQ(fit.Features[0], tool::Feature::Coat);
  EXPECT_NEAR(fit.Model->GetNumber("clearcoatRoughnessFactor"), 0.2, 0.02);
  EXPECT_NEAR(fit.Model->GetNumber("roughnessFactor"), 0.5, 0.03);
}

//------------------------------------------------------------------------------
TEST(ExportFit, TakesNoPartThatIsOfNoUse)
{
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.6, 0.3, 0.2);
  tool::LitSphere sphere(Front, true);
  sphere.AddLight(MakeSky());
  for (const char* name : { "preview_surface", "vtk_pbr" })
  {
    const tool::ModelFit fit = tool::FitModel(
      name, FindCase("preview-surface-core").Fit.Model, sphere, false, [](double) {});
    EXPECT_EQ(fit.Error, tool::GetMeanError(sphere.Sum(fit.Model),
                           sphere.Sum(FindCase("preview-surface-core").Fit.Model)));
    if (std::string(name) == "preview_surface")
    {
      EXPECT_TRUE(fit.Features.empty());
      EXPECT_LT(fit.Error, 1e-3);
    }
    EXPECT_LT(fit.Error, 0.03) << name;
  }
  EXPECT_THROW(
    tool::FitModel("phong", lambert, sphere, false, [](double) {}), std::invalid_argument);
  lambert->SetAlbedo(0.0, 0.0, 0.0);
  EXPECT_THROW(tool::FitModel("gltf", lambert, sphere, false, [](double) {}), std::runtime_error);
}

//------------------------------------------------------------------------------
// People set no index of 2.8 by hand, and no part of a metal. What that costs is known.
TEST(ExportFit, UsualValues)
{
  tool::LitSphere sphere(Front, true);
  sphere.AddLight(MakeHall());
  const auto unusual = tool::SurfaceModel::Make("preview_surface");
  unusual->SetValues({ 0.4, 0.3, 0.2, 0.15, 0.4, 2.8, 0.0, 0.01 });
  const tool::ModelFit usual =
    tool::FitModel("preview_surface", unusual, sphere, true, [](double) {});
  std::printf("usual: %.4f, closest: %.4f\n", usual.Error, usual.ClosestError);
  EXPECT_LT(usual.ClosestError, usual.Error);
  EXPECT_LT(usual.Error, usual.ClosestError + 0.2);
  const double metallic = usual.Model->GetNumber("metallic");
  EXPECT_TRUE(metallic == 0.0 || (metallic >= 0.3 && usual.Model->GetNumber("roughness") <= 0.6));
  EXPECT_LE(usual.Model->GetNumber("ior"), 2.0);
}

//------------------------------------------------------------------------------
// A light a thousand times as bright changes nothing: each counts by its relative error.
TEST(ExportFit, EveryLightCountsTheSame)
{
  const ExportCase& coated = FindCase("gltf-coat"); // which this model cannot show exactly
  std::vector<double> values[2];
  for (const bool bright : { false, true })
  {
    const vtkSmartPointer<vtkEnvironment> hall = MakeHall();
    std::vector<float> pixels = hall->GetPixels();
    for (float& value : pixels)
    {
      value *= bright ? 1024.0f : 1.0f;
    }
    ASSERT_TRUE(hall->SetPixels(hall->GetWidth(), hall->GetHeight(), std::move(pixels)));
    tool::LitSphere sphere(Front, true);
    sphere.AddLight(MakeSky());
    sphere.AddLight(hall);
    values[bright] = tool::FitModel("preview_surface", coated.Fit.Model, sphere, false,
      [](double) {}).Model->GetValues();
  }
  for (std::size_t k = 0; k < values[0].size(); ++k)
  {
    EXPECT_NEAR(values[1][k], values[0][k], 1e-3) << k;
  }
}

//------------------------------------------------------------------------------
TEST(ExportFit, FindsTheDirectionOfGrooves)
{
  const auto grooved = tool::SurfaceModel::Make("vtk_pbr");
  grooved->SetValues(
    { 0.7, 0.6, 0.5, 1.0, 0.4, 1.5, 1.0, 1.0, 1.0, 0.0, 0.0, 2.0, 0.8, 0.25 }); // across
  tool::LitSphere sphere(Front, false);
  sphere.AddLight(MakeHall());
  const tool::ModelFit fit = tool::FitModel("vtk_pbr", grooved, sphere, false, [](double) {});
  ASSERT_EQ(fit.Features.size(), 1u);
  EXPECT_EQ(fit.Features[0], tool::Feature::Anisotropy);
  EXPECT_NEAR(fit.Model->GetNumber("AnisotropyRotation"), 0.25, 0.01);
  EXPECT_NEAR(fit.Model->GetNumber("Anisotropy"), 0.8, 0.05);
  EXPECT_LT(fit.Error, 0.01);
}

//------------------------------------------------------------------------------
TEST(ExportFiles, NumbersAndNames)
{
  EXPECT_EQ(tool::FormatValue(1.0), "1");
  EXPECT_EQ(tool::FormatValue(0.12345), "0.1235");
  EXPECT_EQ(tool::FormatValue(-1e-9), "0");
  EXPECT_EQ(tool::MakeIdentifier("gold-paint"), "gold_paint");
  EXPECT_EQ(tool::MakeIdentifier("3M\n<red>"), "material_3M__red_");
  EXPECT_EQ(tool::MakeIdentifier(""), "material");
  const auto model = tool::SurfaceModel::Make("gltf");
  std::vector<double> values = model->GetValues();
  values[0] = 0.123456;
  values.back() = vtkMath::Pi(); // of which 3.1416 is too much
  model->SetValues(values);
  tool::RoundValues(model);
  EXPECT_DOUBLE_EQ(model->GetValues()[0], 0.1235);
  EXPECT_DOUBLE_EQ(model->GetValues().back(), 3.1415);
}

//------------------------------------------------------------------------------
// VTK's own importer reads the material and the ball.
TEST(ExportFiles, VtkReadsGltf)
{
  const ExportCase& made = FindCase("gltf-all");
  for (const bool binary : { false, true })
  {
    const std::string path =
      testing::TempDir() + "export-" + std::to_string(getpid()) + (binary ? ".glb" : ".gltf");
    std::ofstream(path, std::ios::binary) << tool::MakeGltf(made.Fit, "a \"ball\"", binary);
    vtkNew<vtkGLTFImporter> importer;
    importer->SetFileName(path.c_str());
    importer->Update();
    std::remove(path.c_str());
    ASSERT_TRUE(importer->GetRenderer());
    vtkActorCollection* actors = importer->GetRenderer()->GetActors();
    ASSERT_EQ(actors->GetNumberOfItems(), 1);
    actors->InitTraversal();
    vtkActor* actor = actors->GetNextActor();
    vtkProperty* property = actor->GetProperty();
    EXPECT_EQ(property->GetInterpolation(), VTK_PBR);
    EXPECT_NEAR(property->GetMetallic(), 0.45, 1e-6);
    EXPECT_NEAR(property->GetRoughness(), 0.35, 1e-6);
    EXPECT_NEAR(property->GetColor()[2], 0.6, 1e-6);
    auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
    ASSERT_TRUE(mapper);
    mapper->Update();
    vtkPolyData* mesh = mapper->GetInput();
    ASSERT_EQ(mesh->GetNumberOfCells(), 2 * 64 * 32);
    ASSERT_TRUE(mesh->GetPointData()->GetNormals());
    for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k)
    {
      double n[3];
      mesh->GetPointData()->GetNormals()->GetTuple(k, n);
      EXPECT_NEAR(vtkMath::Distance2BetweenPoints(n, mesh->GetPoint(k)), 0.0, 1e-10);
    }
    // Counterclockwise from outside.
    for (vtkIdType k = 5 * 64; k < 6 * 64; ++k)
    {
      vtkCell* cell = mesh->GetCell(k);
      double a[3], b[3], c[3], edge1[3], edge2[3], out[3];
      cell->GetPoints()->GetPoint(0, a);
      cell->GetPoints()->GetPoint(1, b);
      cell->GetPoints()->GetPoint(2, c);
      vtkMath::Subtract(b, a, edge1);
      vtkMath::Subtract(c, a, edge2);
      vtkMath::Cross(edge1, edge2, out);
      EXPECT_GT(vtkMath::Dot(out, a), 0.0);
    }
  }
}

//------------------------------------------------------------------------------
// Only the parts that the fit took are written.
TEST(ExportFiles, GltfHasTheExtensionsThatAreUsed)
{
  for (const char* name : { "gltf-core", "gltf-coat", "gltf-all" })
  {
    const ExportCase& made = FindCase(name);
    const nlohmann::json file = nlohmann::json::parse(tool::MakeGltf(made.Fit, name, false));
    const nlohmann::json& material = file.at("materials")[0];
    EXPECT_EQ(file.contains("extensionsUsed"), !made.Fit.Features.empty());
    EXPECT_EQ(
      material.value("extensions", nlohmann::json::object()).size(), made.Fit.Features.size());
    for (const auto& used : file.value("extensionsUsed", nlohmann::json::array()))
    {
      EXPECT_TRUE(material.at("extensions").contains(used)) << used;
    }
    EXPECT_EQ(file.at("materials")[0].at("name"), name);
  }
  const nlohmann::json all = nlohmann::json::parse(
    tool::MakeGltf(FindCase("gltf-all").Fit, "all", false))["materials"][0]["extensions"];
  EXPECT_EQ(all["KHR_materials_clearcoat"]["clearcoatFactor"], 0.4);
  EXPECT_EQ(all["KHR_materials_sheen"]["sheenColorFactor"][1], 0.05);
  EXPECT_EQ(all["KHR_materials_specular"]["specularFactor"], 0.7);
  EXPECT_EQ(all["KHR_materials_anisotropy"]["anisotropyRotation"], 0.7);
}

//------------------------------------------------------------------------------
// The keys are the setters' names: here they are called.
TEST(ExportFiles, VtkJsonFitsTheProperty)
{
  const ExportCase& made = FindCase("vtk-pbr-all");
  const nlohmann::json file = nlohmann::json::parse(tool::MakeVtkJson(made.Fit, "a\"b"));
  EXPECT_EQ(file.at("material"), "a\"b");
  const nlohmann::json& values = file.at("property");
  vtkNew<vtkProperty> property;
  property->SetInterpolation(values.at("Interpolation"));
  EXPECT_EQ(property->GetInterpolation(), VTK_PBR);
  property->SetMetallic(values.at("Metallic"));
  property->SetCoatIOR(values.at("CoatIOR"));
  EXPECT_DOUBLE_EQ(property->GetMetallic(), 0.45);
  EXPECT_DOUBLE_EQ(property->GetCoatIOR(), 1.5);
  for (const char* key : { "Color", "Roughness", "BaseIOR", "EdgeTint", "CoatStrength",
         "CoatRoughness", "CoatColor", "Anisotropy", "AnisotropyRotation", "Diffuse" })
  {
    EXPECT_TRUE(values.contains(key)) << key;
  }
}
