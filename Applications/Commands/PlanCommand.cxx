// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Inputs.h"
#include "Meshes.h"
#include "Methods.h"
#include "Progress.h"
#include "Scenes.h"
#include "Tool.h"
#include "TracedSurface.h"
#include "vtkOcclusionPredictor.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace
{
struct PlanCommandOptions
{
  std::string File;
  std::string Environment;
  tool::PlanOptions Plan;
  std::string Mesh;
  std::string Size = "500x500";
  std::string View = "30,20";
  bool ChoiceOnly = false;
  bool JSON = false;
};

constexpr int LargestPlannedPicture = 8192;
// Share of the picture's smaller side that the mesh takes, as in the other commands.
constexpr double PlannedFill = 0.9;

//------------------------------------------------------------------------------
// occlusion: null where no mesh is given.
std::string GetText(vtkRadiancePlanner* planner, vtkOcclusionPredictor* occlusion)
{
  return planner->GetPlan() + (occlusion ? "; " + occlusion->GetText() : "");
}

//------------------------------------------------------------------------------
void PrintJSON(vtkRadiancePlanner* planner, vtkOcclusionPredictor* occlusion,
  const std::string& material, vtkEnvironment* environment)
{
  nlohmann::ordered_json candidates = nlohmann::ordered_json::array();
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    candidates.push_back({ { "method", planner->GetMethodName(k) },
      { "sizes", planner->GetDescription(k) }, { "predicted_error", planner->GetPredictedError(k) },
      { "predicted_picture_error", planner->GetPredictedPictureError(k) },
      { "cost", planner->GetPredictedCost(k) },
      { "predicted_percentile_95", planner->GetPredictedPercentile95(k) },
      { "predicted_percentile_99", planner->GetPredictedPercentile99(k) },
      { "texture_bytes", planner->GetTextureBytes(k) },
      { "setup_ms", planner->GetSetUpMilliseconds(k) } });
  }
  nlohmann::ordered_json plan = { { "material", material },
    { "environment", environment->GetName() }, { "tolerance", planner->GetErrorTolerance() },
    { "candidates", candidates }, { "choice", planner->GetChoice() },
    { "interactive_choice", planner->GetInteractiveChoice() },
    { "meets_tolerance", planner->GetMeetsTolerance() }, { "reason", planner->GetReason() },
    { "plan", GetText(planner, occlusion) } };
  if (occlusion)
  {
    plan["unoccluded_error"] = occlusion->GetError();
    plan["unoccluded_uncertainty"] = occlusion->GetUncertainty();
    plan["needs_occlusion"] = vtkOcclusionPredictor::IsWorthModeling(occlusion->GetError(),
      planner->GetPredictedError(planner->GetChoice()), planner->GetErrorTolerance());
  }
  tool::PrintOut(plan.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

//------------------------------------------------------------------------------
void PrintTable(vtkRadiancePlanner* planner, vtkOcclusionPredictor* occlusion)
{
  char line[160];
  std::snprintf(line, sizeof(line), "  %-10s %-46s %8s %8s %8s %8s %8s %9s\n", "method", "sizes",
    "error %", "95 % of", "99 % of", "cost", "MB", "set-up ms");
  std::string text = line;
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    std::snprintf(line, sizeof(line), "%c %-10s %-46s %8.3g %8.3g %8.3g %8.4g %8.3g %9.3g\n",
      k == planner->GetChoice() ? '>' : ' ', planner->GetMethodName(k).c_str(),
      planner->GetDescription(k).c_str(), 100.0 * planner->GetPredictedError(k),
      100.0 * planner->GetPredictedPercentile95(k), 100.0 * planner->GetPredictedPercentile99(k),
      planner->GetPredictedCost(k), 1e-6 * static_cast<double>(planner->GetTextureBytes(k)),
      planner->GetSetUpMilliseconds(k));
    text += line;
  }
  tool::PrintOut(text + "\n" + GetText(planner, occlusion) + "\n");
}

//------------------------------------------------------------------------------
void Run(PlanCommandOptions& options, const CLI::App* command)
{
  options.Plan.Check();
  options.Plan.All = !options.ChoiceOnly;
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestPlannedPicture);
  const tool::View view = tool::ParseView(options.View);
  for (const char* name : { "--size", "--view" })
  {
    if (command->count(name) > 0 && !options.Plan.ForView)
    {
      tool::PrintNote(std::string(name) + " has no effect without --for-view");
    }
  }
  const tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);
  const vtkSmartPointer<vtkPolyData> mesh =
    options.Mesh.empty() ? tool::MakeSphere() : tool::LoadMesh(options.Mesh);
  tool::VisiblePairs seen;
  if (options.Plan.ForView)
  {
    tool::Scene scene;
    scene.SetMesh(mesh);
    scene.SetView(view.Azimuth, view.Elevation, PlannedFill);
    scene.SetMaterial(material.BRDF);
    scene.Look(size.Width, size.Height, seen);
  }
  const vtkSmartPointer<vtkRadiancePlanner> planner =
    tool::MakePlan(material, environment, options.Plan, options.Plan.ForView ? &seen : nullptr);
  vtkSmartPointer<vtkOcclusionPredictor> occlusion;
  if (!options.Mesh.empty())
  {
    occlusion = tool::PredictOcclusion(tool::MakeTracedScene(mesh), material.BRDF, environment);
  }
  if (options.JSON)
  {
    PrintJSON(planner, occlusion, material.Name, environment);
    return;
  }
  PrintTable(planner, occlusion);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddPlanCommand(CLI::App& app)
{
  auto options = std::make_shared<PlanCommandOptions>();
  CLI::App* command = app.add_subcommand(
    "plan", "Show how a material under an environment would be rendered, and why");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  command->add_option("--environment", options->Environment, EnvironmentHelp)->required();
  AddProjectionOption(command);
  options->Plan.AddTo(command);
  options->Plan.AddForViewTo(command);
  command->add_option("--mesh", options->Mesh,
    "Also predict the error of leaving out what this mesh hides of the environment; with "
    "--for-view, "
    "plan for it: ply, stl, obj, vtp, vtk, gltf, glb or 'ball-on-foot' (default: a sphere)");
  command->add_option("--size", options->Size,
    "With --for-view, the picture's size in pixels, WIDTHxHEIGHT (default 500x500)");
  command->add_option("--view", options->View,
    "With --for-view, where to look from, AZIMUTH,ELEVATION[,ANGLE] in degrees, as for render "
    "(default "
    "30,20)");
  command->add_flag("--choice-only", options->ChoiceOnly,
    "Try only the candidates that the renderer tries before it chooses (takes a second instead of "
    "many)");
  command->add_flag("--json", options->JSON, "Write JSON instead of text");
  command->footer("Prints a table of the candidates, the cheapest first: error relative to the "
                  "mean radiance over a sphere (with\n--for-view, over the picture), what 95 and "
                  "99 % of the pixels stay within, cost of a pixel (times a\ntable's), texture "
                  "memory, and set-up time. > marks the choice. --for-view needs "
                  "OpenGL.\n\nExample:\n  "
                  "measured-brdf plan gold-paint --environment hall --tolerance 0.02");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
