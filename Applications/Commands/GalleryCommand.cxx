// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Meshes.h"
#include "Picture.h"
#include "Progress.h"
#include "Scenes.h"
#include "Sheets.h"
#include "Tool.h"

#include "vtkEmbeddedMaterials.h"
#include "vtkRadianceIntegrator.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

namespace
{
struct GalleryOptions
{
  std::vector<std::string> Files;
  std::string Environment = "sky";
  std::string Size = "1920x1200";
  std::string Output;
};

constexpr int LargestSheet = 8192;
constexpr int TileSmooth = 2; // tiles are rendered at this multiple and averaged

//------------------------------------------------------------------------------
// Embedded materials of many kinds.
std::vector<std::string> ChooseEmbedded()
{
  static const char* const chosen[] = { "blue-fabric", "pink-felt", "gold-paint",
    "green-metallic-paint", "violet-rubber", "nickel", "cherry-235", "blue-car-paint" };
  std::vector<std::string> names;
  for (const char* name : chosen)
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
// Columns for n tiles so that they come out near square.
int ChooseColumns(int n, int width, int height)
{
  int best = 1;
  double bestSide = 0.0;
  for (int columns = 1; columns <= n; ++columns)
  {
    const int rows = (n + columns - 1) / columns;
    const double side =
      std::min(static_cast<double>(width) / columns, static_cast<double>(height) / rows);
    if (side > bestSide)
    {
      bestSide = side;
      best = columns;
    }
  }
  return best;
}

//------------------------------------------------------------------------------
// Sizes of the caption below a picture.
struct Caption
{
  explicit Caption(int tileWidth)
    : Small(std::clamp(tileWidth / 34, 9, 40))
    , Large(Small * 7 / 4)
    , Height(Small * 13 / 2)
  {
  }
  int Small; // font of the source
  int Large; // font of the name
  int Height;
};

//------------------------------------------------------------------------------
// Name, kind and source in the box (x, y) to (x + width, y + caption.Height).
void DrawCaption(tool::Picture& sheet, int x, int y, int width, const Caption& caption,
  const tool::Material& material)
{
  const int left = x + caption.Small;
  const int room = width - 2 * caption.Small;
  const std::string kind = material.Kind == material.Name ? "" : material.Kind;
  const int kindWidth = kind.empty() ? 0 : tool::MeasureText(kind, caption.Small, false);
  const int top = y + caption.Height;
  const int nameLine = top - caption.Small / 2 - caption.Large;
  tool::DrawText(sheet, left, nameLine,
    tool::Fit(material.Name, caption.Large, true, room - kindWidth - caption.Small), caption.Large,
    true, tool::White);
  tool::DrawText(sheet, left + room - kindWidth, nameLine, kind, caption.Small, false, tool::Gray);
  int line = nameLine - caption.Small * 7 / 4;
  for (const std::string& text :
    tool::Wrap(material.Source.empty() ? material.Format : material.Source, caption.Small, room, 2))
  {
    tool::DrawText(sheet, left, line, text, caption.Small, false, tool::Gray);
    line -= caption.Small * 3 / 2;
  }
}

//------------------------------------------------------------------------------
void Run(const GalleryOptions& options)
{
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestSheet);
  if (tool::Extension(options.Output) != ".png")
  {
    throw tool::UsageError(options.Output + ": the picture must end in .png");
  }
  std::vector<tool::Material> materials;
  for (const std::string& file : options.Files.empty() ? ChooseEmbedded() : options.Files)
  {
    materials.push_back(tool::LoadMaterial(file));
  }
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);

  const int n = static_cast<int>(materials.size());
  const int unit = std::max(8, size.Height / 60);
  const int gap = std::max(2, unit / 3);
  const int header = 3 * unit;
  const int columns = ChooseColumns(n, size.Width, size.Height - header);
  const int rows = (n + columns - 1) / columns;
  const int tileWidth = (size.Width - (columns + 1) * gap) / columns;
  const Caption caption(tileWidth);
  const int tileHeight = (size.Height - header - rows * gap) / rows - caption.Height;
  if (std::min(tileWidth, tileHeight) < 48 ||
      TileSmooth * std::max(tileWidth, tileHeight) > LargestSheet)
  {
    throw tool::UsageError("--size: " + options.Size + " doesn't suit " + std::to_string(n) +
                           " materials: their tiles would be " + std::to_string(tileWidth) + "x" +
                           std::to_string(tileHeight));
  }

  tool::Picture sheet = tool::MakePaper(size.Width, size.Height);
  tool::DrawText(sheet, gap + unit / 2, size.Height - header + unit,
    tool::Fit("Materials under \"" + environment->GetName() + "\"", (5 * unit) / 4, false,
      size.Width - 2 * unit),
    (5 * unit) / 4, false, tool::White);

  const tool::Backdrop backdrop = tool::MakeQuietBackdrop(environment);
  const double exposure = tool::ChooseExposure(environment);
  tool::Scene scene;
  scene.SetMesh(tool::MakeBallOnFoot());
  scene.SetView(25.0, 14.0, 1.02);
  scene.SetLight(environment, nullptr);
  tool::ProgressBar bar("rendering");
  for (int k = 0; k < n; ++k)
  {
    materials[k].BRDF->Prepare();
    scene.SetMaterial(materials[k].BRDF);
    tool::Picture tile = scene.Render(TileSmooth * tileWidth, TileSmooth * tileHeight);
    tool::ComposeOver(tile, scene, backdrop, exposure);
    tool::RollOff(tile);
    tile = tool::Downsample(tile, TileSmooth);
    // The last row stands in the middle where it is not full.
    const int inRow = std::min(columns, n - (k / columns) * columns);
    const int left = (size.Width - inRow * (tileWidth + gap) + gap) / 2;
    const int x = left + (k % columns) * (tileWidth + gap);
    const int top = size.Height - header - (k / columns) * (tileHeight + caption.Height + gap);
    tool::Paste(sheet, tile, x, top - tileHeight);
    DrawCaption(sheet, x, top - tileHeight - caption.Height, tileWidth, caption, materials[k]);
    bar.Update((k + 1.0) / n);
  }
  tool::WritePNG(options.Output, sheet, tool::EncodeSRGB);
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
  command->add_option("--size", options->Size,
    "Size of the whole picture in pixels, WIDTHxHEIGHT (default 1920x1200)");
  command->add_option("-o,--output", options->Output, "PNG picture to write")->required();
  command->footer("Example:\n  measured-brdf gallery --environment studio.exr -o gallery.png\n\n"
                  "The planner chooses a method for each material, for an error of at most 2 %.\n"
                  "The exposure makes a white wall light gray; highlights are compressed.\n"
                  "Needs OpenGL; without a screen, put 'xvfb-run -a' before it.");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
