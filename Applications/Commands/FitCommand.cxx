// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "JsonReport.h"
#include "Methods.h"
#include "NumberText.h"
#include "Options.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkLobeBRDFFitter.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <sstream>

using nlohmann::ordered_json;

namespace
{
constexpr int NumberOfFitErrorPairs = 1 << 16;

struct FitOptions
{
  std::string File;
  std::string Output;
  std::string Model;
  std::string Loss = "log-cosine";
  int Lobes = 1;
  int Starts = 4;
  int Samples = 0; // 0: the fitter's own
  unsigned int Seed = 1;
  bool Anisotropic = false;
  bool Json = false;
};

const std::map<std::string, int> Losses = { { "log-cosine", vtkBRDFFitter::LOG_COSINE },
  { "cube-root", vtkBRDFFitter::CUBE_ROOT_COSINE }, { "squared", vtkBRDFFitter::SQUARED } };

// The models, and the options that they do not take.
const std::map<std::string, std::vector<std::string>> Models = { { "d-brdf", { "--lobes" } },
  { "ashikhmin-shirley", {} }, { "blinn-phong", { "--anisotropic" } },
  { "auto", { "--lobes", "--anisotropic" } } };

// What --model auto tries where a basis does not suit, each with its number of lobes.
const std::pair<const char*, int> Candidates[] = { { "d-brdf", 1 }, { "ashikhmin-shirley", 1 },
  { "ashikhmin-shirley", 2 } };

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDFFitter> MakeFitter(const FitOptions& options)
{
  if (options.Model == "d-brdf")
  {
    auto fitter = vtkSmartPointer<vtkDistributionBRDFFitter>::New();
    fitter->SetNumberOfPhiSamples(options.Anisotropic ? 32 : 0);
    return fitter;
  }
  auto fitter = vtkSmartPointer<vtkLobeBRDFFitter>::New();
  fitter->SetShape(options.Model == "blinn-phong" ? vtkLobeBRDFFitter::BLINN_PHONG
                                                  : vtkLobeBRDFFitter::ASHIKHMIN_SHIRLEY);
  fitter->SetNumberOfLobes(options.Lobes);
  fitter->SetAnisotropy(
    options.Anisotropic ? vtkLobeBRDFFitter::ANISOTROPIC : vtkLobeBRDFFitter::AS_INPUT);
  return fitter;
}

//------------------------------------------------------------------------------
void Check(const FitOptions& options, const CLI::App* command)
{
  tool::CheckWritable(options.Output);
  for (const std::string& option : Models.at(options.Model))
  {
    if (command->count(option) > 0)
    {
      throw tool::UsageError(option + ": --model " + options.Model + " has no such option");
    }
  }
}

//------------------------------------------------------------------------------
// With the reason why it is a fit, where --model auto chose.
void Report(
  const FitOptions& options, vtkBRDFFitter* fitter, double seconds, const std::string& reason = "")
{
  const double* in = fitter->GetInputAlbedo();
  const double* out = fitter->GetOutputAlbedo();
  ordered_json d = { { "input", options.File }, { "output", options.Output },
    { "model", options.Model }, { "loss", options.Loss }, { "residual", fitter->GetResidual() },
    { "relative_l2_error", fitter->GetRelativeL2Error() },
    { "iterations", fitter->GetNumberOfIterations() }, { "converged", fitter->GetConverged() },
    { "seconds", seconds }, { "albedo_of_input", { in[0], in[1], in[2] } },
    { "albedo_of_fit", { out[0], out[1], out[2] } }, { "parameters", ordered_json::array() } };
  std::istringstream report(fitter->GetReport());
  for (std::string line; std::getline(report, line);)
  {
    d["parameters"].push_back(line);
  }
  if (!reason.empty())
  {
    d["representation"] = "fit";
    d["representation_form"] = tool::DescribeForm(fitter->GetOutput());
    d["reason"] = reason;
  }
  tool::PrintReport(d, options.Json);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDFFitter> FitModel(const FitOptions& options, vtkBRDF* brdf)
{
  const vtkSmartPointer<vtkBRDFFitter> fitter = MakeFitter(options);
  fitter->SetInput(brdf);
  fitter->SetLoss(Losses.at(options.Loss));
  fitter->SetNumberOfStarts(options.Starts);
  fitter->SetSeed(options.Seed);
  if (options.Samples > 0)
  {
    fitter->SetNumberOfSamples(options.Samples);
  }
  if (!tool::RunWithProgress(fitter.Get(), &vtkBRDFFitter::Fit, "fitting"))
  {
    throw tool::Error(options.File + ": " + tool::TakeErrorText());
  }
  return fitter;
}

//------------------------------------------------------------------------------
// Basis or fit by the advisor's rule; of the fits the one of least residual.
void RunAuto(
  const FitOptions& options, const tool::Material& material, const std::function<double()>& seconds)
{
  const tool::Representation made = tool::Represent(material, tool::MethodOptions().Order);
  if (made.Kind == "basis")
  {
    const double error =
      vtkBRDFResampler::GetRelativeL2Error(material.BRDF, made.BRDF, NumberOfFitErrorPairs);
    tool::WriteMaterial(made.BRDF, options.Output);
    tool::PrintReport(
      { { "input", options.File }, { "output", options.Output }, { "model", "basis" },
        { "representation", made.Kind }, { "representation_form", made.Description },
        { "reason", made.Reason }, { "relative_l2_error", error }, { "seconds", seconds() } },
      options.Json);
    return;
  }
  tool::PrintNote(material.Name + ": " + made.Reason);
  vtkSmartPointer<vtkBRDFFitter> best;
  FitOptions chosen = options;
  for (const auto& candidate : Candidates)
  {
    FitOptions tried = options;
    tried.Model = candidate.first;
    tried.Lobes = candidate.second;
    const vtkSmartPointer<vtkBRDFFitter> fitter = FitModel(tried, material.BRDF);
    tool::PrintNote(fitter->GetModelName() + ", lobes " + std::to_string(candidate.second) +
                    ": residual " + measuredbrdf::NumberText(fitter->GetResidual(), 4));
    if (!best || fitter->GetResidual() < best->GetResidual())
    {
      best = fitter;
      chosen = tried;
    }
  }
  tool::WriteMaterial(best->GetOutput(), options.Output);
  Report(chosen, best, seconds(), made.Reason);
}

//------------------------------------------------------------------------------
void RunFit(const FitOptions& options, const CLI::App* command)
{
  Check(options, command);
  tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [begin]
  { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  if (options.Model == "auto")
  {
    RunAuto(options, material, seconds);
    return;
  }
  const vtkSmartPointer<vtkBRDFFitter> fitter = FitModel(options, material.BRDF);
  tool::WriteMaterial(fitter->GetOutput(), options.Output);
  Report(options, fitter, seconds());
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddFitCommand(CLI::App& app)
{
  auto options = std::make_shared<FitOptions>();
  CLI::App* command = app.add_subcommand(
    "fit", "Fit a small model to a material, write it and print how close it is");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  command
    ->add_option("--model", options->Model,
      "d-brdf: tables of the half vector's distribution and of the Fresnel term; "
      "ashikhmin-shirley, blinn-phong: analytic lobes. These have a Lambert part, too. auto: a "
      "basis where it does not ring, otherwise the closest of the D-BRDF and 1 or 2 "
      "Ashikhmin-Shirley lobes. "
      "For programs without measured materials there is export")
    ->required()
    ->check(CLI::IsMember(Models));
  command->add_option("--lobes", options->Lobes, "Number of lobes of analytic models (default 1)")
    ->check(CLI::Range(1, 3));
  command
    ->add_option("--loss", options->Loss,
      "The loss is the squared difference of: ln(1 + f cos) (log-cosine, default); (f cos)^(1/3) "
      "(cube-root); or f itself (squared), which gives the least relative L2 error")
    ->check(CLI::IsMember(Losses));
  command
    ->add_option("--starts", options->Starts, "Number of starting points to refine (default 4)")
    ->check(CLI::Range(1, 64));
  command
    ->add_option("--samples", options->Samples,
      "Number of direction pairs, 256 to 262144 (default 32768); all derivatives are in memory, 1 "
      "to 2 kB each")
    ->check(CLI::Range(256, 1 << 18));
  command->add_option(
    "--seed", options->Seed, "Shifts the direction pairs; same seed, same result (default 1)");
  command->add_flag("--anisotropic", options->Anisotropic,
    "Let the lobes be anisotropic (default: where the material is)");
  command->add_flag("--json", options->Json, "Write JSON instead of text");
  command->add_option("-o,--output", options->Output, "File to write, ending in .exr")
    ->check(EndsIn({ ".exr" }))
    ->required();
  command->footer(
    "The residual is the root mean square of these differences over direction pairs that the\n"
    "fit did not use. The relative L2 error weights f by both cosines.\n\n"
    "Example:\n  measured-brdf fit satin_purple_rgb.bsdf --model ashikhmin-shirley --lobes 2 \\\n"
    "    -o satin.exr");
  command->callback([options, command]() { RunFit(*options, command); });
}
} // namespace tool
