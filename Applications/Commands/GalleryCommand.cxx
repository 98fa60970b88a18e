// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Inputs.h"
#include "Meshes.h"
#include "Options.h"
#include "Progress.h"
#include "Scenes.h"
#include "Sheets.h"
#include "Tool.h"

#include "vtkEmbeddedMaterials.h"
#include "vtkRadianceIntegrator.h"

#include <cmath>
#include <memory>

namespace
{
struct GalleryOptions
{
  std::vector<std::string> Files;
  std::string Environment = "sky";
  std::string Output;
  int Tile = 480;
};

constexpr int TileSmooth = 2; // tiles are rendered at this multiple and averaged

//------------------------------------------------------------------------------
// Embedded materials of many kinds.
std::vector<std::string> ChooseEmbedded()
{
  std::vector<std::string> names;
  for (const char* name : { "blue-fabric", "pink-felt", "gold-paint", "green-metallic-paint",
         "violet-rubber", "nickel", "cherry-235", "blue-car-paint" })
  {
    for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
    {
      if (vtkEmbeddedMaterials::GetName(k) == name) // some builds have no car paint
      {
        names.emplace_back(name);
      }
    }
  }
  return names;
}

//------------------------------------------------------------------------------
void Run(const GalleryOptions& options)
{
  std::vector<tool::Material> materials;
  for (const std::string& file : options.Files.empty() ? ChooseEmbedded() : options.Files)
  {
    materials.push_back(tool::LoadMaterial(file));
  }
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);
  const tool::Backdrop backdrop = tool::MakeQuietBackdrop(environment);
  const int count = static_cast<int>(materials.size());
  const int columns = static_cast<int>(std::ceil(std::sqrt(1.6 * count))); // wider than high
  tool::ContactSheet sheet("Materials under \"" + environment->GetName() + "\"",
    std::min(columns, count), (count + columns - 1) / columns, options.Tile, options.Tile);
  tool::Scene scene;
  scene.SetMesh(tool::MakeBallOnFoot());
  scene.SetView({ 25.0, 14.0 }, 1.02);
  scene.SetLight(environment, nullptr);
  tool::ProgressBar bar("rendering");
  for (int k = 0; k < count; ++k)
  {
    const tool::Material& material = materials[static_cast<std::size_t>(k)];
    material.BRDF->Prepare();
    scene.Mapper->SetBRDF(material.BRDF);
    tool::Picture tile = scene.Render(TileSmooth * options.Tile, TileSmooth * options.Tile);
    tool::ComposeOver(tile, scene, backdrop, tool::ChooseExposure(environment));
    tool::RollOff(tile);
    const bool hasKind = !material.Kind.empty() && material.Kind != material.Name;
    sheet.Add(k % columns, k / columns, tool::Downsample(tile, TileSmooth), material.Name,
      (hasKind ? material.Kind + "; " : "") +
        (material.Source.empty() ? material.Format : material.Source));
    bar.Update((k + 1.0) / count);
  }
  sheet.Write(options.Output);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddGalleryCommand(CLI::App& app)
{
  auto options = std::make_shared<GalleryOptions>();
  CLI::App* command =
    app.add_subcommand("gallery", "Make one labelled picture of several materials");
  command->add_option("FILE", options->Files,
    std::string("Materials, each as in the other commands: ") + GetMaterialHelp() +
      ". Default: a choice of the embedded ones");
  command->add_option(
    "--environment", options->Environment, std::string(EnvironmentHelp) + " (default)");
  AddProjectionOption(command);
  command->add_option("--tile", options->Tile, "Size of each picture in pixels (default 480)")
    ->check(CLI::Range(48, 2048));
  command->add_option("-o,--output", options->Output, "PNG picture to write")
    ->check(EndsIn({ ".png" }))
    ->required();
  command->footer("Example:\n  measured-brdf gallery --environment studio.exr -o gallery.png\n\n"
                  "The planner chooses a method for each material, for an error of at most 2 %.\n"
                  "The exposure makes a white wall light gray; highlights are compressed.\n"
                  "Needs OpenGL; without a screen, put 'xvfb-run -a' before it.");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
