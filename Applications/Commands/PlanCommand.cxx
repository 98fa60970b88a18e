// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Inputs.h"
#include "JsonReport.h"
#include "Methods.h"
#include "Options.h"
#include "Progress.h"
#include "Scenes.h"
#include "Tool.h"
#include "TracedSurface.h"
#include "vtkOcclusionPredictor.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <memory>

namespace
{
struct PlanCommandOptions
{
  std::string File;
  tool::Stage Stage;
  tool::PlanOptions Plan;
  bool ChoiceOnly = false;
  bool JSON = false;
};

constexpr int LargestPlannedPicture = 8192;

// occlusion: null where no mesh is given.
//------------------------------------------------------------------------------
nlohmann::ordered_json Describe(vtkRadiancePlanner* planner, vtkOcclusionPredictor* occlusion,
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
    { "plan", planner->GetPlan() + (occlusion ? "; " + occlusion->GetText() : "") } };
  if (occlusion)
  {
    plan["unoccluded_error"] = occlusion->GetError();
    plan["unoccluded_uncertainty"] = occlusion->GetUncertainty();
    plan["needs_occlusion"] = vtkOcclusionPredictor::IsWorthModeling(occlusion->GetError(),
      planner->GetPredictedError(planner->GetChoice()), planner->GetErrorTolerance());
  }
  return plan;
}

//------------------------------------------------------------------------------
void Run(PlanCommandOptions& options, const CLI::App* command)
{
  options.Plan.All = !options.ChoiceOnly;
  for (const char* name : { "--size", "--view" })
  {
    if (command->count(name) > 0 && !options.Plan.ForView)
    {
      tool::PrintNote(std::string(name) + " has no effect without --for-view");
    }
  }
  const tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const vtkSmartPointer<vtkEnvironment> environment =
    tool::LoadEnvironment(options.Stage.EnvironmentFile);
  const vtkSmartPointer<vtkPolyData> mesh = options.Stage.LoadMesh();
  tool::VisiblePairs seen;
  if (options.Plan.ForView)
  {
    tool::Scene scene;
    options.Stage.Place(scene, mesh);
    scene.Mapper->SetBRDF(material.BRDF);
    scene.Look(options.Stage.Size.Width, options.Stage.Size.Height, seen);
  }
  const vtkSmartPointer<vtkRadiancePlanner> planner =
    tool::MakePlan(material, environment, options.Plan, options.Plan.ForView ? &seen : nullptr);
  vtkSmartPointer<vtkOcclusionPredictor> occlusion;
  if (!options.Stage.MeshFile.empty())
  {
    occlusion = tool::PredictOcclusion(tool::MakeTracedScene(mesh), material.BRDF, environment);
  }
  nlohmann::ordered_json plan = Describe(planner, occlusion, material.Name, environment);
  if (!options.JSON)
  {
    for (std::size_t k = 0; k < plan["candidates"].size(); ++k)
    {
      nlohmann::ordered_json row = { { ">", plan["choice"] == k ? ">" : "" } };
      row.update(plan["candidates"][k]);
      plan["candidates"][k] = row;
    }
  }
  tool::PrintReport(plan, options.JSON);
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
  options->Plan.AddTo(command, true);
  options->Stage.AddTo(command, LargestPlannedPicture,
    "Also predict the error of leaving out what this mesh hides of the environment; with "
    "--for-view, plan for it and for --size and --view");
  command->add_flag("--choice-only", options->ChoiceOnly,
    "Try only the candidates that the renderer tries before it chooses (takes a second instead of "
    "many)");
  command->add_flag("--json", options->JSON, "Write JSON instead of text");
  command->footer(
    "Prints the candidates, the cheapest first: error relative to the mean radiance over a sphere\n"
    "(with --for-view, over the picture), cost of a pixel (times a table's), what 95 and 99 % of "
    "the\npixels stay within, texture memory, and set-up time. > marks the choice. --for-view "
    "needs "
    "OpenGL.\n\nExample:\n  measured-brdf plan gold-paint --environment hall --tolerance 0.02");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
