// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartMeter.h"
#include "ChartMethods.h"
#include "ChartPages.h"
#include "ChartResults.h"
#include "Files.h"
#include "Inputs.h"
#include "Measuring.h"
#include "Options.h"
#include "Program.h"
#include "Progress.h"
#include "Tool.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <set>

namespace
{
namespace fs = std::filesystem;

struct ChartOptions
{
  std::vector<std::string> Files;
  std::vector<std::string> Environments = { "sky", "hall" };
  std::vector<std::string> Methods; // all
  std::vector<double> Tolerances = { 0.01, 0.02, 0.05 };
  std::string Sweep = "small";
  tool::Stage Stage;
  int ReferencePixels = 0; // all
  int Rounds = 9;
  double Slowest = 2000.0;
  bool ForView = false;
  std::string Folder;
};

// A matte one, a plastic, a paint and a metal of those that come with the tool.
const std::vector<std::string> DefaultMaterials = { "pink-felt", "violet-rubber", "gold-paint",
  "nickel" };
constexpr int LargestChartedPicture = 4096;

//------------------------------------------------------------------------------
// Those of the charts that are there by name.
std::vector<std::string> ListMethods()
{
  std::vector<std::string> names;
  for (const tool::ChartMethod& method : tool::GetChartMethods())
  {
    if (method.Name != tool::PBRMethod && method.Name != tool::PlannerMethod)
    {
      names.push_back(method.Name);
    }
  }
  return names;
}

//------------------------------------------------------------------------------
std::string Join(const std::vector<std::string>& parts)
{
  std::string text;
  for (const std::string& part : parts)
  {
    text += (text.empty() ? "" : ",") + part;
  }
  return text;
}

//------------------------------------------------------------------------------
std::vector<tool::Material> LoadMaterials(const std::vector<std::string>& files)
{
  std::vector<tool::Material> materials;
  std::set<std::string> names;
  for (const std::string& file : files)
  {
    if (file.empty())
    {
      throw tool::UsageError("FILE: one of the materials has an empty name");
    }
    materials.push_back(tool::LoadMaterial(file));
    // Results are found by name.
    if (!names.insert(materials.back().Name).second)
    {
      materials.back().Name = fs::path(file).stem().string();
      if (!names.insert(materials.back().Name).second)
      {
        throw tool::UsageError("FILE: two materials are called " + materials.back().Name);
      }
    }
  }
  return materials;
}

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkEnvironment>> LoadEnvironments(const std::vector<std::string>& files)
{
  std::vector<vtkSmartPointer<vtkEnvironment>> environments;
  std::set<std::string> names;
  for (const std::string& file : files)
  {
    environments.push_back(tool::LoadEnvironment(file));
    if (!names.insert(environments.back()->GetName()).second)
    {
      throw tool::UsageError("--environments: two are called " + environments.back()->GetName());
    }
  }
  return environments;
}

//------------------------------------------------------------------------------
// The pairs that the results do not have yet; what there is so far is in the folder after each.
// Throws Error where a pair that they have has changed since.
void MeasureAll(const ChartOptions& options, tool::ChartMeter& meter, tool::ChartJson& results)
{
  const std::vector<tool::Material> materials =
    LoadMaterials(options.Files.empty() ? DefaultMaterials : options.Files);
  const auto environments = LoadEnvironments(options.Environments);
  std::vector<std::pair<const tool::Material*, vtkEnvironment*>> tasks;
  for (const tool::Material& material : materials)
  {
    for (const auto& environment : environments)
    {
      const tool::ChartJson* kept = tool::FindPair(results, material.Name, environment->GetName());
      if (!kept)
      {
        tasks.emplace_back(&material, environment);
      }
      else if (kept->at("fingerprint") != meter.GetFingerprint(material, environment))
      {
        throw tool::Error(options.Folder + "/results.json: " + material.Name + " under " +
                          environment->GetName() +
                          " has changed since it was measured. Write to another folder");
      }
    }
  }
  tool::ProgressBar bar("measuring");
  for (std::size_t k = 0; k < tasks.size(); ++k)
  {
    const auto show = [&](double share)
    { bar.Update((static_cast<double>(k) + share) / static_cast<double>(tasks.size())); };
    try
    {
      results["pairs"].push_back(meter.Measure(*tasks[k].first, tasks[k].second, show));
    }
    catch (const tool::Error&)
    {
      if (!tool::Interruptible::IsInterrupted())
      {
        throw;
      }
      throw tool::Error("interrupted: " + std::to_string(k) + " of " +
                        std::to_string(tasks.size()) + " pairs were measured and are in " +
                        options.Folder + "; the same command continues from there");
    }
    tool::SaveResults(options.Folder, results);
    tool::DrawPairPage(results, results["pairs"].back(), options.Folder);
  }
}

//------------------------------------------------------------------------------
void PrintVerdict(
  const tool::ChartJson& results, const ChartOptions& options, const tool::ChartMeter& meter)
{
  std::size_t figures = 0;
  for (const tool::ChartJson& pair : results["pairs"])
  {
    figures += pair["planner"].size();
  }
  char text[200];
  std::snprintf(text, sizeof(text),
    "The planner's %zu points: %.0f %% on the front of all that was measured or within %.0f %% of "
    "its time.\n",
    figures, 100.0 * tool::GetShareWithin(results), 100.0 * tool::FrontMargin);
  tool::PrintOut(tool::FormatCount(results["pairs"].size(), "pair") + " in " + options.Folder +
                 ": summary.png, setup.png, memory.png, one of each pair, results.csv, "
                 "results.json\nErrors are those of " +
                 meter.DescribePixels() + ".\n" + text);
}

//------------------------------------------------------------------------------
void Run(const ChartOptions& options)
{
  const std::vector<std::string> methods =
    options.Methods.empty() ? ListMethods() : options.Methods;
  const std::vector<tool::ChartSize> sizes =
    tool::ListChartSizes(methods, options.Tolerances, options.Sweep == "full", options.ForView);
  tool::MakeFolder(options.Folder);
  tool::CheckWritable(options.Folder + "/results.json");
  const tool::Interruptible interruptible;
  tool::ChartMeter meter(
    { options.Stage.LoadMesh(), options.Stage,
      options.ReferencePixels > 0 ? options.ReferencePixels : std::numeric_limits<int>::max(),
      options.Rounds, options.Slowest },
    sizes);
  nlohmann::ordered_json machine = tool::DescribeMachine();
  machine.update(meter.DescribeRenderer());
  const tool::Size& size = options.Stage.Size;
  const nlohmann::ordered_json settings = { { "methods", methods }, { "sweep", options.Sweep },
    { "tolerances", options.Tolerances },
    { "mesh", options.Stage.MeshFile.empty() ? "sphere" : options.Stage.MeshFile },
    { "size", std::to_string(size.Width) + "x" + std::to_string(size.Height) },
    { "view",
      { options.Stage.View.Azimuth, options.Stage.View.Elevation, options.Stage.View.Angle } },
    { "reference_pixels",
      options.ReferencePixels > 0 ? std::to_string(options.ReferencePixels) : "all" },
    { "rounds", options.Rounds }, { "slowest", options.Slowest }, { "for_view", options.ForView } };
  tool::ChartJson results = tool::LoadResults(options.Folder, settings, machine);

  MeasureAll(options, meter, results);
  tool::DrawSummaryPages(results, options.Folder);
  PrintVerdict(results, options, meter);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddChartCommand(CLI::App& app)
{
  auto options = std::make_shared<ChartOptions>();
  CLI::App* command = app.add_subcommand(
    "chart", "Chart the speed and accuracy of the methods for your materials on your machine");
  const CLI::Validator notEmpty([](const std::string& part)
    { return std::string(part.empty() ? "expected names with commas between them" : ""); },
    "NAME");
  command->add_option("FILE", options->Files,
    std::string("Materials, each as in the other commands: ") + GetMaterialHelp() +
      ". Default: " + Join(DefaultMaterials));
  command
    ->add_option("--environments", options->Environments,
      "Environments, with commas between them, each as in the other commands (default sky,hall)")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(notEmpty);
  AddProjectionOption(command);
  command
    ->add_option("--methods", options->Methods,
      "Methods, with commas between them (default all): " + Join(ListMethods()) +
        ". VTK's own shading is always included")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(notEmpty);
  command
    ->add_option("--tolerances", options->Tolerances,
      "Tolerances whose plans are marked, with commas between them, from 0.001 to 1 (default "
      "0.01,0.02,0.05)")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->check(Between(1e-3, 1.0));
  command
    ->add_option(
      "--sweep", options->Sweep, "small (default): a few sizes of each method; full: all of them")
    ->check(CLI::IsMember({ "small", "full" }));
  options->Stage.AddMeshTo(command, LargestChartedPicture);
  command
    ->add_option("--reference-pixels", options->ReferencePixels,
      "Compare at most so many covered pixels, those on a regular grid (default: all, many of "
      "which are interpolated, as in compare)")
    ->check(CLI::Range(1, LargestChartedPicture * LargestChartedPicture));
  command
    ->add_option("--rounds", options->Rounds,
      "Number of timed frames of each method, drawn in turns (default 9). Slow methods get fewer, "
      "at "
      "least 3; methods above half a second get one")
    ->check(CLI::Range(3, 1000));
  command
    ->add_option("--slowest", options->Slowest,
      "Leave out sizes whose frames would take longer than this, in ms (default 2000)")
    ->check(Between(1e-3, 1e9));
  command->add_flag("--for-view", options->ForView,
    "Also mark the plan for the picture's own normals, views and pixels ('in view'). Without this, "
    "plans are made for a sphere seen from everywhere");
  command->add_option("-o,--output", options->Folder, "Folder to write to")->required();
  command->footer(
    "Results are kept after each pair of material and environment. After Ctrl-C or a crash the "
    "same command\ncontinues; with more materials or environments it adds them. Times are "
    "meaningful on an otherwise\nidle machine only.\n\nExample:\n  measured-brdf chart felt.bsdf "
    "satin.bsdf --environments studio.exr,sunset.exr --sweep full -o charts\n\nNeeds OpenGL; "
    "without a screen, put 'xvfb-run -a' before it.");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
