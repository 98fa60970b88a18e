// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Methods.h"
#include "Progress.h"
#include "Surface.h"
#include "Tool.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace
{
struct IntegrateOptions
{
  std::string File;
  std::string Environment;
  std::string Pairs;
  std::string On = "cpu";
  std::string Output;
  tool::MethodOptions Method;
};

//------------------------------------------------------------------------------
void Run(IntegrateOptions& options, const CLI::App* command)
{
  static const tool::PairColumns columns = { "nx", "ny", "nz", "vx", "vy", "vz" };
  options.Method.Check(command);
  if (options.On == "gpu" && tool::IsOnCpuOnly(options.Method.Method))
  {
    throw tool::UsageError("--on gpu: --method " + options.Method.Method + " runs on the CPU only");
  }
  tool::Interruptible interruptible;
  const std::vector<tool::Pair> pairs = tool::ReadPairs(options.Pairs, columns);
  const tool::Material material = tool::LoadMaterial(options.File);
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);
  std::vector<double> normals;
  std::vector<double> views;
  for (const tool::Pair& pair : pairs)
  {
    normals.insert(normals.end(), pair.begin(), pair.begin() + 3);
    views.insert(views.end(), pair.begin() + 3, pair.end());
  }
  tool::Method method = tool::MakeMethod(options.Method, material, environment);
  if (!method.Integrator)
  {
    method.Planner = tool::MakePlan(material, environment, options.Method.Plan);
    method.Integrator =
      vtkSmartPointer<vtkRadianceIntegrator>::Take(method.Planner->NewIntegrator());
  }
  const auto integrate = options.On == "gpu" ? tool::DrawPairs : tool::IntegratePairs;
  tool::WriteResults(options.Output, columns, pairs, integrate(method.Integrator, normals, views));
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddIntegrateCommand(CLI::App& app)
{
  auto options = std::make_shared<IntegrateOptions>();
  CLI::App* command = app.add_subcommand(
    "integrate", "Compute the light a material sends to the viewer under an environment");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  command->add_option("--environment", options->Environment, EnvironmentHelp)->required();
  AddProjectionOption(command);
  command
    ->add_option("--pairs", options->Pairs,
      "CSV file with the columns nx,ny,nz (surface normal) and vx,vy,vz (from the surface to the "
      "viewer) in world coordinates, y up. Other columns and lines that start with # are ignored")
    ->required();
  options->Method.Method = "reference";
  options->Method.AddTo(command, true);
  command
    ->add_option("--on", options->On,
      "Where to compute it: cpu (default), or gpu, by the renderer's shader (not with --method "
      "exact)")
    ->check(CLI::IsMember({ "cpu", "gpu" }));
  command->add_option("-o,--output", options->Output,
    "CSV file to write: the six columns and r,g,b of the outgoing radiance, linear Rec. 709 "
    "(default: standard output)");
  command->footer("Example:\n  measured-brdf integrate gold-paint --environment sky --pairs nv.csv "
                  "--method reference");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
