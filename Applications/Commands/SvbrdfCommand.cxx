// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "JsonReport.h"
#include "Picture.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkDataArray.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkMaterialMapFitter.h"
#include "vtkNew.h"
#include "vtkPhotographSet.h"
#include "vtkPhotographSetReader.h"
#include "vtkPointData.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace
{
struct SvbrdfOptions
{
  std::string Input;
  std::string Output;
  std::vector<std::string> Library;
  bool Tables = false;
  int Materials = 4;
  double Tolerance = 0.02;
  double Smoothness = 0.01;
  int Sample = 4096;
  unsigned int Seed = 1;
  std::string Transfer;
  double Irradiance = 0.0;
  bool Json = false;
};

const std::map<std::string, int> Transfers = { { "automatic", vtkPhotographSet::AUTOMATIC },
  { "linear", vtkPhotographSet::LINEAR }, { "srgb", vtkPhotographSet::SRGB },
  { "gamma", vtkPhotographSet::POWER } };

//------------------------------------------------------------------------------
void Check(const SvbrdfOptions& options)
{
  if (!std::isfinite(options.Irradiance))
  {
    throw tool::UsageError("--irradiance: expected a finite number > 0");
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPhotographSet> ReadPhotographs(const SvbrdfOptions& options)
{
  vtkNew<vtkPhotographSetReader> reader;
  reader->SetFileName(options.Input);
  if (!reader->Read())
  {
    tool::TakeErrorText();
    throw tool::Error(reader->GetErrorMessage());
  }
  if (reader->GetNumberOfIgnoredFiles() > 0)
  {
    tool::PrintNote(
      options.Input + ": " +
      tool::FormatCount(static_cast<std::size_t>(reader->GetNumberOfIgnoredFiles()), "file") +
      " ignored, whose names say no directions");
  }
  vtkSmartPointer<vtkPhotographSet> photographs = reader->GetPhotographs();
  if (!options.Transfer.empty())
  {
    photographs->SetTransfer(Transfers.at(options.Transfer));
  }
  if (options.Irradiance > 0.0)
  {
    photographs->SetIrradiance(options.Irradiance);
  }
  return photographs;
}

//------------------------------------------------------------------------------
void AddLibrary(const SvbrdfOptions& options, vtkMaterialMapFitter* fitter)
{
  std::vector<std::string> names = options.Library;
  const int embedded = names.empty() ? vtkEmbeddedMaterials::GetNumberOfMaterials() : 0;
  for (int k = 0; k < embedded; ++k)
  {
    names.push_back(vtkEmbeddedMaterials::GetName(k));
  }
  for (const std::string& name : names)
  {
    tool::Interruptible::Check();
    fitter->AddMaterial(tool::LoadMaterial(name).BRDF, name);
  }
}

//------------------------------------------------------------------------------
// What map.json calls a material: a built-in name, or a file relative to its folder.
std::string GetReference(const std::string& name, const std::string& folder)
{
  if (name.find_first_of("/.#") == std::string::npos)
  {
    return name;
  }
  const std::size_t hash = name.find('#');
  std::error_code error;
  const fs::path relative = fs::relative(name.substr(0, hash), folder, error);
  std::string reference = error || relative.empty() ? name : relative.string();
  reference += error || hash == std::string::npos ? "" : name.substr(hash);
  // A plain file's name must be told from a built-in one.
  return reference.find_first_of("/.#") == std::string::npos ? "./" + reference : reference;
}

//------------------------------------------------------------------------------
// JSON has no infinity.
ordered_json ToJson(double value)
{
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

//------------------------------------------------------------------------------
// Writes those that were found.
ordered_json DescribeMaterials(const SvbrdfOptions& options, vtkMaterialMapFitter* fitter)
{
  ordered_json materials = ordered_json::array();
  vtkMaterialMap* map = fitter->GetOutput();
  for (int k = 0; k < map->GetNumberOfMaterials(); ++k)
  {
    std::string reference = GetReference(map->GetName(k), options.Output);
    if (options.Tables)
    {
      reference = "material-" + std::to_string(k + 1) + ".exr";
      tool::WriteMaterial(map->GetBRDF(k), (fs::path(options.Output) / reference).string());
    }
    materials.push_back({ { "material", reference }, { "coverage", fitter->GetCoverage(k) },
      { "largest_weight", fitter->GetLargestWeight(k) },
      { "weight_uncertainty", ToJson(fitter->GetUncertainty(k)) } });
  }
  return materials;
}

//------------------------------------------------------------------------------
ordered_json DescribeFit(const SvbrdfOptions& options, vtkMaterialMapFitter* fitter)
{
  vtkPhotographSet* photographs = fitter->GetPhotographs();
  const int* size = fitter->GetErrorImage()->GetDimensions();
  const int* worst = fitter->GetWorstTexel();
  ordered_json fit = { { "photographs", photographs->GetNumberOfPhotographs() },
    { "method", options.Tables ? "tables" : "library" }, { "size", { size[0], size[1] } },
    { "mean_error", fitter->GetMeanError() }, { "error_95_percent", fitter->GetError95() },
    { "worst_error", fitter->GetWorstError() },
    { "worst_texel_from_top_left", { worst[0], size[1] - 1 - worst[1] } },
    { "saturated_pixels", fitter->GetNumberOfSaturatedPixels() },
    { "black_pixels", fitter->GetNumberOfBlackPixels() },
    { "invalid_pixels", fitter->GetNumberOfInvalidPixels() },
    { "texels_without_data", fitter->GetNumberOfTexelsWithoutData() }, { "seed", options.Seed } };
  if (options.Tables)
  {
    fit["factorization_error"] = fitter->GetFactorizationError();
    fit["iterations"] = fitter->GetNumberOfIterations();
    fit["converged"] = fitter->GetConverged();
    fit["share_of_table_seen"] = fitter->GetSeenShare();
  }
  fit["findings"] = ordered_json::array();
  for (int k = 0; k < fitter->GetNumberOfFindings(); ++k)
  {
    fit["findings"].push_back(fitter->GetFinding(k));
  }
  return fit;
}

//------------------------------------------------------------------------------
// error.exr: the errors as they are; error.png: from black to white, the 99th percentile.
void WriteErrors(const SvbrdfOptions& options, vtkImageData* errors, ordered_json& fit)
{
  const int* size = errors->GetDimensions();
  const auto* values = static_cast<const float*>(errors->GetScalarPointer());
  const std::size_t texels = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  std::vector<float> sorted(values, values + texels);
  const auto rank = sorted.begin() + static_cast<std::ptrdiff_t>(texels * 99 / 100);
  std::nth_element(sorted.begin(), rank, sorted.end());
  const double white = std::max<double>(*rank, 1e-6);
  tool::Picture exact(size[0], size[1]), shown(size[0], size[1]);
  for (std::size_t k = 0; k < 4 * texels; ++k)
  {
    const float error = values[k / 4];
    exact.Pixels[k] = k % 4 == 3 ? 1.0f : error;
    shown.Pixels[k] = k % 4 == 3 ? 1.0f : static_cast<float>(error / white);
  }
  const fs::path folder(options.Output);
  tool::WriteEXR((folder / "error.exr").string(), exact);
  tool::WritePNG((folder / "error.png").string(), shown, [](double value) { return value; });
  fit["white_of_error_png"] = white;
}

constexpr int MaterialsPerImage = 3; // alpha is no place for a weight: programs multiply by it
constexpr double LargestCode = 65535.0;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeWeightImage(vtkMaterialMap* map, int first)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(map->GetWeightImage(0)->GetDimensions());
  image->AllocateScalars(VTK_UNSIGNED_SHORT, MaterialsPerImage);
  vtkDataArray* codes = image->GetPointData()->GetScalars();
  codes->Fill(0.0);
  const int end = std::min(first + MaterialsPerImage, map->GetNumberOfMaterials());
  for (int k = first; k < end; ++k) // the fitter's images have four components
  {
    vtkDataArray* weights = map->GetWeightImage(k / 4)->GetPointData()->GetScalars();
    for (vtkIdType texel = 0; texel < codes->GetNumberOfTuples(); ++texel)
    {
      const double weight = weights->GetComponent(texel, k % 4);
      codes->SetComponent(texel, k - first, std::round(LargestCode * weight));
    }
  }
  return image;
}

//------------------------------------------------------------------------------
// FOLDER/map.json and FOLDER/weights-N.png, three materials in each.
void WriteMaterialMap(vtkMaterialMap* map, const std::string& folder, const ordered_json& materials,
  const ordered_json& facts)
{
  ordered_json description = { { "materials", materials }, { "weights", ordered_json::array() } };
  description.update(facts);
  for (int first = 0; first < map->GetNumberOfMaterials(); first += MaterialsPerImage)
  {
    const std::string name = "weights-" + std::to_string(first / MaterialsPerImage + 1) + ".png";
    tool::WritePNG((fs::path(folder) / name).string(), MakeWeightImage(map, first));
    description["weights"].push_back(name);
  }
  tool::WriteWhole((fs::path(folder) / "map.json").string(),
    description.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n");
}

//------------------------------------------------------------------------------
void Run(const SvbrdfOptions& options)
{
  Check(options);
  tool::Interruptible interruptible;
  vtkNew<vtkMaterialMapFitter> fitter;
  fitter->SetPhotographs(ReadPhotographs(options));
  if (options.Tables)
  {
    fitter->SetMethodToTables();
  }
  else
  {
    AddLibrary(options, fitter);
  }
  fitter->SetMaximumNumberOfMaterials(options.Materials);
  fitter->SetTolerance(options.Tolerance);
  fitter->SetSmoothness(options.Smoothness);
  fitter->SetNumberOfSampleTexels(options.Sample);
  fitter->SetSeed(options.Seed);
  tool::MakeFolder(options.Output);
  if (!tool::RunWithProgress(fitter.Get(), &vtkMaterialMapFitter::Fit, "fitting"))
  {
    throw tool::Error(options.Input + ": " + tool::TakeErrorText());
  }
  ordered_json fit = DescribeFit(options, fitter);
  WriteErrors(options, fitter->GetErrorImage(), fit);
  const ordered_json materials = DescribeMaterials(options, fitter);
  WriteMaterialMap(fitter->GetOutput(), options.Output, materials, { { "fit", fit } });
  ordered_json report = { { "photographs_of", options.Input },
    { "map", (fs::path(options.Output) / "map.json").string() } };
  report.update(fit);
  report["materials"] = materials;
  tool::PrintReport(report, options.Json);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddSvbrdfCommand(CLI::App& app)
{
  auto options = std::make_shared<SvbrdfOptions>();
  CLI::App* command = app.add_subcommand("svbrdf",
    "Photographs of a flat sample under known lights and views -> a map of materials: weights for "
    "each texel");
  command
    ->add_option("PHOTOGRAPHS", options->Input,
      "A list in JSON with files, directions and exposures, or a folder of files named like "
      "tl015_pl030_tv045_pv060.jpg (light and view, polar angle and azimuth), as the Bonn and UTIA "
      "databases name them")
    ->required();
  CLI::Option* library = command->add_option("--library", options->Library,
    "The materials to choose from (default: all built-in ones). " + GetMaterialHelp());
  library->delimiter(',');
  CLI::Option* tables = command->add_flag("--tables", options->Tables,
    "Find the materials, too: tables over half and difference angles, instead of a library");
  tables->excludes(library);
  command
    ->add_option("--materials", options->Materials,
      "Most materials of the map; with --tables, how many (default 4)")
    ->check(CLI::Range(1, 32));
  command
    ->add_option("--tolerance", options->Tolerance,
      "A further material of the library must lower the sum of squared errors by this share "
      "(default 0.02)")
    ->check(CLI::Range(0.0, 1.0))
    ->excludes(tables);
  command
    ->add_option("--smoothness", options->Smoothness,
      "How smooth tables are where photographs are few (default 0.01)")
    ->check(CLI::Range(1e-8, 1e4))
    ->needs(tables);
  command
    ->add_option("--sample", options->Sample,
      "Number of texels by which materials are chosen or found (default 4096)")
    ->check(CLI::Range(64, 1 << 20));
  command->add_option(
    "--seed", options->Seed, "Seed of the sample (default 1); the same seed gives the same map");
  command
    ->add_option("--transfer", options->Transfer,
      "What pixels of the files mean: automatic (integers by sRGB's curve, floats linear), linear, "
      "srgb or gamma (2.2, or the list's); default: what the list says, or automatic")
    ->check(CLI::IsMember({ "automatic", "linear", "srgb", "gamma" }));
  command
    ->add_option("--irradiance", options->Irradiance,
      "Irradiance of a surface that faces the light, at exposure 1 (default: the list's, or pi: a "
      "white diffuse surface below the light has the value 1)")
    ->check(CLI::PositiveNumber);
  command->add_flag("--json", options->Json, "Write JSON instead of text");
  command
    ->add_option("-o,--output", options->Output,
      "Folder for map.json, weights-N.png, error.exr, error.png and found materials")
    ->required();
  command->footer(
    "The error of a texel is sqrt(sum of squares left / sum of squares) over its\n"
    "photographs, which count alike. 'photograph' simulates photographs.\n\n"
    "Example:\n  measured-brdf svbrdf UBO_CORDUROY256 --tables --materials 3 -o cord");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
