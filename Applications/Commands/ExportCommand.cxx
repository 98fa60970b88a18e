// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExportFiles.h"
#include "Files.h"
#include "Inputs.h"
#include "JsonReport.h"
#include "LitSphere.h"
#include "Measuring.h"
#include "ModelFit.h"
#include "Options.h"
#include "Progress.h"
#include "Sheets.h"
#include "Tool.h"

#include "vtkNew.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkRadianceMetrics.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

using nlohmann::ordered_json;

namespace
{
const char* const Neutral = "neutral";

struct ExportOptions
{
  std::string File;
  std::string To;
  std::string Output;
  std::string Model;
  std::vector<std::string> FitUnder = { "sky", "hall", "neutral" };
  std::string Environment = "room";
  tool::View View = { 30.0, 20.0 };
  std::string Sheet;
  std::string Report;
  int Size = 32;
  bool Json = false;
  bool IsClosest = false;
};

/// A light, and whether a fit saw it.
struct Light
{
  vtkSmartPointer<vtkEnvironment> Environment;
  bool Seen;
};

/// A fit and its errors under each light.
struct Export
{
  tool::ModelFit Fit;
  std::vector<tool::ComparedLight> Lights;
};

//------------------------------------------------------------------------------
const tool::ExportTarget& FindTarget(const std::string& name)
{
  const std::vector<tool::ExportTarget>& targets = tool::GetExportTargets();
  return *std::find_if(targets.begin(), targets.end(),
    [&name](const tool::ExportTarget& target) { return target.Name == name; });
}

//------------------------------------------------------------------------------
// The gray studio that vtkPBRPropertyFitter fits under.
vtkSmartPointer<vtkEnvironment> MakeNeutral()
{
  constexpr int height = 128;
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < 2 * height; ++x)
    {
      double d[3];
      vtkEnvironment::GetDirection((x + 0.5) / (2 * height), (y + 0.5) / height, d);
      pixels.insert(
        pixels.end(), 3, static_cast<float>(vtkPBRPropertyFitter::GetNeutralRadiance(d)));
    }
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  environment->SetPixels(2 * height, height, std::move(pixels));
  environment->SetName("neutral studio");
  return environment;
}

//------------------------------------------------------------------------------
std::vector<Light> LoadLights(const ExportOptions& options)
{
  std::vector<Light> lights;
  for (const std::string& name : options.FitUnder)
  {
    lights.push_back({ name == Neutral ? MakeNeutral() : tool::LoadEnvironment(name), true });
  }
  lights.push_back(
    { options.Environment == Neutral ? MakeNeutral() : tool::LoadEnvironment(options.Environment),
      false });
  return lights;
}

//------------------------------------------------------------------------------
void Check(const ExportOptions& options, const tool::ExportTarget& target)
{
  const std::string absence = tool::GetModelFitAbsence();
  if (!absence.empty())
  {
    throw tool::Error("export: " + absence);
  }
  const auto& endings = target.Extensions;
  if (std::find(endings.begin(), endings.end(), tool::Extension(options.Output)) == endings.end())
  {
    throw tool::UsageError(options.Output + ": the file of --to " + target.Name + " must end in " +
                           endings.front() + (endings.size() > 1 ? " or " + endings.back() : ""));
  }
  if (!options.Model.empty() && target.Models.size() == 1)
  {
    throw tool::UsageError("--model: --to " + target.Name + " has one model only");
  }
  if (options.Environment.empty())
  {
    throw tool::UsageError("--environment: this build has no 'room'; name a light that the fit "
                           "does not see");
  }
  const std::vector<std::string>& seen = options.FitUnder;
  if (std::find(seen.begin(), seen.end(), options.Environment) != seen.end())
  {
    throw tool::UsageError("--environment: the fit sees '" + options.Environment +
                           "' already (--fit-under); name another light");
  }
  for (const std::string& path : { options.Output, options.Sheet, options.Report })
  {
    tool::CheckWritable(path);
  }
}

//------------------------------------------------------------------------------
tool::LitSphere MakeSphere(
  const tool::Material& material, const std::vector<Light>& lights, const tool::View& view)
{
  tool::ProgressBar bar("collecting light");
  tool::LitSphere sphere(tool::GetViewDirection(view), material.BRDF->IsIsotropic());
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    tool::Interruptible::Check();
    bar.Update(static_cast<double>(k) / static_cast<double>(lights.size()));
    if (lights[k].Seen)
    {
      sphere.AddLight(lights[k].Environment);
    }
  }
  return sphere;
}

//------------------------------------------------------------------------------
tool::ModelFit Fit(const std::string& model, const tool::Material& material,
  const tool::LitSphere& sphere, bool usual)
{
  tool::ProgressBar bar("fitting");
  const auto proceed = [&bar](double share)
  {
    tool::Interruptible::Check();
    bar.Update(share);
  };
  try
  {
    tool::ModelFit fit = tool::FitModel(model, material.BRDF, sphere, usual, proceed);
    tool::RoundValues(fit.Model);
    return fit;
  }
  catch (const tool::Error&)
  {
    throw;
  }
  catch (const std::runtime_error& e)
  {
    throw tool::Error(material.File + ": " + e.what());
  }
}

//------------------------------------------------------------------------------
ordered_json MakeReport(const ExportOptions& options, const tool::Material& material,
  const std::vector<Light>& lights, const std::vector<Export>& exports, int pixels)
{
  ordered_json report = { { "material", material.Name }, { "target", options.To },
    { "pixels", pixels }, { "models", ordered_json::array() } };
  for (const Export& made : exports)
  {
    ordered_json values;
    for (const tool::ModelParameter& parameter : made.Fit.Model->GetParameters())
    {
      values[parameter.Name] = tool::GetJson(made.Fit, parameter);
    }
    ordered_json features = ordered_json::array();
    for (const tool::Feature feature : made.Fit.Features)
    {
      features.push_back(tool::GetFeatureName(feature));
    }
    ordered_json errors = ordered_json::array();
    for (std::size_t k = 0; k < made.Lights.size(); ++k)
    {
      errors.push_back({ { "light", made.Lights[k].Name }, { "seen_by_the_fit", lights[k].Seen },
        { "relative_l1", made.Lights[k].RelativeL1 }, { "flip", made.Lights[k].Flip } });
    }
    report["models"].push_back({ { "model", made.Fit.Model->GetTitle() }, { "parts", features },
      { "values", values }, { "fit_error", made.Fit.Error },
      { "closest_fit_error", made.Fit.ClosestError }, { "errors", errors } });
  }
  return report;
}

//------------------------------------------------------------------------------
std::string MakeFile(
  const ExportOptions& options, const std::vector<Export>& exports, const std::string& name)
{
  const tool::ModelFit& first = exports.front().Fit;
  if (options.To == "gltf")
  {
    return tool::MakeGltf(first, name, tool::Extension(options.Output) == ".glb");
  }
  if (options.To == "mtlx")
  {
    std::vector<tool::ModelFit> fits;
    for (const Export& made : exports)
    {
      fits.push_back(made.Fit);
    }
    return tool::MakeMaterialX(fits, name);
  }
  if (options.To == "usda")
  {
    return tool::MakeUsd(first, name);
  }
  return options.To == "vtk-json" ? tool::MakeVtkJson(first, name)
                                  : tool::MakeParaViewScript(first, name);
}

//------------------------------------------------------------------------------
void Run(const ExportOptions& options)
{
  const tool::ExportTarget& target = FindTarget(options.To);
  Check(options, target);
  const tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const std::vector<Light> lights = LoadLights(options);
  material.BRDF->Prepare();

  const tool::LitSphere sphere = MakeSphere(material, lights, options.View);
  std::vector<Export> exports;
  for (const std::string& model : target.Models)
  {
    if (options.Model.empty() || options.Model == "both" || options.Model == model)
    {
      exports.push_back({ Fit(model, material, sphere, !options.IsClosest), {} });
    }
  }
  const tool::Surface surface = tool::MakeSphereSurface(options.Size, options.View);
  const tool::Grid grid(surface, { options.Size, options.Size });
  for (const Light& light : lights)
  {
    const std::vector<double> reference =
      tool::IntegrateReference(material.BRDF, light.Environment, surface);
    for (Export& made : exports)
    {
      tool::ComparedLight compared{ light.Environment->GetName(), reference,
        tool::IntegrateReference(made.Fit.Model, light.Environment, surface), 0.0, 0.0 };
      vtkNew<vtkRadianceMetrics> metrics;
      tool::Measure(metrics, grid, compared.Radiance, reference);
      compared.RelativeL1 = metrics->GetRelativeL1();
      compared.Flip = metrics->GetFLIP();
      made.Lights.push_back(std::move(compared));
    }
  }
  tool::WriteWhole(options.Output, MakeFile(options, exports, material.Name));
  if (!options.Sheet.empty())
  {
    std::vector<tool::ComparedLight> rows;
    for (const Export& made : exports)
    {
      for (tool::ComparedLight row : made.Lights)
      {
        row.Name = made.Fit.Model->GetTitle() + ", " + row.Name;
        rows.push_back(std::move(row));
      }
    }
    tool::WriteLightSheet(options.Sheet, material.Name, "export", grid, rows);
  }
  const ordered_json report =
    MakeReport(options, material, lights, exports, static_cast<int>(surface.Pixels.size()));
  tool::WriteReport(options.Report, report);
  tool::PrintReport(report, options.Json);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddExportCommand(CLI::App& app)
{
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export",
    "Fit another program's shading model to a material, write its file and print the error");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  std::vector<std::string> names;
  std::string help;
  for (const ExportTarget& target : GetExportTargets())
  {
    names.push_back(target.Name);
    help += (help.empty() ? "" : "; ") + target.Name + ": " + target.Description;
  }
  command->add_option("--to", options->To, help)->required()->check(CLI::IsMember(names));
  command
    ->add_option("-o,--output", options->Output,
      "File to write: .gltf or .glb, .mtlx, .usda, .json (vtk-json), .py (paraview-state)")
    ->required();
  command
    ->add_option("--model", options->Model,
      "Of --to mtlx: standard_surface, open_pbr or both (default), a material each")
    ->check(CLI::IsMember({ "standard_surface", "open_pbr", "both" }));
  command
    ->add_option("--fit-under", options->FitUnder,
      "Lights that the fit sees, A,B,...: environments as for --environment, or 'neutral', a gray "
      "studio (default sky,hall,neutral)")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check([](const std::string& name)
      { return std::string(name.empty() ? "expected a list A,B,... of environments" : ""); });
  command->add_option("--environment", options->Environment,
    std::string("A light that the fit does not see, for one more error (default room). ") +
      EnvironmentHelp);
  AddProjectionOption(command);
  command
    ->add_option("--size", options->Size,
      "Pixels across the sphere whose errors are printed (default 32). Each takes a sum over the "
      "environments' texels")
    ->check(CLI::Range(8, 512));
  AddViewOption(command, options->View, "Of the sphere, whose ANGLE is of no effect. ");
  command->add_flag("--closest", options->IsClosest,
    "Take every value that the target allows. By default the values are such as people set by "
    "hand, for example no felt that is a part metal, and what that costs is printed");
  command
    ->add_option("--sheet", options->Sheet,
      "Picture to write, .png: the exact sphere, the export's and the signed error, under each "
      "light")
    ->check(EndsIn({ ".png" }));
  command->add_option("--report", options->Report, "JSON file to write: the same as --json");
  command->add_flag("--json", options->Json, "Write JSON instead of text");
  command->footer(
    "Example:\n  measured-brdf export gold-paint --to gltf -o gold.glb --sheet gold.png");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
