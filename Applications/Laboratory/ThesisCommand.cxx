// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Measuring.h"
#include "Meshes.h"
#include "Methods.h"
#include "Progress.h"
#include "Scenes.h"
#include "Sheets.h"
#include "Tool.h"

#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace
{
struct ThesisCommandOptions
{
  std::vector<std::string> Files;
  std::vector<std::string> Environments = { "hall", "sky" };
  std::string Specular = "gold-metallic-paint3";
  std::string Output;
  int Tile = 240;
  int Order = 8;
};

constexpr int Smooth = 2;       // tiles are rendered at this multiple and averaged
constexpr int Lights = 64;      // the thesis's and Debevec's number
constexpr double Noise = 0.001; // of the simulated camera, relative to full scale
constexpr int Bits = 14;

// The thesis's gallery (3.3) and the embedded materials that stand for it: MERL's closest samples
// (it has no foil, silk or velvet, and no magenta plastic that is not mirror-like), named for what
// they are.
struct Figure
{
  const char* Thesis;
  const char* Name;
};
constexpr Figure Figures[] = { { "blue synthetic fabric", "blue-fabric" },
  { "blue silk", "pink-fabric2" }, { "chocolate foil", "gold-metallic-paint3" },
  { "gold dust paint", "gold-paint" }, { "teal paint", "green-metallic-paint" },
  { "magenta plastic", "violet-rubber" }, { "red velvet", "red-fabric2" } };

//------------------------------------------------------------------------------
// A material as the thesis shows it, and what to call it.
struct Exhibit
{
  vtkSmartPointer<vtkBRDF> BRDF;
  std::string Name;
  std::string Note;
};

//------------------------------------------------------------------------------
// The paper of an embedded fit; the format's name of a file.
std::string GetOrigin(const tool::Material& material)
{
  for (const char* paper : { "Low et al. 2012", "Ngan et al. 2005" })
  {
    if (material.Source.find(paper) != std::string::npos)
    {
      return std::string("fit of ") + paper;
    }
  }
  return material.Format;
}

//------------------------------------------------------------------------------
// Mean |a - b| / mean b over the pixels that both cover.
double GetPictureDifference(const tool::Picture& a, const tool::Picture& b)
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < a.Pixels.size(); ++k)
  {
    if (k % 4 < 3 && a.Pixels[k / 4 * 4 + 3] > 0.0f && b.Pixels[k / 4 * 4 + 3] > 0.0f)
    {
      difference += std::abs(a.Pixels[k] - b.Pixels[k]);
      sum += b.Pixels[k];
    }
  }
  return difference / sum;
}

//------------------------------------------------------------------------------
// Measured by the simulated device and continued over the hemisphere where its basis suits; the
// D-BRDF fit else.
Exhibit MakeExhibit(const tool::Material& material, const std::string& standsFor, int order)
{
  Exhibit exhibit;
  exhibit.Name = material.Name;
  const std::string begin = standsFor.empty() ? "" : "For the thesis's " + standsFor + ". ";
  const tool::Advice advice = tool::Advise(material.BRDF, order);
  if (advice.IsBasis)
  {
    laboratory::AcquisitionOptions device;
    device.Order = order;
    device.Noise = Noise;
    device.Bits = Bits;
    const laboratory::Extrapolation whole = laboratory::Extrapolate(
      laboratory::Acquire(material.BRDF, device, laboratory::ShowProgress(material.Name)).Stack);
    if (whole.IsAccepted)
    {
      exhibit.BRDF = whole.Output;
      exhibit.Note = begin + "Simulated acquisition (zonal, order " + std::to_string(order) +
                     ") of the " + GetOrigin(material);
      return exhibit;
    }
  }
  exhibit.BRDF = laboratory::FitDistribution(material.BRDF, material.Name);
  exhibit.Note = begin + "D-BRDF of the " + GetOrigin(material) + "; basis residual " +
                 tool::FormatPercent(advice.InZoneResidual);
  return exhibit;
}

//------------------------------------------------------------------------------
tool::Picture Finish(tool::Picture tile, const tool::OffscreenScene& scene,
  const tool::Backdrop& backdrop, double exposure)
{
  tool::ComposeOver(tile, scene, backdrop, exposure);
  tool::RollOff(tile);
  return tool::Downsample(tile, Smooth);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkLightSetRadianceIntegrator> MakeLoop(
  vtkEnvironment* environment, const tool::LightSetOptions& options)
{
  auto loop = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  loop->SetLightSet(tool::MakeLightSet(environment, options));
  return loop;
}

/// What a figure shows at one of its places.
struct Tile
{
  tool::Picture Shown;
  std::string Name;
  std::string Note;
};

//------------------------------------------------------------------------------
void DrawFigure(const std::string& path, const std::string& title, int columns, int rows, int width,
  int height, const std::function<Tile(int column, int row)>& draw)
{
  tool::ContactSheet sheet(title, columns, rows, width, height);
  tool::ProgressBar bar(title);
  for (int k = 0; k < columns * rows; ++k)
  {
    tool::Interruptible::Check();
    const Tile tile = draw(k % columns, k / columns);
    sheet.Add(k % columns, k / columns, tile.Shown, tile.Name, tile.Note);
    bar.Update((k + 1.0) / (columns * rows));
  }
  sheet.Write(path);
}

//------------------------------------------------------------------------------
class Gallery
{
public:
  Gallery(const ThesisCommandOptions& options)
    : Settings(options)
    , Specular(tool::LoadMaterial(options.Specular))
  {
    for (const std::string& name : options.Environments)
    {
      this->Environments.push_back(tool::LoadEnvironment(name));
    }
  }

  // 3.3: the materials, a row for each environment.
  void DrawMaterials(const std::string& path)
  {
    std::vector<Exhibit> exhibits;
    for (const std::string& file : this->Settings.Files)
    {
      exhibits.push_back(MakeExhibit(tool::LoadMaterial(file), "", this->Settings.Order));
    }
    for (const Figure& figure : Figures)
    {
      if (this->Settings.Files.empty())
      {
        exhibits.push_back(
          MakeExhibit(tool::LoadMaterial(figure.Name), figure.Thesis, this->Settings.Order));
      }
    }
    tool::Scene scene;
    scene.SetMesh(tool::MakeBallOnFoot());
    scene.SetView({ 25.0, 14.0 }, 1.02);
    DrawFigure(path,
      "Thesis 3.3: materials under " + std::to_string(Lights) +
        " median-cut lights, basis pair or D-BRDF",
      static_cast<int>(exhibits.size()), static_cast<int>(this->Environments.size()),
      this->Settings.Tile, this->Settings.Tile,
      [&](int column, int row)
      {
        vtkEnvironment* environment = this->Environments[static_cast<std::size_t>(row)];
        const Exhibit& exhibit = exhibits[static_cast<std::size_t>(column)];
        scene.SetLight(environment, MakeLoop(environment, { Lights }));
        scene.Mapper->SetBRDF(exhibit.BRDF);
        return Tile{ Finish(this->Render(scene), scene, tool::MakeQuietBackdrop(environment),
                       tool::ChooseExposure(environment)),
          exhibit.Name, exhibit.Note };
      });
  }

  // 2.3.4: harmonics of growing order on a specular material, the exact picture, its D-BRDF fit.
  void DrawRinging(const std::string& path)
  {
    std::vector<Exhibit> exhibits = { { this->Specular.BRDF, "exact: " + this->Specular.Name,
      "" } };
    for (const int order : { 2, 4, 6, 8, 12 })
    {
      const auto basis = laboratory::ProjectOnto(this->Specular.BRDF,
        vtkBasisBRDF::SPHERICAL_HARMONICS, order, tool::DeviceZone, this->Specular.Name);
      exhibits.push_back({ basis, "harmonics, order " + std::to_string(order),
        std::to_string((order + 1) * (order + 1)) + " functions, " });
    }
    exhibits.push_back(
      { laboratory::FitDistribution(this->Specular.BRDF, this->Specular.Name), "D-BRDF fit", "" });

    vtkEnvironment* environment = this->Environments.front();
    const auto many = MakeLoop(environment, { Lights });
    vtkNew<vtkLightSet> light;
    const double direction[3] = { 0.61, 0.61, 0.5 };
    const double irradiance[3] = { 1.0, 1.0, 1.0 };
    light->AddLight(direction, irradiance);
    vtkNew<vtkLightSetRadianceIntegrator> one;
    one->SetLightSet(light);
    tool::Scene scene;
    scene.SetMesh(tool::MakeSphere());
    scene.SetView({ 25.0, 14.0 }, 0.9);
    tool::Picture reference(1, 1);
    DrawFigure(path,
      "Thesis 2.3.4: a global basis rings on specular materials; one light above, " +
        std::to_string(Lights) + " below",
      static_cast<int>(exhibits.size()), 2, this->Settings.Tile, this->Settings.Tile,
      [&](int column, int row)
      {
        const Exhibit& exhibit = exhibits[static_cast<std::size_t>(column)];
        scene.SetLight(environment, row == 0 ? one.Get() : many.Get());
        scene.Mapper->SetBRDF(exhibit.BRDF);
        const tool::Picture picture = this->Render(scene);
        reference = column == 0 ? picture : reference;
        tool::Backdrop ground = tool::MakeQuietBackdrop(environment);
        ground.Factor *= row == 0 ? 0.0 : 1.0;
        return Tile{ Finish(
                       picture, scene, ground, row == 0 ? 1.2 : tool::ChooseExposure(environment)),
          exhibit.Name,
          column == 0 ? "the material itself"
                      : exhibit.Note + "image error " +
                          tool::FormatPercent(GetPictureDifference(picture, reference)) };
      });
  }

  // 3.2.2 and 3.2.3: both generators at 16, 64 and 256 lights, on the map and on the object.
  void DrawLights(const std::string& path)
  {
    const int tile = this->Settings.Tile;
    vtkEnvironment* environment = this->Environments.front();
    tool::Scene scene;
    scene.SetMesh(tool::MakeBallOnFoot());
    scene.SetView({ 25.0, 14.0 }, 1.02);
    scene.Mapper->SetBRDF(this->Specular.BRDF);
    DrawFigure(path, "Thesis 3.2: median cut (above) and importance sampling (below)", 3, 2,
      3 * tile, tile,
      [&](int column, int row)
      {
        const tool::LightSetOptions options{ 16 << 2 * column,
          row == 0 ? "median-cut" : "importance" };
        const vtkSmartPointer<vtkLightSet> lights = tool::MakeLightSet(environment, options);
        const tool::Picture map = tool::DrawLightMap(environment, lights, row == 0, 2 * tile, tile);
        scene.SetLight(environment, MakeLoop(environment, options));
        tool::Picture both = tool::MakePaper(3 * tile, tile);
        tool::Paste(both, map, 0, (tile - map.Height) / 2);
        tool::Paste(both,
          Finish(this->Render(scene), scene, tool::MakeQuietBackdrop(environment),
            tool::ChooseExposure(environment)),
          2 * tile, 0);
        return Tile{ both,
          std::to_string(options.Count) + " lights, " +
            (row == 0 ? "median cut" : "importance sampling"),
          environment->GetName() + "; " + this->Specular.Name };
      });
  }

private:
  tool::Picture Render(tool::Scene& scene) const
  {
    return scene.Render(Smooth * this->Settings.Tile, Smooth * this->Settings.Tile);
  }

  const ThesisCommandOptions& Settings;
  tool::Material Specular;
  std::vector<vtkSmartPointer<vtkEnvironment>> Environments;
};

//------------------------------------------------------------------------------
void RunThesis(const ThesisCommandOptions& options)
{
  tool::MakeFolder(options.Output);
  const tool::Interruptible interruptible;
  Gallery gallery(options);
  gallery.DrawLights(options.Output + "/lights.png");
  gallery.DrawRinging(options.Output + "/ringing.png");
  gallery.DrawMaterials(options.Output + "/materials.png");
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddThesisCommand(CLI::App& app)
{
  auto options = std::make_shared<ThesisCommandOptions>();
  CLI::App* command = app.add_subcommand("thesis",
    "Draw the thesis's figures: its seven materials, ringing, median cut and importance sampling");
  command->add_option("FILE", options->Files,
    std::string("Materials for the gallery, each as in the other commands: ") + GetMaterialHelp() +
      ". Default: the embedded ones that stand for the thesis's");
  command->add_option("--environment", options->Environments,
    std::string(EnvironmentHelp) + "; a row each when given again (default: hall and sky)");
  AddProjectionOption(command);
  command->add_option("--specular", options->Specular,
    "Material of the ringing series and of the light sets (default gold-metallic-paint3, a "
    "foil-like one)");
  command->add_option("--order", options->Order, "Order of the zonal basis (default 8)")
    ->check(CLI::Range(1, static_cast<int>(vtkBasisBRDF::MaximumOrder)));
  command->add_option("--tile", options->Tile, "Size of a picture in pixels (default 240)")
    ->check(CLI::Range(32, 1024));
  command
    ->add_option(
      "-o,--output", options->Output, "Folder for materials.png, ringing.png and lights.png")
    ->required();
  command->footer("Example:\n  measured-brdf-lab thesis -o output/thesis\n\n"
                  "Needs OpenGL; without a screen, put 'xvfb-run -a' before it.");
  command->callback([options]() { RunThesis(*options); });
}
} // namespace tool
