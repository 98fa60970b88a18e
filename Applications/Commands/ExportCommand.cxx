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

//------------------------------------------------------------------------------
std::vector<Light> LoadLights(const ExportOptions& options)
{
  const auto load = [](const std::string& name)
  {
    auto environment = vtkSmartPointer<vtkEnvironment>::New();
    if (name != Neutral)
    {
      return tool::LoadEnvironment(name);
    }
    vtkPBRPropertyFitter::SetToNeutralStudio(environment);
    return environment;
  };
  std::vector<Light> lights;
  for (const std::string& name : options.FitUnder)
  {
    lights.push_back({ load(name), true });
  }
  lights.push_back({ load(options.Environment), false });
  return lights;
}

//------------------------------------------------------------------------------
void Check(const ExportOptions& options, const tool::ExportTarget& target)
{
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
ordered_json MakeReport(const tool::ModelFit& fit, const std::vector<Light>& lights,
  const std::vector<tool::ComparedLight>& compared)
{
  ordered_json values;
  for (const tool::ModelParameter& parameter : fit.Model->GetParameters())
  {
    values[parameter.Name] = tool::GetJson(fit, parameter);
  }
  ordered_json features = ordered_json::array();
  for (const tool::Feature feature : fit.Features)
  {
    features.push_back(tool::GetFeatureName(feature));
  }
  ordered_json errors = ordered_json::array();
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    errors.push_back(
      { { "light", lights[k].Environment->GetName() }, { "seen_by_the_fit", lights[k].Seen },
        { "relative_l1", compared[k].RelativeL1 }, { "flip", compared[k].Flip } });
  }
  return { { "model", fit.Model->GetTitle() }, { "parts", features }, { "values", values },
    { "fit_error", fit.Error }, { "closest_fit_error", fit.ClosestError }, { "errors", errors } };
}

//------------------------------------------------------------------------------
void Run(const ExportOptions& options)
{
  const auto& targets = tool::GetExportTargets();
  const tool::ExportTarget& target = *std::find_if(targets.begin(), targets.end(),
    [&](const tool::ExportTarget& known) { return known.Name == options.To; });
  Check(options, target);
  const tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const std::vector<Light> lights = LoadLights(options);
  material.BRDF->Prepare();

  const tool::LitSphere sphere = MakeSphere(material, lights, options.View);
  std::vector<tool::ModelFit> fits;
  for (const std::string& model : target.Models)
  {
    if (options.Model.empty() || options.Model == "both" || options.Model == model)
    {
      fits.push_back(Fit(model, material, sphere, !options.IsClosest));
    }
  }
  const tool::Surface surface = tool::MakeSphereSurface(options.Size, options.View);
  const tool::Grid grid(surface, { options.Size, options.Size });
  std::vector<std::vector<double>> references;
  for (const Light& light : lights)
  {
    references.push_back(tool::IntegrateReference(material.BRDF, light.Environment, surface));
  }
  ordered_json report = { { "material", material.Name }, { "target", options.To },
    { "pixels", surface.Pixels.size() }, { "models", ordered_json::array() } };
  std::vector<tool::ComparedLight> rows;
  for (const tool::ModelFit& fit : fits)
  {
    std::vector<tool::ComparedLight> compared;
    for (std::size_t k = 0; k < lights.size(); ++k)
    {
      vtkEnvironment* environment = lights[k].Environment;
      tool::ComparedLight row{ fit.Model->GetTitle() + ", " + environment->GetName(), references[k],
        tool::IntegrateReference(fit.Model, environment, surface), 0.0, 0.0 };
      vtkNew<vtkRadianceMetrics> metrics;
      tool::Measure(metrics, grid, row.Radiance, references[k]);
      row.RelativeL1 = metrics->GetRelativeL1();
      row.Flip = metrics->GetFLIP();
      compared.push_back(std::move(row));
    }
    report["models"].push_back(MakeReport(fit, lights, compared));
    rows.insert(rows.end(), compared.begin(), compared.end());
  }
  tool::WriteWhole(
    options.Output, target.Make(fits, material.Name, tool::Extension(options.Output) == ".glb"));
  if (!options.Sheet.empty())
  {
    tool::WriteLightSheet(options.Sheet, material.Name, "export", grid, rows);
  }
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
