// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Materials.h"

#include "Files.h"
#include "Meshes.h"
#include "NumberText.h"
#include "State.h"
#include "Tool.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFFormats.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSumBRDF.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

namespace explorer
{
namespace
{
const std::string Prefix = "model:";

//------------------------------------------------------------------------------
bool Has(const std::vector<std::string>& list, const std::string& ending)
{
  return std::find(list.begin(), list.end(), ending) != list.end();
}

//------------------------------------------------------------------------------
// Those that were opened, under their heading.
void AddFiles(std::vector<Item>& items, const std::vector<std::string>& files)
{
  for (const std::string& file : files)
  {
    items.push_back({ file, std::filesystem::path(file).filename().string(), "Files", file });
  }
}
}

//------------------------------------------------------------------------------
std::vector<std::string> GetMaterialExtensions()
{
  std::vector<std::string> all;
  for (const auto& format : vtkBRDFFormats::GetFormats())
  {
    for (const std::string& ending : format->GetExtensions())
    {
      if (!Has(all, ending))
      {
        all.push_back(ending);
      }
    }
  }
  return all;
}

//------------------------------------------------------------------------------
const std::vector<std::string>& GetEnvironmentExtensions()
{
  static const std::vector<std::string> endings = { ".exr", ".hdr", ".pic", ".pfm", ".tif", ".tiff",
    ".tx", ".png", ".jpg", ".jpeg" };
  return endings;
}

//------------------------------------------------------------------------------
FileKind FindFileKind(const std::string& file)
{
  const std::vector<Item> environments = ListEnvironments({});
  const std::string ending = tool::Extension(file.substr(0, file.find('#')));
  const bool isMaterial = Has(GetMaterialExtensions(), ending);
  const bool isEnvironment = Has(GetEnvironmentExtensions(), ending) ||
                             std::any_of(environments.begin(), environments.end(),
                               [&file](const Item& item) { return item.File == file; });
  return isMaterial && isEnvironment              ? FileKind::MaterialOrEnvironment
         : isEnvironment                          ? FileKind::Environment
         : isMaterial                             ? FileKind::Material
         : Has(tool::GetMeshExtensions(), ending) ? FileKind::Mesh
         : ending == ".json"                      ? FileKind::State
                                                  : FileKind::Material;
}

//------------------------------------------------------------------------------
bool IsBuiltIn(const std::string& name)
{
  for (const auto& items : { ListMaterials({}), ListEnvironments({}), ListMeshes("") })
  {
    if (std::any_of(
          items.begin(), items.end(), [&name](const Item& item) { return item.File == name; }))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::vector<Item> ListMaterials(const std::vector<std::string>& opened)
{
  std::vector<Item> items;
  AddFiles(items, opened);
  for (const ParametricModel& model : GetModels())
  {
    items.push_back({ Prefix + model.Key, model.Name, "Models",
      model.Description + "; its parameters are in the Model tab" });
  }
  const auto embedded = static_cast<std::ptrdiff_t>(items.size());
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    items.push_back(
      { name, name, vtkEmbeddedMaterials::GetKind(k), vtkEmbeddedMaterials::GetSource(k) });
  }
  std::stable_sort(items.begin() + embedded, items.end(),
    [](const Item& a, const Item& b) { return a.Kind < b.Kind; });
  return items;
}

//------------------------------------------------------------------------------
std::vector<Item> ListEnvironments(const std::vector<std::string>& opened)
{
  std::vector<Item> items;
  for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
  {
    const std::string name = vtkEmbeddedEnvironments::GetName(k);
    items.push_back({ name, name, "Built-in", vtkEmbeddedEnvironments::GetSource(k) });
  }
  items.push_back({ DirectionalLightName, "Directional light", "Built-in",
    "One light from one direction; its direction and irradiance are in the Light tab" });
  AddFiles(items, opened);
  return items;
}

//------------------------------------------------------------------------------
std::vector<Item> ListMeshes(const std::string& opened)
{
  std::vector<Item> items = { { "sphere", "Sphere", "Built-in", "A unit sphere" },
    { "ball-on-foot", "Ball on foot", "Built-in",
      "The gallery's piece: a ball on a fluted foot" } };
  if (opened.find_first_of("/.") != std::string::npos)
  {
    AddFiles(items, { opened });
  }
  return items;
}

namespace
{
constexpr double LargestExponent = 1e6; // as the models' own

//------------------------------------------------------------------------------
ModelParameter MakeExponent(
  const std::string& key, const std::string& name, const std::string& description, double value)
{
  return { key, name, description, 0.0, LargestExponent, { value }, true };
}

//------------------------------------------------------------------------------
ModelParameter MakeColor(const std::string& key, const std::string& name,
  const std::string& description, double largest, double value)
{
  return { key, name, description, 0.0, largest, { value, value, value } };
}

//------------------------------------------------------------------------------
// With a Lambert part beside it, where that is not black.
vtkSmartPointer<vtkBRDF> AddDiffuse(vtkBRDF* brdf, const std::vector<double>& albedo)
{
  if (std::all_of(albedo.begin(), albedo.end(), [](double value) { return value == 0.0; }))
  {
    return brdf;
  }
  vtkNew<vtkLambertBRDF> diffuse;
  diffuse->SetAlbedo(albedo.data());
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(diffuse);
  sum->AddTerm(brdf);
  return sum;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeLambert(const ModelValues& values)
{
  auto brdf = vtkSmartPointer<vtkLambertBRDF>::New();
  brdf->SetAlbedo(values.at("albedo").data());
  return brdf;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeBlinnPhong(const ModelValues& values)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetSpecular(values.at("specular").data());
  brdf->SetExponent(values.at("exponent")[0]);
  return AddDiffuse(brdf, values.at("albedo"));
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeAshikhminShirley(const ModelValues& values)
{
  auto brdf = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
  const double index = values.at("index_of_refraction")[0];
  brdf->SetSpecularScale(values.at("specular_scale").data());
  brdf->SetReflectance(values.at("reflectance").data());
  brdf->SetDiffuse(values.at("diffuse").data());
  brdf->SetExponents(values.at("exponent_u")[0], values.at("exponent_v")[0]);
  brdf->SetFresnelModel(
    index > 1.0 ? vtkAshikhminShirleyBRDF::DIELECTRIC : vtkAshikhminShirleyBRDF::SCHLICK);
  brdf->SetIndexOfRefraction(index);
  return brdf;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeDistribution(const ModelValues& values)
{
  vtkNew<vtkDistributionBRDF> brdf;
  brdf->SetBlinnDistribution(values.at("exponent")[0]);
  brdf->SetSchlickFresnel(values.at("f0").data());
  return AddDiffuse(brdf, values.at("albedo"));
}
}

//------------------------------------------------------------------------------
const std::vector<ParametricModel>& GetModels()
{
  static const ModelParameter lambert =
    MakeColor("albedo", "Albedo", "Share of the light that a Lambert part reflects", 1.0, 0.2);
  static const std::vector<ParametricModel> models = {
    { "Lambert", "Lambert", "f = albedo / pi",
      { MakeColor("albedo", "Albedo", "Share of the light that is reflected", 1.0, 0.8) },
      &MakeLambert },
    { "BlinnPhong", "Blinn-Phong", "ks (n+2)/(2 pi) (n.h)^n, with a Lambert part",
      { lambert, MakeColor("specular", "Specular", "Scale ks of the lobe, no unit", 1.0, 0.1),
        MakeExponent("exponent", "Exponent", "Exponent n of the half vector's cosine", 50.0) },
      &MakeBlinnPhong },
    { "AshikhminShirley", "Ashikhmin-Shirley",
      "Anisotropic Phong lobe with Fresnel term and coupled diffuse part (2000)",
      { MakeColor("reflectance", "Reflectance", "Rs, reflectance at normal incidence", 1.0, 0.04),
        MakeColor("diffuse", "Diffuse", "Rd of the coupled diffuse part", 1.0, 0.2),
        MakeColor("specular_scale", "Specular scale", "Factor on the specular part", 10.0, 1.0),
        MakeExponent("exponent_u", "Exponent u", "Phong exponent along the tangent", 100.0),
        MakeExponent("exponent_v", "Exponent v", "Phong exponent along the bitangent", 100.0),
        { "index_of_refraction", "Index of refraction",
          "Above 1: a dielectric's exact Fresnel term. At 1: Schlick's, from the reflectance", 1.0,
          100.0, { 1.0 }, true } },
      &MakeAshikhminShirley },
    { "Distribution", "D-BRDF",
      "Ashikhmin and Premoze's (2007) with Blinn-Phong's distribution and Schlick's Fresnel term, "
      "and a Lambert part",
      { lambert, MakeColor("f0", "F0", "Fresnel reflectance at normal incidence", 1.0, 0.04),
        MakeExponent("exponent", "Exponent", "Exponent of the distribution", 50.0) },
      &MakeDistribution }
  };
  return models;
}

//------------------------------------------------------------------------------
const ParametricModel* FindModel(const std::string& name)
{
  const std::vector<ParametricModel>& models = GetModels();
  const auto found = std::find_if(models.begin(), models.end(),
    [&name](const ParametricModel& model)
    { return name.substr(0, name.find(' ')) == Prefix + model.Key; });
  return found == models.end() ? nullptr : &*found;
}

//------------------------------------------------------------------------------
std::string NameModel(const ParametricModel& model, const ModelValues& values)
{
  std::string name = Prefix + model.Key;
  for (const ModelParameter& parameter : model.Parameters)
  {
    const std::vector<double>& numbers = values.at(parameter.Key);
    char separator = '=';
    name += numbers == parameter.Default ? "" : " " + parameter.Key;
    for (std::size_t k = 0; k < numbers.size() && numbers != parameter.Default; ++k)
    {
      name += std::exchange(separator, ',') + tool::FormatNumber(numbers[k]);
    }
  }
  return name;
}

//------------------------------------------------------------------------------
ModelValues GetValues(const std::string& name)
{
  const std::vector<ModelParameter>& known = FindModel(name)->Parameters;
  ModelValues values;
  for (const ModelParameter& parameter : known)
  {
    values[parameter.Key] = parameter.Default;
  }
  std::istringstream words(name);
  std::string word;
  words >> word; // the model's own
  while (words >> word)
  {
    std::replace_if(
      word.begin(), word.end(), [](char c) { return c == '=' || c == ','; }, ' ');
    std::istringstream parts(word);
    std::string text;
    parts >> text;
    const auto parameter = std::find_if(
      known.begin(), known.end(), [&text](const ModelParameter& one) { return one.Key == text; });
    if (parameter == known.end())
    {
      throw tool::Error(name + ": \"" + text + "\": expected a parameter of this model");
    }
    std::vector<double> numbers;
    for (double number = 0.0; parts >> text && measuredbrdf::ParseNumber(text, number) &&
                              number >= parameter->Least && number <= parameter->Largest;)
    {
      numbers.push_back(number);
    }
    if (parts || numbers.size() != parameter->Default.size())
    {
      throw tool::Error(name + ": \"" + parameter->Key + "\": expected " +
                        tool::FormatCount(parameter->Default.size(), "number") + " from " +
                        tool::FormatNumber(parameter->Least) + " to " +
                        tool::FormatNumber(parameter->Largest));
    }
    values[parameter->Key] = numbers;
  }
  return values;
}

//------------------------------------------------------------------------------
tool::Material MakeSnapshot(const tool::Material& material)
{
  tool::Material snapshot = material;
  if (auto copy = vtkSmartPointer<vtkBRDF>::Take(material.BRDF->NewSnapshot()))
  {
    snapshot.BRDF = copy;
  }
  return snapshot;
}

//------------------------------------------------------------------------------
ShownMaterial ReadMaterial(const std::string& file)
{
  ShownMaterial read;
  if (const ParametricModel* model = FindModel(file))
  {
    read.Material.BRDF = model->Make(GetValues(file));
    read.Material.Name = model->Name + file.substr(std::min(file.find(' '), file.size()));
    read.Material.BRDF->SetName(read.Material.Name);
    read.Material.BRDF->SetSource(model->Description);
    read.Material.File = file;
    read.Material.Source = model->Description;
    read.Material.Format = "model";
  }
  else
  {
    read.Material = tool::LoadMaterial(file);
  }
  read.Material.BRDF->Prepare();
  if (read.Material.Transmission)
  {
    read.Material.Transmission->Prepare();
  }
  return read;
}
} // namespace explorer
