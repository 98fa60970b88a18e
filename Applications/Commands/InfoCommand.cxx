// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Inputs.h"
#include "Inspection.h"
#include "JsonReport.h"
#include "Meshes.h"
#include "Tool.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>

using nlohmann::ordered_json;

namespace
{
struct InfoOptions
{
  std::string File;
  bool Json = false;
};

//------------------------------------------------------------------------------
void Run(const InfoOptions& options)
{
  const bool isMesh = tool::IsMeshFile(options.File);
  const ordered_json info = isMesh ? tool::InspectMesh(options.File)
                                   : tool::InspectMaterial(tool::LoadMaterial(options.File));
  tool::PrintReport(info, options.Json);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddInfoCommand(CLI::App& app)
{
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
    app.add_subcommand("info", "Describe a material: format, sizes, range, albedo per angle, "
                               "reciprocity, bad values; or a mesh: "
                               "what it hides of the environment");
  command
    ->add_option("FILE", options->File,
      GetMaterialHelp() + "; or a mesh: ply, stl, obj, vtp, vtk, gltf, glb or 'ball-on-foot'")
    ->required();
  command->add_flag("--json", options->Json, "Write JSON instead of text");
  command->footer("Example:\n  measured-brdf info gold-paint");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
