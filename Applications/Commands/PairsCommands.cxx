// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Figures for pairs of directions in a CSV file: f of a material, and the light that it sends.
#include "Files.h"
#include "Inputs.h"
#include "Methods.h"
#include "Progress.h"
#include "Tool.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace
{
struct PairsOptions
{
  std::string File;
  std::string Environment;
  std::string Pairs;
  std::string Output;
  tool::MethodOptions Method;
};

//------------------------------------------------------------------------------
void RunEvaluate(const PairsOptions& options)
{
  static const tool::PairColumns columns = { "ix", "iy", "iz", "ox", "oy", "oz" };
  const std::vector<tool::Pair> pairs = tool::ReadPairs(options.Pairs, columns);
  const tool::Material material = tool::LoadMaterial(options.File);
  material.BRDF->Prepare();
  std::vector<double> rgb(3 * pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    material.BRDF->Evaluate(pairs[k].data(), pairs[k].data() + 3, &rgb[3 * k]);
  }
  tool::WriteResults(options.Output, columns, pairs, rgb);
}

//------------------------------------------------------------------------------
void RunIntegrate(PairsOptions& options, const CLI::App* command)
{
  static const tool::PairColumns columns = { "nx", "ny", "nz", "vx", "vy", "vz" };
  options.Method.Check(command);
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
  const auto integrator = tool::MakeIntegrator(options.Method, material, environment);
  tool::WriteResults(
    options.Output, columns, pairs, tool::IntegratePairs(integrator, normals, views));
}

//------------------------------------------------------------------------------
void AddFiles(
  CLI::App* command, PairsOptions& options, const std::string& columns, const std::string& results)
{
  command->add_option("FILE", options.File, tool::GetMaterialHelp())->required();
  command
    ->add_option("--pairs", options.Pairs,
      "CSV file with the columns " + columns +
        ". Other columns and lines that start with # are ignored")
    ->required();
  command->add_option("-o,--output", options.Output,
    "CSV file to write: the six columns and r,g,b of " + results + " (default: standard output)");
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddEvaluateCommand(CLI::App& app)
{
  auto options = std::make_shared<PairsOptions>();
  CLI::App* command =
    app.add_subcommand("evaluate", "Look up a material's BRDF for pairs of directions");
  AddFiles(command, *options,
    "ix,iy,iz (towards the light) and ox,oy,oz (towards the viewer) in the surface's frame: z is "
    "the normal",
    "f(i,o) in 1/sr, linear Rec. 709, without the cosine");
  command->footer("Example:\n  measured-brdf evaluate gold-paint --pairs pairs.csv -o values.csv");
  command->callback([options]() { RunEvaluate(*options); });
}

//------------------------------------------------------------------------------
void AddIntegrateCommand(CLI::App& app)
{
  auto options = std::make_shared<PairsOptions>();
  CLI::App* command = app.add_subcommand(
    "integrate", "Compute the light a material sends to the viewer under an environment");
  AddFiles(command, *options,
    "nx,ny,nz (surface normal) and vx,vy,vz (from the surface to the viewer) in world coordinates, "
    "y up",
    "the outgoing radiance, linear Rec. 709");
  command->add_option("--environment", options->Environment, EnvironmentHelp)->required();
  AddProjectionOption(command);
  options->Method.Method = "reference";
  options->Method.AddTo(command, true, false);
  command->footer("Example:\n  measured-brdf integrate gold-paint --environment sky --pairs nv.csv "
                  "--method reference");
  command->callback([options, command]() { RunIntegrate(*options, command); });
}
} // namespace tool
