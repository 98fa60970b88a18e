// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "MaterialMapFiles.h"
#include "Meshes.h"
#include "Program.h"
#include "Progress.h"
#include "Scenes.h"
#include "Stability.h"
#include "Tool.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

namespace
{
using tool::stability::Case;
using tool::stability::Context;
using tool::stability::Finding;

struct StabilityOptions
{
  std::string File;
  std::string Environment;
  std::vector<std::string> Cases;
  bool Short = false;
  std::string Output;
};

//------------------------------------------------------------------------------
// The wanted cases in their own order. Names are of cases or of groups.
std::vector<Case> Select(const std::vector<std::string>& names)
{
  std::string known;
  std::string group;
  std::vector<Case> wanted;
  std::set<std::string> unknown(names.begin(), names.end());
  for (const Case& one : tool::stability::GetCases())
  {
    known += one.Group == group ? ", " : (known.empty() ? "" : "; ") + one.Group + ": ";
    known += one.Name;
    group = one.Group;
    unknown.erase(one.Name);
    unknown.erase(one.Group);
    if (names.empty() || std::count(names.begin(), names.end(), one.Name) > 0 ||
        std::count(names.begin(), names.end(), one.Group) > 0)
    {
      wanted.push_back(one);
    }
  }
  if (!unknown.empty())
  {
    throw tool::UsageError(
      "--case: there is neither a case nor a group '" + *unknown.begin() + "'; " + known);
  }
  return wanted;
}

//------------------------------------------------------------------------------
// A case that breaks down is a case that fails; only Ctrl-C ends the run.
void RunCase(const Case& one, Context& context)
{
  try
  {
    one.Run(context);
  }
  catch (const std::exception& problem)
  {
    tool::Interruptible::Check();
    context.Add("", "broke down", 1.0, 0.0, problem.what());
  }
  const std::string errors = tool::TakeErrorText();
  if (!errors.empty())
  {
    context.Add("", "errors", 1.0, 0.0, errors);
  }
}

//------------------------------------------------------------------------------
std::string FormatRow(const std::string& name, const Finding& finding)
{
  char row[256];
  std::snprintf(row, sizeof(row), "%-18s %-14s %10.3g %10.3g  %-11s  ", name.c_str(),
    finding.Method.c_str(), finding.Value, finding.Threshold, finding.GetStatus().c_str());
  return row + finding.Figure + (finding.Note.empty() ? "" : " (" + finding.Note + ")") + "\n";
}

//------------------------------------------------------------------------------
// Values that are not finite become null.
nlohmann::ordered_json ToJson(const Case& one, const Finding& finding, const std::string& picture)
{
  return { { "name", one.Name }, { "group", one.Group }, { "method", finding.Method },
    { "figure", finding.Figure }, { "value", finding.Value }, { "threshold", finding.Threshold },
    { "known_limit", finding.Bound != finding.Threshold }, { "bound", finding.Bound },
    { "status", finding.GetStatus() }, { "note", finding.Note }, { "picture", picture } };
}

//------------------------------------------------------------------------------
void RunStability(const StabilityOptions& options)
{
  const std::vector<Case> cases = Select(options.Cases);
  const std::filesystem::path folder(options.Output);
  const std::string path = (folder / "stability.json").string();
  tool::MakeFolder(options.Output);
  tool::CheckWritable(path);
  const tool::Interruptible interruptible;
  Context inputs;
  inputs.Short = options.Short;
  if (!options.File.empty())
  {
    inputs.Material = tool::LoadMaterial(options.File).BRDF;
  }
  if (!options.Environment.empty())
  {
    inputs.Light = tool::LoadEnvironment(options.Environment);
  }

  nlohmann::ordered_json findings = nlohmann::ordered_json::array();
  nlohmann::ordered_json seconds;
  std::map<std::string, tool::Picture> pictures;
  std::map<std::string, int> counts;
  tool::PrintOut("CASE               METHOD              VALUE  THRESHOLD  STATUS       FIGURE\n");
  for (const Case& one : cases)
  {
    tool::Interruptible::Check();
    Context context = inputs;
    const auto begin = std::chrono::steady_clock::now();
    {
      tool::ProgressBar bar("case " + std::to_string(seconds.size() + 1) + " of " +
                            std::to_string(cases.size()) + ", " + one.Name);
      bar.Update(static_cast<double>(seconds.size()) / static_cast<double>(cases.size()));
      RunCase(one, context);
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    seconds[one.Name] = std::round(100.0 * taken.count()) / 100.0;
    const std::string picture = context.Shown ? one.Name + ".png" : "";
    if (context.Shown)
    {
      pictures.emplace(picture, *context.Shown);
    }
    for (const Finding& finding : context.Findings)
    {
      tool::PrintOut(FormatRow(one.Name, finding));
      findings.push_back(ToJson(one, finding, picture));
      ++counts[finding.GetStatus()];
    }
  }
  for (const auto& [name, picture] : pictures)
  {
    tool::WritePNG((folder / name).string(), picture, tool::EncodeSRGB);
  }
  tool::Scene window;
  window.SetMesh(tool::MakeSphere());
  window.Open(64, 64);
  const nlohmann::ordered_json machine = tool::DescribeMachine();
  const nlohmann::ordered_json report = { { "version", machine["program"] },
    { "vtk", machine["vtk"] },
    { "machine", machine["processor"].get<std::string>() + ", " + machine["threads"].dump() +
                   " threads, " + machine["system"].get<std::string>() },
    { "renderer", window.GetRendererName() }, { "short", options.Short },
    { "material", options.File.empty() ? "each case's own" : options.File },
    { "environment", options.Environment.empty() ? "each case's own" : options.Environment },
    { "seconds", seconds }, { "cases", findings } };
  tool::WriteWhole(
    path, report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  tool::PrintOut(std::to_string(counts["pass"]) + " pass, " +
                 std::to_string(counts["known limit"]) + " known limits, " +
                 std::to_string(counts["fail"]) + " fail\n");
  if (counts["fail"] > 0)
  {
    throw tool::Error(std::to_string(counts["fail"]) + " figures are beyond their threshold; " +
                      path + " has them all");
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddStabilityCommand(CLI::App& app)
{
  auto options = std::make_shared<StabilityOptions>();
  CLI::App* command = app.add_subcommand(
    "stability", "Provoke every known way to fail, and measure what each method makes of it");
  command->add_option("FILE", options->File,
    GetMaterialHelp() + ". Takes the place of the cases' own where they leave a choice");
  command->add_option("--environment", options->Environment,
    std::string(EnvironmentHelp) + ". Takes the place of the cases' own likewise");
  AddProjectionOption(command);
  command->add_option("--case", options->Cases,
    "Cases or groups of cases to run, by name (default: all); a wrong name lists them");
  command->add_flag(
    "--short", options->Short, "Fewer steps and smaller sizes: a test, not a study");
  command
    ->add_option(
      "-o,--output", options->Output, "Folder for stability.json and the cases' pictures")
    ->required();
  command->footer("Exit status 1 where a figure is beyond its threshold and not a known limit.\n\n"
                  "Example:\n  measured-brdf-lab stability --case temporal -o stability\n\n"
                  "Needs OpenGL; without a screen, put 'xvfb-run -a' before it.");
  command->callback([options]() { RunStability(*options); });
}
} // namespace tool
