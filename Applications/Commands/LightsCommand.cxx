// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Options.h"
#include "Sheets.h"
#include "Tool.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace
{
struct LightsOptions
{
  std::string Environment;
  std::string Output;
  std::string Preview;
  tool::LightSetOptions Lights;
};

constexpr int PreviewWidth = 1024;

//------------------------------------------------------------------------------
std::string FormatLights(vtkLightSet* lights)
{
  std::string text = "x,y,z,r,g,b\n";
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    double direction[3];
    double irradiance[3];
    lights->GetDirection(k, direction);
    lights->GetIrradiance(k, irradiance);
    for (const double value :
      { direction[0], direction[1], direction[2], irradiance[0], irradiance[1], irradiance[2] })
    {
      text += tool::FormatNumber(value) + ",";
    }
    text.back() = '\n';
  }
  return text;
}

//------------------------------------------------------------------------------
void Run(const LightsOptions& options)
{
  options.Lights.Check();
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);
  const vtkSmartPointer<vtkLightSet> lights = tool::MakeLightSet(environment, options.Lights);
  if (lights->GetNumberOfLights() < options.Lights.Count)
  {
    tool::PrintNote(std::to_string(lights->GetNumberOfLights()) + " lights instead of " +
                    std::to_string(options.Lights.Count) + ": the environment has no more to give");
  }
  tool::WriteWhole(options.Output, FormatLights(lights));
  if (!options.Preview.empty())
  {
    tool::WritePNG(options.Preview,
      tool::DrawLightMap(
        environment, lights, !options.Lights.IsImportance(), PreviewWidth, PreviewWidth),
      tool::EncodeSRGB);
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddLightsCommand(CLI::App& app)
{
  auto options = std::make_shared<LightsOptions>();
  CLI::App* command =
    app.add_subcommand("lights", "Turn an environment into a set of directional lights");
  command->add_option("ENV", options->Environment, EnvironmentHelp)->required();
  AddProjectionOption(command);
  options->Lights.AddTo(command, "--count");
  command
    ->add_option("-o,--output", options->Output,
      "CSV file to write: x,y,z (towards the light, y up) and r,g,b (irradiance on a surface that "
      "faces it) per light")
    ->required();
  command
    ->add_option("--preview", options->Preview,
      "PNG picture to write: the tone-mapped map with the lights and their regions (importance "
      "sampling has no regions)")
    ->check(EndsIn({ ".png" }));
  command->footer("Example:\n  measured-brdf lights studio.exr --count 64 -o lights.csv "
                  "--preview lights.png");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
