// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Lettering.h"
#include "Meshes.h"
#include "Picture.h"
#include "Progress.h"
#include "Scene.h"
#include "Sizes.h"
#include "Tool.h"

#include "vtkEmbeddedMaterials.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace
{
struct Options
{
  std::vector<std::string> Files;
  std::string Environment = "sky";
  std::string Size = "1920x1200";
  std::string Output;
  tool::LightSetOptions Lights;
};

constexpr int LargestSize = 8192;
constexpr int Smooth = 2; // tiles are rendered at this multiple and averaged
constexpr double BlurDegrees = 9.0;
constexpr double BackdropDim = 0.6; // the backdrop steps back behind the objects
constexpr tool::RGB Paper = { 0.013, 0.014, 0.017 };
constexpr tool::RGB White = { 1.0, 1.0, 1.0 };
constexpr tool::RGB Grey = { 0.5, 0.5, 0.52 };

//------------------------------------------------------------------------------
// One embedded material of each of the kinds the thesis shows, then others of new kinds.
std::vector<std::string> ChooseEmbedded()
{
  static const char* const kinds[] = { "fabric", "silk", "foil", "gold paint", "teal paint",
    "magenta plastic", "velvet" };
  constexpr std::size_t wanted = 8;
  const int n = vtkEmbeddedMaterials::GetNumberOfMaterials();
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const char* kind : kinds)
  {
    for (int k = 0; k < n; ++k)
    {
      if (vtkEmbeddedMaterials::GetKind(k) == kind && seen.insert(kind).second)
      {
        names.push_back(vtkEmbeddedMaterials::GetName(k));
      }
    }
  }
  for (int k = 0; k < n && names.size() < wanted; ++k)
  {
    if (seen.insert(vtkEmbeddedMaterials::GetKind(k)).second)
    {
      names.push_back(vtkEmbeddedMaterials::GetName(k));
    }
  }
  return names;
}

//------------------------------------------------------------------------------
// Scale that makes a white diffuse ball's mean brightness under this light a light grey.
double ChooseExposure(vtkEnvironment* environment)
{
  double total[3];
  environment->GetTotal(total);
  const double mean = vtkEnvironment::GetLuminance(total) / (4.0 * vtkMath::Pi());
  return mean > 0.0 ? 0.55 / mean : 1.0;
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
void Paste(tool::Picture& sheet, const tool::Picture& tile, int x0, int y0)
{
  for (int y = 0; y < tile.Height; ++y)
  {
    std::copy_n(tile.At(0, y), 4 * static_cast<std::size_t>(tile.Width), sheet.At(x0, y0 + y));
  }
}

//------------------------------------------------------------------------------
// Name and source at the foot of a tile, on a shade that makes both readable.
void Label(tool::Picture& tile, const tool::Material& material)
{
  const int unit = std::max(8, std::min(tile.Width, tile.Height) / 36);
  const int margin = unit;
  const int room = tile.Width - 2 * margin;
  const std::vector<std::string> source =
    tool::Wrap(material.Source.empty() ? material.Format : material.Source, unit, room, 2);
  const int lines = static_cast<int>(source.size());
  const int height = margin + 2 * unit + (lines * 3 * unit) / 2 + margin;
  for (int y = 0; y < std::min(tile.Height, 2 * height); ++y)
  {
    const double shade = 0.82 * std::clamp(2.0 - 1.6 * y / height, 0.0, 1.0);
    for (int x = 0; x < tile.Width; ++x)
    {
      tile.Blend(x, y, { 0.004, 0.004, 0.006 }, shade * shade);
    }
  }
  int baseline = margin;
  for (int k = lines - 1; k >= 0; --k)
  {
    tool::DrawText(tile, margin, baseline, source[k], unit, false, Grey);
    baseline += (3 * unit) / 2;
  }
  tool::DrawText(tile, margin, baseline + unit / 3, tool::Fit(material.Name, (9 * unit) / 5, room),
    (9 * unit) / 5, true, White);
}

//------------------------------------------------------------------------------
void Run(const Options& options)
{
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestSize);
  if (tool::Extension(options.Output) != ".png")
  {
    throw tool::UsageError(options.Output + ": the picture must end in .png");
  }
  options.Lights.Check();
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
  const int tileHeight = (size.Height - header - rows * gap) / rows;
  if (std::min(tileWidth, tileHeight) < 48 ||
      Smooth * std::max(tileWidth, tileHeight) > LargestSize)
  {
    throw tool::UsageError("--size: " + options.Size + " doesn't suit " + std::to_string(n) +
                           " materials: their tiles would be " + std::to_string(tileWidth) + "x" +
                           std::to_string(tileHeight));
  }

  tool::Picture sheet(size.Width, size.Height);
  for (int y = 0; y < size.Height; ++y)
  {
    for (int x = 0; x < size.Width; ++x)
    {
      sheet.Blend(x, y, Paper, 1.0);
    }
  }
  tool::DrawText(sheet, gap + unit / 2, size.Height - header + unit,
    tool::Fit("Measured materials under \"" + environment->GetName() + "\", " +
                std::to_string(options.Lights.Count) + " lights",
      (5 * unit) / 4, size.Width - 2 * unit),
    (5 * unit) / 4, false, White);

  tool::Backdrop backdrop(environment, BlurDegrees);
  backdrop.Scale(BackdropDim);
  const double exposure = ChooseExposure(environment);
  tool::Scene scene;
  scene.SetMesh(tool::MakeBallOnFoot());
  scene.SetLight(environment, options.Lights);
  scene.SetView(25.0, 16.0, 0.98);
  tool::ProgressBar bar("rendering");
  for (int k = 0; k < n; ++k)
  {
    scene.SetMaterial(materials[k].BRDF);
    tool::Picture tile = scene.Render(Smooth * tileWidth, Smooth * tileHeight);
    tool::ComposeOver(tile, scene, backdrop, exposure);
    for (float& value : tile.Pixels)
    {
      value = static_cast<float>(tool::RollOff(value));
    }
    tile = tool::Downsample(tile, Smooth);
    Label(tile, materials[k]);
    // The last row stands in the middle where it is not full.
    const int inRow = std::min(columns, n - (k / columns) * columns);
    const int left = (size.Width - inRow * (tileWidth + gap) + gap) / 2;
    Paste(sheet, tile, left + (k % columns) * (tileWidth + gap),
      size.Height - header - (k / columns + 1) * (tileHeight + gap) + gap);
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
  auto options = std::make_shared<Options>();
  options->Lights.Count = 256;
  CLI::App* command =
    app.add_subcommand("gallery", "Make one labelled picture of several materials");
  command->add_option("FILE", options->Files,
    std::string("Materials, each as in the other commands: ") + MaterialHelp +
      ". Default: a choice of the embedded ones");
  command->add_option(
    "--environment", options->Environment, std::string(EnvironmentHelp) + " (default)");
  options->Lights.AddTo(command, "--lights");
  command->add_option("--size", options->Size,
    "Size of the whole picture in pixels, WIDTHxHEIGHT (default 1920x1200)");
  command->add_option("-o,--output", options->Output, "PNG picture to write")->required();
  command->footer("Example:\n  measured-brdf gallery --environment studio.exr -o gallery.png\n\n"
                  "The light is scaled so that a white wall would come out light grey, and "
                  "highlights are rolled off.\n"
                  "Needs OpenGL; without a screen, put 'xvfb-run -a' before it.");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
