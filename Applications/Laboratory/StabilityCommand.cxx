// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "MaterialMapFiles.h"
#include "Program.h"
#include "Progress.h"
#include "Stability.h"
#include "Tool.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

using tool::stability::Case;
using tool::stability::Context;
using tool::stability::Finding;

namespace
{
struct StabilityOptions
{
  std::string File;
  std::string Environment;
  std::vector<std::string> Cases;
  bool Short = false;
  std::string Output;
};

/// What a case found.
struct Outcome
{
  const Case* Source;
  std::vector<Finding> Findings;
  std::string Picture; // file name; empty: none
  double Seconds;
};

constexpr char ReportName[] = "stability.json";

//------------------------------------------------------------------------------
// The wanted cases in their own order. Names are of cases or of groups.
std::vector<Case> Select(const std::vector<std::string>& names)
{
  const std::vector<Case> all = tool::stability::GetCases();
  std::string known;
  std::string group;
  for (const Case& one : all)
  {
    known += one.Group == group ? ", " : (known.empty() ? "" : "; ") + one.Group + ": ";
    known += one.Name;
    group = one.Group;
  }
  for (const std::string& name : names)
  {
    if (std::none_of(all.begin(), all.end(),
          [&](const Case& one) { return name == one.Name || name == one.Group; }))
    {
      throw tool::UsageError(
        "--case: there is neither a case nor a group '" + name + "'; " + known);
    }
  }
  std::vector<Case> wanted;
  std::copy_if(all.begin(), all.end(), std::back_inserter(wanted),
    [&](const Case& one)
    {
      return names.empty() || std::count(names.begin(), names.end(), one.Name) > 0 ||
             std::count(names.begin(), names.end(), one.Group) > 0;
    });
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
// The note, and the reason of a known limit that shows.
std::string GetNote(const Finding& finding)
{
  const bool known = finding.GetStatus() == "known limit";
  return finding.Note + (known && !finding.Note.empty() ? "; " : "") + (known ? finding.Why : "");
}

//------------------------------------------------------------------------------
std::string FormatRow(const std::string& name, const Finding& finding)
{
  char row[256];
  std::snprintf(row, sizeof(row), "%-18s %-14s %10.3g %10.3g  %-11s  ", name.c_str(),
    finding.Method.c_str(), finding.Value, finding.Threshold, finding.GetStatus().c_str());
  return row + finding.Figure + (GetNote(finding).empty() ? "" : " (" + GetNote(finding) + ")") +
         "\n";
}

//------------------------------------------------------------------------------
nlohmann::ordered_json MakeReport(
  const StabilityOptions& options, const Context& inputs, const std::vector<Outcome>& outcomes)
{
  const auto bound = [](double value)
  { return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(); };
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const Outcome& outcome : outcomes)
  {
    for (const Finding& finding : outcome.Findings)
    {
      cases.push_back({ { "name", outcome.Source->Name }, { "group", outcome.Source->Group },
        { "method", finding.Method }, { "figure", finding.Figure },
        { "value", bound(finding.Value) }, { "threshold", bound(finding.Threshold) },
        { "known_limit", finding.Bound == finding.Threshold ? nlohmann::ordered_json(false)
                                                            : nlohmann::ordered_json(true) },
        { "bound", bound(finding.Bound) }, { "status", finding.GetStatus() },
        { "note", GetNote(finding) }, { "picture", outcome.Picture } });
    }
  }
  nlohmann::ordered_json seconds;
  for (const Outcome& outcome : outcomes)
  {
    seconds[outcome.Source->Name] = std::round(100.0 * outcome.Seconds) / 100.0;
  }
  const nlohmann::ordered_json machine = tool::DescribeMachine();
  return { { "version", machine["program"] }, { "vtk", machine["vtk"] },
    { "machine", machine["processor"].get<std::string>() + ", " + machine["threads"].dump() +
                   " threads, " + machine["system"].get<std::string>() },
    { "renderer", inputs.Renderer.empty() ? "none: no case drew" : inputs.Renderer },
    { "short", options.Short },
    { "material", options.File.empty() ? "each case's own" : options.File },
    { "environment", options.Environment.empty() ? "each case's own" : options.Environment },
    { "seconds", seconds }, { "cases", cases } };
}

//------------------------------------------------------------------------------
void Run(const StabilityOptions& options)
{
  const std::vector<Case> cases = Select(options.Cases);
  const std::filesystem::path folder(options.Output);
  tool::MakeFolder(options.Output);
  tool::CheckWritable((folder / ReportName).string());
  const tool::Interruptible interruptible;
  Context inputs;
  inputs.Short = options.Short;
  inputs.BRDF = options.File.empty() ? nullptr : tool::LoadMaterial(options.File).BRDF;
  inputs.Environment =
    options.Environment.empty() ? nullptr : tool::LoadEnvironment(options.Environment);

  std::vector<Outcome> outcomes;
  std::vector<std::pair<std::string, tool::Picture>> pictures;
  int counts[3] = { 0, 0, 0 };
  tool::PrintOut("CASE               METHOD              VALUE  THRESHOLD  STATUS       FIGURE\n");
  for (const Case& one : cases)
  {
    tool::Interruptible::Check();
    Context context = inputs;
    const auto begin = std::chrono::steady_clock::now();
    {
      tool::ProgressBar bar("case " + std::to_string(outcomes.size() + 1) + " of " +
                            std::to_string(cases.size()) + ", " + one.Name);
      bar.Update(static_cast<double>(outcomes.size()) / static_cast<double>(cases.size()));
      RunCase(one, context);
    }
    outcomes.push_back({ &one, context.Findings, "",
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() });
    if (context.Shown)
    {
      outcomes.back().Picture = one.Name + ".png";
      pictures.emplace_back(outcomes.back().Picture, *context.Shown);
    }
    inputs.Renderer = context.Renderer;
    for (const Finding& finding : context.Findings)
    {
      tool::PrintOut(FormatRow(one.Name, finding));
      const std::string status = finding.GetStatus();
      ++counts[status == "pass" ? 0 : (status == "fail" ? 2 : 1)];
    }
  }
  for (const auto& [name, picture] : pictures)
  {
    tool::WritePNG((folder / name).string(), picture, tool::EncodeSRGB);
  }
  tool::WriteWhole((folder / ReportName).string(),
    MakeReport(options, inputs, outcomes)
        .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
      "\n");
  tool::PrintOut(std::to_string(counts[0]) + " pass, " + std::to_string(counts[1]) +
                 " known limits, " + std::to_string(counts[2]) + " fail\n");
  if (counts[2] > 0)
  {
    throw tool::Error(std::to_string(counts[2]) + " figures are beyond their threshold; " +
                      (folder / ReportName).string() + " has them all");
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
  command->callback([options]() { Run(*options); });
}
} // namespace tool
