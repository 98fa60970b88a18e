// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartMeter.h"
#include "ChartMethods.h"
#include "ChartPages.h"
#include "ChartResults.h"
#include "Files.h"
#include "Inputs.h"
#include "MaterialMapFiles.h"
#include "Measuring.h"
#include "Meshes.h"
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
  std::string Metric = "relative_l1";
  std::string Mesh;
  std::string Size = "500x500";
  std::string View = "30,20";
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
constexpr double Margin = 0.2;

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
std::string JoinTolerances(const std::vector<double>& tolerances)
{
  std::vector<std::string> parts;
  for (const double tolerance : tolerances)
  {
    parts.push_back(tool::FormatNumber(tolerance));
  }
  return Join(parts);
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
struct Task
{
  const tool::Material* Material;
  vtkEnvironment* Environment;
};

//------------------------------------------------------------------------------
// The pairs that the results do not have yet. Throws Error where one has changed since.
std::vector<Task> ListTasks(const std::vector<tool::Material>& materials,
  const std::vector<vtkSmartPointer<vtkEnvironment>>& environments, const tool::ChartMeter& meter,
  const tool::ChartJson& results, const std::string& folder)
{
  std::vector<Task> tasks;
  for (const tool::Material& material : materials)
  {
    for (const vtkSmartPointer<vtkEnvironment>& environment : environments)
    {
      const tool::ChartJson* kept = tool::FindPair(results, material.Name, environment->GetName());
      if (!kept)
      {
        tasks.push_back({ &material, environment });
      }
      else if (kept->at("fingerprint") != meter.GetFingerprint(material, environment))
      {
        throw tool::Error(folder + "/results.json: " + material.Name + " under " +
                          environment->GetName() +
                          " has changed since it was measured. Write to another folder");
      }
    }
  }
  return tasks;
}

//------------------------------------------------------------------------------
// What there is so far is in the folder after each pair.
void MeasureAll(const std::vector<Task>& tasks, tool::ChartMeter& meter, tool::ChartJson& results,
  const tool::Metric& metric, const std::string& folder)
{
  tool::ProgressBar bar("measuring");
  for (std::size_t k = 0; k < tasks.size(); ++k)
  {
    const auto show = [&](double share)
    { bar.Update((static_cast<double>(k) + share) / static_cast<double>(tasks.size())); };
    try
    {
      results["pairs"].push_back(meter.Measure(*tasks[k].Material, tasks[k].Environment, show));
    }
    catch (const tool::Error&)
    {
      if (!tool::Interruptible::IsInterrupted())
      {
        throw;
      }
      throw tool::Error("interrupted: " + std::to_string(k) + " of " +
                        std::to_string(tasks.size()) + " pairs were measured and are in " + folder +
                        "; the same command continues from there");
    }
    tool::SaveResults(folder, results);
    const tool::ChartJson& pair = results["pairs"].back();
    tool::DrawPage(
      tool::MakePairPage(results, pair, metric), folder + "/" + tool::MakeFileName(pair) + ".png");
  }
}

//------------------------------------------------------------------------------
void PrintVerdict(
  const tool::ChartJson& results, const ChartOptions& options, const tool::ChartMeter& meter)
{
  std::size_t figures = 0;
  for (const tool::ChartJson& pair : results["pairs"])
  {
    figures += tool::RatePlanner(pair, options.Metric).size();
  }
  char text[200];
  std::snprintf(text, sizeof(text),
    "The planner's %zu points: %.0f %% on the front of all that was measured or within %.0f %% of "
    "its time.\n",
    figures, 100.0 * tool::GetShareWithin(results, options.Metric, Margin), 100.0 * Margin);
  tool::PrintOut(tool::FormatCount(results["pairs"].size(), "pair") + " in " + options.Folder +
                 ": summary.png, setup.png, memory.png, one of each pair, results.csv, "
                 "results.json\nErrors are those of " +
                 meter.DescribePixels() + ".\n" + text);
}

//------------------------------------------------------------------------------
const tool::Metric& FindMetric(const std::string& name)
{
  const std::vector<tool::Metric>& metrics = tool::GetMetrics();
  return *std::find_if(metrics.begin(), metrics.end(),
    [&name](const tool::Metric& metric) { return metric.Name == name; });
}

//------------------------------------------------------------------------------
// As the results keep it.
nlohmann::ordered_json DescribeLimit(int pixels)
{
  return pixels > 0 ? nlohmann::ordered_json(pixels) : nlohmann::ordered_json("all");
}

//------------------------------------------------------------------------------
void Run(const ChartOptions& options)
{
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestChartedPicture);
  const tool::View view = tool::ParseView(options.View);
  const std::vector<std::string> methods =
    options.Methods.empty() ? ListMethods() : options.Methods;
  for (const double tolerance : options.Tolerances)
  {
    if (!(tolerance >= 1e-3 && tolerance <= 1.0)) // also not a number
    {
      throw tool::UsageError("--tolerances: " + tool::FormatNumber(tolerance) +
                             " is not between 0.001 and 1, like 0.02");
    }
  }
  const std::vector<tool::ChartSize> sizes =
    tool::ListChartSizes(methods, options.Tolerances, options.Sweep == "full", options.ForView);
  if (!(options.Slowest > 0.0))
  {
    throw tool::UsageError(
      "--slowest: " + tool::FormatNumber(options.Slowest) + " is not a time above 0 in ms");
  }
  tool::MakeFolder(options.Folder);
  tool::CheckWritable(options.Folder + "/results.json");
  const tool::Interruptible interruptible;
  const std::vector<tool::Material> materials =
    LoadMaterials(options.Files.empty() ? DefaultMaterials : options.Files);
  const auto environments = LoadEnvironments(options.Environments);

  const tool::ChartScene scene = {
    options.Mesh.empty() ? tool::MakeSphere() : tool::LoadMesh(options.Mesh), view, size,
    options.ReferencePixels > 0 ? options.ReferencePixels : std::numeric_limits<int>::max(),
    options.Rounds, options.Slowest
  };
  tool::ChartMeter meter(scene, sizes);
  nlohmann::ordered_json machine = tool::DescribeMachine();
  machine.update(meter.DescribeRenderer());
  const nlohmann::ordered_json settings = { { "methods", Join(methods) },
    { "sweep", options.Sweep }, { "tolerances", JoinTolerances(options.Tolerances) },
    { "mesh", options.Mesh.empty() ? "sphere" : options.Mesh }, { "size", options.Size },
    { "view", options.View }, { "reference_pixels", DescribeLimit(options.ReferencePixels) },
    { "rounds", options.Rounds }, { "slowest", options.Slowest }, { "for_view", options.ForView } };
  tool::ChartJson results = tool::LoadResults(options.Folder, settings, machine);

  const tool::Metric& metric = FindMetric(options.Metric);
  MeasureAll(ListTasks(materials, environments, meter, results, options.Folder), meter, results,
    metric, options.Folder);
  for (const tool::Summary& summary : tool::Summaries)
  {
    tool::DrawPage(tool::MakeSummaryPage(results, metric, summary),
      options.Folder + "/" + summary.File + ".png");
  }
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
      "Tolerances whose plans are marked, with commas between them, from 0.001 to 1 (default " +
        JoinTolerances(options->Tolerances) + ")")
    ->delimiter(',')
    ->allow_extra_args(false);
  command
    ->add_option(
      "--sweep", options->Sweep, "small (default): a few sizes of each method; full: all of them")
    ->check(CLI::IsMember({ "small", "full" }));
  std::vector<std::string> metrics;
  for (const Metric& metric : GetMetrics())
  {
    if (metric.IsError)
    {
      metrics.push_back(metric.Name);
    }
  }
  command
    ->add_option("--metric", options->Metric,
      "Error that the charts show (default relative_l1); the tables hold all: " + Join(metrics))
    ->check(CLI::IsMember(metrics));
  command->add_option("--mesh", options->Mesh,
    "Mesh to show it on: ply, stl, obj, vtp, vtk, gltf, glb or 'ball-on-foot' (default: a sphere)");
  command->add_option(
    "--size", options->Size, "Picture size in pixels, WIDTHxHEIGHT (default 500x500)");
  command->add_option("--view", options->View,
    "Where to look from, AZIMUTH,ELEVATION[,ANGLE] in degrees, as for render (default 30,20)");
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
  command->add_option("--slowest", options->Slowest,
    "Leave out sizes whose frames would take longer than this, in ms (default 2000)");
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
