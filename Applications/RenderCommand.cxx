// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Meshes.h"
#include "Picture.h"
#include "Progress.h"
#include "Scene.h"
#include "Sizes.h"
#include "Thesis.h"
#include "Tool.h"

#include "vtkVersion.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace
{
struct Options
{
  std::string File;
  std::string Environment;
  std::string Mesh;
  std::string Method = "light-set";
  std::string Size = "800x800";
  std::string View = "30,20";
  std::string Background;
  double Exposure = 0.0;
  std::string Output;
  std::string Report;
  tool::LightSetOptions Lights;
  tool::ThesisOptions Thesis;
};

// Frames that frame_ms is the median of.
constexpr int NumberOfFrames = 21;
// PNG pictures are rendered at this multiple and averaged, up to a size that every driver takes.
constexpr int Smooth = 2;
constexpr int LargestSize = 8192;

//------------------------------------------------------------------------------
double Median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

//------------------------------------------------------------------------------
// Encoding of display light as the mapper writes it.
double EncodeGamma(double linear) { return std::pow(linear, 1.0 / 2.2); }

//------------------------------------------------------------------------------
void WritePicture(
  const Options& options, tool::Scene& scene, vtkEnvironment* environment, const tool::Size& size)
{
  const bool png = tool::Extension(options.Output) == ".png";
  const int factor = png && Smooth * std::max(size.Width, size.Height) <= LargestSize ? Smooth : 1;
  tool::Picture picture = scene.Render(factor * size.Width, factor * size.Height);
  const double exposure = std::exp2(options.Exposure);
  if (options.Background == "environment" || (options.Background.empty() && png))
  {
    tool::ComposeOver(picture, scene, tool::Backdrop(environment), exposure);
  }
  else
  {
    for (std::size_t k = 0; k < picture.Pixels.size(); ++k)
    {
      picture.Pixels[k] *= k % 4 == 3 ? 1.0f : static_cast<float>(exposure);
    }
  }
  if (!png)
  {
    tool::WriteEXR(options.Output, picture);
    return;
  }
  for (float& value : picture.Pixels)
  {
    value = std::min(value, 1.0f); // before averaging: smooth edges next to highlights
  }
  tool::WritePNG(options.Output, tool::Downsample(picture, factor), EncodeGamma);
}

//------------------------------------------------------------------------------
void Run(const Options& options, const CLI::App* command)
{
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestSize);
  const tool::View view = tool::ParseView(options.View);
  const std::string extension = tool::Extension(options.Output);
  if (extension != ".png" && extension != ".exr")
  {
    throw tool::UsageError(options.Output + ": the picture must end in .png or .exr");
  }
  options.Lights.Check();
  options.Thesis.Check(command, options.Method);

  tool::Material material = tool::LoadMaterial(options.File);
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);
  const vtkSmartPointer<vtkPolyData> mesh =
    options.Mesh.empty() ? tool::MakeSphere() : tool::LoadMesh(options.Mesh);

  const auto begin = std::chrono::steady_clock::now();
  tool::Representation representation;
  if (options.Method == "thesis")
  {
    const tool::Interruptible interruptible;
    representation = tool::RepresentAsThesis(material, options.Thesis);
    material.BRDF = representation.BRDF;
  }
  tool::Scene scene;
  scene.SetMesh(mesh);
  scene.SetMaterial(material.BRDF);
  scene.SetLight(environment, options.Lights);
  scene.SetView(view.Azimuth, view.Elevation, 0.9);
  if (!options.Report.empty())
  {
    scene.Render(size.Width, size.Height);
    const double setup =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    std::vector<double> frames;
    for (int k = 0; k < NumberOfFrames; ++k)
    {
      frames.push_back(scene.TimeFrame());
    }
    nlohmann::ordered_json report = { { "frame_ms", Median(frames) }, { "setup_ms", setup },
      { "texture_bytes", scene.GetTextureBytes() }, { "method", options.Method },
      { "lights", options.Lights.Count }, { "lights_in_use", scene.GetNumberOfLights() },
      { "light_set", options.Lights.Method }, { "soft_lights", options.Lights.Soft },
      { "width", size.Width }, { "height", size.Height }, { "frames", NumberOfFrames },
      { "material", material.Name }, { "environment", environment->GetName() },
      { "renderer", scene.GetRendererName() }, { "vtk", vtkVersion::GetVTKVersion() } };
    if (options.Method == "thesis")
    {
      report["representation"] = representation.Kind;
      report["representation_form"] = representation.Description;
      report["reason"] = representation.Reason;
    }
    tool::WriteText(options.Report,
      report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
  WritePicture(options, scene, environment, size);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddRenderCommand(CLI::App& app)
{
  auto options = std::make_shared<Options>();
  CLI::App* command =
    app.add_subcommand("render", "Render a mesh of the material under an environment");
  command->add_option("FILE", options->File, MaterialHelp)->required();
  command->add_option("--environment", options->Environment, EnvironmentHelp)->required();
  AddProjectionOption(command);
  command->add_option("--mesh", options->Mesh,
    "Mesh to show it on: ply, stl, obj, vtp, vtk, gltf or glb (default: a sphere). Smooth normals "
    "are made where it has none");
  command
    ->add_option("--method", options->Method,
      "light-set (default): a sum over lights that stand for the environment; thesis: the same "
      "with "
      "the material in a basis or, where that rings, as a D-BRDF fit")
    ->check(CLI::IsMember({ "light-set", "thesis" }));
  options->Lights.AddTo(command, "--lights");
  options->Lights.AddSoftTo(command);
  options->Thesis.AddTo(command);
  command->add_option(
    "--size", options->Size, "Picture size in pixels, WIDTHxHEIGHT (default 800x800)");
  command->add_option("--view", options->View,
    "Where to look from, AZIMUTH,ELEVATION in degrees: azimuth 0 is from +z, 90 from +x; elevation "
    "is above the horizon (default 30,20)");
  command->add_option("--exposure", options->Exposure,
    "Brighten (or darken) the picture by so many stops; default 0: physical values as they are");
  command
    ->add_option("--background", options->Background,
      "environment or none (default: environment in .png, none, with alpha 0, in .exr)")
    ->check(CLI::IsMember({ "environment", "none" }));
  command
    ->add_option("-o,--output", options->Output,
      "Picture to write: .png (8 bit, as displayed) or .exr (linear float RGBA)")
    ->required();
  command->add_option("--report", options->Report,
    "JSON file to write: frame_ms (median), setup_ms, texture_bytes, method, lights, renderer, "
    "vtk; of --method thesis the representation and the reason too");
  command->footer("Example:\n  measured-brdf render gold-paint --environment sky --lights 256 "
                  "-o gold.png\n\nNeeds OpenGL; without a screen, put 'xvfb-run -a' before it.");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
